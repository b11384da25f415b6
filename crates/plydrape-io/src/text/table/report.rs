//! What a model says beside its measures, as plain text.

use super::{WIDTH, significant, slack_in_words, tool};
use crate::result::ResultFile;
use crate::store::shown;
use plydrape::measure::Name;
use plydrape::outcome::Summary;

/// How high the ply lies, where it touches first, its slack, which bodies come nearest to what, and what the motion takes of the tool.
pub(super) fn report(result: &ResultFile) -> String {
    let summary = &result.summary;
    let nearest = summary.limits.iter().rfind(|verdict| verdict.name == Name::Clearance);
    let said = [
        heights(summary),
        landing(summary),
        slack_in_words(summary).map(|words| format!("slack at the end is {words}")),
        nearest.map(|nearest| format!("nearest: {}", nearest.at)),
    ];
    let lines = said.into_iter().flatten().map(|said| shown::excerpt(&said, WIDTH) + "\n");
    lines.collect::<String>() + &tool::tool(result)
}

/// How high the sheet lies at the end.
fn heights(summary: &Summary) -> Option<String> {
    let report = summary.sheet.as_ref()?;
    let highest = summary.last.value(Name::Height)?;
    let mut text = format!(
        "at the end {} mm high at most: ridges {} mm, bridges {} mm",
        significant(highest),
        significant(report.ridge_max_mm?),
        significant(report.bridge_max_mm?),
    );
    if let Some(share) = summary.height_share {
        text += &format!("; {} % above the limit", significant(100.0 * share));
    }
    Some(text)
}

/// Where the ply touches first.
fn landing(summary: &Summary) -> Option<String> {
    let step = summary.first_contact_step()?;
    let uv = summary.sheet.as_ref().and_then(|report| report.first_contact_uv_mm);
    let at = uv.map(|[u, v]| format!(", at fabric point ({u:.1}, {v:.1}) mm")).unwrap_or_default();
    Some(format!("touches the mold first in step {step}{at}"))
}
