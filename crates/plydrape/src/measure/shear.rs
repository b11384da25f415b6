//! Shear: the largest shear angle of a cell, (6) of `docs/theory`.

use super::{
    Bound, DEGREE, Description, Found, Measure, Most, Observation, Unit, UsualLimit, Worth,
};
use crate::layup::Layup;

/// Shear; see the head of this file.
pub struct Shear;

impl Measure for Shear {
    fn description(&self) -> Description {
        let own = Description::new("shear", "shear_deg", "shear", Unit::DEGREE);
        Description { worth: Worth::Kept, ..own }
    }

    fn bound(&self) -> Option<Bound> {
        Some(
            Bound::angle("Shear angle")
                .follows("the material's locking angle or else 45 deg", 40.0 * DEGREE),
        )
    }

    fn usual_limit(&self, layup: &Layup) -> Option<UsualLimit> {
        match layup.ply.material.locking_angle {
            Some(angle) => UsualLimit::new(angle, "the locking angle of the material"),
            None => UsualLimit::new(
                45_f64.to_radians(),
                "our assumption, because the locking angle of the material is unknown",
            ),
        }
    }

    fn evaluate(&self, seen: &Observation) -> Option<Found> {
        let mut most = Most::default();
        for cell in &seen.state.cells {
            most.meet(cell.shear.to_degrees(), cell.site, cell.place);
        }
        most.found()
    }
}
