//! Gripper distance: the smallest distance of any two grippers.

use super::{Found, Measure, Sense, State, Unit, Worth};
use crate::draping::reach::closest;
use crate::scene::Scene;

/// Gripper distance; see the head of this file.
pub struct GripperDistance;

impl Measure for GripperDistance {
    fn name(&self) -> &'static str {
        "gripper_distance"
    }

    fn key(&self) -> &'static str {
        "gripper_distance_mm"
    }

    fn label(&self) -> &'static str {
        "gripper distance"
    }

    fn unit(&self) -> Unit {
        Unit::MILLIMETRE
    }

    fn sense(&self) -> Sense {
        Sense::AtLeast
    }

    fn worth(&self) -> Worth {
        Worth::Kept
    }

    fn limit(&self, scene: &Scene) -> Option<f64> {
        Some(scene.limits.gripper_distance * 1e3)
    }

    fn evaluate(&self, state: &State) -> Option<Found> {
        closest(&state.snapshot.positions)
    }
}
