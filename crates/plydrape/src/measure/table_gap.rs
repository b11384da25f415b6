//! Table gap: how high the ply hangs over the table from which it was lifted, as it begins to be carried away.

use super::{Description, Found, Limits, Measure, Observation, Sense, Unit, Worth};
use crate::layup::Layup;

/// Table gap; see the head of this file.
pub struct TableGap;

impl Measure for TableGap {
    fn description(&self) -> Description {
        let own = Description::new("table_gap", "table_gap_mm", "table gap", Unit::MILLIMETER);
        Description { sense: Sense::AtLeast, worth: Worth::Kept, ..own }
    }

    fn is_signed(&self) -> bool {
        true
    }

    fn derived_limit(&self, layup: &Layup, _: &Limits) -> Option<f64> {
        // a ply that still touches drags along the table
        layup.pick_up.filter(|pick_up| pick_up.lift_steps > 0).map(|_| 0.0)
    }

    fn evaluate(&self, seen: &Observation) -> Option<Found> {
        let pick_up = seen.layup.pick_up.filter(|pick_up| pick_up.lift_steps > 0)?;
        // the step after those of the lift, with a ply that nobody has let go of yet
        let is_lifted = seen.state.step == pick_up.lift_steps + 1;
        if !is_lifted || !seen.state.grippers.iter().all(|gripper| gripper.holds) {
            return None;
        }
        let points = seen.state.points.iter();
        let lowest = points.min_by(|a, b| a.place[2].total_cmp(&b.place[2]))?;
        let value = (lowest.place[2] - pick_up.height) * 1e3;
        Some(Found { value, site: lowest.site, place: Some(lowest.place) })
    }
}
