//! Landing error: how far a landed point or gripper is from its place in the ideal drape, the larger of
//! `landing_contact.rs` and `landing_gripper.rs`, in every step.

use super::landing_contact::LandingContact;
use super::landing_gripper::landed_gripper;
use super::{Description, Found, Measure, Sense, State, Unit};

/// Landing error; see the head of this file.
pub struct LandingError;

impl Measure for LandingError {
    fn description(&self) -> Description {
        Description::new("landing_error", "landing_error_mm", "landing error", Unit::MILLIMETRE)
    }

    fn evaluate(&self, state: &State) -> Option<Found> {
        let both = [LandingContact.evaluate(state), landed_gripper(state, true)];
        both.into_iter().flatten().reduce(|most, next| {
            if Sense::AtMost.is_worse(next.value, most.value) { next } else { most }
        })
    }
}
