//! Overstretch as a length: the way of a segment of an edge beyond its fabric.

use super::{Description, Found, Measure, Observation, Unit};
use crate::state::LineState;

/// Overstretch as a length; see the head of this file.
pub struct OverstretchLength;

impl Measure for OverstretchLength {
    fn description(&self) -> Description {
        Description::of_catenaries(
            "overstretch_length",
            "overstretch_mm",
            "overstretch length",
            Unit::MILLIMETER,
        )
    }

    fn evaluate(&self, seen: &Observation) -> Option<Found> {
        seen.most_of_edges(LineState::overstretch).in_units_of(1e-3)
    }
}
