//! Speed: the largest of a gripper in a planned motion.

use super::{Measure, Scope, Unit, Worth};
use crate::scene::Scene;

/// Speed; see the head of this file.
pub struct Speed;

impl Measure for Speed {
    fn name(&self) -> &'static str {
        "speed"
    }

    fn label(&self) -> &'static str {
        "speed"
    }

    fn unit(&self) -> Unit {
        Unit::plain("m/s")
    }

    fn scope(&self) -> Scope {
        Scope::Whole
    }

    fn worth(&self) -> Worth {
        Worth::Kept
    }

    fn limit(&self, scene: &Scene) -> Option<f64> {
        Some(scene.limits.speed)
    }
}
