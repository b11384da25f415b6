//! Off the mold: how far a target that was given is beyond the mold's boundary or inside it.

use super::{Description, Measure, Scope, Unit};

/// Off the mold; see the head of this file.
pub struct OffMold;

impl Measure for OffMold {
    fn description(&self) -> Description {
        let own = Description::new("off_mold", "off_mold", "off the mold", Unit::MILLIMETER);
        Description { scope: Scope::Whole, ..own }
    }
}
