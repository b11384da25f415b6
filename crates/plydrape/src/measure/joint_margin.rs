//! Joint margin: how far the joints of the arm stay from the ends of their ranges along a motion in time; negative beyond them.

use super::{Description, Found, Limits, Measure, Scope, Sense, Unit, WholeMotion, Worth};
use crate::layup::Layup;
use crate::state::Site;

/// Joint margin; see the head of this file.
pub struct JointMargin;

impl Measure for JointMargin {
    fn description(&self) -> Description {
        let own =
            Description::new("joint_margin", "joint_margin_deg", "joint margin", Unit::DEGREE);
        Description { sense: Sense::AtLeast, scope: Scope::Motion, worth: Worth::Kept, ..own }
    }

    fn is_signed(&self) -> bool {
        true
    }

    fn derived_limit(&self, layup: &Layup, _limits: &Limits) -> Option<f64> {
        layup.tool.as_ref()?.arm.as_ref().map(|arm| arm.margin.to_degrees())
    }

    fn evaluate_motion(&self, whole: &WholeMotion) -> Option<(Found, Option<f64>)> {
        let peak = whole.tool?.arm?.margin;
        let found =
            Found { value: peak.value.to_degrees(), site: Site::Joint(peak.gripper), place: None };
        Some((found, Some(peak.time)))
    }
}
