//! Derivatives of the balanced state of ply and mounts, eq. (11d) of `docs/theory/equilibrium.md`.
//!
//! With r(d, p) = f + m the implicit function theorem gives `K dd/dp = ∂r/∂p`. The right side follows from the tangent
//! of the ply with pads that follow the robot; another tangent, along the pads' own way, gives the state. The matrix of the search knows a gripper's neighborhood only, so its solution is refined with the
//! exact derivative along it until nothing is left.

use super::super::direction::Direction;
use super::super::sensitivity::{Linearized, StateTangent};
use super::super::solver::Solver;
use super::MountedSolver;
use super::force::Held;
use super::newton::{Matrix, Unknowns};
use crate::ply::ContactSegment;

/// The last balanced state of a [`MountedSolver`], ready to be differentiated along any number of directions.
///
/// Exact wherever that state is differentiable: not where the fabric just begins to slide. Pads that stand on the mold stay
/// where they are along the axes that yield; what has slid before stays.
pub struct MountedLinearization<'a> {
    mounts: &'a MountedSolver,
    held: Held<'a>,
    linearized: Linearized<'a>,
    unknowns: Unknowns,
    matrix: Option<Matrix>,
    sound: bool,
}

impl MountedSolver {
    /// Prepares the derivatives of the last balanced state; `solver` and `contacts` must be those of the last
    /// [`MountedSolver::solve`].
    #[must_use]
    pub fn linearize<'a>(
        &'a self,
        solver: &'a Solver,
        contacts: &'a [Option<ContactSegment>],
    ) -> MountedLinearization<'a> {
        let grid = solver.ply().rows();
        let held = Held { solver, pads: self.pads(), contacts };
        let unknowns = Unknowns::of(self, grid);
        let reach = 2 * solver.tuning().mount_reach;
        let matrix = Matrix::new(self, &self.balance, held, &unknowns, reach);
        let linearized = solver.linearize(self.pads(), contacts);
        MountedLinearization { mounts: self, held, linearized, unknowns, matrix, sound: true }
    }
}

impl MountedLinearization<'_> {
    /// How the state changes along a direction, whose grippers are where the robot holds the mounts; and how the pads move
    /// (m).
    pub fn along(&mut self, direction: &Direction) -> (StateTangent, Vec<[f64; 3]>) {
        let mut moving = direction.clone();
        for n in 0..moving.grippers.len() {
            if let Some(standing) = &self.mounts.standing()[n] {
                moving.grippers[n] = self.mounts.law.way(standing, direction.grippers[n]);
            }
        }
        let mut left = self.unbalanced(&moving, direction);
        let first = largest(&left);
        let tuning = *self.held.solver.tuning();
        let mut remaining = first;
        for _ in 0..tuning.refinements {
            let Some(matrix) = &self.matrix else { break };
            if remaining <= tuning.tangent_tolerance * first {
                break;
            }
            let mut step = left.clone();
            matrix.solve(&mut step);
            let before = moving.clone();
            for ((n, axis), p) in self.unknowns.list.iter().zip(&step) {
                moving.grippers[*n][*axis] += p;
            }
            left = self.unbalanced(&moving, direction);
            let now = largest(&left);
            if now.is_nan() || now >= remaining {
                moving = before;
                break;
            }
            remaining = now;
        }
        let mut tangent = self.linearized.along(&moving);
        tangent.is_sound &= remaining <= tuning.linear_rounding * first;
        self.sound &= tangent.is_sound;
        (tangent, moving.grippers)
    }

    /// Whether every derivative taken so far is one.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        self.sound
    }

    /// Change of the unbalanced force at each unknown while the pads move along `moving` and the robot along `robot`.
    fn unbalanced(&mut self, moving: &Direction, robot: &Direction) -> Vec<f64> {
        let tangent = self.linearized.along(moving);
        let mut change = vec![[0.0; 3]; moving.grippers.len()];
        self.held.changes(moving, &tangent, |_, gripper, force| {
            (0..3).for_each(|n| change[gripper][n] += force[n]);
        });
        for (n, reaction) in self.mounts.reactions().iter().enumerate() {
            let offset = [0, 1, 2].map(|axis| moving.grippers[n][axis] - robot.grippers[n][axis]);
            for axis in 0..3 {
                let row = reaction.stiffness[axis];
                change[n][axis] -= (0..3).map(|k| row[k] * offset[k]).sum::<f64>();
            }
        }
        self.unknowns.list.iter().map(|(n, axis)| change[*n][*axis]).collect()
    }
}

fn largest(forces: &[f64]) -> f64 {
    forces.iter().fold(0.0, |most, force| force.abs().max(most))
}
