//! `report.html`: one page that shows a result, without a network.
//!
//! The page is built from the sources in `viewer/` into `report.html` beside this file, which holds two marks. In
//! their place come the title and everything that is shown, as one JSON object: numbers of the result, the ply's
//! surface and the mold in triangles. The page computes no mechanics.

mod block;
mod cell;
mod facts;
mod geometry;
mod margin;
mod sample;
mod sheet;

use super::OutputError;
use crate::result::ResultFile;
use crate::strength;
use crate::table::slack_in_words;
use cell::{Cell, VacuumEvent, cell, events};
use facts::{Fact, facts};
use geometry::{Detail, Geometry, Ranges};
use plydrape::draping::record::{Step, Worst};
use plydrape::measure::{Name, Sense, Subject, Unit, Verdict};
use plydrape::ply::GripperId;
use sample::{Sample, sample, stands};
use serde::Serialize;
use sheet::{Sheet, Shown, sheet};

/// The page without a result.
const PAGE: &str = include_str!("report.html");
/// Where the title goes.
const TITLE: &str = "__PLYDRAPE_TITLE__";
/// Where the data go.
const DATA: &str = "__PLYDRAPE_DATA__";

/// Of a limit that is exceeded beyond measure.
const MOST_RATIO: f64 = 1e9;

/// What the page is given.
#[derive(Serialize)]
struct Page<'a> {
    format: &'static str,
    version: u32,
    program: &'a str,
    title: &'a str,
    input: Option<&'a str>,
    facts: Vec<Fact>,
    accepted: bool,
    interrupted: bool,
    stopped: Option<&'a str>,
    steps: Vec<usize>,
    times: Vec<f64>,
    /// Grippers along u and v; zeros where catenaries make no surface: they are no whole array, or lines are missing.
    grid: [usize; 2],
    /// Fabric between neighboring grippers along u and v (mm).
    pitch: [f64; 2],
    /// Column and row of each gripper.
    ids: Vec<GripperId>,
    divisions: usize,
    limits: Vec<Limit<'a>>,
    /// What published data say of the angles at the end.
    strength: Strength,
    measures: Vec<Course<'a>>,
    fields: Vec<Field>,
    geometry: Geometry,
    /// What the grippers carry and what stands in the cell, if the scene says so.
    cell: Option<Cell<'a>>,
    /// When pads grip, press and let go; nothing where they hold the ply from first to last.
    events: Vec<VacuumEvent>,
    /// The ply as a sheet, which decides, if it was draped.
    sheet: Option<Sheet<'a>>,
    /// The verdict over a sample of cells, if there is one.
    sample: Option<Sample<'a>>,
    /// The largest errors that the motion stands, in words.
    stands: Option<String>,
    left_out: Vec<String>,
}

/// What published data say, for information.
#[derive(Serialize)]
struct Strength {
    notes: Vec<strength::Note>,
    /// What it is and is not.
    warning: &'static str,
}

/// A limit and how it was kept.
#[derive(Serialize)]
struct Limit<'a> {
    name: String,
    /// The same in other units, where it is slack.
    note: Option<String>,
    value: f64,
    limit: f64,
    unit: &'a str,
    least: bool,
    ok: bool,
    /// The value as a multiple of its limit: beyond 1 it is exceeded.
    ratio: f64,
    /// It is one of the motion, which counts with every model.
    motion: bool,
    step: Option<usize>,
    #[serde(rename = "where")]
    at: &'a str,
    place: Option<[f64; 3]>,
    measure: Option<&'static str>,
}

/// A measure over the steps.
#[derive(Serialize)]
struct Course<'a> {
    key: &'static str,
    label: &'static str,
    unit: &'static str,
    values: Vec<Option<f64>>,
    #[serde(rename = "where")]
    at: Vec<Option<&'a str>>,
    places: Vec<Option<[f64; 3]>>,
    limit: Option<f64>,
    least: bool,
}

/// What the ply's color can tell.
#[derive(Serialize)]
struct Field {
    key: &'static str,
    label: String,
    unit: &'static str,
    on: &'static str,
    /// `even`, or `orders` where equal ratios are equally far apart; what lies beyond the ends has their colors.
    scale: &'static str,
    low: f64,
    high: f64,
    limit: Option<f64>,
}

impl Field {
    /// Equal differences are equally far apart.
    fn even(
        key: &'static str,
        label: impl Into<String>,
        unit: &'static str,
        on: &'static str,
        [low, high]: [f64; 2],
        limit: Option<f64>,
    ) -> Self {
        Field { key, label: label.into(), unit, on, scale: "even", low, high, limit }
    }

    /// Equal ratios are equally far apart; both ends are positive.
    fn orders(
        key: &'static str,
        label: impl Into<String>,
        unit: &'static str,
        on: &'static str,
        ends: [f64; 2],
        limit: Option<f64>,
    ) -> Self {
        Field { scale: "orders", ..Field::even(key, label, unit, on, ends, limit) }
    }
}

/// How a page is given what it draws.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Form {
    /// Triangles of the mold at most; none leaves it out.
    pub triangles: Option<usize>,
    /// Positions are packed: smaller, and slower to write and to read.
    pub packed: bool,
}

impl Form {
    /// That of a page that stands in a file.
    pub const FILE: Form = Form { triangles: Some(8000), packed: true };
}

/// What the page of a result is given, as JSON.
///
/// # Errors
/// As [`html`].
pub fn data(result: &ResultFile, form: Form) -> Result<String, OutputError> {
    Ok(super::json::of(&page(result, form)?)?)
}

/// The page of a result. Same result, same bytes.
///
/// # Errors
/// [`OutputError`] if a number is not finite, or the states of the sheet cannot be read.
pub fn html(result: &ResultFile) -> Result<String, OutputError> {
    let data = data(result, Form::FILE)?.replace('<', "\\u003c");
    let title = result.scene.title.replace('&', "&amp;").replace('<', "&lt;");
    let whole =
        PAGE.split_once(TITLE).and_then(|(head, rest)| Some((head, rest.split_once(DATA)?)));
    let (head, (body, tail)) = whole.unwrap_or((PAGE, ("", "")));
    Ok([head, &title, body, data.trim_end(), tail].concat())
}

fn page(result: &ResultFile, form: Form) -> Result<Page<'_>, OutputError> {
    let (scene, summary) = (&result.scene, &result.summary);
    let mut detail = Detail::of(result);
    let kept = Shown::of(result)?;
    if let Some(kept) = &kept {
        // both models in the same steps
        detail.steps.retain(|k| kept.has(result.steps[*k].step));
    }
    let shown: Vec<&Step> = detail.steps.iter().map(|k| &result.steps[*k]).collect();
    let steps: Vec<usize> = shown.iter().map(|step| step.step).collect();
    let (geometry, ranges) = Geometry::of(result, &detail, form);
    let sample = sample(result, kept.as_ref().map(Shown::mesh));
    let sheet = match (kept, &summary.sheet) {
        (Some(kept), Some(outcome)) => Some(sheet(result, outcome, kept, &steps)?),
        _ => None,
    };
    let grid = scene.ply.lines().surface();
    Ok(Page {
        format: "plydrape-page",
        version: 2,
        program: &result.program,
        title: &scene.title,
        input: scene.input.as_deref(),
        facts: facts(result),
        accepted: summary.accepted,
        interrupted: summary.interrupted(),
        stopped: summary.stopped.as_deref(),
        steps,
        times: shown.iter().map(|step| step.time).collect(),
        grid: [grid.nu, grid.nv],
        pitch: scene.ply.cell.map(|side| side * 1e3),
        ids: (0..scene.ply.grippers()).map(|n| scene.ply.id(n)).collect(),
        divisions: detail.intervals,
        limits: limits(result),
        strength: Strength { notes: strength::notes(summary), warning: strength::INFORMATION },
        measures: courses(result, &shown),
        fields: fields(result, &ranges),
        geometry,
        cell: cell(result, &shown),
        events: events(result),
        sheet,
        sample,
        stands: stands(result),
        left_out: detail.left_out(result.steps.len()),
    })
}

/// Every limit of a result, with the measure that it is about.
fn limits(result: &ResultFile) -> Vec<Limit<'_>> {
    let limits = result.summary.limits.iter().map(|verdict| {
        let course = has_course(result, verdict.name).then(|| verdict.name.measure().key());
        let note = (verdict.name == Name::SlackRatio).then(|| slack_in_words(&result.summary));
        Limit { note: note.flatten(), ..limit(verdict, course) }
    });
    limits.collect()
}

/// A judged limit, with the key of its measure over the steps.
fn limit<'a>(verdict: &'a Verdict, measure: Option<&'static str>) -> Limit<'a> {
    Limit {
        name: verdict.name.title(),
        note: None,
        value: verdict.value,
        limit: verdict.limit,
        unit: &verdict.unit,
        least: verdict.is_least(),
        ok: verdict.ok,
        ratio: verdict.ratio().min(MOST_RATIO),
        motion: verdict.name.measure().subject() == Subject::Motion,
        step: verdict.step,
        at: &verdict.at,
        place: verdict.place,
        measure,
    }
}

/// Whether a measure has a value in some step.
fn has_course(result: &ResultFile, name: Name) -> bool {
    result.steps.iter().any(|step| step.measures.get(name).is_some())
}

/// Every measure that has a value in some step, with its limit where the result is judged by it.
fn courses<'a>(result: &'a ResultFile, shown: &[&'a Step]) -> Vec<Course<'a>> {
    let course = |name: &Name| {
        let measure = name.measure();
        let unit = measure.unit();
        let worst: Vec<Option<&Worst>> =
            shown.iter().map(|step| step.measures.get(*name)).collect();
        let judged = result.summary.limits.iter().find(|verdict| verdict.name == *name);
        Course {
            key: measure.key(),
            label: measure.label(),
            // as in the table of limits
            unit: unit.shown,
            values: worst.iter().map(|w| w.map(|w| as_shown(w.value, unit))).collect(),
            at: worst.iter().map(|w| w.map(|w| w.at.as_str())).collect(),
            places: worst.iter().map(|w| w.and_then(|w| w.place)).collect(),
            limit: judged.map(|verdict| verdict.limit),
            least: measure.sense() == Sense::AtLeast,
        }
    };
    Name::ALL.iter().filter(|name| has_course(result, **name)).map(course).collect()
}

/// A recorded value in the unit that it is shown in; one in the same unit keeps its digits.
fn as_shown(value: f64, unit: Unit) -> f64 {
    if unit.factor == 1.0 { value } else { value * unit.factor }
}

/// What colors can tell of this result.
fn fields(result: &ResultFile, ranges: &Ranges) -> Vec<Field> {
    let mut out = vec![Field::even("height", "height", "mm", "vertex", ranges.height, None)];
    if let Some(range) = ranges.gap {
        out.push(Field::even("gap", "gap to the mold", "mm", "vertex", range, None));
    }
    if result.scene.ply.lines().surface().cells() > 0 {
        let limit = Some(result.scene.limits.shear.to_degrees());
        out.push(Field::even("shear", "shear angle", "°", "cell", ranges.shear, limit));
        out.push(Field::even("direction", "warp direction", "°", "cell", ranges.direction, None));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample;

    /// The marks of the page are filled once each, and nothing in a title or a scene can end the data early.
    #[test]
    fn text_of_a_scene_cannot_leave_its_place() {
        let mut result = sample::draped(4, 2, 3);
        result.scene.title = "</title><script>alert(1)</script> & more".into();
        result.scene.input = Some("# </script><script>alert(2)</script> __PLYDRAPE_DATA__".into());
        let html = html(&result).unwrap();
        assert_eq!(html.matches("alert(1)</script>").count(), 0);
        assert_eq!(html.matches("alert(2)</script>").count(), 0);
        assert!(html.contains("&lt;/title>"));
        assert_eq!(PAGE.matches(TITLE).count(), 1);
        assert_eq!(PAGE.matches(DATA).count(), 1);
    }

    /// A limit stands beside the course of its own measure, in the same unit.
    #[test]
    fn limits_know_their_measures() {
        let result = sample::draped(4, 2, 3);
        let page = page(&result, Form::FILE).unwrap();
        let tilt = page.limits.iter().find(|limit| limit.name == "tilt").unwrap();
        assert_eq!(tilt.measure, Some("tilt_deg"));
        for course in &page.measures {
            assert_eq!(course.values.len(), result.steps.len());
            let own = page.limits.iter().filter(|limit| limit.measure == Some(course.key));
            for limit in own {
                assert_eq!((limit.unit, Some(limit.limit)), (course.unit, course.limit));
            }
        }
        assert_eq!(as_shown(0.25, Unit::SHARE), 25.0);
        assert_eq!(as_shown(0.1 + 0.2, Unit::DEGREE), 0.1 + 0.2);
    }

    /// Large results are drawn coarser, then without diagonals, then in fewer steps, the last among them.
    #[test]
    fn large_results_say_what_is_left_out() {
        let small = Detail::of(&sample::draped(4, 2, 3));
        assert!(small.left_out(3).is_empty() && small.intervals == 12);
        let mut result = sample::draped(2, 2, 2);
        result.scene.ply.grid = plydrape::ply::Grid { nu: 100, nv: 100 };
        let step = result.steps[0].clone();
        result.steps = vec![step; 200];
        let large = Detail::of(&result);
        assert_eq!(large.left_out(200).len(), 2, "{large:?}");
        assert_eq!(large.steps.last(), Some(&199));
        assert!(large.steps.len() * 199 * 199 <= 3_000_000);
    }
}
