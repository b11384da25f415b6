//! Tool turn rate: how fast the frame of a tool turns along a motion in time, between its samples.

use super::{Description, Found, Limits, Measure, Scope, Unit, WholeMotion, Worth};
use crate::layup::Layup;

/// Tool turn rate; see the head of this file.
pub struct ToolTurnRate;

impl Measure for ToolTurnRate {
    fn description(&self) -> Description {
        let own = Description::new(
            "tool_turn_rate",
            "tool_turn_rate_deg_s",
            "tool turn rate",
            Unit::DEGREE_PER_SECOND,
        );
        Description { scope: Scope::Motion, worth: Worth::Kept, ..own }
    }

    fn derived_limit(&self, layup: &Layup, _limits: &Limits) -> Option<f64> {
        layup.tool.as_ref().map(|tool| tool.turn_rate.to_degrees())
    }

    fn evaluate_motion(&self, whole: &WholeMotion) -> Option<(Found, Option<f64>)> {
        whole.tool.map(|peaks| whole.frame_peak(peaks.turn_rate))
    }
}
