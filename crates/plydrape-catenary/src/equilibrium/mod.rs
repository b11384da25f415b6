//! All horizontal forces and shared slopes of a ply at given gripper positions.
//!
//! Given the shared slopes, every edge force is a scalar root and the diagonals follow, so only the
//! slopes are solved for together. The files follow the method:
//!
//! - `problem` states what hangs where and what holds it, eqs. (6)–(8) of `docs/theory/ply.md`; no solve changes it.
//! - `force` gives one element's force with its derivatives to the slopes that hold it, eq. (9a), and `state` all of
//!   them at given shared slopes.
//! - `rule` is what a rule for the slopes has to give, a residual and a step: `min_force`, eq. (9), with its `hessian`,
//!   and `moment_balance`, eq. (10).
//! - `newton` is the iteration of either rule, and `status` says how it ended.
//! - `solver` goes from step to step, with a `warm_start` from earlier solutions, and by continuation where it must.
//! - `sensitivity` is the exact derivative of a solved state along a `direction`, eq. (11).
//! - `coloring` says which grippers are moved at once when the ply is differentiated.
//! - `tuning` holds every constant of the method.

mod coloring;
mod direction;
mod force;
mod hessian;
mod min_force;
mod moment_balance;
mod newton;
mod problem;
mod rule;
mod sensitivity;
mod solver;
mod state;
mod status;
mod tuning;
mod warm_start;

pub(crate) use coloring::Coloring;
pub use direction::{Direction, Property};
pub use problem::{
    Constraint, Element, End, PlaneSlope, Problem, SharedSlope, Side, SlopeSource, Stretched,
    heading,
};
pub use sensitivity::{Linearized, StateTangent};
pub use solver::Solver;
pub use status::{EarlyEnds, Solved, Status};
pub use tuning::EquilibriumTuning;

use num_dual::DualNum;

/// A plain number, or a dual number with its derivative.
pub trait Number: DualNum<Primitive = f64> + Copy {}
impl<T: DualNum<Primitive = f64> + Copy> Number for T {}
