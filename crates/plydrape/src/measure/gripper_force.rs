//! Gripper force: the force of the ply on one gripper, in whatever direction.

use super::{Bound, Description, Found, Measure, Observation, Unit, Worth};
use crate::geometry::vector::norm;

/// Gripper force; see the head of this file.
pub struct GripperForce;

impl Measure for GripperForce {
    fn description(&self) -> Description {
        let own =
            Description::new("gripper_force", "gripper_force_n", "gripper force", Unit::NEWTON);
        Description { worth: Worth::Kept, ..own }
    }

    fn bound(&self) -> Option<Bound> {
        Some(Bound::force("Force of the ply on one gripper").such_as(15.0))
    }

    fn evaluate(&self, seen: &Observation) -> Option<Found> {
        seen.most_of_grippers(|gripper| norm(gripper.force)).found()
    }
}
