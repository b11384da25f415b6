//! Transport speed: the largest speed of a gripper before the ply comes near the mold.
//!
//! The transport ends two steps before the first contact. In it a ply hangs as it did, so it may go as fast as the robot; where there is
//! no limit of its own, it has that of the whole motion.

use super::{Bound, Description, Found, Measure, Practice, Scope, Unit, WholeMotion, Worth};

/// Transport speed; see the head of this file.
pub struct TransportSpeed;

impl Measure for TransportSpeed {
    fn description(&self) -> Description {
        let name = "transport_speed";
        let own = Description::new(name, name, "transport speed", Unit::plain("m/s"));
        Description { scope: Scope::Motion, worth: Worth::Kept, ..own }
    }

    fn bound(&self) -> Option<Bound> {
        let bound = Bound::within("Speed of a gripper in the transport", [1e-6, 1e2], "a gripper");
        Some(bound.found(Practice::SPEED).such_as(1.0))
    }

    fn evaluate_motion(&self, whole: &WholeMotion) -> Option<(Found, Option<f64>)> {
        Some(whole.gripper_peak(whole.peaks.transport.speed))
    }
}
