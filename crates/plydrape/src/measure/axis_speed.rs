//! Axis speed: of the axis of a tool that is nearest to its limit in a planned motion, as a share of that limit.

use super::{Description, Measure, Scope, Subject, Unit, Worth};
use crate::scene::Scene;

/// Axis speed; see the head of this file.
pub struct AxisSpeed;

impl Measure for AxisSpeed {
    fn description(&self) -> Description {
        Description {
            scope: Scope::Whole,
            worth: Worth::Kept,
            subject: Subject::Motion,
            ..Description::new("axis_speed", "axis_speed", "axis speed", Unit::SHARE)
        }
    }

    fn limit(&self, scene: &Scene) -> Option<f64> {
        scene.tool.as_ref().map(|_| 1.0)
    }
}
