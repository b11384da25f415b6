//! Landing error: how far a landed point or gripper is from its place in the ideal drape, the larger of
//! `landing_contact.rs` and `landing_gripper.rs`, in every step.

use super::{Found, Measure, Sense, State, Unit};
use super::landing_contact::LandingContact;
use super::landing_gripper::landed_gripper;

/// Landing error; see the head of this file.
pub struct LandingError;

impl Measure for LandingError {
    fn name(&self) -> &'static str {
        "landing_error"
    }

    fn key(&self) -> &'static str {
        "landing_error_mm"
    }

    fn label(&self) -> &'static str {
        "landing error"
    }

    fn unit(&self) -> Unit {
        Unit::MILLIMETRE
    }

    fn evaluate(&self, state: &State) -> Option<Found> {
        let both = [LandingContact.evaluate(state), landed_gripper(state, true)];
        both.into_iter().flatten().reduce(|most, next| if Sense::AtMost.is_worse(next.value, most.value) { next } else { most })
    }
}
