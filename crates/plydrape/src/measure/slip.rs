//! Slip: the load of the ply on a gripper along the ply, against the largest one that a pad holds before the fabric slides, with a safety.

use super::{Description, Found, Limits, Measure, Name, Observation, Unit, Worth};
use crate::layup::Layup;
use crate::state::GripperState;

/// Slip; see the head of this file.
pub struct Slip;

impl Measure for Slip {
    fn description(&self) -> Description {
        let own = Description::new("slip", "slip_n", "load along the ply", Unit::NEWTON);
        Description { worth: Worth::Kept, ..own }
    }

    fn derived_limit(&self, layup: &Layup, limits: &Limits) -> Option<f64> {
        // fabric that may slide does so at the slip force
        let force = layup.settings.pad.slip_force?;
        limits.get(Name::SlipLength).is_none().then_some(force / limits.grip_safety)
    }

    fn evaluate(&self, seen: &Observation) -> Option<Found> {
        seen.layup.settings.pad.slip_force?;
        seen.most_of_grippers(GripperState::load_along).found()
    }
}
