//! Acceleration: the largest of a gripper in a planned motion.

use super::{Description, Measure, Scope, Subject, Unit, Worth};
use crate::scene::Scene;

/// Acceleration; see the head of this file.
pub struct Acceleration;

impl Measure for Acceleration {
    fn description(&self) -> Description {
        Description {
            scope: Scope::Whole,
            worth: Worth::Kept,
            subject: Subject::Motion,
            ..Description::new("acceleration", "acceleration", "acceleration", Unit::plain("m/s²"))
        }
    }

    fn limit(&self, scene: &Scene) -> Option<f64> {
        Some(scene.limits.acceleration)
    }
}
