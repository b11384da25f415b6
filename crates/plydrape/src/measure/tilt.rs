//! Tilt: the angle between the ply's normal at a gripper and the vertical.

use super::{Found, Measure, Most, Site, State, Unit, Worth};
use crate::scene::Scene;

/// Tilt; see the head of this file.
pub struct Tilt;

impl Measure for Tilt {
    fn name(&self) -> &'static str {
        "tilt"
    }

    fn key(&self) -> &'static str {
        "tilt_deg"
    }

    fn label(&self) -> &'static str {
        "tilt"
    }

    fn unit(&self) -> Unit {
        Unit::DEGREE
    }

    fn worth(&self) -> Worth {
        Worth::Kept
    }

    fn limit(&self, scene: &Scene) -> Option<f64> {
        Some(scene.limits.tilt.to_degrees())
    }

    fn evaluate(&self, state: &State) -> Option<Found> {
        let mut most = Most::default();
        for (n, attitude) in state.attitudes().iter().enumerate() {
            most.meet(attitude.tilt.to_degrees(), Site::Gripper(n), state.snapshot.positions[n]);
        }
        most.found()
    }
}
