//! What is impossible in what a result that was read says of its tool.

use super::ResultFile;
use crate::read::urdf::is_plain;
use plydrape::arm::{Arm, Joint};
use plydrape::geometry::vector::dot;
use plydrape::tool::{MissingStroke, Tool};

/// What is impossible in the tool and in what the motion takes of it.
pub(super) fn fault(result: &ResultFile) -> Option<String> {
    // only a scene with a tool has the motion of one
    let grippers = result.scene.ply.grippers();
    let (tool, record) = match (&result.scene.tool, &result.summary.tool) {
        (None, None) => return None,
        (Some(tool), record) => (tool, record.as_ref()),
        (None, Some(_)) => return Some("it has a motion of a tool, but no tool".into()),
    };

    // the tool carries all grippers, and its axes and its arm can move
    if tool.mounts.len() != grippers {
        return Some(format!("its tool carries {} grippers, not {grippers}", tool.mounts.len()));
    }
    if !is_sound(tool) {
        return Some("its tool has an impossible axis or rate".into());
    }
    if let Some(arm) = &tool.arm {
        let finite = |angles: &[f64; 6]| angles.iter().all(|angle| angle.is_finite());
        let starts =
            arm.start.iter().chain(record.and_then(|r| r.arm.as_ref()).map(|a| &a.start_deg));
        if !(is_whole(arm) && starts.into_iter().all(finite)) {
            return Some("its arm has an impossible joint".into());
        }
    }

    // what the motion takes of the tool is of grippers, steps and axes that there are
    let record = record?;
    let steps = 1..=result.summary.steps_planned.max(1);
    let is_known = |missing: &MissingStroke| {
        missing.gripper < grippers
            && missing.axis < tool.axes.len()
            && steps.contains(&missing.step)
    };
    let known = record.gripper < grippers
        && steps.contains(&record.step)
        && record.strokes_mm.len() == tool.axes.len()
        && record.missing.as_ref().is_none_or(is_known);
    (!known).then(|| "what its motion takes of the tool is not of this tool".into())
}

/// Whether the joints of an arm have names and turn, each about an axis within a range, and its limits are some.
fn is_whole(arm: &Arm) -> bool {
    let turns = |joint: &Joint| {
        let length = dot(joint.axis, joint.axis);
        (length - 1.0).abs() < 1e-6 && joint.range[0] < joint.range[1] && joint.speed > 0.0
    };
    let named = [&arm.name].into_iter().chain(arm.joints.iter().map(|joint| &joint.name));
    arm.joints.iter().all(turns)
        && named.into_iter().all(|name| is_plain(name))
        && arm.reach() > 0.0
        && arm.margin >= 0.0
        && arm.singular >= 0.0
}

/// Whether strokes hold their start, all rates are above zero, and axes of pads are at right angles.
fn is_sound(tool: &Tool) -> bool {
    let axis = |axis: &plydrape::tool::Axis| {
        axis.stroke[0] <= 0.0 && 0.0 <= axis.stroke[1] && axis.speed > 0.0
    };
    let fixed = tool.fixed_pads.is_none_or(|pads| {
        let unit = |n: usize, m: usize| if n == m { 1.0 } else { 0.0 };
        let right = |n: usize, m: usize| (dot(pads[n], pads[m]) - unit(n, m)).abs() < 1e-6;
        (0..3).all(|n| (0..3).all(|m| right(n, m)))
    });
    fixed && tool.axes.iter().all(axis) && tool.turn_rate > 0.0 && tool.turn_acceleration > 0.0
}
