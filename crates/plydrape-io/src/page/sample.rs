//! What the page shows of the verdict over a sample of cells, and of what a motion tolerates.

use super::limit::Limit;
use crate::result::ResultFile;
use crate::result::sheet::SheetMesh;
use crate::text::table::closest_first;
use crate::text::table::{sample_in_words, share};
use plydrape::geometry::distance;
use plydrape::measure::Name;
use plydrape::outcome::CellVerdict;
use serde::Serialize;

/// The verdict over a sample.
#[derive(Serialize)]
pub(super) struct Sample<'a> {
    /// Cells that keep every limit.
    accepted: usize,
    ok: bool,
    /// What the sample says of all cells, and the share of them that must keep the limits.
    words: String,
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

/// The sample of a result, if it has one; `mesh` is that of the sheet, if the sheet decides.
pub(super) fn sample<'a>(result: &'a ResultFile, mesh: Option<&SheetMesh>) -> Option<Sample<'a>> {
    let verdict = result.summary.sample.as_ref()?;
    let height = result.summary.limits.iter().find(|limit| limit.name == Name::Height);
    let highest = verdict.highest.as_ref().map(|highest| Highest {
        height_mm: highest.height_mm,
        uv_mm: highest.uv_mm,
        line: &highest.line,
        gripper: &highest.gripper,
        node: mesh.and_then(|mesh| nearest(mesh, highest.uv_mm.map(|c| c * 1e-3))),
    });
    Some(Sample {
        accepted: verdict.accepted(),
        ok: verdict.ok,
        words: sample_in_words(verdict),
        share: share(verdict),
        cells: &verdict.cells,
        height_limit: height.map(|height| height.limit),
        limits: closest_first(&verdict.limits).into_iter().map(Limit::from).collect(),
        highest,
    })
}

/// The node nearest to a place in the fabric (m).
fn nearest(mesh: &SheetMesh, [u, v]: [f64; 2]) -> Option<usize> {
    let away = |place: &[f64; 2]| distance([place[0], place[1], 0.0], [u, v, 0.0]);
    let places = mesh.places.iter().enumerate();
    places.min_by(|a, b| away(a.1).total_cmp(&away(b.1))).map(|(node, _)| node)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample;
    use plydrape::errors::Errors;
    use plydrape::measure::{Verdict, Worst};
    use plydrape::outcome::{self, SampleVerdict};

    /// A result with a sample of four cells, of which one has no end.
    fn sampled() -> ResultFile {
        let mut result = sample::draped(4, 2, 3);
        let cell = |accepted, height_mm| CellVerdict { accepted, height_mm, ratio: 1.0 };
        let highest = outcome::Highest {
            height_mm: 0.4,
            uv_mm: [290.0, 12.0],
            line: "gripper g3_0 to gripper g3_1".into(),
            gripper: "gripper g3_0".into(),
        };
        let worst = Worst { value: 0.4, at: String::new(), place: None };
        result.summary.limits.push(Verdict::new(Name::Height, worst, 0.5, Some(3)));
        let errors = Errors { share: 0.75, samples: 4, ..Errors::default() };
        result.summary.sample = Some(SampleVerdict {
            errors,
            needed: 3,
            ok: true,
            confidence: errors.confidence(3, 4, true),
            limits: result.summary.limits.clone(),
            cells: vec![
                cell(true, Some(0.1)),
                cell(true, Some(0.2)),
                cell(false, None),
                cell(true, Some(0.3)),
            ],
            highest: Some(highest),
            spread_mm: vec![0.0, 0.1, 0.4],
        });
        result
    }

    /// Three nodes along u.
    fn mesh() -> SheetMesh<'static> {
        SheetMesh {
            places: vec![[0.0, 0.0], [0.15, 0.0], [0.3, 0.0]].into(),
            areas: vec![0.01; 3].into(),
            segments: vec![[0, 1], [1, 2]].into(),
            cells: Vec::new().into(),
            grippers: 2,
            releases: false,
        }
    }

    /// Counts, the share in words, and the node nearest to the highest place; without a sheet there is none to show.
    #[test]
    fn a_sample_is_told_with_the_node_of_its_highest_place() {
        let result = sampled();
        let told = sample(&result, Some(&mesh())).unwrap();
        assert_eq!((told.accepted, told.share.as_str()), (3, "75 %"));
        let words = "3 of 4 cells with errors keep every limit: 75 % of all cells do, with 26.2 % confidence";
        assert_eq!(told.words, words);
        assert_eq!(told.cells.len(), 4);
        assert_eq!(told.height_limit, Some(0.5));
        assert_eq!(told.highest.unwrap().node, Some(2));
        assert_eq!(sample(&result, None).unwrap().highest.unwrap().node, None);
        assert!(sample(&sample::draped(4, 2, 3), None).is_none());
    }
}
