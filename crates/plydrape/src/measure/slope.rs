//! Slope: the steepest that a span leaves its end against its own chord, rise over run.
//!
//! It says whether (1) of `docs/theory` is valid there: its curvature is that of small slopes.

use super::{Description, Found, Measure, Most, Site, State, Unit};

/// Slope; see the head of this file.
pub struct Slope;

impl Measure for Slope {
    fn description(&self) -> Description {
        Description::new("slope", "slope", "slope against the chord", Unit::NUMBER)
    }

    fn evaluate(&self, state: &State) -> Option<Found> {
        let mut most = Most::default();
        for span in &state.snapshot.shape.spans {
            if span.profile.is_none() || span.run() <= 0.0 {
                continue;
            }
            let chord = (span.ends[1][2] - span.ends[0][2]) / span.run();
            for (slope, end) in span.slopes.into_iter().zip(span.ends) {
                most.meet((slope - chord).abs(), Site::Catenary(span.catenary), end);
            }
        }
        most.found()
    }
}
