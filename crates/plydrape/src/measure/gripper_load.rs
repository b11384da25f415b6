//! Load: what a gripper holds of the ply against gravity; where the ply pushes it up, how hard.

use super::{Bound, Description, Found, Measure, Observation, Unit, Worth};

/// Load; see the head of this file.
pub struct GripperLoad;

impl Measure for GripperLoad {
    fn description(&self) -> Description {
        let own = Description::new("gripper_load", "gripper_load_n", "gripper load", Unit::NEWTON);
        Description { worth: Worth::Kept, ..own }
    }

    fn bound(&self) -> Option<Bound> {
        Some(
            Bound::force("Vertical load that one gripper holds")
                .usually(10.0, "a vacuum cup of 30 mm holds 14 to 28 N across a porous ply"),
        )
    }

    fn evaluate(&self, seen: &Observation) -> Option<Found> {
        seen.most_of_grippers(|gripper| gripper.load().abs()).found()
    }
}
