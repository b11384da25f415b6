//! Joint speed: of the joint of the arm that is nearest to its limit along a motion in time, as a share of that limit.

use super::{Description, Found, Limits, Measure, Scope, Unit, WholeMotion, Worth};
use crate::layup::Layup;
use crate::state::Site;

/// Joint speed; see the head of this file.
pub struct JointSpeed;

impl Measure for JointSpeed {
    fn description(&self) -> Description {
        let own = Description::new("joint_speed", "joint_speed", "joint speed", Unit::SHARE);
        Description { scope: Scope::Motion, worth: Worth::Kept, ..own }
    }

    fn derived_limit(&self, layup: &Layup, _limits: &Limits) -> Option<f64> {
        layup.tool.as_ref()?.arm.as_ref().map(|_| 1.0)
    }

    fn evaluate_motion(&self, whole: &WholeMotion) -> Option<(Found, Option<f64>)> {
        let peak = whole.tool?.arm?.speed_share;
        let found = Found { value: peak.value, site: Site::Joint(peak.gripper), place: None };
        Some((found, Some(peak.time)))
    }
}
