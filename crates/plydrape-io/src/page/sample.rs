//! What the page shows of the verdict over a sample of cells, and of the largest errors that a motion stands.

use super::facts::shown;
use super::{Limit, limit};
use crate::result::ResultFile;
use crate::sheet::SheetMesh;
use plydrape::errors::{CellVerdict, SampleVerdict, Stands, Term};
use plydrape::mold::distance;
use serde::Serialize;

/// The verdict over a sample.
#[derive(Serialize)]
pub(super) struct Sample<'a> {
    /// Cells that keep every limit, and how many must.
    accepted: usize,
    needed: usize,
    ok: bool,
    /// The share of the cells that must, in words.
    share: String,
    cells: &'a [CellVerdict],
    /// Limit of the heights (mm), where they are judged.
    height_limit: Option<f64>,
    limits: Vec<Limit<'a>>,
    highest: Option<Highest<'a>>,
}

/// The highest place of the sample.
#[derive(Serialize)]
struct Highest<'a> {
    height_mm: f64,
    uv_mm: [f64; 2],
    line: &'a str,
    gripper: &'a str,
    /// The node of the sheet there.
    node: Option<usize>,
}

/// That of a result, if it has one; `mesh` is that of the sheet.
pub(super) fn sample<'a>(result: &'a ResultFile, mesh: Option<&SheetMesh>) -> Option<Sample<'a>> {
    let verdict = result.summary.sample.as_ref()?;
    let target = result.scene.target.is_some();
    let highest = verdict.highest.as_ref().map(|highest| Highest {
        height_mm: highest.height_mm,
        uv_mm: highest.uv_mm,
        line: &highest.line,
        gripper: &highest.gripper,
        node: mesh.and_then(|mesh| nearest(mesh, highest.uv_mm.map(|c| c * 1e-3))),
    });
    Some(Sample {
        accepted: verdict.accepted(),
        needed: verdict.needed,
        ok: verdict.ok,
        share: share(verdict),
        cells: &verdict.cells,
        height_limit: target.then_some(result.scene.limits.height * 1e3),
        limits: verdict.limits.iter().map(|verdict| limit(verdict, None)).collect(),
        highest,
    })
}

/// The share of the cells that must keep the limits.
pub(super) fn share(verdict: &SampleVerdict) -> String {
    format!("{} %", shown(verdict.errors.share * 1e2))
}

/// The node nearest to a place in the fabric (m).
fn nearest(mesh: &SheetMesh, [u, v]: [f64; 2]) -> Option<usize> {
    let away = |place: &[f64; 2]| distance([place[0], place[1], 0.0], [u, v, 0.0]);
    let places = mesh.places.iter().enumerate();
    places.min_by(|a, b| away(a.1).total_cmp(&away(b.1))).map(|(node, _)| node)
}

/// The largest errors that the motion stands, in words; none where it was not asked for.
pub(super) fn stands(result: &ResultFile) -> Option<String> {
    let Stands { factor, at_least, position, tried } = result.summary.stands?;
    let tried = format!("by {tried} drapes each");
    if factor == 0.0 {
        return Some(format!("stands none of the errors that were tried, {tried}"));
    }
    let least = if at_least { "at least " } else { "" };
    let size = shown(position.value() * 1e3);
    let of_position = match position {
        Term::Deviation(_) => format!("{size} mm (standard deviation) of each gripper's position"),
        Term::Bound(_) => format!("±\u{202f}{size} mm of each gripper's position"),
    };
    let times = format!("{} times the errors of the scene", shown(factor));
    Some(match (position.is_zero(), result.scene.errors.is_some()) {
        (true, _) => format!("stands {least}{times}, {tried}"),
        (false, false) => format!("stands errors of {least}{of_position}, {tried}"),
        (false, true) => format!("stands errors of {least}{of_position}: {times}, {tried}"),
    })
}
