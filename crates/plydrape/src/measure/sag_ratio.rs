//! Sag: how deep the deepest span hangs below its chord, as a share of its run.
//!
//! It says whether (1) of `docs/theory` is valid there: small-sag theory is usually trusted to 1/8, and holds to about 1/4.

use super::{Description, Found, Measure, Most, Site, State, Unit};

/// Sag; see the head of this file.
pub struct SagRatio;

impl Measure for SagRatio {
    fn description(&self) -> Description {
        Description::new("sag_ratio", "sag_ratio", "sag over run", Unit::SHARE)
    }

    fn evaluate(&self, state: &State) -> Option<Found> {
        let mut most = Most::default();
        for (span, points) in state.snapshot.shape.spans.iter().zip(state.stations()) {
            if span.profile.is_none() || span.run() <= 0.0 {
                continue;
            }
            let [a, b] = span.ends;
            let last = (points.len() - 1) as f64;
            for (n, point) in points.iter().enumerate() {
                let chord = a[2] + (b[2] - a[2]) * n as f64 / last;
                let sag = (chord - point[2]) / span.run();
                // a sag that is no number stays it
                let sag = if sag <= 0.0 { 0.0 } else { sag };
                most.meet(sag, Site::Catenary(span.catenary), *point);
            }
        }
        most.found()
    }
}
