//! Landing shear error |γ_end − γ_l|: how much the shear of a cell between grippers at the end differs from the one that it had when a
//! diagonal of it landed.
//!
//! A diagonal is no fiber: a cell that lands with a shear other than its last one is in the wrong shape, whichever of its diagonals
//! that leaves too long or too short. Only catenaries follow diagonals.

use super::{Bound, DEGREE, Description, Found, Measure, Most, Observation, Scope, Unit};
use crate::layup::Layup;

/// Landing shear error |γ_end − γ_l|; see the head of this file.
pub struct LandingShear;

impl Measure for LandingShear {
    fn description(&self) -> Description {
        let own = Description::of_catenaries(
            "landing_shear",
            "landing_shear_deg",
            "landing shear error",
            Unit::DEGREE,
        );
        Description { scope: Scope::End, ..own }
    }

    fn bound(&self) -> Option<Bound> {
        let about = "Difference between a cell's shear at the end and when its diagonal landed";
        Some(Bound::angle(about).usually(
            3.0 * DEGREE,
            "our choice: the tolerance of ply angles, for the angle between the fibers of a cell",
        ))
    }

    fn applies(&self, layup: &Layup) -> bool {
        layup.mold.is_some() && layup.target.is_some() && !layup.ply.lines().cells().is_empty()
    }

    fn evaluate(&self, seen: &Observation) -> Option<Found> {
        seen.layup.mold.as_ref()?;
        let mut most = Most::default();
        for cell in &seen.state.cells {
            if let Some(error) = cell.landing_error {
                most.meet(error.to_degrees(), cell.site, cell.place);
            }
        }
        // where catenaries hang and no cell has landed there is no error
        most.found().or_else(|| seen.catenaries().next().map(|_| Found::NONE))
    }
}
