//! The sheet in a panel: its cells, colored by their height over the mold, fabric lines, and its pads.
//!
//! The scale is the same in all figures, by orders of size from a tenth of a millimeter to ten, so that pictures can be
//! compared.

use super::FigureError;
use super::colour::{FRAME, WEAVE, viridis};
use super::panel::Stage;
use super::piece::{Form, Piece, grown, thread};
use super::projection::{Point, View};
use super::scale::Scale;
use crate::OutputError;
use crate::result::ResultFile;
use crate::sheet::{CutCell, SheetState};

use plydrape::layup::Model;
use std::collections::HashSet;

/// Heights at the ends of the colors (m).
const HEIGHTS: [f64; 2] = [1e-4, 1e-2];
/// Squares of all panels, about, and cells up to which fabric lines are drawn.
const SQUARES: usize = 8000;
const LINES: usize = 3500;

/// The sheet in the steps of a figure.
pub(super) struct SheetPicture {
    /// Corners of the whole cells.
    pub cells: Vec<[usize; 4]>,
    /// Cells that the boundary cuts.
    cut: Vec<CutCell>,
    /// The states that are shown, one a panel.
    pub states: Vec<SheetState<'static>>,
}

impl SheetPicture {
    /// Reads the states of some steps; none of a result that the sheet does not decide.
    pub fn read(result: &ResultFile, steps: &[usize]) -> Result<Option<Self>, OutputError> {
        let Some(kept) = result.sheet_states.as_ref().filter(|_| result.model() == Model::Sheet)
        else {
            return Ok(None);
        };
        let mut file = kept.open()?;
        let known = file.steps()?;
        let mut states = Vec::new();
        for step in steps {
            let number = known.iter().find(|(kept, _)| kept == step).map(|(_, n)| *n);
            let Some(number) = number else { return Err(not_kept(*step, &known).into()) };
            states.extend(file.state(number)?);
        }
        let cut = CutCell::all(&result.scene.ply, &result.scene.settings, file.mesh());
        let known: HashSet<[u32; 4]> = cut.iter().map(|cell| cell.nodes).collect();
        let whole = file.mesh().cells.iter().filter(|cell| !known.contains(*cell));
        let cells = whole.map(|cell| cell.map(|n| n as usize)).collect();
        Ok(Some(SheetPicture { cells, cut, states }))
    }

    /// The state of a step.
    pub fn state(&self, step: usize) -> Option<&SheetState<'static>> {
        self.states.iter().find(|state| state.step as usize == step)
    }

    /// What its colors stand for (m); none without a mold.
    pub fn scale(&self) -> Option<Scale> {
        let known = self.states.iter().flat_map(|state| state.height.iter()).any(|h| h.is_finite());
        known.then_some(Scale::Orders(HEIGHTS))
    }

    /// The largest height in a step (m).
    pub fn highest(&self, step: usize) -> Option<f64> {
        let heights = self.state(step)?.height.iter().copied().filter(|h| h.is_finite());
        heights.reduce(f64::max)
    }
}

impl Stage<'_> {
    /// The cells of a state, its fabric lines and its pads.
    pub(super) fn sheet(
        &self,
        pieces: &mut Vec<Piece>,
        view: &View,
        (picture, state): (&SheetPicture, &SheetState),
    ) {
        let drawn = picture.cells.len() * self.panels;
        let parts = (SQUARES / drawn.max(1)).isqrt().clamp(1, 4);
        let mut lift = 0.0;
        for cell in &picture.cells {
            let at = |share: [f64; 2]| within(state, *cell, share);
            let share = |k: usize| k as f64 / parts as f64;
            for [k, m] in (0..parts * parts).map(|n| [n % parts, n / parts]) {
                let corners = [[k, m], [k + 1, m], [k + 1, m + 1], [k, m + 1]];
                let corners = corners.map(|corner| at(corner.map(share)).0);
                let middle = at([k, m].map(|n| share(n) + 0.5 / parts as f64));
                pieces.push(self.part(view, &corners, middle));
            }
            let sides = [0, 1, 2, 3].map(|k| [cell[k], cell[(k + 1) % 4]]);
            lift = length(sides[0].map(|n| state.positions[n])).max(lift);
            if drawn <= LINES {
                for side in [sides[0], sides[3]] {
                    let line = side.map(|n| state.positions[n]);
                    thread(pieces, view, &line, 0.5 * length(line), WEAVE, 0.6);
                }
            }
        }
        for cell in &picture.cut {
            let at = |share: &[f64; 2]| within(state, cell.nodes.map(|n| n as usize), *share);
            let polygon = cell.polygon();
            let corners: Vec<Point> = polygon.iter().map(|share| at(share).0).collect();
            let middle = [0, 1]
                .map(|n| polygon.iter().map(|share| share[n]).sum::<f64>() / polygon.len() as f64);
            pieces.push(self.part(view, &corners, at(&middle)));
        }
        for (place, turn) in state.grippers.iter().zip(state.pad_rotation.iter()) {
            self.disc(pieces, view, (*place, *turn), lift);
        }
    }

    /// A part of the sheet between corners, with the color of its middle, a point and its height (m).
    fn part(&self, view: &View, corners: &[Point], (place, height): (Point, f64)) -> Piece {
        let value = if self.is_over_mold() { height } else { place[2] };
        let ink = match value.is_finite() {
            true => viridis(self.scale.share(value.max(0.0))),
            false => FRAME,
        };
        let depth = corners.iter().map(|p| view.depth(*p)).sum::<f64>() / corners.len() as f64;
        let points = grown(&corners.iter().map(|p| view.at(*p)).collect::<Vec<_>>());
        Piece { depth, place, points, ink, form: Form::Area }
    }
}

/// Why a step has no picture, with the steps that have one.
fn not_kept(step: usize, kept: &[(usize, usize)]) -> FigureError {
    let numbers: Vec<String> = kept.iter().map(|(step, _)| step.to_string()).collect();
    FigureError::NotKept { step, kept: numbers.join(", ") }
}

/// The point of a cell at shares of its sides, and its height over the mold (m).
fn within(state: &SheetState, cell: [usize; 4], [a, b]: [f64; 2]) -> (Point, f64) {
    let weights = [(1.0 - a) * (1.0 - b), a * (1.0 - b), a * b, (1.0 - a) * b];
    let sum = |of: &dyn Fn(usize) -> f64| (0..4).map(|k| weights[k] * of(cell[k])).sum::<f64>();
    ([0, 1, 2].map(|c| sum(&|n| state.positions[n][c])), sum(&|n| state.height[n]))
}

fn length([a, b]: [Point; 2]) -> f64 {
    plydrape::geometry::distance(a, b)
}
