//! Jerk: the largest of a gripper in a planned motion.

use super::{Description, Measure, Scope, Subject, Unit, Worth};
use crate::scene::Scene;

/// Jerk; see the head of this file.
pub struct Jerk;

impl Measure for Jerk {
    fn description(&self) -> Description {
        Description {
            scope: Scope::Whole,
            worth: Worth::Kept,
            subject: Subject::Motion,
            ..Description::new("jerk", "jerk", "jerk", Unit::plain("m/s³"))
        }
    }

    fn limit(&self, scene: &Scene) -> Option<f64> {
        Some(scene.limits.jerk)
    }
}
