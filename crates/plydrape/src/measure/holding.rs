//! Holding: the load that draws the ply off a pad, across the ply, against the largest one that a pad holds, with a safety.
//!
//! In the catenaries it is the force on the gripper downwards. What presses the pad on the mold does not count.

use super::{Description, Found, Measure, Most, Site, State, Unit, Worth};
use crate::draping::load::loads;
use crate::scene::Scene;

/// Holding; see the head of this file.
pub struct Holding;

impl Measure for Holding {
    fn description(&self) -> Description {
        let own = Description::new("holding", "holding_n", "load across the ply", Unit::NEWTON);
        Description { worth: Worth::Kept, ..own }
    }

    fn limit(&self, scene: &Scene) -> Option<f64> {
        scene.settings.pad.holding_force.map(|force| force / scene.limits.grip_safety)
    }

    fn evaluate(&self, state: &State) -> Option<Found> {
        state.scene.settings.pad.holding_force?;
        let mut most = Most::default();
        for (n, load) in loads(state.scene, state.snapshot).into_iter().enumerate() {
            most.meet(load.vertical.max(0.0), Site::Gripper(n), state.snapshot.positions[n]);
        }
        most.found()
    }
}
