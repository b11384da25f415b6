//! Off the mold: how far a target that was given is beyond the mold's boundary or inside it.

use super::{Description, Measure, Scope, Subject, Unit};

/// Off the mold; see the head of this file.
pub struct OffMold;

impl Measure for OffMold {
    fn description(&self) -> Description {
        Description {
            scope: Scope::Whole,
            subject: Subject::Motion,
            ..Description::new("off_mold", "off_mold", "off the mold", Unit::MILLIMETRE)
        }
    }
}
