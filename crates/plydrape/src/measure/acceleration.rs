//! Acceleration: the largest of a gripper along a motion in time.

use super::{Description, Found, Measure, Scope, Unit, UsualLimit, WholeMotion, Worth};
use crate::layup::Layup;

/// Acceleration; see the head of this file.
pub struct Acceleration;

impl Measure for Acceleration {
    fn description(&self) -> Description {
        let own =
            Description::new("acceleration", "acceleration", "acceleration", Unit::plain("m/s²"));
        Description { scope: Scope::Whole, worth: Worth::Kept, ..own }
    }

    fn usual_limit(&self, _layup: &Layup) -> Option<UsualLimit> {
        UsualLimit::new(
            1.0,
            "our assumption of a robot that carries a light tool, from no data sheet",
        )
    }

    fn evaluate_motion(&self, whole: &WholeMotion) -> Option<(Found, Option<f64>)> {
        Some(whole.gripper_peak(whole.peaks.acceleration))
    }
}
