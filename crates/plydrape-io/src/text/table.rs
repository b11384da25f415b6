//! A result as plain text for a terminal, at most 100 columns wide.
//!
//! [`screen`] is what fits a screen: title and size, what was found, ten steps, the limits with the closest first, the verdict and its
//! margins. [`details`] is the rest: all steps, all limits, what limits the time of the motion, what the model says beside, and what the other
//! model says if it was asked. Both speak of the model that decides. Colors ([`Ink`]) mark how close a limit is.

mod beside;
mod comparison;
mod errors;
mod ink;
mod limited_by;
mod limits;
mod report;
mod screen;
mod slack;
mod steps;
mod tool;

pub use comparison::comparison;
pub(crate) use errors::{sample_in_words, share, tolerances, tried};
pub use ink::Ink;
pub use limited_by::limited_by;
pub(crate) use limits::closest_first;
pub use screen::{details, draped, heading, screen, verdict};
pub(crate) use slack::slack_in_words;
pub use steps::steps_table;

use crate::ResultFile;
use crate::result::sheet::ended;
use crate::store::shown;
use plydrape::layup::Model;
use plydrape::measure::{Name, Verdict};
use plydrape::outcome::Summary;
use plydrape::scene::World;

/// Most characters of a line, beside the ellipsis where it is cut.
const WIDTH: usize = 99;

/// A model in words.
#[must_use]
pub fn model_name(model: Model) -> &'static str {
    match model {
        Model::Sheet => "the sheet",
        Model::Catenaries => "the catenaries",
    }
}

/// A number with this many digits after the point; in exponent form if that would be too wide.
pub(crate) fn fixed(value: Option<f64>, digits: usize) -> String {
    match value {
        None => "–".into(),
        Some(v) if v.abs() < 1e6 => {
            let text = format!("{v:.digits$}");
            // No "-0.00".
            if text.bytes().all(|b| matches!(b, b'-' | b'0' | b'.')) {
                format!("{:.digits$}", 0.0)
            } else {
                text
            }
        }
        Some(v) => format!("{v:.2e}"),
    }
}

/// The verdict of a summary of a result alone, in one line: accepted and in which world, or what is exceeded furthest, by the model that
/// decides.
#[must_use]
pub fn verdict_in_a_line(result: &ResultFile, summary: &Summary) -> String {
    let model = model_name(summary.model);
    if summary.accepted() {
        return format!("accepted by {model}{}", result.world());
    }
    match (limiting(&summary.limits), ended(summary)) {
        (Some(worst), _) => {
            let need = tool::need(result).map(|need| need + "; ").unwrap_or_default();
            format!("not accepted by {model}: {need}{}", verdict_text(worst))
        }
        (None, Some(ended)) => format!("not accepted by {model}: {ended}"),
        (None, None) => format!("not accepted by {model} with the errors of the scene"),
    }
}

/// Of the limits that do not hold, the one exceeded furthest; those of the tool come before all others, because the ply lies badly where
/// the tool does not follow.
#[must_use]
pub fn limiting(limits: &[Verdict]) -> Option<&Verdict> {
    let of_tool = |verdict: &Verdict| {
        matches!(
            verdict.name,
            Name::ToolResidual
                | Name::ToolTurnRate
                | Name::ToolTurnAcceleration
                | Name::AxisSpeed
                | Name::ArmMiss
                | Name::JointSpeed
                | Name::JointAcceleration
                | Name::JointMargin
                | Name::ArmSingularity
        )
    };
    limits
        .iter()
        .filter(|v| !v.ok)
        .max_by(|a, b| of_tool(a).cmp(&of_tool(b)).then(a.ratio().total_cmp(&b.ratio())))
}

/// Of the limits that hold, the one that is nearest to not holding; `None` for zero, which only zero keeps.
#[must_use]
pub fn closest(limits: &[Verdict]) -> Option<&Verdict> {
    let kept = limits.iter().filter(|v| v.ok && v.limit != 0.0);
    kept.max_by(|a, b| a.ratio().total_cmp(&b.ratio()))
}

/// A verdict as text: name, value, limit, step and place.
#[must_use]
pub fn verdict_text(v: &Verdict) -> String {
    let step = v.step.map(|step| format!(" in step {step}")).unwrap_or_default();
    let at = if v.at.is_empty() { String::new() } else { format!(", {}", v.at) };
    format!("{}{step}{at}", measure_text(v))
}

/// The measure of a verdict as text: name, value, limit.
#[must_use]
pub fn measure_text(v: &Verdict) -> String {
    let (name, unit) = (v.name.title(), unit(&v.unit));
    let (value, limit) = (significant(v.value), significant(v.limit));
    match v.judged {
        true => format!("{name} {value}{unit} against {limit}{unit}"),
        false => format!("{name} (limit {limit}{unit})"),
    }
}

/// The limits that no plan can keep, one in a line; empty if there are none.
#[must_use]
pub fn infeasible_limits(verdicts: &[Verdict]) -> String {
    if verdicts.is_empty() {
        return String::new();
    }
    let lines = verdicts.iter().map(|v| format!("  {}\n", verdict_text(v)));
    "no plan can keep these limits:\n".to_owned() + &lines.collect::<String>()
}

fn unit(unit: &str) -> String {
    match unit {
        "" | "1" => String::new(),
        "°" => unit.into(),
        _ => format!(" {unit}"),
    }
}

/// Four significant digits, without zeros at the end.
pub(crate) fn significant(value: f64) -> String {
    let size = value.abs();
    if size != 0.0 && !(1e-3..1e6).contains(&size) {
        return format!("{value:.2e}");
    }
    // Digits after the point, so that four count in all.
    let power = if size == 0.0 { 0.0 } else { size.log10().floor() };
    let text = format!("{value:.*}", (3.0 - power).max(0.0) as usize);
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

/// The worlds in which several drapes are accepted, where those have no errors: a line for each, as in `accepted is without errors`.
pub(crate) fn accepted_in(worlds: &[World]) -> String {
    let told = [World::Ideal, World::WithoutErrors].into_iter().filter(|w| worlds.contains(w));
    told.map(|world| format!("accepted is{}\n", world.words())).collect()
}

/// Columns aligned, two spaces between; numbers to the right, the columns of text to the left.
pub(crate) fn aligned(rows: &[Vec<String>], texts: &[usize]) -> String {
    let columns = rows.first().map_or(0, Vec::len);
    let cells = |column: usize| rows.iter().map(move |r| r[column].chars().count());
    let widths: Vec<usize> = (0..columns).map(|c| cells(c).max().unwrap_or(0)).collect();
    let mut text = String::new();
    for row in rows {
        let set = |(column, cell): (usize, &String)| {
            let pad = " ".repeat(widths[column] - cell.chars().count());
            match texts.contains(&column) {
                true => format!("{cell}{pad}"),
                false => format!("{pad}{cell}"),
            }
        };
        let line: Vec<String> = row.iter().enumerate().map(set).collect();
        text.push_str(&shown::excerpt(line.join("  ").trim_end(), WIDTH));
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample;
    use plydrape::measure::Worst;
    use plydrape::outcome::Status;
    use plydrape::scene::World;

    fn limit(name: Name, value: f64, limit: f64, ok: bool) -> Verdict {
        let (unit, at) = ("mm".into(), "gripper g0_0".into());
        Verdict { name, value, limit, unit, ok, step: Some(30), at, place: None, judged: true }
    }

    /// The line names the limit that is exceeded most, relative to its size, even a least one; without one, how the drape ended.
    #[test]
    fn the_line_of_a_verdict_names_the_worst_limit() {
        let mut result = sample::draped(4, 2, 30);
        result.summary.limits = vec![
            limit(Name::Tilt, 12.0, 40.0, true),
            limit(Name::Overstretch, 2.0, 1.0, false),
            limit(Name::ContactShare, 10.0, 90.0, false),
        ];
        result.summary.limits.push(limit(Name::AxisSpeed, 1.1, 1.0, false));
        assert_eq!(limiting(&result.summary.limits).map(|v| v.name), Some(Name::AxisSpeed));
        result.summary.limits.pop();
        let line = "not accepted by the catenaries: contact share 10 mm against 90 mm in step 30, gripper g0_0";
        assert_eq!(verdict_in_a_line(&result, &result.summary), line);
        result.summary.limits.truncate(1);
        let line = "accepted by the catenaries in an ideal cell, without errors";
        assert_eq!(verdict_in_a_line(&result, &result.summary), line);
        result.scene.settings.sheet.overhang = 0.02;
        let unseen = "; the catenaries do not see fabric beyond the outer grippers";
        assert_eq!(verdict_in_a_line(&result, &result.summary), format!("{line}{unseen}"));
        result.scene.settings.sheet.overhang = 0.0;
        result.summary.world = World::WithoutErrors;
        assert_eq!(
            verdict_in_a_line(&result, &result.summary),
            "accepted by the catenaries without errors"
        );
        result.summary.world = World::Errors;
        assert_eq!(verdict_in_a_line(&result, &result.summary), "accepted by the catenaries");
        result.summary.status = Status::NotAtRest;
        let line = "not accepted by the catenaries: the ply is not at rest at the end";
        assert_eq!(verdict_in_a_line(&result, &result.summary), line);
    }

    /// 38° of 40° is nearer to its limit than 60 mm, where 50 mm is the least; a limit of zero is never near.
    #[test]
    fn the_closest_limit_is_the_one_with_the_smallest_margin() {
        let limits = [
            limit(Name::GripperDistance, 60.0, 50.0, true),
            limit(Name::Tilt, 38.0, 40.0, true),
            limit(Name::Workspace, 0.0, 0.0, true),
            limit(Name::SlackRatio, 0.05, 0.05, false),
        ];
        assert_eq!(closest(&limits).map(|v| v.name), Some(Name::Tilt));
        assert_eq!(limiting(&limits).map(|v| v.name), Some(Name::SlackRatio));
        assert_eq!(verdict_text(&limits[1]), "tilt 38 mm against 40 mm in step 30, gripper g0_0");
        assert_eq!(
            infeasible_limits(&limits[3..]),
            "no plan can keep these limits:\n  slack ratio 0.05 mm against 0.05 mm in step 30, gripper g0_0\n"
        );
        assert_eq!(infeasible_limits(&[]), "");
    }

    /// What the other model says changes no verdict: here it tears, and breaks a limit.
    #[test]
    fn the_model_beside_judges_nothing() {
        let mut result = sample::sheet(4, 2, 3);
        let before = (verdict_in_a_line(&result, &result.summary), verdict(&result, Ink::Plain));
        let mut also = sample::draped(4, 2, 3);
        let worst = Worst { value: 90.0, at: "gripper g0_0".into(), place: None };
        also.summary.limits = vec![Verdict::new(Name::Tilt, worst, 40.0, Some(3))];
        also.summary.status = Status::Torn;
        result.also = Some(sample::also(also));
        assert!(result.summary.accepted());
        assert_eq!(verdict_in_a_line(&result, &result.summary), before.0);
        assert!(verdict(&result, Ink::Plain).starts_with(&before.1));
    }

    /// Digits that matter, none that do not.
    #[test]
    fn numbers_are_short() {
        let shown = [0.0, 0.5, 12.0, 12.345678, 123456.0, 0.0142, 1e-9, 40.0].map(significant);
        assert_eq!(shown, ["0", "0.5", "12", "12.35", "123456", "0.0142", "1.00e-9", "40"]);
        assert_eq!(fixed(Some(-1e-12), 2), "0.00");
    }
}
