//! Joint acceleration: the largest angular acceleration of a joint of the arm along a motion in time, where a scene limits it.

use super::{Description, Found, Limits, Measure, Scope, Unit, WholeMotion, Worth};
use crate::layup::Layup;
use crate::state::Site;

/// Joint acceleration; see the head of this file.
pub struct JointAcceleration;

impl Measure for JointAcceleration {
    fn description(&self) -> Description {
        let own = Description::new(
            "joint_acceleration",
            "joint_acceleration_deg_s2",
            "joint acceleration",
            Unit::DEGREE_PER_SECOND_SQUARED,
        );
        Description { scope: Scope::Motion, worth: Worth::Kept, ..own }
    }

    fn derived_limit(&self, layup: &Layup, _limits: &Limits) -> Option<f64> {
        layup.tool.as_ref()?.arm.as_ref()?.acceleration.map(f64::to_degrees)
    }

    fn evaluate_motion(&self, whole: &WholeMotion) -> Option<(Found, Option<f64>)> {
        let peak = whole.tool?.arm?.acceleration;
        let found =
            Found { value: peak.value.to_degrees(), site: Site::Joint(peak.gripper), place: None };
        Some((found, Some(peak.time)))
    }
}
