//! Jerk: the largest of a gripper along a motion in time.

use super::{Description, Found, Measure, Scope, Unit, UsualLimit, WholeMotion, Worth};
use crate::layup::Layup;

/// Jerk; see the head of this file.
pub struct Jerk;

impl Measure for Jerk {
    fn description(&self) -> Description {
        let own = Description::new("jerk", "jerk", "jerk", Unit::plain("m/s³"));
        Description { scope: Scope::Whole, worth: Worth::Kept, ..own }
    }

    fn usual_limit(&self, _layup: &Layup) -> Option<UsualLimit> {
        UsualLimit::new(
            10.0,
            "our assumption: the largest acceleration is reached within a tenth of a second",
        )
    }

    fn evaluate_motion(&self, whole: &WholeMotion) -> Option<(Found, Option<f64>)> {
        Some(whole.gripper_peak(whole.peaks.jerk))
    }
}
