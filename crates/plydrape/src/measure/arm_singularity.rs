//! Distance from a singularity: the least singular value of how the flange moves by the joints, with lengths in units of the arm's reach. At zero
//! there is a direction in which the flange cannot move at all.

use super::{Description, Found, Limits, Measure, Scope, Sense, Unit, WholeMotion, Worth};
use crate::layup::Layup;
use crate::state::Site;

/// Distance from a singularity; see the head of this file.
pub struct ArmSingularity;

impl Measure for ArmSingularity {
    fn description(&self) -> Description {
        let own = Description::new(
            "arm_singularity",
            "arm_singularity",
            "distance from a singularity",
            Unit::NUMBER,
        );
        Description { sense: Sense::AtLeast, scope: Scope::Motion, worth: Worth::Kept, ..own }
    }

    fn derived_limit(&self, layup: &Layup, _limits: &Limits) -> Option<f64> {
        layup.tool.as_ref()?.arm.as_ref().map(|arm| arm.singular)
    }

    fn evaluate_motion(&self, whole: &WholeMotion) -> Option<(Found, Option<f64>)> {
        let peak = whole.tool?.arm?.singular;
        let found = Found { value: peak.value, site: Site::Flange, place: None };
        Some((found, Some(peak.time)))
    }
}
