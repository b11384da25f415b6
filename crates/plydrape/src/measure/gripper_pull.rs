//! Pull: the horizontal force of the ply on a gripper, of spans from gripper to gripper alone.
//!
//! Edges count as for the load (`gripper_load.rs`). With rigid grippers the pull of a taut span is that of the axial stiffness: 0.01 % of stretch
//! are 10 N a line in the paper's ply.

use super::{Description, Found, Measure, Most, Site, State, Unit, Worth};
use crate::draping::load::loads;
use crate::scene::Scene;

/// Pull; see the head of this file.
pub struct GripperPull;

impl Measure for GripperPull {
    fn description(&self) -> Description {
        Description {
            worth: Worth::Kept,
            ..Description::new("gripper_pull", "gripper_pull_n", "gripper pull", Unit::NEWTON)
        }
    }

    fn limit(&self, scene: &Scene) -> Option<f64> {
        scene.limits.gripper_pull
    }

    fn evaluate(&self, state: &State) -> Option<Found> {
        let mut most = Most::default();
        for (n, load) in loads(state.scene, state.snapshot).into_iter().enumerate() {
            let [x, y] = load.pull;
            most.meet(x.hypot(y), Site::Gripper(n), state.snapshot.positions[n]);
        }
        most.found()
    }
}
