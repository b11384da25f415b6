//! Tool turn acceleration: how fast the turning of the frame of a tool changes in a planned motion, between its samples.

use super::{Description, Measure, Scope, Subject, Unit, Worth};
use crate::scene::Scene;

/// Tool turn acceleration; see the head of this file.
pub struct ToolTurnAcceleration;

impl Measure for ToolTurnAcceleration {
    fn description(&self) -> Description {
        Description {
            scope: Scope::Whole,
            worth: Worth::Kept,
            subject: Subject::Motion,
            ..Description::new("tool_turn_acceleration", "tool_turn_acceleration_deg_s2", "tool turn acceleration", Unit::plain("°/s²"))
        }
    }

    fn limit(&self, scene: &Scene) -> Option<f64> {
        scene.tool.as_ref().map(|tool| tool.turn_acceleration.to_degrees())
    }
}
