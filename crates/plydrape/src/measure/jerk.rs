//! Jerk: the largest of a gripper along a motion in time.

use super::{Bound, Description, Found, Measure, Practice, Scope, Unit, WholeMotion, Worth};

/// Jerk; see the head of this file.
pub struct Jerk;

impl Measure for Jerk {
    fn description(&self) -> Description {
        let own = Description::new("jerk", "jerk", "jerk", Unit::plain("m/s³"));
        Description { scope: Scope::Motion, worth: Worth::Kept, ..own }
    }

    fn bound(&self) -> Option<Bound> {
        Some(
            Bound::within(
                "Jerk of a gripper",
                [1e-6, 1e7],
                "a gripper",
            )
            .found(Practice::JERK)
            .usually(
                10.0,
                "our assumption: the largest acceleration is reached within a tenth of a second",
            ),
        )
    }

    fn evaluate_motion(&self, whole: &WholeMotion) -> Option<(Found, Option<f64>)> {
        Some(whole.gripper_peak(whole.peaks.drape.jerk))
    }
}
