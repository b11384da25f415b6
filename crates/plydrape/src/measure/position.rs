//! Position: how far fabric that lies on the mold is from where the ideal drape has it.
//!
//! A diagonal of catenaries is no fiber: where its points land follows from the shear that its cell lands with, which is judged by itself
//! (`landing_shear.rs`), so they have no error here.

use super::{Bound, Description, Found, Measure, Most, Observation, Scope, Unit};
use crate::layup::Layup;

/// Position; see the head of this file.
pub struct Position;

impl Measure for Position {
    fn description(&self) -> Description {
        let own = Description::new(
            "position",
            "position_mm",
            "position of landed points",
            Unit::MILLIMETER,
        );
        Description { scope: Scope::End, ..own }
    }

    fn bound(&self) -> Option<Bound> {
        Some(
            Bound::gap("Distance of landed points of the ply from their ideal places at the end")
                .usually(2e-3, "the tolerance of positions that the project DrapeBot gives, ±2 mm"),
        )
    }

    fn applies(&self, layup: &Layup) -> bool {
        layup.target.is_some()
    }

    fn evaluate(&self, seen: &Observation) -> Option<Found> {
        let mut most = Most::default();
        for point in &seen.state.points {
            if let Some(error) = point.error {
                most.meet(error, point.site, point.place);
            }
        }
        most.in_units_of(1e-3)
    }
}
