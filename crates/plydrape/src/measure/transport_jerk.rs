//! Transport jerk: the largest jerk of a gripper before the ply comes near the mold.
//!
//! The transport ends two steps before the first contact. In it a ply hangs as it did, so it may go as fast as the robot; where there is
//! no limit of its own, it has that of the whole motion.

use super::{Bound, Description, Found, Measure, Practice, Scope, Unit, WholeMotion, Worth};

/// Transport jerk; see the head of this file.
pub struct TransportJerk;

impl Measure for TransportJerk {
    fn description(&self) -> Description {
        let name = "transport_jerk";
        let own = Description::new(name, name, "transport jerk", Unit::plain("m/s³"));
        Description { scope: Scope::Motion, worth: Worth::Kept, ..own }
    }

    fn bound(&self) -> Option<Bound> {
        let bound = Bound::within("Jerk of a gripper in the transport", [1e-6, 1e7], "a gripper");
        Some(bound.found(Practice::JERK).such_as(30.0))
    }

    fn evaluate_motion(&self, whole: &WholeMotion) -> Option<(Found, Option<f64>)> {
        Some(whole.gripper_peak(whole.peaks.transport.jerk))
    }
}
