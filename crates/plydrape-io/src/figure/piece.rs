//! The pieces of a picture, painted from the farthest to the nearest: the painter's algorithm.

use super::FigureError;
use super::canvas::{Canvas, Ink, Px};
use super::projection::{Point, View};

/// A flat shape on the sheet and how near it is.
pub(super) struct Piece {
    /// How near it is (m); larger is nearer.
    pub(super) depth: f64,
    /// Where it is in space (m).
    pub(super) place: Point,
    /// Its corners.
    pub(super) points: Vec<Px>,
    /// Its color.
    pub(super) ink: Ink,
    /// What it is.
    pub(super) form: Form,
}

/// What a piece is.
#[derive(Clone, Copy)]
pub(super) enum Form {
    /// A filled polygon.
    Area,
    /// A line of a width (picture points).
    Line(f64),
    /// An open circle of a radius (picture points) around its only point.
    Ring(f64),
}

/// Paints all pieces, farther ones first; equally near ones in the order given.
pub(super) fn paint(canvas: &mut Canvas, mut pieces: Vec<Piece>) -> Result<(), FigureError> {
    pieces.sort_by(|a, b| a.depth.total_cmp(&b.depth));
    for piece in &pieces {
        match piece.form {
            Form::Area => canvas.polygon(&piece.points, piece.ink)?,
            Form::Line(width) => canvas.line(&piece.points, piece.ink, width)?,
            Form::Ring(radius) => {
                let width = (0.45 * radius).min(1.3);
                canvas.circle(piece.points[0], radius, piece.ink, width)?;
            }
        }
    }
    Ok(())
}

/// A line in pieces, each with its own depth, brought nearer by `lift` (m).
pub(super) fn thread(
    pieces: &mut Vec<Piece>,
    view: &View,
    line: &[Point],
    lift: f64,
    ink: Ink,
    width: f64,
) {
    pieces.extend(line.windows(2).map(|pair| Piece {
        depth: lift + (view.depth(pair[0]) + view.depth(pair[1])) / 2.0,
        place: [0, 1, 2].map(|c| (pair[0][c] + pair[1][c]) / 2.0),
        points: overlapped(view.at(pair[0]), view.at(pair[1])),
        ink,
        form: Form::Line(width),
    }));
}

/// A piece of line, a little longer at both ends, so that pieces join.
fn overlapped(a: Px, b: Px) -> Vec<Px> {
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let hair = 0.3 / dx.hypot(dy).max(0.3);
    vec![[a[0] - hair * dx, a[1] - hair * dy], [b[0] + hair * dx, b[1] + hair * dy]]
}

/// A polygon grown by a hair, so that no seam shows beside its neighbors.
pub(super) fn grown(corners: &[Px]) -> Vec<Px> {
    let count = corners.len() as f64;
    let center = [0, 1].map(|c| corners.iter().map(|p| p[c]).sum::<f64>() / count);
    let grow = |[x, y]: &Px| {
        let (dx, dy) = (x - center[0], y - center[1]);
        let hair = 0.7 / dx.hypot(dy).max(0.7);
        [x + hair * dx, y + hair * dy]
    };
    corners.iter().map(grow).collect()
}
