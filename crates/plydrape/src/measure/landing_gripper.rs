//! Landing of grippers: how far a gripper ends from where the ideal drape puts it.
//!
//! It is a limit of rigid grippers alone. Those on mounts are commanded beyond their places on purpose, and the landing of
//! the ply says where they have brought it.

use super::{Description, Found, Measure, Most, Scope, Site, State, Subject, Unit};
use crate::mold::distance;
use crate::scene::Scene;

/// Landing of grippers; see the head of this file.
pub struct LandingGripper;

impl Measure for LandingGripper {
    fn description(&self) -> Description {
        Description {
            scope: Scope::End,
            subject: Subject::Motion,
            ..Description::new(
                "landing_gripper",
                "landing_gripper_mm",
                "landing of grippers",
                Unit::MILLIMETRE,
            )
        }
    }

    fn limit(&self, scene: &Scene) -> Option<f64> {
        let target = scene.target.as_ref().filter(|_| !scene.settings.pad.gives());
        target.map(|_| scene.limits.landing_gripper * 1e3)
    }

    fn evaluate(&self, state: &State) -> Option<Found> {
        landed_gripper(state, false)
    }
}

/// The gripper farthest from its target, of all or of those that stand on the mold (mm).
pub(super) fn landed_gripper(state: &State, standing: bool) -> Option<Found> {
    let (scene, mut most) = (state.scene, Most::default());
    let tolerance = scene.settings.contact.tolerance;
    for (n, target) in scene.target.as_ref()?.grippers.iter().enumerate() {
        // a motion is judged by where the robot is, a landing by where the fabric is
        let at = if standing { &state.snapshot.positions } else { state.snapshot.commanded() };
        let place = at[n];
        let stands =
            |place| scene.mold.as_ref().is_some_and(|m| m.signed_distance(place) <= tolerance);
        if !standing || stands(place) {
            most.meet(distance(place, *target), Site::Gripper(n), place);
        }
    }
    most.in_units_of(1e-3)
}
