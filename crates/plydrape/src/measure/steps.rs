//! Steps: how far a gripper of a stepwise plan is short of its target when the steps are spent.

use super::{Description, Measure, Scope, Unit};

/// Steps; see the head of this file.
pub struct Steps;

impl Measure for Steps {
    fn description(&self) -> Description {
        let own = Description::new("steps", "steps", "steps", Unit::MILLIMETER);
        Description { scope: Scope::Whole, ..own }
    }
}
