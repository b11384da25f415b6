//! Acceleration: the largest of a gripper along a motion in time.

use super::{Bound, Description, Found, Measure, Practice, Scope, Unit, WholeMotion, Worth};

/// Acceleration; see the head of this file.
pub struct Acceleration;

impl Measure for Acceleration {
    fn description(&self) -> Description {
        let own =
            Description::new("acceleration", "acceleration", "acceleration", Unit::plain("m/s²"));
        Description { scope: Scope::Motion, worth: Worth::Kept, ..own }
    }

    fn bound(&self) -> Option<Bound> {
        Some(
            Bound::within("Acceleration of a gripper", [1e-6, 1e4], "a gripper")
                .found(Practice::ACCELERATION)
                .usually(
                    1.0,
                    "our assumption of a robot that carries a light tool, from no data sheet",
                ),
        )
    }

    fn evaluate_motion(&self, whole: &WholeMotion) -> Option<(Found, Option<f64>)> {
        Some(whole.gripper_peak(whole.peaks.drape.acceleration))
    }
}
