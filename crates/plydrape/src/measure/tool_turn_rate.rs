//! Tool turn rate: how fast the frame of a tool turns in a planned motion, between its samples.

use super::{Description, Measure, Scope, Subject, Unit, Worth};
use crate::scene::Scene;

/// Tool turn rate; see the head of this file.
pub struct ToolTurnRate;

impl Measure for ToolTurnRate {
    fn description(&self) -> Description {
        Description {
            scope: Scope::Whole,
            worth: Worth::Kept,
            subject: Subject::Motion,
            ..Description::new("tool_turn_rate", "tool_turn_rate_deg_s", "tool turn rate", Unit::DEGREE_PER_SECOND)
        }
    }

    fn limit(&self, scene: &Scene) -> Option<f64> {
        scene.tool.as_ref().map(|tool| tool.turn_rate.to_degrees())
    }
}
