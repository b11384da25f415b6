//! Tilt: the angle between the ply's normal at a gripper and its stem, which is upright unless a tool turns it.
//!
//! A pad without a joint does not tilt, and the lines of catenaries are not clamped at it: there it is how far they are from the
//! direction of the pad.

use super::{Description, Found, Measure, Most, Site, State, Unit, Worth};
use crate::scene::Scene;

/// Tilt; see the head of this file.
pub struct Tilt;

impl Measure for Tilt {
    fn description(&self) -> Description {
        Description {
            worth: Worth::Kept,
            ..Description::new("tilt", "tilt_deg", "tilt", Unit::DEGREE)
        }
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
