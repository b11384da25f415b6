//! The outcome of the sheet as plain text.

use super::{WIDTH, limiting, limits, significant, verdict_text};
use crate::sheet::{ended, overstrained};
use crate::shown;
use plydrape::draping::record::{Summary, Verdict};
use plydrape::measure::Subject;
use plydrape::sheet;

/// The table of the sheet's limits, what else it says of the ply, and the verdict that counts.
pub(super) fn verdict(summary: &Summary, sheet: &sheet::measure::Summary) -> String {
    let mut text = format!("the whole ply as a sheet of {} nodes:\n", sheet.nodes);
    text += &limits(&sheet.limits, summary.sample.as_ref());
    let planned = summary.steps_planned;
    let said = [heights(sheet), landing(sheet), ended(sheet, planned)];
    for said in said.into_iter().flatten().chain(overstrained(sheet).into_iter().flatten()) {
        text += &shown::excerpt(&said, WIDTH);
        text.push('\n');
    }
    match (summary.accepted_without_errors(), summary.accepted) {
        (true, true) => return text + "accepted by the sheet, which decides\n",
        (true, false) => return text + "accepted by the sheet, which decides, without errors\n",
        (false, _) => {}
    }
    text += "not accepted by the sheet, which decides\n";
    match worst(summary, sheet) {
        Some(worst) => text + &shown::excerpt(&format!("  {}", verdict_text(worst)), WIDTH) + "\n",
        None => text,
    }
}

/// Of the limits that count and do not hold, the one exceeded furthest.
fn worst<'a>(summary: &'a Summary, sheet: &'a sheet::measure::Summary) -> Option<&'a Verdict> {
    let of_motion = |v: &&Verdict| v.name.measure().subject() == Subject::Motion;
    limiting(&sheet.limits).or_else(|| {
        let broken = summary.limits.iter().filter(of_motion).filter(|v| !v.ok);
        broken.max_by(|a, b| a.ratio().total_cmp(&b.ratio()))
    })
}

/// How high the ply lies at the end.
fn heights(sheet: &sheet::measure::Summary) -> Option<String> {
    let (max, share) = (sheet.height_max_mm?, sheet.height_share_above_half_mm?);
    Some(format!(
        "at the end {} mm high at most: ridges {} mm, bridges {} mm; {} % above 0.5 mm",
        significant(max),
        significant(sheet.ridge_max_mm?),
        significant(sheet.bridge_max_mm?),
        significant(100.0 * share)
    ))
}

/// Where it touches first.
fn landing(sheet: &sheet::measure::Summary) -> Option<String> {
    let (step, [u, v]) = (sheet.first_contact_step?, sheet.first_contact_uv_mm?);
    Some(format!("touches the mold first in step {step}, at fabric point ({u:.1}, {v:.1}) mm"))
}
