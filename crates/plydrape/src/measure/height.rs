//! Height of the ply over the mold at the end, as the sheet has it. Catenaries know the ply along lines alone: for their lines
//! `bridging.rs` and `wrinkle.rs` take its place.

use super::{Bound, Description, Found, Measure, Observation, Scope, Unit};
use crate::layup::{Layup, Model};

/// Height of the ply over the mold at the end; see the head of this file.
pub struct Height;

impl Measure for Height {
    fn description(&self) -> Description {
        let own =
            Description::of_sheet("height", "height_mm", "height over the mold", Unit::MILLIMETER);
        Description { scope: Scope::End, ..own }
    }

    fn bound(&self) -> Option<Bound> {
        Some(
            Bound::gap("Height of the ply over the mold at the end").usually(
                5e-4,
                "our choice of what no longer counts as a wrinkle; no source gives it",
            ),
        )
    }

    fn applies(&self, layup: &Layup) -> bool {
        layup.target.is_some()
    }

    fn evaluate(&self, seen: &Observation) -> Option<Found> {
        match seen.state.model {
            Model::Sheet => seen.highest().in_units_of(1e-3),
            Model::Catenaries => None,
        }
    }
}
