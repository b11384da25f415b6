//! All horizontal forces and shared slopes of a ply at given gripper positions.
//!
//! Given the shared slopes, every edge force is a scalar root and the diagonals follow, so only the
//! slopes are solved for together. `assembly` states what hangs where, `slopes` what holds it,
//! `element` differentiates one span,
//! `min_force` and `moment_balance` are the two rules for the slopes, eqs. (9) and (10) of
//! `docs/theory/equilibrium.md`, and `tangent` is the exact derivative of the solved state along a `direction`.
//! `status` says how a solve ended and `tuning` holds every constant of the method.

mod assembly;
mod direction;
mod element;
mod hessian;
mod min_force;
mod moment_balance;
mod slopes;
mod solver;
mod status;
mod tangent;
mod tuning;

pub use assembly::{
    Assembly, Constraint, Element, End, Joint, PlaneSlope, Side, SlopeSource, heading, neighbours,
};
pub use direction::{Direction, Property};
pub use solver::Solver;
pub use status::{EarlyEnds, Equilibrium, Status};
pub use tangent::{Linearized, StateTangent};
pub use tuning::Tuning;

use num_dual::DualNum;

/// A plain number, or one that carries its derivative along.
pub trait Number: DualNum<Primitive = f64> + Copy {}
impl<T: DualNum<Primitive = f64> + Copy> Number for T {}
