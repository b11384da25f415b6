//! Overstretch: the way of a free or lying segment of an edge beyond its fabric, as a share of the whole edge.

use super::{Bound, Description, Found, Measure, Observation, Practice, Unit};

/// Overstretch; see the head of this file.
pub struct Overstretch;

impl Measure for Overstretch {
    fn description(&self) -> Description {
        Description::of_catenaries("overstretch", "overstretch", "overstretch", Unit::SHARE)
    }

    fn bound(&self) -> Option<Bound> {
        Some(
            Bound::share("Chord beyond the free length as a share of the edge")
                .found(Practice::STRETCH)
                .usually(0.001, "our choice, of a whole edge; no source gives it"),
        )
    }

    fn evaluate(&self, seen: &Observation) -> Option<Found> {
        seen.most_of_edges(|line| line.overstretch() / line.whole).found()
    }
}
