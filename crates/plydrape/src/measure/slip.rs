//! Slip: the load of the ply on a gripper along the ply, against the largest one that a pad holds, with a safety.
//!
//! In the catenaries it is the horizontal force on the gripper, which is bounded by the slip force where mounts yield, so
//! that a pad under which the fabric slides has a load of exactly that.

use super::{Description, Found, Measure, Most, Site, State, Unit, Worth};
use crate::draping::load::loads;
use crate::scene::Scene;

/// Slip; see the head of this file.
pub struct Slip;

impl Measure for Slip {
    fn description(&self) -> Description {
        let own = Description::new("slip", "slip_n", "load along the ply", Unit::NEWTON);
        Description { worth: Worth::Kept, ..own }
    }

    fn limit(&self, scene: &Scene) -> Option<f64> {
        scene.settings.pad.slip_force.map(|force| force / scene.limits.grip_safety)
    }

    fn evaluate(&self, state: &State) -> Option<Found> {
        state.scene.settings.pad.slip_force?;
        let mut most = Most::default();
        for (n, load) in loads(state.scene, state.snapshot).into_iter().enumerate() {
            let [x, y] = load.pull;
            most.meet(x.hypot(y), Site::Gripper(n), state.snapshot.positions[n]);
        }
        most.found()
    }
}
