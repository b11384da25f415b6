//! Tilt: the angle between the ply's normal at a gripper and its stem, which is upright unless a tool turns it.
//!
//! A pad without a joint does not tilt, and a model that does not clamp the ply at it says by the tilt how far the ply is from the
//! direction of the pad.

use super::{Bound, DEGREE, Description, Found, Measure, Observation, Unit, UsualLimit, Worth};
use crate::layup::Layup;

/// Tilt; see the head of this file.
pub struct Tilt;

impl Measure for Tilt {
    fn description(&self) -> Description {
        let own = Description::new("tilt", "tilt_deg", "tilt", Unit::DEGREE);
        Description { worth: Worth::Kept, ..own }
    }

    fn bound(&self) -> Option<Bound> {
        Some(Bound::angle("Gripper tilt").follows("the grippers' `max_tilt`", 35.0 * DEGREE))
    }

    fn usual_limit(&self, layup: &Layup) -> Option<UsualLimit> {
        UsualLimit::new(layup.settings.max_tilt, "the limit of the ball joints")
    }

    fn evaluate(&self, seen: &Observation) -> Option<Found> {
        seen.most_of_grippers(|gripper| gripper.tilt.to_degrees()).found()
    }
}
