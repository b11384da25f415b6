//! Speed: the largest of a gripper in a planned motion.

use super::{Description, Measure, Scope, Subject, Unit, Worth};
use crate::scene::Scene;

/// Speed; see the head of this file.
pub struct Speed;

impl Measure for Speed {
    fn description(&self) -> Description {
        Description {
            scope: Scope::Whole,
            worth: Worth::Kept,
            subject: Subject::Motion,
            ..Description::new("speed", "speed", "speed", Unit::plain("m/s"))
        }
    }

    fn limit(&self, scene: &Scene) -> Option<f64> {
        Some(scene.limits.speed)
    }
}
