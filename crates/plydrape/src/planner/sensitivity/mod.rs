//! The quantities of a solved ply that a plan weighs, each with its exact gradient to all gripper positions.
//!
//! The equilibrium is differentiated by the implicit function theorem, eq. (11) of `docs/theory/equilibrium.md`: one
//! tangent for each gripper coordinate gives how every span's force, end slopes, run, rise and length
//! follow. All else is the chain rule. Contact segments stay fixed. Gradients are exact wherever the state is
//! differentiable: not where a diagonal just begins to shear, a slope just reaches its limit, or a point
//! just comes into contact.
//!
//! `span` has the quantities of one span, `contact` those of a span and the mold, `gripper` those of
//! grippers and cells, `outcome` those of the end of a drape.

mod contact;
mod gripper;
mod outcome;
mod span;

pub use outcome::{Outcome, outcome};
pub use span::Place;

use crate::draping::spans::{FreeSpan, Point, Shape};
use crate::equilibrium::{Direction, Solver, StateTangent};
use crate::ply::ContactSegment;
use crate::scene::Scene;

/// A number with its gradient to all gripper positions.
#[derive(Debug, Clone, PartialEq)]
pub struct Quantity {
    /// The value.
    pub value: f64,
    /// Derivatives to x, y, z of each gripper (per m), in the order of [`crate::ply::Grid::index`].
    pub gradient: Vec<f64>,
}

/// Rows of an element: force, both end slopes, run, rise, length.
const ROWS: usize = 6;

/// A solved ply with the derivatives of its state to all gripper positions.
pub struct Sensitivity<'a> {
    scene: &'a Scene,
    /// The free spans.
    pub shape: &'a Shape,
    positions: &'a [Point],
    contacts: &'a [Option<ContactSegment>],
    /// Derivatives of each element's force (N), end slopes, run, rise and length (m).
    rows: Vec<f64>,
    /// Taut path of each cell's stretched diagonal (m), if any, and its derivatives.
    paths: Vec<Option<Quantity>>,
    /// Slope of the ply at each gripper along u and v, where there is one.
    slopes: Vec<[Option<Quantity>; 2]>,
    /// Whether the state has derivatives: see [`StateTangent::is_sound`]. Gradients are meaningless where not.
    pub is_sound: bool,
}

impl<'a> Sensitivity<'a> {
    /// Differentiates the last state of a solver: `shape` are its spans, `positions` (m) and `contacts`
    /// those with which it was solved.
    #[must_use]
    pub fn new(
        scene: &'a Scene,
        solver: &mut Solver,
        shape: &'a Shape,
        positions: &'a [Point],
        contacts: &'a [Option<ContactSegment>],
    ) -> Self {
        let width = 3 * positions.len();
        let mut state = State::new(solver, positions);
        let mut direction = Direction::none(positions.len());
        let mut linearized = solver.linearize(positions, contacts);
        for column in 0..width {
            direction.grippers[column / 3][column % 3] = 1.0;
            state.put(column, &linearized.along(&direction));
            direction.grippers[column / 3][column % 3] = 0.0;
        }
        let is_sound = linearized.is_sound();
        let State { rows, paths, slopes, .. } = state;
        Sensitivity { scene, shape, positions, contacts, rows, paths, slopes, is_sound }
    }

    /// Number of derivatives: three a gripper.
    #[must_use]
    pub fn width(&self) -> usize {
        3 * self.positions.len()
    }

    /// Derivatives of one row of an element.
    fn row(&self, element: usize, row: usize) -> &[f64] {
        let width = self.width();
        &self.rows[(ROWS * element + row) * width..][..width]
    }

    /// The gripper that holds an end of a span; none where the mold does.
    #[must_use]
    pub fn gripper_at(&self, span: &FreeSpan, end: usize) -> Option<usize> {
        let grid = self.scene.ply.grid;
        let c = grid.catenary(span.catenary);
        let whole = self.contacts[span.catenary].is_none();
        (whole || span.segment == end).then(|| grid.index(if end == 0 { c.from } else { c.to }))
    }

    fn zeros(&self) -> Vec<f64> {
        vec![0.0; self.width()]
    }
}

/// Adds `factor` times `row` to `to`.
fn add(to: &mut [f64], factor: f64, row: &[f64]) {
    if factor != 0.0 {
        for (to, x) in to.iter_mut().zip(row) {
            *to += factor * x;
        }
    }
}

/// The derivatives of a state, filled column by column.
struct State {
    width: usize,
    rows: Vec<f64>,
    paths: Vec<Option<Quantity>>,
    slopes: Vec<[Option<Quantity>; 2]>,
}

impl State {
    fn new(solver: &Solver, positions: &[Point]) -> Self {
        let (problem, width) = (solver.problem(), 3 * positions.len());
        let quantity = |value| Quantity { value, gradient: vec![0.0; width] };
        let slope = |gripper, d| solver.gripper_slope(positions, gripper, d).map(quantity);
        let slopes = (0..positions.len()).map(|n| [0, 1].map(|d| slope(n, d))).collect();
        State {
            width,
            rows: vec![0.0; ROWS * problem.elements.len() * width],
            paths: problem.shearing.iter().map(|s| s.map(|(path, _)| quantity(path))).collect(),
            slopes,
        }
    }

    fn put(&mut self, column: usize, tangent: &StateTangent) {
        for (n, force) in tangent.force.iter().enumerate() {
            let ([first, second], [run, rise, length]) = (tangent.end_slopes[n], tangent.spans[n]);
            for (row, value) in [*force, first, second, run, rise, length].into_iter().enumerate() {
                self.rows[(ROWS * n + row) * self.width + column] = value;
            }
        }
        for (path, change) in self.paths.iter_mut().zip(&tangent.paths) {
            if let Some(path) = path {
                path.gradient[column] = *change;
            }
        }
        for (slopes, changes) in self.slopes.iter_mut().zip(&tangent.grippers) {
            for (slope, change) in slopes.iter_mut().zip(changes) {
                if let Some(slope) = slope {
                    slope.gradient[column] = *change;
                }
            }
        }
    }
}
