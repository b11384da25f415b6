//! Bridging: the gap between ply and mold between two touches of one edge, of which the model follows one.
//!
//! A diagonal is no fiber: one that landed in another shear than its cell ends with is too short or too long for its place, and spans hollows that
//! the fabric lies in. Its gaps are in its record.

use super::{Bound, Description, Found, Measure, Most, Observation, Scope, Unit};
use crate::layup::Layup;

/// Bridging; see the head of this file.
pub struct Bridging;

impl Measure for Bridging {
    fn description(&self) -> Description {
        let own =
            Description::of_catenaries("bridging", "bridging_mm", "bridging", Unit::MILLIMETER);
        Description { scope: Scope::End, ..own }
    }

    fn bound(&self) -> Option<Bound> {
        Some(Bound::gap("Bridging gap").usually(1e-3, "our choice; no source gives it"))
    }

    fn applies(&self, layup: &Layup) -> bool {
        layup.mold.is_some() && layup.target.is_some()
    }

    fn evaluate(&self, seen: &Observation) -> Option<Found> {
        seen.layup.mold.as_ref()?;
        seen.edges().next()?;
        let mut most = Most::default();
        for (_, line) in seen.edges() {
            if let Some((gap, place)) = line.bridge {
                most.meet(gap, line.site, place);
            }
        }
        Some(most.in_units_of(1e-3).unwrap_or(Found::NONE))
    }
}
