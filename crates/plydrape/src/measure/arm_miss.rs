//! What the arm misses: how far its flange stays from where the motion brings it, with a wrong turn as a length on the arm's reach.

use super::{Description, Found, Limits, Measure, Scope, Unit, WholeMotion, Worth};
use crate::layup::Layup;
use crate::state::Site;

/// What the arm misses; see the head of this file.
pub struct ArmMiss;

impl Measure for ArmMiss {
    fn description(&self) -> Description {
        let own =
            Description::new("arm_miss", "arm_miss_mm", "missed by the arm", Unit::MILLIMETER);
        Description { scope: Scope::Motion, worth: Worth::Kept, ..own }
    }

    fn derived_limit(&self, layup: &Layup, _limits: &Limits) -> Option<f64> {
        Some(1e3 * layup.tool.as_ref()?.arm.as_ref()?.allowed_miss())
    }

    fn evaluate_motion(&self, whole: &WholeMotion) -> Option<(Found, Option<f64>)> {
        let peak = whole.tool?.arm?.missed;
        let found = Found { value: 1e3 * peak.value, site: Site::Flange, place: None };
        Some((found, Some(peak.time)))
    }
}
