//! Move limit: the straight way of a gripper against the reach of all steps together.

use super::{Measure, Scope, Unit};

/// Move limit; see the head of this file.
pub struct MoveLimit;

impl Measure for MoveLimit {
    fn name(&self) -> &'static str {
        "move_limit"
    }

    fn label(&self) -> &'static str {
        "move limit"
    }

    fn unit(&self) -> Unit {
        Unit::MILLIMETRE
    }

    fn scope(&self) -> Scope {
        Scope::Whole
    }
}
