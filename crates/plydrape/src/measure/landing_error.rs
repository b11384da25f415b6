//! Landing error: how far a landed point or gripper is from its place in the ideal drape, the larger of
//! `position.rs` and `landing_gripper.rs`, in every step.

use super::landing_gripper::landed_gripper;
use super::position::Position;
use super::{Description, Found, Measure, Observation, Sense, Unit};

/// Landing error; see the head of this file.
pub struct LandingError;

impl Measure for LandingError {
    fn description(&self) -> Description {
        Description::new("landing_error", "landing_error_mm", "landing error", Unit::MILLIMETER)
    }

    fn evaluate(&self, seen: &Observation) -> Option<Found> {
        let both = [Position.evaluate(seen), landed_gripper(seen, true)];
        both.into_iter().flatten().reduce(|most, next| {
            if Sense::AtMost.is_worse(next.value, most.value) { next } else { most }
        })
    }
}
