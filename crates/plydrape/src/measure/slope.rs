//! Slope: the steepest that a span leaves its end against its own chord, rise over run.
//!
//! It says whether (1) of `docs/theory` is valid there: its curvature is that of small slopes.

use super::{Description, Found, Measure, Most, Observation, Unit};

/// Slope; see the head of this file.
pub struct Slope;

impl Measure for Slope {
    fn description(&self) -> Description {
        Description::of_catenaries("slope", "slope", "slope against the chord", Unit::NUMBER)
    }

    fn evaluate(&self, seen: &Observation) -> Option<Found> {
        let mut most = Most::default();
        for (_, line) in seen.catenaries() {
            if let Some(slope) = line.slope {
                most.meet(slope, line.site, line.place);
            }
        }
        most.found()
    }
}
