//! Steps and verdict as plain text for a terminal, at most 100 columns wide.

mod book;
mod comparison;
mod errors;
mod limited_by;
mod sheet;
mod slack;
mod tool;

pub use book::book;
pub use comparison::comparison;
pub(crate) use comparison::verdict as verdict_on;
pub(crate) use errors::{share, stands_in_words};
pub use limited_by::limited_by;
pub(crate) use slack::slack_in_words;

use crate::result::ResultFile;
use crate::shown;
use plydrape::draping::record::{Step, Summary, Verdict};
use plydrape::equilibrium::Status;
use plydrape::errors::SampleVerdict;
use plydrape::measure::{Name, Subject};
use std::collections::BTreeSet;
use std::fmt::Write;

/// From this many steps on, only selected ones are shown.
const MOST_ROWS: usize = 40;

/// Most characters of a line, beside the ellipsis where it is cut.
const WIDTH: usize = 99;

/// Columns after the step, with their units.
const COLUMNS: [&str; 9] = [
    "contact %",
    "slack mm",
    "slack °",
    "wrinkle mm",
    "overstr. %",
    "shear °",
    "tilt °",
    "force N",
    "landing mm",
];

/// One row a step: worst values and the share in contact.
///
/// Of more than 40 steps it shows the first, the last, those where contact and shear begin, those of
/// the worst values, and some evenly between.
#[must_use]
pub fn steps_table(result: &ResultFile) -> String {
    let shown = chosen(result);
    let mut rows = vec![header()];
    rows.extend(shown.iter().map(|index| row(&result.steps[*index])));
    let mut text = aligned(&rows, &[]);
    if shown.len() < result.steps.len() {
        let (some, all) = (shown.len(), result.steps.len());
        let _ = writeln!(text, "{some} of {all} steps shown; steps.csv has all");
    }
    text.push_str(&failed_solves(result));
    text
}

/// The table of steps, whose columns are those of catenaries, where these hang; then the verdict.
#[must_use]
pub fn steps_and_verdict(result: &ResultFile) -> String {
    let verdict = verdict(result);
    if result.scene.ply.has_lines() {
        format!("{}\n{verdict}", steps_table(result))
    } else {
        verdict
    }
}

fn header() -> Vec<String> {
    let mut row = vec!["step".to_owned()];
    row.extend(COLUMNS.map(str::to_owned));
    row
}

fn row(step: &Step) -> Vec<String> {
    let m = &step.measures;
    let shown = |name: Name, digits: usize| {
        let factor = name.measure().unit().factor;
        fixed(m.value(name).map(|value| value * factor), digits)
    };
    vec![
        step.step.to_string(),
        shown(Name::ContactShare, 1),
        shown(Name::Slack, 2),
        shown(Name::SlackAngle, 2),
        shown(Name::Wrinkle, 2),
        shown(Name::Overstretch, 3),
        shown(Name::Shear, 2),
        shown(Name::Tilt, 2),
        shown(Name::Force, 3),
        shown(Name::LandingError, 2),
    ]
}

/// A number with so many digits after the point; in exponent form if that would be too wide.
fn fixed(value: Option<f64>, digits: usize) -> String {
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

/// Positions of the steps to show.
fn chosen(result: &ResultFile) -> BTreeSet<usize> {
    let count = result.steps.len();
    if count <= MOST_ROWS {
        return (0..count).collect();
    }
    let summary = &result.summary;
    let mut numbers: BTreeSet<usize> = summary.limits.iter().filter_map(|v| v.step).collect();
    for first in [summary.first_contact_step, summary.first_shear_step, summary.all_shear_step]
        .into_iter()
        .flatten()
    {
        numbers.extend([first.saturating_sub(1), first]);
    }
    let marked = (0..count).filter(|k| numbers.contains(&result.steps[*k].step));
    let even = (0..=20).map(|k| k * (count - 1) / 20);
    marked.chain(even).collect()
}

/// A line for equilibria that did not converge, if any.
fn failed_solves(result: &ResultFile) -> String {
    let failed: Vec<&Step> = result.steps.iter().filter(|step| !step.solver.found()).collect();
    let Some(first) = failed.first() else {
        return String::new();
    };
    let status = match first.solver.status {
        Status::Converged => first.solver.contact.name(),
        status => status.name(),
    };
    let step = first.step;
    match failed.len() {
        1 => format!("step {step} did not converge: {status}\n"),
        more => format!("{more} steps did not converge, the first in step {step}: {status}\n"),
    }
}

/// The table of limits and one line: accepted, or not and why. Where the sheet was draped too, its limits are in a table of their
/// own behind, and its line says that it decides. What drapes with errors say is in lines below.
#[must_use]
pub fn verdict(result: &ResultFile) -> String {
    let (summary, sample) = (&result.summary, result.summary.sample.as_ref());
    let text = match &summary.sheet {
        None => {
            let text = match (summary.accepted_without_errors(), summary.accepted) {
                (true, true) => "accepted",
                (true, false) => "accepted without errors",
                (false, _) => "not accepted",
            };
            catenaries(summary, sample) + &line(text, limiting(&summary.limits))
        }
        Some(sheet) => {
            let none = !result.scene.ply.has_lines();
            let text = match (none, summary.catenaries_accepted()) {
                (true, true) => {
                    "the motion keeps its limits; no catenaries hang between these cups"
                }
                (true, false) => "not accepted by its motion",
                (false, true) => "accepted by the catenaries",
                (false, false) => "not accepted by the catenaries",
            };
            catenaries(summary, None)
                + &line(text, limiting(&summary.limits))
                + "\n"
                + &sheet::verdict(summary, sheet)
        }
    };
    text + &tool::tool(result) + &errors::errors(result)
}

/// The verdict alone, in one line: which model accepts the drape, or what is exceeded furthest.
#[must_use]
pub fn verdict_in_a_line(result: &ResultFile) -> String {
    let summary = &result.summary;
    let model = if summary.sheet.is_some() { "the sheet" } else { "the catenaries" };
    if summary.accepted {
        return format!("accepted by {model}");
    }
    let of_motion = |v: &&Verdict| v.name.measure().subject() == Subject::Motion;
    let motion: Vec<Verdict> = summary.limits.iter().filter(of_motion).cloned().collect();
    let worst = limiting(result.deciding_limits()).or_else(|| limiting(&motion));
    match worst {
        Some(worst) => format!("not accepted by {model}: {}", verdict_text(worst)),
        None if summary.accepted_without_errors() => {
            "not accepted with the errors of the scene".into()
        }
        None => format!("not accepted by {model}, which did not come to its end at rest"),
    }
}

/// Every limit in a row; of a sample with a column of what its share of the cells keeps.
fn limits(limits: &[Verdict], sample: Option<&SampleVerdict>) -> String {
    if limits.is_empty() {
        return String::new();
    }
    let titles = ["limit", "worst", "allowed", "unit", "", "step", "at"];
    let mut rows = vec![titles.map(str::to_owned).to_vec()];
    rows[0].splice(3..3, sample.map(errors::share));
    let kept = |sample: &SampleVerdict, name: Name| {
        let verdict = sample.limits.iter().find(|verdict| verdict.name == name);
        verdict.map_or_else(|| "–".into(), |verdict| significant(verdict.value))
    };
    rows.extend(limits.iter().map(|v| {
        let mut row = vec![
            v.name.title(),
            significant(v.value),
            significant(v.limit),
            v.unit.to_string(),
            if v.ok { "pass" } else { "FAIL" }.into(),
            v.step.map_or_else(|| "–".into(), |step| step.to_string()),
            v.at.clone(),
        ];
        row.splice(3..3, sample.map(|sample| kept(sample, v.name)));
        row
    }));
    match sample {
        Some(_) => aligned(&rows, &[0, 4, 5, 7]),
        None => aligned(&rows, &[0, 3, 4, 6]),
    }
}

/// The limits of the catenaries, which bodies come nearest to what, and where their drape ended early.
fn catenaries(summary: &Summary, sample: Option<&SampleVerdict>) -> String {
    let mut text = limits(&summary.limits, sample);
    if let Some(words) = slack_in_words(summary) {
        let _ = writeln!(text, "slack at the end is {words}");
    }
    if let Some(nearest) = summary.limits.iter().rfind(|v| v.name == Name::Clearance) {
        let _ = writeln!(text, "nearest: {}", nearest.at);
    }
    if let Some(reason) = &summary.stopped {
        let _ = writeln!(text, "stopped: {reason}");
    }
    if summary.catenaries_interrupted() {
        let (done, planned) = (summary.steps, summary.steps_planned);
        let _ = writeln!(text, "interrupted after step {done} of {planned}");
    }
    text
}

/// The line of a verdict, with the limit that is exceeded furthest.
fn line(verdict: &str, worst: Option<&Verdict>) -> String {
    let text = match worst {
        None => verdict.to_owned(),
        Some(worst) => format!("{verdict}: {}", verdict_text(worst)),
    };
    shown::excerpt(&text, WIDTH) + "\n"
}

/// Of the limits that do not hold, the one exceeded furthest.
#[must_use]
pub fn limiting(limits: &[Verdict]) -> Option<&Verdict> {
    limits.iter().filter(|v| !v.ok).max_by(|a, b| a.ratio().total_cmp(&b.ratio()))
}

/// Of the limits that hold, the one that is nearest to not holding; none of zero, which only zero keeps.
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
    format!("{name} {value}{unit} against {limit}{unit}")
}

/// The limits that no plan can keep, one in a line; empty if there are none.
#[must_use]
pub fn infeasible_limits(verdicts: &[Verdict]) -> String {
    if verdicts.is_empty() {
        return String::new();
    }
    let lines =
        verdicts.iter().map(|v| shown::excerpt(&format!("  {}", verdict_text(v)), WIDTH) + "\n");
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
fn significant(value: f64) -> String {
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

/// Columns aligned, two spaces between; numbers to the right, the columns of text to the left.
fn aligned(rows: &[Vec<String>], texts: &[usize]) -> String {
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

    fn widest(text: &str) -> usize {
        text.lines().map(|l| l.chars().count()).max().unwrap_or(0)
    }

    fn limit(name: Name, value: f64, limit: f64, ok: bool) -> Verdict {
        let (unit, at) = ("mm".into(), "gripper g0_0".into());
        Verdict { name, value, limit, unit, ok, step: Some(30), at, place: None }
    }

    /// Up to forty steps are all there, in aligned columns.
    #[test]
    fn short_runs_show_every_step() {
        let text = steps_table(&sample::draped(4, 2, 30));
        assert_eq!(text.lines().count(), 31);
        assert!(widest(&text) <= 100, "{text}");
        let widths: BTreeSet<usize> = text.lines().map(|l| l.chars().count()).collect();
        assert_eq!(widths.len(), 1, "{text}");
    }

    /// Of many steps the first, the last and the first contact stay.
    #[test]
    fn long_runs_show_the_steps_that_matter() {
        let result = sample::draped(4, 2, 300);
        let text = steps_table(&result);
        assert!(text.lines().count() < 60, "{text}");
        for step in [1, 300, result.summary.first_contact_step.unwrap()] {
            assert!(
                text.lines().any(|l| l.split_whitespace().next() == Some(&step.to_string())),
                "step {step} in\n{text}"
            );
        }
    }

    /// The line names the limit that is exceeded most, relative to its size, even a least one.
    #[test]
    fn verdict_names_the_worst_limit() {
        let mut result = sample::draped(4, 2, 30);
        result.summary.accepted = false;
        result.summary.limits = vec![
            limit(Name::Tilt, 12.0, 40.0, true),
            limit(Name::Overstretch, 2.0, 1.0, false),
            limit(Name::ContactShare, 10.0, 90.0, false),
        ];
        let text = verdict(&result);
        let worst = "not accepted: contact share 10 mm against 90 mm in step 30, gripper g0_0\n";
        assert!(text.ends_with(worst), "{text}");
        assert!(widest(&text) <= 100);
        let line = "not accepted by the catenaries: contact share 10 mm against 90 mm in step 30, ";
        assert!(verdict_in_a_line(&result).starts_with(line), "{}", verdict_in_a_line(&result));
        result.summary.limits.truncate(1);
        result.summary.accepted = true;
        assert!(verdict(&result).ends_with("accepted\n"));
        assert_eq!(verdict_in_a_line(&result), "accepted by the catenaries");
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

    /// Each model has its own line; the sheet's limits and those of the motion decide, whatever the catenaries say.
    #[test]
    fn the_verdict_of_the_sheet_says_that_it_decides() {
        let mut result = sample::draped(4, 2, 30);
        let mut sheet = sample::sheet_summary();
        sheet.limits = vec![limit(Name::Height, 0.2, 0.5, true)];
        result.summary.limits = vec![limit(Name::SlackRatio, 1.0, 0.05, false)];
        result.summary.decide_by(sheet.clone());
        let text = verdict(&result);
        assert!(text.contains("\nnot accepted by the catenaries: slack ratio 1 mm"), "{text}");
        assert!(text.ends_with("\naccepted by the sheet, which decides\n"), "{text}");

        let workspace = limit(Name::Workspace, 3.0, 0.0, false);
        result.summary.limits.push(workspace);
        result.summary.decide_by(sheet.clone());
        let text = verdict(&result);
        let worst = "\nnot accepted by the sheet, which decides\n  workspace 3 mm against 0 mm";
        assert!(text.contains(worst), "{text}");

        sheet.accepted = false;
        sheet.limits[0] = Verdict { at: "far ".repeat(50), ok: false, ..sheet.limits[0].clone() };
        sheet.status = plydrape::sheet::Status::NotAtRest;
        result.summary.decide_by(sheet);
        let text = verdict(&result);
        assert!(text.contains("which decides\n  height 0.2 mm against 0.5 mm"), "{text}");
        assert!(text.contains("\nthe sheet is not at rest at the end\n"), "{text}");
        assert!(widest(&text) <= 100, "{text}");
    }

    /// Digits that matter, none that do not.
    #[test]
    fn numbers_are_short() {
        let shown = [0.0, 0.5, 12.0, 12.345678, 123456.0, 0.0142, 1e-9, 40.0].map(significant);
        assert_eq!(shown, ["0", "0.5", "12", "12.35", "123456", "0.0142", "1.00e-9", "40"]);
        assert_eq!(fixed(Some(-1e-12), 2), "0.00");
    }

    /// The text of a place may be long; the table stays within its width.
    #[test]
    fn long_places_are_cut() {
        let mut result = sample::draped(4, 2, 2);
        result.summary.limits[0].at = "very far away ".repeat(20);
        result.summary.limits[0].ok = false;
        assert!(widest(&verdict(&result)) <= 100);
    }
}
