//! Overstretch: the way of a free or lying segment of an edge beyond its fabric, as a share of the whole edge.

use super::{Description, Found, Measure, Observation, Unit, UsualLimit};
use crate::layup::Layup;

/// Overstretch; see the head of this file.
pub struct Overstretch;

impl Measure for Overstretch {
    fn description(&self) -> Description {
        Description::new("overstretch", "overstretch", "overstretch", Unit::SHARE)
    }

    fn usual_limit(&self, _layup: &Layup) -> Option<UsualLimit> {
        UsualLimit::new(0.001, "our choice, of a whole edge; no source gives it")
    }

    fn evaluate(&self, seen: &Observation) -> Option<Found> {
        seen.most_of_edges(|line| line.overstretch() / line.whole).found()
    }
}
