//! Speed: the largest of a gripper along a motion in time.

use super::{Bound, Description, Found, Measure, Practice, Scope, Unit, WholeMotion, Worth};

/// Speed; see the head of this file.
pub struct Speed;

impl Measure for Speed {
    fn description(&self) -> Description {
        let own = Description::new("speed", "speed", "speed", Unit::plain("m/s"));
        Description { scope: Scope::Motion, worth: Worth::Kept, ..own }
    }

    fn bound(&self) -> Option<Bound> {
        Some(
            Bound::within("Speed of a gripper", [1e-6, 1e2], "a gripper")
                .found(Practice::SPEED)
                .usually(
                    0.25,
                    "our assumption: the speed to which robots are reduced where people are near",
                ),
        )
    }

    fn evaluate_motion(&self, whole: &WholeMotion) -> Option<(Found, Option<f64>)> {
        Some(whole.gripper_peak(whole.peaks.drape.speed))
    }
}
