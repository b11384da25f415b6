//! Wrinkle angle: the steepest angle of the ruck that the slack of a segment makes on the mold (`ply/ruck.rs`).

use super::wrinkle::largest_ruck;
use super::{Description, Found, Measure, Observation, Unit};

/// Wrinkle angle; see the head of this file.
pub struct WrinkleAngle;

impl Measure for WrinkleAngle {
    fn description(&self) -> Description {
        Description::of_catenaries(
            "wrinkle_angle",
            "wrinkle_angle_deg",
            "wrinkle angle",
            Unit::DEGREE,
        )
    }

    fn evaluate(&self, seen: &Observation) -> Option<Found> {
        largest_ruck(seen, |ruck| ruck.steepest().to_degrees()).found()
    }
}
