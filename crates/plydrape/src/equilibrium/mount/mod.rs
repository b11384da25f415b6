//! The equilibrium of a ply with the mounts of its grippers, section 11a of `docs/theory/equilibrium.md`.
//!
//! The pads are displaced from where the robot holds their mounts, by offsets d along the axes that yield, until the force
//! of the mounts balances that of the ply: f(c + d) + m(d) = 0, eq. (11c). Inside, the equilibrium of the ply at given
//! pads is that of all other files; outside, Newton's method moves the pads with its exact derivatives.
//!
//! - `law` is the mount: springs, and a slider at the slip force.
//! - `force` is what the ply does to the pads, and its derivative along a direction.
//! - `newton` finds the offsets, with a `band` matrix.
//! - `sensitivity` differentiates the balanced state to where the robot holds the mounts, eq. (11d).

mod band;
mod force;
mod law;
mod newton;
mod sensitivity;
#[cfg(test)]
mod tests;

pub use law::{MountLaw, MountReaction, Standing};
pub use sensitivity::MountedLinearization;

use super::solver::Solver;
use super::status::Equilibrium;
use crate::layup::Settings;
use crate::ply::{ContactSegment, Ply};
use newton::Matrix;

/// Whether a balance that is not found from the last one is searched for by continuation in the stiffness of the mounts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Continuation {
    /// No: the grippers can be moved less far instead.
    Never,
    /// Yes.
    IfNeeded,
}

/// Finds equilibria of a ply and the mounts of its grippers, one after the other.
///
/// What the fabric has slid under the pads before a solve counts in it; [`MountedSolver::keep`] keeps what it has slid since.
#[derive(Debug, Clone)]
pub struct MountedSolver {
    law: MountLaw,
    /// How far the fabric had slid under each pad (m) before the last solve.
    slip: Vec<[f64; 2]>,
    /// Where pads stand on the mold (m).
    standing: Vec<Option<Standing>>,
    /// The last balance, from which the next search starts.
    balance: Balance,
    matrix: Option<Matrix>,
}

/// The pads of a ply and the forces on them.
#[derive(Debug, Clone, PartialEq, Default)]
struct Balance {
    /// Displacement of each pad from where the robot holds it (m), the slide of the fabric included.
    offset: Vec<[f64; 3]>,
    /// Where the pads hold the fabric (m).
    pads: Vec<[f64; 3]>,
    /// Force of the ply on each pad (N).
    ply: Vec<[f64; 3]>,
    /// What the mounts do.
    reactions: Vec<MountReaction>,
    /// Largest force of a span, a mount or on a pad (N).
    largest: f64,
}

impl MountedSolver {
    /// For the grippers of a scene; none if their mounts are rigid and the fabric never slides under them.
    #[must_use]
    pub fn new(ply: &Ply, settings: &Settings) -> Option<MountedSolver> {
        let law = MountLaw::new(ply, &settings.pad, &super::Tuning::default())?;
        let count = ply.grippers();
        let balance = Balance { offset: vec![[0.0; 3]; count], ..Balance::default() };
        Some(MountedSolver {
            law,
            slip: vec![[0.0; 2]; count],
            standing: vec![None; count],
            balance,
            matrix: None,
        })
    }

    /// Solves the equilibrium of the ply and the mounts, which the robot holds at `commanded` (m), in the order of
    /// [`crate::ply::Ply::index`]; the state of the ply is left in its solver.
    ///
    /// The status is [`super::Status::MountsNotBalanced`] where no balance was found; the state is then the best one.
    pub fn solve(
        &mut self,
        solver: &mut Solver,
        commanded: &[[f64; 3]],
        contacts: &[Option<ContactSegment>],
        continuation: Continuation,
    ) -> Equilibrium {
        newton::solve(self, solver, commanded, contacts, continuation)
    }

    /// Keeps the slide of the last solve: the next ones start from it.
    pub fn keep(&mut self) {
        for (slip, reaction) in self.slip.iter_mut().zip(&self.balance.reactions) {
            *slip = reaction.slip;
        }
    }

    /// The mounts.
    #[must_use]
    pub fn law(&self) -> &MountLaw {
        &self.law
    }

    /// Where the pads hold the fabric (m), of the last solve.
    #[must_use]
    pub fn pads(&self) -> &[[f64; 3]] {
        &self.balance.pads
    }

    /// What the mounts do, of the last solve.
    #[must_use]
    pub fn reactions(&self) -> &[MountReaction] {
        &self.balance.reactions
    }

    /// Force of the ply on each pad (N), of the last solve.
    #[must_use]
    pub fn ply_forces(&self) -> &[[f64; 3]] {
        &self.balance.ply
    }

    /// Force on a gripper (N): that of its mount along the axes that yield, that of the ply along rigid ones.
    #[must_use]
    pub fn gripper_force(&self, gripper: usize) -> [f64; 3] {
        let (ply, mount) = (self.balance.ply[gripper], self.balance.reactions[gripper].force);
        [0, 1, 2].map(|n| if self.law.yields(n) { -mount[n] } else { ply[n] })
    }

    /// Force of the mold on a pad that stands on it (N), along the axes that yield.
    #[must_use]
    pub fn mold_force(&self, gripper: usize) -> [f64; 3] {
        let (ply, mount) = (self.balance.ply[gripper], self.balance.reactions[gripper].force);
        [0, 1, 2].map(|n| if self.law.yields(n) { -mount[n] - ply[n] } else { 0.0 })
    }

    /// Largest force of a span, a mount or on a pad (N), of the last solve: what forces are compared with.
    #[must_use]
    pub fn largest_force(&self) -> f64 {
        self.balance.largest
    }

    /// Where each pad stands on the mold (m); none of one in the air.
    #[must_use]
    pub fn standing(&self) -> &[Option<Standing>] {
        &self.standing
    }

    /// Puts a pad on the mold at a place (m), where it stays along the axes that yield; or lifts it off.
    pub fn stand(&mut self, gripper: usize, place: Option<Standing>) {
        self.standing[gripper] = place;
    }

    /// Whether the pad of a gripper moves along an axis to find its balance.
    fn is_free(&self, gripper: usize, axis: usize) -> bool {
        self.law.yields(axis) && self.standing[gripper].is_none()
    }
}
