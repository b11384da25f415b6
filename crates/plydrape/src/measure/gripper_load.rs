//! Load: what a gripper holds against gravity, as the ply hangs.
//!
//! Both families of edges have the weight of the whole ply in the model, so each counts half here, and the boundary lines of a family, which
//! stand for half a strip, half of that. A span between two grippers pulls with its vertical force; of a free segment that the mold
//! holds at its other end, the tension is an artifact of the axial stiffness, and half of its weight counts.

use super::{Description, Found, Measure, Most, Site, State, Unit, Worth};
use crate::draping::load::loads;
use crate::scene::Scene;

/// Load; see the head of this file.
pub struct GripperLoad;

impl Measure for GripperLoad {
    fn description(&self) -> Description {
        Description {
            worth: Worth::Kept,
            ..Description::new("gripper_load", "gripper_load_n", "gripper load", Unit::NEWTON)
        }
    }

    fn limit(&self, scene: &Scene) -> Option<f64> {
        Some(scene.limits.gripper_load)
    }

    fn evaluate(&self, state: &State) -> Option<Found> {
        let mut most = Most::default();
        for (n, load) in loads(state.scene, state.snapshot).into_iter().enumerate() {
            most.meet(load.vertical.abs(), Site::Gripper(n), state.snapshot.positions[n]);
        }
        most.found()
    }
}
