//! Transport acceleration: the largest acceleration of a gripper before the ply comes near the mold.
//!
//! The transport ends two steps before the first contact. In it a ply hangs as it did, so it may go as fast as the robot; where there is
//! no limit of its own, it has that of the whole motion.

use super::{Bound, Description, Found, Measure, Practice, Scope, Unit, WholeMotion, Worth};

/// Transport acceleration; see the head of this file.
pub struct TransportAcceleration;

impl Measure for TransportAcceleration {
    fn description(&self) -> Description {
        let name = "transport_acceleration";
        let own = Description::new(name, name, "transport acceleration", Unit::plain("m/s²"));
        Description { scope: Scope::Motion, worth: Worth::Kept, ..own }
    }

    fn bound(&self) -> Option<Bound> {
        let bound =
            Bound::within("Acceleration of a gripper in the transport", [1e-6, 1e4], "a gripper");
        Some(bound.found(Practice::ACCELERATION).such_as(3.0))
    }

    fn evaluate_motion(&self, whole: &WholeMotion) -> Option<(Found, Option<f64>)> {
        Some(whole.gripper_peak(whole.peaks.transport.acceleration))
    }
}
