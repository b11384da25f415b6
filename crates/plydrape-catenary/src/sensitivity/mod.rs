//! The quantities of a solved ply that a plan weighs, each with its gradient to all gripper positions.
//!
//! The equilibrium is differentiated by the implicit function theorem, eq. (11) of `docs/theory/equilibrium.md`: one
//! tangent for each group of distant grippers and each axis gives how every span's force, end slopes, run, rise and length
//! follow. All else is the chain rule. Contact segments stay fixed. Gradients are exact, but for what is left out of them
//! as negligible, wherever the state is differentiable: not where a diagonal just begins to shear, a slope just reaches its
//! limit, or a point just comes into contact.
//!
//! `state` has the derivatives of the state as sparse rows, `span` the quantities of one span,
//! `contact` those of a span and the mold, `gripper` those of grippers and cells, `last_step` those of the end of a drape; `row` is a sparse row.

mod contact;
mod gripper;
mod last_step;
mod row;
mod span;
mod state;
#[cfg(test)]
mod tests;
pub mod tuning;

pub use last_step::LastStep;
pub use row::Row;
pub use span::PointDerivative;

use crate::draping::spans::{Equilibrium, FreeSpan, Point};
use crate::equilibrium::Solver;
use crate::layup::Layup;
use crate::ply::ContactSegment;
use state::StateDerivatives;

/// A number with its gradient to all gripper positions.
#[derive(Debug, Clone, PartialEq)]
pub struct Quantity {
    /// The value.
    pub value: f64,
    /// Derivatives to x, y, z of each gripper (per m), in the order of [`crate::ply::Ply::index`].
    pub gradient: Row,
}

/// Rows of an element: force, both end slopes, run, rise, length.
const ROWS: usize = 6;

/// A solved ply with the derivatives of its state to all gripper positions.
pub struct Sensitivity<'a> {
    layup: &'a Layup,
    /// The free spans.
    pub shape: &'a Equilibrium,
    positions: &'a [Point],
    contacts: &'a [Option<ContactSegment>],
    /// Derivatives of each element's force (N), end slopes, run, rise and length (m).
    rows: Vec<[Row; ROWS]>,
    /// Taut path of each cell's stretched diagonal (m), if any, and its derivatives.
    paths: Vec<Option<Quantity>>,
    /// Slope of the ply at each gripper along u and v, where there is one.
    slopes: Vec<[Option<Quantity>; 2]>,
}

impl<'a> Sensitivity<'a> {
    /// Differentiates the last state of a solver: `shape` are its spans, `positions` (m) and `contacts`
    /// those with which it was solved. Derivatives below a share `negligible` of the largest of the same quantity are left out, see
    /// [`tuning::SensitivityTuning`], so that the memory and the directions that it takes grow with the number of
    /// grippers and not with its square; with 0 there are all.
    #[must_use]
    pub fn new(
        layup: &'a Layup,
        solver: &mut Solver,
        shape: &'a Equilibrium,
        positions: &'a [Point],
        contacts: &'a [Option<ContactSegment>],
        negligible: f64,
    ) -> Self {
        let StateDerivatives { rows, paths, slopes } =
            StateDerivatives::new(&layup.ply, solver, positions, contacts, negligible);
        Sensitivity { layup, shape, positions, contacts, rows, paths, slopes }
    }

    /// Derivatives of one row of an element.
    fn row(&self, element: usize, row: usize) -> &Row {
        &self.rows[element][row]
    }

    /// The gripper that holds an end of a span; `None` where the mold does.
    #[must_use]
    pub fn gripper_at(&self, span: &FreeSpan, end: usize) -> Option<usize> {
        let whole = self.contacts[span.catenary].is_none();
        (whole || span.segment == end).then(|| self.layup.ply.lines().ends(span.catenary)[end])
    }
}
