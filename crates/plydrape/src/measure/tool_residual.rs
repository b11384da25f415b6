//! Tool residual: the largest distance between where a gripper should be and where the tool brings it.

use super::{Description, Measure, Scope, Subject, Unit, Worth};
use crate::scene::Scene;

/// Tool residual; see the head of this file.
pub struct ToolResidual;

impl Measure for ToolResidual {
    fn description(&self) -> Description {
        Description {
            scope: Scope::Whole,
            worth: Worth::Kept,
            subject: Subject::Motion,
            ..Description::new("tool_residual", "tool_residual_mm", "tool residual", Unit::MILLIMETRE)
        }
    }

    fn limit(&self, scene: &Scene) -> Option<f64> {
        Some(1e3 * scene.tool.as_ref()?.residual?)
    }
}
