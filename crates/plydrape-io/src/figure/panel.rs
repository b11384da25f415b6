//! One step in 3D: ply, catenaries, grippers, contact, mold; nearer shapes are drawn over farther ones.

use super::FigureError;
use super::axes::Frame;
use super::canvas::{Canvas, Px};
use super::colour::{BLACK, EDGE, MOLD, RED, TARGET, WEAVE, viridis};
use super::layout::bounds;
use super::piece::{self, Form, Piece, grown, thread};
use super::projection::{Point, View, turned};
use super::relief::Relief;
use super::scale::Scale;
use super::sheet::SheetPicture;
use crate::result::ResultFile;
use crate::surface;
use plydrape::mold::Mold;
use plydrape::outcome::Step;
use plydrape::ply::Grid;

/// Radius of a gripper as a share of the shorter side of a cell.
const GRIPPER: f64 = 0.12;
/// Largest radius of a contact mark (picture points).
pub(super) const MOST_MARK: f64 = 3.6;
/// Distance of contact marks as a share of the cell.
const MARKS_APART: f64 = 0.125;

/// How finely a step is drawn: all lines and cells together stay within what a page can hold.
#[derive(Debug, Clone, Copy)]
struct Detail {
    /// Squares of a cell along each side.
    squares: usize,
    /// Squares between the fabric lines on the surface, if there are any.
    weave: Option<usize>,
    /// Pieces of a catenary.
    pieces: usize,
    /// Corners of a gripper's disc.
    corners: usize,
    /// Diagonals of very large arrays are left out.
    diagonals: bool,
}

impl Detail {
    /// For one of so many panels, with cells of so many picture points.
    fn of(result: &ResultFile, panels: usize, cell: f64) -> Self {
        let cells = result.scene.ply.lines().cells().len().max(1) as f64;
        let most = (6000.0 / cells / panels as f64).sqrt();
        let squares = (cell / 9.0).max(4.0).min(most).clamp(1.0, 28.0) as usize;
        Detail {
            squares: if squares > 1 { squares / 2 * 2 } else { 1 },
            weave: (squares >= 8).then_some(if squares < 20 { 2 } else { 4 }),
            pieces: (3000.0 / cells).min(cell / 7.0).clamp(1.0, 24.0) as usize,
            corners: (2000.0 / cells).clamp(8.0, 32.0) as usize,
            diagonals: cells < 1500.0,
        }
    }
}

/// What all panels share.
pub(super) struct Stage<'a> {
    pub result: &'a ResultFile,
    pub frame: Frame,
    /// Panels on the sheet.
    pub panels: usize,
    /// What the ply's colors stand for (m).
    pub scale: Scale,
    /// The patch of mold that is shown.
    pub mold: Option<MoldPicture>,
    /// The sheet, which is shown instead of the catenaries.
    pub sheet: Option<SheetPicture>,
}

/// What is shown of a mold.
pub(super) enum MoldPicture {
    /// The corners of a flat one.
    Flat([Point; 4]),
    /// The surface of a curved one.
    Relief(Relief),
}

impl MoldPicture {
    /// Lowest and highest point of what is shown (m).
    pub(super) fn heights(&self) -> [f64; 2] {
        match self {
            MoldPicture::Flat(patch) => bounds(patch).map(|p| p[2]),
            MoldPicture::Relief(relief) => relief.heights(),
        }
    }
}

/// The mold of a result, if it is curved.
pub(super) fn curved(result: &ResultFile) -> Option<&Mold> {
    result.scene.mold.as_ref().filter(|mold| !matches!(mold, Mold::Plane(_)))
}

/// What the ply's color tells at a place (m): its gap to a curved mold, else its height.
pub(crate) fn colour_value(result: &ResultFile, p: Point) -> f64 {
    curved(result).map_or(p[2], |mold| mold.signed_distance(p).max(0.0))
}

/// Radius of a gripper's disc (m).
pub(crate) fn gripper_radius(result: &ResultFile) -> f64 {
    let [a, b] = result.scene.ply.cell;
    let side = if result.scene.ply.grid.nv != 1 { a.min(b) } else { a };
    GRIPPER * side
}

/// A step and its curves (m).
type Shown<'a> = (&'a Step, &'a [Vec<Vec<Point>>]);

impl Stage<'_> {
    /// Draws a step where `view` puts it.
    pub(super) fn draw(
        &self,
        canvas: &mut Canvas,
        view: &View,
        step: &Step,
    ) -> Result<(), FigureError> {
        self.frame.back(canvas, view)?;
        self.mold(canvas, view)?;
        let mut pieces = Vec::new();
        let detail = Detail::of(self.result, self.panels, self.cell_length() * view.scale());
        let sheet = self.sheet.as_ref();
        if let Some(shown) = sheet.and_then(|sheet| Some((sheet, sheet.state(step.step)?))) {
            self.sheet(&mut pieces, view, shown);
        } else {
            let curves = self.result.curves(step);
            self.ply(&mut pieces, view, (step, &curves), detail);
            for gripper in &step.grippers {
                let held = (gripper.position, gripper.quaternion);
                self.disc(&mut pieces, view, held, self.lift(detail));
            }
            self.contact(&mut pieces, view, (step, &curves), detail);
        }
        if let Some(MoldPicture::Relief(relief)) = &self.mold {
            for line in self.outline() {
                thread(&mut pieces, view, &line, 0.0, TARGET, 1.2);
            }
            relief.paint_among(canvas, view, pieces)?;
        } else {
            piece::paint(canvas, pieces)?;
        }
        self.frame.front(canvas, view)
    }

    /// Whether colors tell heights over the mold.
    pub(super) fn is_over_mold(&self) -> bool {
        self.sheet.as_ref().is_some_and(|sheet| sheet.scale().is_some())
    }

    /// The outline of where the ply should end, side by side, each on the mold.
    fn outline(&self) -> Vec<Vec<Point>> {
        let (Some(target), Some(mold)) = (self.result.scene.target_grippers(), curved(self.result))
        else {
            return Vec::new();
        };
        let border = self.result.scene.ply.neighbours().into_iter().filter(|pair| pair.border);
        let side = |(a, b): (Point, Point)| match mold.path(a, b) {
            Some(line) => surface::stations(&line.points, 12),
            None => vec![a, b],
        };
        border
            .filter_map(|pair| {
                let [a, b] = pair.grippers.map(|n| target.get(n).copied());
                a.zip(b)
            })
            .map(side)
            .collect()
    }

    /// The patch of a flat mold, and on it the outline of where the ply should end.
    fn mold(&self, canvas: &mut Canvas, view: &View) -> Result<(), FigureError> {
        let Some(MoldPicture::Flat(patch)) = self.mold else {
            return Ok(());
        };
        canvas.polygon(&patch.map(|p| view.at(p)), MOLD)?;
        if let Some(target) = self.result.scene.target_grippers() {
            let grid = self.result.scene.ply.grid;
            if grid == Grid::NONE {
                for pair in self.result.scene.ply.neighbours().iter().filter(|pair| pair.border) {
                    let ends = pair.grippers.map(|n| target.get(n).map(|p| view.at(*p)));
                    let ends: Vec<Px> = ends.into_iter().flatten().collect();
                    canvas.line(&ends, TARGET, 1.2)?;
                }
                return Ok(());
            }
            let (nu, nv) = (grid.nu - 1, grid.nv - 1);
            let corners = [[0, 0], [nu, 0], [nu, nv], [0, nv], [0, 0]];
            let path: Vec<Px> = corners
                .iter()
                .filter_map(|id| target.get(grid.index(*id)))
                .map(|p| view.at(*p))
                .collect();
            canvas.line(&path, TARGET, 1.2)?;
        }
        Ok(())
    }

    /// How much nearer than its place a line on the surface counts (m), so that the squares that it
    /// borders do not cover it.
    fn lift(&self, detail: Detail) -> f64 {
        1.5 * self.cell_length() / detail.squares as f64
    }

    /// The longer side of a cell (m); of a strip, its length.
    fn cell_length(&self) -> f64 {
        let [a, b] = self.result.scene.ply.cell;
        if self.result.scene.ply.grid.nv != 1 { a.max(b) } else { a }
    }

    /// How many catenaries are drawn; edges come first.
    fn drawn(&self, detail: Detail) -> usize {
        let lines = self.result.scene.ply.lines();
        match detail.diagonals {
            true => lines.catenaries(),
            false => lines.edges(),
        }
    }

    /// Surface and catenaries.
    fn ply(&self, pieces: &mut Vec<Piece>, view: &View, (step, curves): Shown, detail: Detail) {
        let graph = self.result.scene.ply.lines();
        let n = detail.squares;
        let lift = self.lift(detail);
        let edges = surface::lines(self.result, step, curves, n);
        let cells = graph.surface().cells();
        for cell in graph.cells().iter().take(cells) {
            let points = surface::cell(&graph, cell, &edges, n);
            for row in 0..n {
                for column in 0..n {
                    let at = row * (n + 1) + column;
                    let square = [at, at + 1, at + n + 2, at + n + 1].map(|i| points[i]);
                    pieces.push(self.square(view, square));
                }
            }
            // Fabric lines: they show shear and wrinkles where colour hardly changes.
            let weave = detail.weave.map(|apart| (apart..n).step_by(apart));
            for m in weave.into_iter().flatten() {
                let each = (0..=n).step_by(2);
                let along: Vec<Point> = each.clone().map(|k| points[m * (n + 1) + k]).collect();
                let across: Vec<Point> = each.map(|k| points[k * (n + 1) + m]).collect();
                for line in [along, across] {
                    thread(pieces, view, &line, lift / 2.0, WEAVE, 0.7);
                }
            }
        }

        let lines = surface::lines(self.result, step, curves, detail.pieces);
        let count = self.drawn(detail);
        // Finer lines leave colour to be seen in small cells.
        let finer = (self.cell_length() * view.scale() / 70.0).clamp(0.4, 1.0);
        for (k, line) in lines.iter().take(count).enumerate() {
            let width = if k < graph.edges() { 1.7 } else { 1.1 };
            thread(pieces, view, line, lift, RED, width * finer);
        }
    }

    /// A piece of surface in the color of its middle, grown by a hair so that no seam shows.
    fn square(&self, view: &View, corners: [Point; 4]) -> Piece {
        let mean = |of: &dyn Fn(Point) -> f64| corners.iter().map(|p| of(*p)).sum::<f64>() / 4.0;
        let place = [0, 1, 2].map(|c| mean(&|p| p[c]));
        Piece {
            depth: mean(&|p| view.depth(p)),
            place,
            points: grown(&corners.map(|p| view.at(p))),
            ink: viridis(self.scale.share(colour_value(self.result, place))),
            form: Form::Area,
        }
    }

    /// A gripper at a place and turned by a quaternion: a disc with a thin light edge, brought nearer by `lift` (m).
    pub(super) fn disc(
        &self,
        pieces: &mut Vec<Piece>,
        view: &View,
        (place, turn): (Point, [f64; 4]),
        lift: f64,
    ) {
        let radius = gripper_radius(self.result);
        let corners =
            Detail::of(self.result, self.panels, self.cell_length() * view.scale()).corners;
        let edge_width = (0.1 * radius * view.scale()).min(0.9);
        let edge = |k: usize| {
            let angle = std::f64::consts::TAU * k as f64 / corners as f64;
            let arm = turned(turn, [radius * angle.cos(), radius * angle.sin(), 0.0]);
            view.at([0, 1, 2].map(|c| place[c] + arm[c]))
        };
        let points: Vec<Px> = (0..corners).map(edge).collect();
        let depth = view.depth(place) + lift + 2.0 * radius;
        let mut edge = points.clone();
        edge.push(points[0]);
        let piece = |points, ink, form| Piece { depth, place, points, ink, form };
        pieces.push(piece(points, BLACK, Form::Area));
        if edge_width > 0.2 {
            pieces.push(piece(edge, EDGE, Form::Line(edge_width)));
        }
    }

    /// Contact: a stronger line along each segment, and open circles from end to end.
    fn contact(&self, pieces: &mut Vec<Piece>, view: &View, (step, curves): Shown, detail: Detail) {
        // Below the grippers, above all of the ply near by.
        let lift = self.lift(detail) + 1.5 * gripper_radius(self.result);
        let cell = self.cell_length();
        let radius = (0.045 * cell * view.scale()).min(MOST_MARK);
        let apart = (MARKS_APART * cell).max(5.0 * radius / view.scale());
        let count = self.drawn(detail);
        for line in surface::contact_lines(step, curves, count) {
            let [Some(first), Some(last)] = [line.first(), line.last()] else {
                continue;
            };
            let square: f64 = (0..3).map(|c| (last[c] - first[c]).powi(2)).sum();
            let marks = (square.sqrt() / apart).floor().min(50.0) as usize;
            let places = match marks {
                0 => vec![line[line.len() / 2]],
                _ => surface::stations(&line, marks),
            };
            if line.len() > 1 {
                let thick = surface::stations(&line, detail.pieces);
                thread(pieces, view, &thick, lift, RED, 0.65 * radius);
            }
            // On a large array the lines alone can tell.
            if radius > 1.0 {
                pieces.extend(places.into_iter().map(|place| Piece {
                    depth: view.depth(place) + lift,
                    place,
                    points: vec![view.at(place)],
                    ink: RED,
                    form: Form::Ring(radius),
                }));
            }
        }
    }
}
