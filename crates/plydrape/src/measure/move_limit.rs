//! Move limit: the straight way of a gripper against the reach of all steps together.

use super::{Description, Measure, Scope, Unit};

/// Move limit; see the head of this file.
pub struct MoveLimit;

impl Measure for MoveLimit {
    fn description(&self) -> Description {
        let own = Description::new("move_limit", "move_limit", "move limit", Unit::MILLIMETER);
        Description { scope: Scope::Whole, ..own }
    }
}
