//! Force of the sheet on one gripper. It is found on the sheet alone, [`crate::sheet`].

use super::{Description, Measure, Scope, Unit};
use crate::scene::Scene;

/// Force of the sheet on one gripper; see the head of this file.
pub struct GripperForce;

impl Measure for GripperForce {
    fn description(&self) -> Description {
        let own =
            Description::new("gripper_force", "gripper_force_n", "gripper force", Unit::NEWTON);
        Description { scope: Scope::Whole, ..own }
    }

    fn limit(&self, scene: &Scene) -> Option<f64> {
        scene.limits.gripper_force
    }
}
