//! Acceleration: the largest of a gripper in a planned motion.

use super::{Measure, Scope, Unit, Worth};
use crate::scene::Scene;

/// Acceleration; see the head of this file.
pub struct Acceleration;

impl Measure for Acceleration {
    fn name(&self) -> &'static str {
        "acceleration"
    }

    fn label(&self) -> &'static str {
        "acceleration"
    }

    fn unit(&self) -> Unit {
        Unit::plain("m/s²")
    }

    fn scope(&self) -> Scope {
        Scope::Whole
    }

    fn worth(&self) -> Worth {
        Worth::Kept
    }

    fn limit(&self, scene: &Scene) -> Option<f64> {
        Some(scene.limits.acceleration)
    }
}
