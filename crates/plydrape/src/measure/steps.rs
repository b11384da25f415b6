//! Steps: how far a gripper of a stepwise plan is short of its target when the steps are spent.

use super::{Description, Measure, Scope, Subject, Unit};

/// Steps; see the head of this file.
pub struct Steps;

impl Measure for Steps {
    fn description(&self) -> Description {
        Description {
            scope: Scope::Whole,
            subject: Subject::Motion,
            ..Description::new("steps", "steps", "steps", Unit::MILLIMETRE)
        }
    }
}
