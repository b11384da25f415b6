//! Local strain: the path of a line along a fiber, or of a segment of it, beyond its fabric, as a share of its own length.
//!
//! The contact tolerance ε lets a point of the ply be ε off its place, and so changes a path of length s by up to ε²/2s. In a segment of ten
//! tolerances that alone is 0.5 % of strain: for a shorter segment, ten tolerances take the place of its length.

use super::{Bound, Description, Found, Measure, Most, Observation, Practice, TUNING, Unit};

/// Local strain; see the head of this file.
pub struct Strain;

impl Measure for Strain {
    fn description(&self) -> Description {
        Description::new("strain", "strain", "local strain", Unit::SHARE)
    }

    fn bound(&self) -> Option<Bound> {
        Some(
            Bound::share("Strain of a line along a fiber or of a segment of it")
                .found(Practice::STRETCH)
                .usually(0.005, "our choice: carbon fibers break at some three times that"),
        )
    }

    fn evaluate(&self, seen: &Observation) -> Option<Found> {
        let tolerance = match seen.layup.mold {
            Some(_) => seen.layup.settings.contact.tolerance,
            None => 0.0,
        };
        let mut most = Most::default();
        for line in seen.state.lines.iter().filter(|line| line.is_fiber) {
            let strain = line.overstretch() / line.length.max(TUNING.gauge_length * tolerance);
            most.meet(strain, line.site, line.place);
        }
        most.found()
    }
}
