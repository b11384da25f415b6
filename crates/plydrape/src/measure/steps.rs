//! Steps: how far a gripper of a stepwise plan is short of its target when the steps are spent.

use super::{Measure, Scope, Unit};

/// Steps; see the head of this file.
pub struct Steps;

impl Measure for Steps {
    fn name(&self) -> &'static str {
        "steps"
    }

    fn label(&self) -> &'static str {
        "steps"
    }

    fn unit(&self) -> Unit {
        Unit::MILLIMETRE
    }

    fn scope(&self) -> Scope {
        Scope::Whole
    }
}
