//! Jerk: the largest of a gripper in a planned motion.

use super::{Measure, Scope, Unit, Worth};
use crate::scene::Scene;

/// Jerk; see the head of this file.
pub struct Jerk;

impl Measure for Jerk {
    fn name(&self) -> &'static str {
        "jerk"
    }

    fn label(&self) -> &'static str {
        "jerk"
    }

    fn unit(&self) -> Unit {
        Unit::plain("m/s³")
    }

    fn scope(&self) -> Scope {
        Scope::Whole
    }

    fn worth(&self) -> Worth {
        Worth::Kept
    }

    fn limit(&self, scene: &Scene) -> Option<f64> {
        Some(scene.limits.jerk)
    }
}
