//! Pull: the horizontal force of the ply on a gripper.

use super::{Description, Found, Measure, Observation, Unit, Worth};
use crate::state::GripperState;

/// Pull; see the head of this file.
pub struct GripperPull;

impl Measure for GripperPull {
    fn description(&self) -> Description {
        let own = Description::new("gripper_pull", "gripper_pull_n", "gripper pull", Unit::NEWTON);
        Description { worth: Worth::Kept, ..own }
    }

    fn evaluate(&self, seen: &Observation) -> Option<Found> {
        seen.most_of_grippers(GripperState::pull).found()
    }
}
