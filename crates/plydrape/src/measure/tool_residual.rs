//! Tool residual: the largest distance between where a gripper should be and where the tool brings it.

use super::{Description, Limits, Measure, Scope, Unit, Worth};
use crate::layup::Layup;

/// Tool residual; see the head of this file.
pub struct ToolResidual;

impl Measure for ToolResidual {
    fn description(&self) -> Description {
        let own = Description::new(
            "tool_residual",
            "tool_residual_mm",
            "tool residual",
            Unit::MILLIMETER,
        );
        Description { scope: Scope::Whole, worth: Worth::Kept, ..own }
    }

    fn derived_limit(&self, layup: &Layup, _limits: &Limits) -> Option<f64> {
        Some(1e3 * layup.tool.as_ref()?.residual?)
    }
}
