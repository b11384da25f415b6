//! Pull: the horizontal force of the ply on a gripper.

use super::{Bound, Description, Found, Measure, Observation, Unit, Worth};
use crate::state::GripperState;

/// Pull; see the head of this file.
pub struct GripperPull;

impl Measure for GripperPull {
    fn description(&self) -> Description {
        let own = Description::new("gripper_pull", "gripper_pull_n", "gripper pull", Unit::NEWTON);
        Description { worth: Worth::Kept, ..own }
    }

    fn bound(&self) -> Option<Bound> {
        let about =
            "Horizontal pull of the ply at one gripper; a vacuum cup of 30 mm slips at 4 to 10 N";
        Some(Bound::force(about).such_as(4.0))
    }

    fn evaluate(&self, seen: &Observation) -> Option<Found> {
        seen.most_of_grippers(GripperState::pull).found()
    }
}
