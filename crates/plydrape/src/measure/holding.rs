//! Holding: the load that draws the ply off a pad, across the ply, against the largest one that a pad holds, with a safety.
//!
//! What presses the pad on the mold does not count.

use super::{Description, Found, Limits, Measure, Observation, Unit, Worth};
use crate::layup::Layup;
use crate::state::GripperState;

/// Holding; see the head of this file.
pub struct Holding;

impl Measure for Holding {
    fn description(&self) -> Description {
        let own = Description::new("holding", "holding_n", "load across the ply", Unit::NEWTON);
        Description { worth: Worth::Kept, ..own }
    }

    fn derived_limit(&self, layup: &Layup, limits: &Limits) -> Option<f64> {
        layup.settings.pad.holding_force.map(|force| force / limits.grip_safety)
    }

    fn evaluate(&self, seen: &Observation) -> Option<Found> {
        seen.layup.settings.pad.holding_force?;
        seen.most_of_grippers(GripperState::load_across).found()
    }
}
