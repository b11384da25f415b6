//! Speed: the largest of a gripper along a motion in time.

use super::{Description, Found, Measure, Scope, Unit, UsualLimit, WholeMotion, Worth};
use crate::layup::Layup;

/// Speed; see the head of this file.
pub struct Speed;

impl Measure for Speed {
    fn description(&self) -> Description {
        let own = Description::new("speed", "speed", "speed", Unit::plain("m/s"));
        Description { scope: Scope::Whole, worth: Worth::Kept, ..own }
    }

    fn usual_limit(&self, _layup: &Layup) -> Option<UsualLimit> {
        UsualLimit::new(
            0.25,
            "our assumption: the speed to which robots are reduced where people are near",
        )
    }

    fn evaluate_motion(&self, whole: &WholeMotion) -> Option<(Found, Option<f64>)> {
        Some(whole.gripper_peak(whole.peaks.speed))
    }
}
