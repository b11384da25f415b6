//! What a motion takes of its tool, and what it would need.

use super::significant;
use crate::result::ResultFile;
use plydrape::ply::gripper_name;
use std::fmt::Write;

/// A line that says how far the tool is from where the grippers should be, and how far it turns and strokes; empty where each
/// gripper moves by itself.
pub(super) fn tool(result: &ResultFile) -> String {
    let (Some(tool), Some(record)) = (&result.scene.tool, &result.summary.tool) else {
        return String::new();
    };
    let mm = |value: f64| significant(if value.abs() < 1e-3 { 0.0 } else { value });
    let gripper = gripper_name(result.scene.ply.id(record.gripper));
    let mut text = format!("the tool leaves {} mm", mm(record.residual_mm));
    if record.residual_mm >= 1e-3 {
        let _ = write!(text, " ({gripper}, step {})", record.step);
    }
    let degrees = if record.turn_deg < 1e-3 { 0.0 } else { record.turn_deg };
    let _ = write!(text, " and turns by {}°", significant(degrees));
    for (axis, [least, most]) in tool.axes.iter().zip(&record.strokes_mm) {
        let _ = write!(text, "; {} {} to {} mm", axis.name, mm(*least), mm(*most));
    }
    text + "\n"
}

/// From how many configurations the arm follows, and where it begins; empty where it is not known.
pub(super) fn arm(result: &ResultFile) -> String {
    let arm = result.scene.tool.as_ref().and_then(|tool| tool.arm.as_ref());
    let found = result.summary.tool.as_ref().and_then(|record| record.arm);
    let (Some(arm), Some(found)) = (arm, found) else { return String::new() };
    let name = &arm.name;
    let start = found.start_deg.map(|angle| (angle.round() + 0.0).to_string()).join(", ");
    match (found.configurations, found.keeping) {
        (0, _) => format!("{name} reaches the first pose in no configuration"),
        (all, 0) => {
            format!("{name} follows within its limits from none of {all} configurations")
        }
        (all, some) => {
            format!("{name} follows from {some} of {all} configurations, and begins at ({start})°")
        }
    }
}

/// What the motion of a result would need of its tool, as in `y of g5_1 needs -41 mm, has -40 mm in step 80`: the stroke that is missing most,
/// where the tool leaves more than its residual may be, or where none is limited more than what counts as touching. `None` where the tool
/// follows.
pub(crate) fn need(result: &ResultFile) -> Option<String> {
    let (tool, record) = (result.scene.tool.as_ref()?, result.summary.tool.as_ref()?);
    let missing = record.missing.as_ref()?;
    let allowed = tool.residual.unwrap_or(result.scene.settings.contact.tolerance);
    (record.residual_mm > 1e3 * allowed).then(|| {
        format!(
            "{} of {} needs {} mm, has {} mm in step {}",
            tool.axes[missing.axis].name,
            gripper_name(result.scene.ply.id(missing.gripper)),
            significant(missing.needs_mm),
            significant(missing.has_mm),
            missing.step
        )
    })
}
