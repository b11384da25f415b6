//! Landing of grippers: how far a gripper ends from where the ideal drape puts it.
//!
//! It is a limit of rigid grippers alone. Those on mounts are commanded beyond their places on purpose, and the position of
//! the ply says where they have brought it.

use super::{Bound, Description, Found, Measure, Most, Observation, Scope, Unit};
use crate::geometry::distance;
use crate::layup::Layup;
use crate::state::Site;

/// Landing of grippers; see the head of this file.
pub struct LandingGripper;

impl Measure for LandingGripper {
    fn description(&self) -> Description {
        let own = Description::new(
            "landing_gripper",
            "landing_gripper_mm",
            "landing of grippers",
            Unit::MILLIMETER,
        );
        Description { scope: Scope::End, ..own }
    }

    fn bound(&self) -> Option<Bound> {
        Some(Bound::gap("Distance of a rigid gripper from its ideal place at the end").usually(
            5e-4,
            "our choice: it lets a plan remove slack at the landing, which takes hundredths of a millimeter",
        ))
    }

    fn applies(&self, layup: &Layup) -> bool {
        layup.target.is_some() && !layup.settings.pad.gives()
    }

    fn evaluate(&self, seen: &Observation) -> Option<Found> {
        landed_gripper(seen, false)
    }
}

/// The gripper farthest from its target, of all or of those that stand on the mold (mm).
pub(super) fn landed_gripper(seen: &Observation, standing: bool) -> Option<Found> {
    let layup = seen.layup;
    let tolerance = layup.settings.contact.tolerance;
    let stands =
        |place| layup.mold.as_ref().is_some_and(|mold| mold.signed_distance(place) <= tolerance);
    let mut most = Most::default();
    let targets = &layup.target.as_ref()?.grippers;
    for (n, (gripper, target)) in seen.state.grippers.iter().zip(targets).enumerate() {
        // a motion is judged by where the robot is, a landing by where the fabric is
        let place = if standing { gripper.position } else { gripper.commanded };
        if !standing || stands(place) {
            most.meet(distance(place, *target), Site::Gripper(n), place);
        }
    }
    most.in_units_of(1e-3)
}
