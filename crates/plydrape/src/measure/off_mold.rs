//! Off the mold: how far a target that was given is beyond the mold's boundary or inside it.

use super::{Measure, Scope, Unit};

/// Off the mold; see the head of this file.
pub struct OffMold;

impl Measure for OffMold {
    fn name(&self) -> &'static str {
        "off_mold"
    }

    fn label(&self) -> &'static str {
        "off the mold"
    }

    fn unit(&self) -> Unit {
        Unit::MILLIMETRE
    }

    fn scope(&self) -> Scope {
        Scope::Whole
    }
}
