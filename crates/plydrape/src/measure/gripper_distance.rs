//! Gripper distance: the smallest distance of any two grippers.

use super::{Description, Found, Measure, Sense, State, Subject, Unit, Worth};
use crate::draping::reach::closest;
use crate::scene::Scene;

/// Gripper distance; see the head of this file.
pub struct GripperDistance;

impl Measure for GripperDistance {
    fn description(&self) -> Description {
        Description {
            sense: Sense::AtLeast,
            worth: Worth::Kept,
            subject: Subject::Motion,
            ..Description::new(
                "gripper_distance",
                "gripper_distance_mm",
                "gripper distance",
                Unit::MILLIMETRE,
            )
        }
    }

    fn limit(&self, scene: &Scene) -> Option<f64> {
        Some(scene.limits.gripper_distance * 1e3)
    }

    fn evaluate(&self, state: &State) -> Option<Found> {
        closest(state.snapshot.commanded())
    }
}
