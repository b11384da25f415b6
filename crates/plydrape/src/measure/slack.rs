//! Slack: fabric of a free or lying segment of an edge beyond its way.

use super::{Description, Found, Measure, Observation, Unit};
use crate::state::LineState;

/// Slack; see the head of this file.
pub struct Slack;

impl Measure for Slack {
    fn description(&self) -> Description {
        Description::of_catenaries("slack", "slack_mm", "slack", Unit::MILLIMETER)
    }

    fn evaluate(&self, seen: &Observation) -> Option<Found> {
        seen.most_of_edges(LineState::slack).in_units_of(1e-3)
    }
}
