//! Sag: how deep the deepest span hangs below its chord, as a share of its run.
//!
//! It says whether (1) of `docs/theory` is valid there: small-sag theory is usually trusted to 1/8, and holds to about 1/4.

use super::{Description, Found, Measure, Most, Observation, Unit};

/// Sag; see the head of this file.
pub struct SagRatio;

impl Measure for SagRatio {
    fn description(&self) -> Description {
        Description::of_catenaries("sag_ratio", "sag_ratio", "sag over run", Unit::SHARE)
    }

    fn evaluate(&self, seen: &Observation) -> Option<Found> {
        let mut most = Most::default();
        for (_, line) in seen.catenaries() {
            if let Some(sag) = line.sag {
                most.meet(sag, line.site, line.place);
            }
        }
        most.found()
    }
}
