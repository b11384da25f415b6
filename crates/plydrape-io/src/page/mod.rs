//! `report.html`: one page that shows a result, without a network.
//!
//! The page is built from the sources in `viewer/` into `report.html` beside this file, which holds two marks. In
//! their place come the title and everything that is shown, as one JSON object: numbers of the result, the ply's
//! surface and the mold in triangles. The page computes no mechanics, and knows no measure by name: which measures and limits there are,
//! their words, units and senses all come with its data.
//!
//! Verdict, limits and charts are those of the model that decides. The other one, where it was draped, is a second `PageDrape` without a
//! limit in it.
//!
//! 1. `limit`, `course`, `field`: limits, measures over the steps, and what colors tell;
//! 2. `drape`: the drape by one model; `grippers`, `reading`, `catenaries`, `sheet`: what is shown of it;
//! 3. `cell`, `mold`: what is the same for both models;
//! 4. `sample`, `facts`: the verdict over a sample of cells, and what was draped;
//! 5. `look`: what a page shows of a scene that is not draped yet; `peer`: the drape of another program beside that of the result;
//! 6. `block`, `packing`: integers in little text.

mod block;
mod catenaries;
mod cell;
mod course;
mod drape;
mod facts;
mod field;
mod grippers;
mod limit;
mod look;
mod mold;
mod packing;
mod peer;
mod reading;
mod sample;
mod sheet;

use crate::Error;
use crate::peer::Comparison;
use crate::result::ResultFile;
use crate::result::sheet::ended;
use crate::scene::SceneFile;
use crate::store::format::VERSION;
use crate::text::table::{tolerances, tried};
use block::Block;
use catenaries::Detail;
use cell::{Cell, VacuumEvent, cell, events};
use drape::{PageDrape, Source};
use facts::{Fact, facts};
use limit::{Limit, limits};
use look::{Look, look};
use mold::Mold;
use peer::Peer;
use plydrape::layup::Model;
use plydrape::ply::GripperId;
use sample::{Sample, sample};
use serde::Serialize;
use sheet::KeptStates;

/// The page without a result.
const PAGE: &str = include_str!("report.html");
/// Where the title goes.
const TITLE: &str = "__PLYDRAPE_TITLE__";
/// Where the data go.
const DATA: &str = "__PLYDRAPE_DATA__";

/// What the page is given.
#[derive(Serialize)]
struct Page<'a> {
    format: &'static str,
    version: u32,
    /// Version of the result files that the page can compare with.
    result_version: u32,
    program: &'a str,
    title: &'a str,
    input: Option<&'a str>,
    facts: Vec<Fact>,
    /// The verdict of the model that decides.
    accepted: bool,
    /// In which world, as it follows the word accepted; empty where it was judged with errors.
    world: String,
    /// Why its end does not count.
    ended: Option<String>,
    steps: Vec<usize>,
    times: Vec<f64>,
    /// The first step in which the ply touches the mold.
    first_contact: Option<usize>,
    /// Column and row of each gripper.
    ids: Vec<GripperId>,
    /// Every limit of the model that decides, the closest first.
    limits: Vec<Limit<'a>>,
    /// The drape by the model that decides.
    drape: PageDrape<'a>,
    /// The drape by the other model, if it was asked for: it is shown and judges nothing.
    also: Option<PageDrape<'a>>,
    mold: Option<Mold>,
    /// What the grippers carry and what stands in the cell, if the scene says so.
    cell: Option<Cell<'a>>,
    /// When pads grip, press and let go; nothing where they hold the ply from first to last.
    events: Vec<VacuumEvent>,
    /// The verdict over a sample of cells, if there is one.
    sample: Option<Sample<'a>>,
    /// The largest errors that the motion tolerates, as text.
    tolerance: Vec<String>,
    /// What is shown of a scene before anything is draped on its mold, in place of a verdict; `None` for a result.
    #[serde(skip_serializing_if = "Option::is_none")]
    look: Option<Look>,
    /// The drape of the same motion by another program; `None` where none is compared.
    #[serde(skip_serializing_if = "Option::is_none")]
    peer: Option<Peer>,
    left_out: Vec<String>,
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
    /// The form of a page in a file.
    pub const FILE: Form = Form { triangles: Some(8000), packed: true };

    /// Integers of all steps in this form.
    fn block(self, steps: usize, components: usize, values: Vec<i32>) -> Block {
        match self.packed {
            true => Block::new(steps, components, &values),
            false => Block::plain(steps, components, values),
        }
    }
}

/// What the page of a result is given, as JSON.
///
/// # Errors
/// As [`html`].
pub fn data(result: &ResultFile, form: Form) -> Result<String, Error> {
    crate::store::json::to_text(&page(result, form)?)
}

/// The page of a result. Same result, same bytes.
///
/// # Errors
/// [`Error`] if a number is not finite, or the states of the sheet cannot be read.
pub fn html(result: &ResultFile) -> Result<String, Error> {
    filled(result, &data(result, Form::FILE)?)
}

/// The page of a result, with the drape of the same motion by another program beside it. Same result and same drape, same bytes.
///
/// # Errors
/// As [`html`].
pub fn compared_html(result: &ResultFile, comparison: &Comparison) -> Result<String, Error> {
    let page = page(result, Form::FILE)?;
    let peer = Some(Peer::new(comparison, &page.steps));
    filled(result, &crate::store::json::to_text(&Page { peer, ..page })?)
}

/// The page of a scene before anything is draped on its mold: the ply at its start, as the `result` of holding it there has it, where it
/// must end, what is said of the scene, each line with its noun, and warnings. Same scene, same bytes.
///
/// # Errors
/// As [`html`].
pub fn look_html(
    scene: &SceneFile,
    mut result: ResultFile,
    lines: &[(&'static str, String)],
    warnings: &[String],
) -> Result<String, Error> {
    // no limit is judged, and none is shown
    result.summary.limits.clear();
    let facts = look::LEGEND.iter().map(|(noun, text)| Fact::new(noun, (*text).into()));
    let facts =
        facts.chain(lines.iter().map(|(noun, text)| Fact::new(noun, text.clone()))).collect();
    let (look, left_out) =
        (Some(look(scene)), warnings.iter().map(|text| look::sentence(text)).collect());
    let page = Page { facts, look, left_out, ..page(&result, Form::FILE)? };
    filled(&result, &crate::store::json::to_text(&page)?)
}

/// The page with its title and its data.
fn filled(result: &ResultFile, data: &str) -> Result<String, Error> {
    let data = data.replace('<', "\\u003c");
    let title = result.scene.title.replace('&', "&amp;").replace('<', "&lt;");
    let whole =
        PAGE.split_once(TITLE).and_then(|(head, rest)| Some((head, rest.split_once(DATA)?)));
    let (head, (body, tail)) = whole.unwrap_or((PAGE, ("", "")));
    Ok([head, &title, body, data.trim_end(), tail].concat())
}

fn page(result: &ResultFile, form: Form) -> Result<Page<'_>, Error> {
    let (scene, summary) = (&result.scene, &result.summary);

    // the steps of the page: those of the model that decides, of large arrays of catenaries fewer
    let detail = Detail::new(result, result.steps.len());
    let every: Vec<usize> = (0..result.steps.len()).collect();
    let shown = if summary.model == Model::Catenaries { &detail.steps } else { &every };
    let steps: Vec<usize> = shown.iter().map(|k| result.steps[*k].step).collect();
    let times = shown.iter().map(|k| result.steps[*k].time).collect();

    // both models; the states of the sheet are those of whichever is the sheet
    let mut kept = KeptStates::open(result)?;
    let mesh = kept.as_ref().filter(|_| summary.model == Model::Sheet).map(KeptStates::mesh);
    let sample = sample(result, mesh);
    let mut states = |model| if model == Model::Sheet { kept.take() } else { None };
    let drape = Source::deciding(result).show(&steps, &detail, states(summary.model), form)?;
    let also = match Source::beside(result) {
        Some(beside) => {
            let detail = Detail::new(result, beside.steps.len());
            Some(beside.show(&steps, &detail, states(beside.summary.model), form)?)
        }
        None => None,
    };

    Ok(Page {
        format: "plydrape-page",
        version: 4,
        result_version: VERSION,
        program: &result.program,
        title: &scene.title,
        input: scene.input.as_deref(),
        facts: facts(result),
        accepted: summary.accepted(),
        world: result.world(),
        ended: ended(summary),
        times,
        first_contact: summary.first_contact_step(),
        ids: (0..scene.ply.grippers()).map(|n| scene.ply.id(n)).collect(),
        limits: limits(summary),
        left_out: left_out(result, &detail, steps.len(), drape.drawn.len()),
        steps,
        drape,
        also,
        mold: form.triangles.and_then(|most| Mold::new(result, most)),
        cell: cell(scene),
        events: events(result),
        sample,
        tolerance: [tolerances(result), tried(result)].concat(),
        look: None,
        peer: None,
    })
}

/// What the page leaves out of the model that decides, in sentences; `drawn` is the number of steps in which it draws the ply, of those that it shows.
fn left_out(result: &ResultFile, detail: &Detail, shown: usize, drawn: usize) -> Vec<String> {
    let (all, catenaries) = (result.steps.len(), result.model() == Model::Catenaries);
    let mut out = Vec::new();
    if catenaries && !detail.diagonals {
        out.push("The diagonals are left out: the array is large.".into());
    }
    if shown < all {
        out.push(format!(
            "{shown} of {all} steps are shown; steps.csv and result.json hold all of them."
        ));
    }
    if drawn < shown {
        out.push(format!(
            "The ply is drawn in {drawn} of {shown} steps, and between them as in the nearest one; grippers, charts and limits are of \
             every step."
        ));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample;
    use plydrape::measure::Name;
    use plydrape::ply::Grid;

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

    /// A limit is drawn with the course of its own measure, in the same unit.
    #[test]
    fn limits_know_their_measures() {
        let result = sample::draped(4, 2, 3);
        let page = page(&result, Form::FILE).unwrap();
        assert!(page.limits.iter().any(|limit| limit.key == Name::Tilt.measure().key()));
        for course in &page.drape.measures {
            for limit in page.limits.iter().filter(|limit| limit.key == course.key) {
                assert_eq!((limit.unit, Some(limit.limit)), (course.unit, course.limit));
            }
        }
    }

    /// The other model has measures and no limit: neither its own nor those of the model that decides.
    #[test]
    fn the_other_model_judges_nothing() {
        let mut result = sample::draped(4, 2, 3);
        let alone = serde_json::to_value(page(&result, Form::FILE).unwrap()).unwrap();
        let summary = result.summary.clone();
        result.also = Some(crate::result::Also { summary, steps: result.steps.clone() });
        let both = serde_json::to_value(page(&result, Form::FILE).unwrap()).unwrap();
        for key in ["accepted", "world", "ended", "limits", "steps", "drape"] {
            assert_eq!(alone[key], both[key], "{key}");
        }
        let also = &both["also"];
        let grippers = &also["grippers"];
        assert!(grippers["used"].is_null());
        for list in [&also["measures"], &also["fields"], &grippers["readings"]] {
            let list = list.as_array().unwrap();
            assert!(!list.is_empty() && list.iter().all(|entry| entry["limit"].is_null()));
        }
    }

    /// What is left out is named: diagonals and steps of a large array, and steps between those in which the ply is drawn.
    #[test]
    fn large_results_say_what_is_left_out() {
        let mut result = sample::draped(2, 2, 2);
        let left_out_lines = |result: &ResultFile, drawn: Option<usize>| {
            let detail = Detail::new(result, result.steps.len());
            let shown = detail.steps.len();
            left_out(result, &detail, shown, drawn.unwrap_or(shown)).len()
        };
        assert_eq!((left_out_lines(&result, None), left_out_lines(&result, Some(1))), (0, 1));
        result.scene.ply.grid = Grid { nu: 100, nv: 100 };
        result.steps = vec![result.steps[0].clone(); 200];
        assert_eq!(left_out_lines(&result, None), 2);
    }
}
