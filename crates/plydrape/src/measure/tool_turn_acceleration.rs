//! Tool turn acceleration: how fast the turning of the frame of a tool changes along a motion in time, between its samples.

use super::{Description, Found, Limits, Measure, Scope, Unit, WholeMotion, Worth};
use crate::layup::Layup;

/// Tool turn acceleration; see the head of this file.
pub struct ToolTurnAcceleration;

impl Measure for ToolTurnAcceleration {
    fn description(&self) -> Description {
        let own = Description::new(
            "tool_turn_acceleration",
            "tool_turn_acceleration_deg_s2",
            "tool turn acceleration",
            Unit::DEGREE_PER_SECOND_SQUARED,
        );
        Description { scope: Scope::Motion, worth: Worth::Kept, ..own }
    }

    fn derived_limit(&self, layup: &Layup, _limits: &Limits) -> Option<f64> {
        layup.tool.as_ref().map(|tool| tool.turn_acceleration.to_degrees())
    }

    fn evaluate_motion(&self, whole: &WholeMotion) -> Option<(Found, Option<f64>)> {
        whole.tool.map(|peaks| whole.frame_peak(peaks.turn_acceleration))
    }
}
