//! Sensitivity: by how much the height at the end differs between drapes of the same motion with changes that are too small for anyone
//! to know, [`crate::outcome::minute_changes`].
//!
//! Where the ply is about to buckle one way or the other, such a change decides which ridges stay: what one drape says of the motion is
//! an accident then. It may be as large as what is left from the highest of these drapes to the limit of the height, and a tenth of that
//! limit where less is left.

use super::{Description, Limits, Measure, Name, Scope, Unit, Worth};
use crate::layup::Layup;

/// The least limit, as a share of that of the height.
const SHARE: f64 = 0.1;

/// Sensitivity; see the head of this file.
pub struct Sensitivity;

impl Measure for Sensitivity {
    fn description(&self) -> Description {
        let own = Description::of_sheet(
            "sensitivity",
            "sensitivity_mm",
            "range of the height by minute changes",
            Unit::MILLIMETER,
        );
        Description { scope: Scope::Whole, worth: Worth::Kept, ..own }
    }

    fn applies(&self, layup: &Layup) -> bool {
        Name::Height.measure().applies(layup)
    }

    fn derived_limit(&self, layup: &Layup, limits: &Limits) -> Option<f64> {
        Some(SHARE * Name::Height.limit(layup, limits)?)
    }
}
