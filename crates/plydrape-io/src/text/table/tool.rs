//! What a motion takes of its tool.

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
