//! Axis speed: of the axis of a tool that is nearest to its limit along a motion in time, as a share of that limit.

use super::{Description, Found, Limits, Measure, Scope, Unit, WholeMotion, Worth};
use crate::layup::Layup;
use crate::state::Site;

/// Axis speed; see the head of this file.
pub struct AxisSpeed;

impl Measure for AxisSpeed {
    fn description(&self) -> Description {
        let own = Description::new("axis_speed", "axis_speed", "axis speed", Unit::SHARE);
        Description { scope: Scope::Motion, worth: Worth::Kept, ..own }
    }

    fn derived_limit(&self, layup: &Layup, _limits: &Limits) -> Option<f64> {
        // a tool may have no axes
        layup.tool.as_ref().filter(|tool| !tool.axes.is_empty()).map(|_| 1.0)
    }

    fn evaluate_motion(&self, whole: &WholeMotion) -> Option<(Found, Option<f64>)> {
        let (peaks, tool) = (whole.tool?, whole.layup.tool.as_ref()?);
        tool.axes.get(peaks.axis)?;
        let peak = peaks.axis_share;
        let site = Site::Axis(peaks.axis, peak.gripper);
        Some((Found { value: peak.value, site, place: None }, Some(peak.time)))
    }
}
