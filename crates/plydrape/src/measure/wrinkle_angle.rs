//! Wrinkle angle: the steepest angle of the ruck that the slack of a segment makes on the mold (`ply/ruck.rs`).

use super::wrinkle::highest;
use super::{Description, Found, Measure, State, Unit};

/// Wrinkle angle; see the head of this file.
pub struct WrinkleAngle;

impl Measure for WrinkleAngle {
    fn description(&self) -> Description {
        Description::new("wrinkle_angle", "wrinkle_angle_deg", "wrinkle angle", Unit::DEGREE)
    }

    fn evaluate(&self, state: &State) -> Option<Found> {
        highest(state, |ruck| ruck.steepest().to_degrees()).found()
    }
}
