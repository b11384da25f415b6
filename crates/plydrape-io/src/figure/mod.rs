//! The paper's figure as one SVG: chosen steps in 3D, one above the other, in one frame and one scale.
//!
//! After Krogh et al. 2018, the figure of the numerical example: catenaries are red lines, a surface
//! inside each cell is colored by z, grippers are black discs tilted with the ply, contact is marked by
//! red circles. Horizontal lengths have equal scale, z too unless its label says by how much it is
//! exaggerated. A curved mold is drawn as a shaded surface, never exaggerated, and the ply over it is
//! colored by its gap to the mold. Where the sheet decides, the figure shows the sheet instead. Same
//! result, same bytes.

mod axes;
mod bar;
mod canvas;
mod colour;
pub mod comparison;
mod layout;
mod panel;
mod piece;
mod projection;
mod relief;
mod scale;
pub mod seeds;
pub mod shear_map;
mod sheet;
mod shorten;

pub(super) use colour::viridis_rgb;
pub(super) use panel::{colour_value, gripper_radius};

use crate::OutputError;
use crate::result::{ResultFile, catenaries};
use plydrape::layup::Model;
use plydrape::outcome::Step;
use plydrape::ply::Grid;
use plydrape::sheet::is_kept;
use sheet::SheetPicture;

/// The most steps that one figure shows.
pub const MOST_PANELS: usize = 3;

/// Why a figure could not be drawn.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum FigureError {
    /// No step is asked for, or the result has none.
    #[error("a figure needs at least one step")]
    NoStep,
    /// More steps than fit.
    #[error("{asked} steps are too many for one figure; choose up to {MOST_PANELS}")]
    TooManySteps {
        /// How many were asked for.
        asked: usize,
    },
    /// A step that the result does not have.
    #[error("the result has no step {step}; its steps are {first} to {last}")]
    NoSuchStep {
        /// The step asked for.
        step: usize,
        /// The result's first step.
        first: usize,
        /// The result's last step.
        last: usize,
    },
    /// A step does not have one gripper for each place of the grid, or a grid too small to draw.
    #[error("step {step} has {found} grippers, its grid of {nu} × {nv} needs {}", nu * nv)]
    Grippers {
        /// The step.
        step: usize,
        /// Its grippers.
        found: usize,
        /// Grippers of the grid along u.
        nu: usize,
        /// Grippers of the grid along v.
        nv: usize,
    },
    /// A coordinate is NaN or infinite.
    #[error("step {step} has a coordinate that is not a finite number")]
    NotFinite {
        /// The step.
        step: usize,
    },
    /// A step of a sheet whose state was not kept.
    #[error("the sheet was not kept in step {step}; its kept steps are {kept}")]
    NotKept {
        /// The step asked for.
        step: usize,
        /// The steps that were kept, in words.
        kept: String,
    },
    /// A net without a node on the mold.
    #[error("the net has no node on the mold, so there is nothing to draw")]
    NoNode,
    /// The SVG writer failed.
    #[error("the figure could not be drawn: {0}")]
    Drawing(String),
}

impl From<FigureError> for OutputError {
    fn from(error: FigureError) -> Self {
        OutputError::Writer(error.into())
    }
}

/// The steps that tell most: the first, the first with contact, the last; each once. Of a sheet, those that were kept.
#[must_use]
pub fn default_steps(result: &ResultFile) -> Vec<usize> {
    let summary = &result.summary;
    let (planned, keep) = (summary.steps_planned, result.scene.settings.sheet.keep);
    let last = result.steps.last().map_or(0, |step| step.step);
    let kept = |step: &usize| {
        summary.model == Model::Catenaries || is_kept(*step, planned, keep) || *step == last
    };
    let contact = summary.first_contact_step().and_then(|step| (step..=last).find(kept));
    let first = result.steps.first().map(|step| step.step);
    let mut steps: Vec<usize> =
        [first, contact, first.map(|_| last)].into_iter().flatten().collect();
    steps.dedup();
    steps
}

/// The figure of up to three steps, given by their numbers (from 1), as an SVG 900 points wide: of the model that decides.
///
/// # Errors
/// [`OutputError`] if a step is missing or of a sheet not kept, its coordinates are not finite, or the states of the sheet cannot be read.
pub fn svg(result: &ResultFile, steps: &[usize]) -> Result<String, OutputError> {
    check(result, steps)?;
    Ok(drawn(result, steps, SheetPicture::read(result, steps)?)?)
}

/// The steps of a result that are asked for by their numbers.
fn check<'a>(result: &'a ResultFile, steps: &[usize]) -> Result<Vec<&'a Step>, FigureError> {
    if steps.len() > MOST_PANELS {
        return Err(FigureError::TooManySteps { asked: steps.len() });
    }
    let (Some(first), Some(last)) = (result.steps.first(), result.steps.last()) else {
        return Err(FigureError::NoStep);
    };
    let find = |step: &usize| {
        let found = result.steps.iter().find(|s| s.step == *step);
        found.ok_or(FigureError::NoSuchStep { step: *step, first: first.step, last: last.step })
    };
    steps.iter().map(find).collect()
}

/// The figure, of the sheet where that decides.
fn drawn(
    result: &ResultFile,
    steps: &[usize],
    sheet: Option<SheetPicture>,
) -> Result<String, FigureError> {
    let shown = check(result, steps)?;
    let grid = result.scene.ply.grid;
    for step in &shown {
        let found = step.grippers.len();
        let none = grid == Grid::NONE;
        let small = grid.nu < 2 || grid.nv < 1;
        if found != result.scene.ply.grippers() || small && !none {
            let (step, nu, nv) = (step.step, grid.nu, grid.nv);
            return Err(FigureError::Grippers { step, found, nu, nv });
        }
        if !points(result, step).all(|p| p.iter().all(|c| c.is_finite() && c.abs() < 1e6)) {
            return Err(FigureError::NotFinite { step: step.step });
        }
    }
    match shown.is_empty() {
        true => Err(FigureError::NoStep),
        false => layout::page(result, &shown, sheet),
    }
}

/// Every point of a step that the figure draws (m).
fn points(result: &ResultFile, step: &Step) -> impl Iterator<Item = [f64; 3]> {
    let curves = result.curves(step).into_iter().flatten().flatten();
    let contact = catenaries(step).iter().filter_map(|c| c.contact.as_ref());
    let grippers = step.grippers.iter().map(|g| g.position);
    grippers.chain(curves).chain(contact.flat_map(|c| c.points.iter().copied()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample;

    /// First, first contact, last; a single step only once.
    #[test]
    fn default_steps_are_first_contact_and_last() {
        let result = sample::draped(4, 2, 30);
        let contact = result.summary.first_contact_step().unwrap();
        assert_eq!(default_steps(&result), [1, contact, 30]);
        assert_eq!(default_steps(&sample::hanging(2, 1)), [1]);
    }

    /// Grids, strips, hanging plies and molds of every tilt give well-formed pictures of finite numbers.
    #[test]
    fn every_kind_of_result_has_a_picture() {
        let mut steep = sample::draped(4, 2, 30);
        steep.scene.mold = Some(plydrape::mold::Mold::Plane(plydrape::mold::Plane {
            point: [0.0; 3],
            normal: [0.999_999_999, 0.0, 4e-5],
        }));
        let results = [
            sample::draped(4, 2, 30),
            sample::draped(2, 4, 30),
            sample::draped(8, 5, 10),
            sample::hanging(2, 1),
            sample::hanging(30, 30),
            sample::tilted(8, 5),
            sample::draped(60, 60, 2),
            steep,
        ];
        for result in &results {
            let text = svg(result, &default_steps(result)).unwrap();
            assert!(text.len() < 8_000_000, "{} bytes", text.len());
            assert!(text.starts_with("<svg ") && text.trim_end().ends_with("</svg>"));
            assert!(text.contains("z (mm)") && !text.contains("NaN") && !text.contains("inf"));
            assert_eq!(text, svg(result, &default_steps(result)).unwrap());
        }
    }

    /// A title may hold anything.
    #[test]
    fn titles_are_escaped() {
        let mut result = sample::hanging(2, 2);
        result.scene.title = "<b>&\"\u{1}</b>".into();
        let text = svg(&result, &[1]).unwrap();
        assert!(text.contains("&lt;b&gt;&amp;&quot; &lt;/b&gt;"));
    }

    /// What cannot be drawn is said in numbers.
    #[test]
    fn steps_that_cannot_be_drawn_are_refused() {
        let mut result = sample::draped(4, 2, 5);
        let svg = |result: &ResultFile, steps: &[usize]| drawn(result, steps, None);
        assert_eq!(svg(&result, &[]), Err(FigureError::NoStep));
        assert_eq!(
            svg(&result, &[1, 9]),
            Err(FigureError::NoSuchStep { step: 9, first: 1, last: 5 })
        );
        assert_eq!(svg(&result, &[1, 2, 3, 4]), Err(FigureError::TooManySteps { asked: 4 }));
        result.steps[1].grippers[0].position[2] = f64::NAN;
        assert_eq!(svg(&result, &[2]), Err(FigureError::NotFinite { step: 2 }));
        result.steps[2].grippers.pop();
        assert!(matches!(svg(&result, &[3]), Err(FigureError::Grippers { found: 7, .. })));
    }
}
