//! Gap: the largest distance of the ply from the mold.

use super::{Description, Found, Measure, Observation, Unit};

/// Gap; see the head of this file.
pub struct Gap;

impl Measure for Gap {
    fn description(&self) -> Description {
        Description::new("gap", "gap_mm", "gap", Unit::MILLIMETER)
    }

    fn evaluate(&self, seen: &Observation) -> Option<Found> {
        seen.layup.mold.as_ref()?;
        Some(seen.highest().in_units_of(1e-3).unwrap_or(Found::NONE))
    }
}
