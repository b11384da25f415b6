//! The physical rule: a ball joint passes no moment, so EI z'' is continuous across each gripper along
//! each line of edges, eq. (10) of `docs/theory/equilibrium.md`.
//!
//! The residual is the jump of moment at each shared slope; its matrix is tridiagonal line by line. A slope at its
//! limit takes the jump instead. The jumps are, nearly, the gradient of a potential energy, and steps go down it.
//! Each edge force follows its own length; diagonals are no tows, and follow at the end.

use super::Number;
use super::problem::{End, Problem, SharedSlope};
use super::rule::{Iterate, Response, Rule, Step, Trial};
use super::state::State;
use super::tuning::EquilibriumTuning;
use num_dual::Dual64;
use std::ops::Range;

/// The rule of balanced moments.
#[derive(Debug, Clone, Default)]
pub struct MomentBalance {
    /// Rows of the tridiagonal matrix: below, on and above the diagonal.
    rows: Vec<[f64; 3]>,
    ratio: Vec<f64>,
}

/// The elements before and after a gripper, each with its end there and the sign of its moment.
fn sides<T>(problem: &Problem<T>, shared: &SharedSlope, slope: usize) -> [(usize, usize, f64); 2] {
    [(0, 1.0), (1, -1.0)].map(|(n, sign)| {
        let element = shared.elements[n];
        let is_first =
            matches!(problem.elements[element].ends[0], End::Shared(other) if other == slope);
        (element, usize::from(!is_first), sign)
    })
}

/// Jump of moment at each shared slope (N·m): EI z'' before the gripper minus EI z'' after it. It grows
/// with the slope.
fn jumps<T: Number>(
    problem: &Problem<T>,
    curvature: impl Fn(usize, usize) -> T,
) -> impl Iterator<Item = T> {
    problem.shared_slopes().iter().enumerate().map(move |(slope, shared)| {
        let moment = |(element, end, _): (usize, usize, f64)| {
            problem.elements[element].rigidity * curvature(element, end)
        };
        let [before, after] = sides(problem, shared, slope).map(moment);
        before - after
    })
}

impl Rule for MomentBalance {
    fn elements(&self, problem: &Problem<f64>) -> Range<usize> {
        0..problem.edge_elements
    }

    fn prepare(&self, problem: &Problem<f64>, state: &mut State) {
        for (slope, shared) in problem.shared_slopes().iter().enumerate() {
            for (element, end, _) in sides(problem, shared, slope) {
                state.needs_mut(element).curvature[end] = true;
            }
        }
        for diagonal in problem.edge_elements..problem.elements.len() {
            state.needs_mut(diagonal).derivatives = false;
        }
    }

    fn residual(&mut self, problem: &Problem<f64>, state: &State, out: &mut [f64]) -> f64 {
        let jumps = jumps(problem, |element, end| state.element(element).curvature[end].value);
        out.iter_mut().zip(jumps).for_each(|(out, jump)| *out = jump);
        0.0
    }

    fn residual_change(&self, problem: &Problem<Dual64>, along: &[Response<Dual64>]) -> Vec<f64> {
        jumps(problem, |element, end| along[element].curvature[end]).map(|jump| jump.eps).collect()
    }

    fn linearize(&mut self, problem: &Problem<f64>, state: &State) {
        self.rows.clear();
        for (slope, shared) in problem.shared_slopes().iter().enumerate() {
            let mut row = [0.0; 3];
            for (n, end, sign) in sides(problem, shared, slope) {
                let (element, gradient) =
                    (&problem.elements[n], state.element(n).curvature[end].gradient);
                let factor = sign * element.rigidity;
                row[1] += factor * gradient[end];
                if let End::Shared(other) = element.ends[1 - end] {
                    row[if other < slope { 0 } else { 2 }] += factor * gradient[1 - end];
                }
            }
            self.rows.push(row);
        }
    }

    fn diagonal(&self, slope: usize) -> f64 {
        self.rows[slope][1]
    }

    /// Where the state is no stable one, the diagonal is raised until the step goes down the energy.
    fn step(&mut self, from: &Iterate, step: &mut Step) {
        let (tuning, Step { active, change, early_ends }) = (from.tuning, step);
        let largest = self.rows.iter().map(|row| row[1].abs()).fold(0.0, f64::max);
        let mut shift = 0.0;
        // no shift grows from zero or beyond infinity
        let grows = largest > 0.0 && largest.is_finite();
        while !self.solve(from.residual, active, shift, change) {
            early_ends.negative_curvatures += u32::from(shift == 0.0);
            if !grows || shift > tuning.largest_shift * largest {
                early_ends.damping_limits += 1;
                break;
            }
            let first = tuning.first_shift * largest;
            shift = if shift == 0.0 { first } else { tuning.shift_growth * shift };
        }
        let size = change.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
        if size > tuning.longest_step {
            change.iter_mut().for_each(|x| *x *= tuning.longest_step / size);
        }
    }

    /// A step is good if the energy still falls at its end, or nearly stands still.
    fn improves(&self, trial: &Trial, tuning: &EquilibriumTuning) -> bool {
        let [promise, uphill] = trial.work;
        uphill <= tuning.uphill * promise.abs()
    }

    fn respond(
        &mut self,
        change: &[f64],
        active: &[bool],
        _: &EquilibriumTuning,
    ) -> (Vec<f64>, bool) {
        let mut out = vec![0.0; change.len()];
        let stable = self.solve(change, active, 0.0, &mut out);
        (out, stable)
    }
}

impl MomentBalance {
    /// Solves the tridiagonal system J x = −`jumps` with the rows of active bounds replaced by x = 0.
    ///
    /// Every line of edges is a block of its own: the couplings between lines are zero.
    ///
    /// `shift` is added to the diagonal; returns false if a pivot is not positive, as on the way to a state
    /// that is no stable one.
    fn solve(&mut self, jumps: &[f64], active: &[bool], shift: f64, out: &mut [f64]) -> bool {
        let (ratio, mut stable) = (&mut self.ratio, true);
        ratio.resize(jumps.len(), 0.0);
        for n in 0..jumps.len() {
            let ([below, on, above], value) =
                if active[n] { ([0.0, 1.0, 0.0], 0.0) } else { (self.rows[n], -jumps[n]) };
            let (last, before) = if n > 0 { (ratio[n - 1], out[n - 1]) } else { (0.0, 0.0) };
            let pivot = on + shift - below * last;
            stable &= pivot > 0.0;
            ratio[n] = above / pivot;
            out[n] = (value - below * before) / pivot;
        }
        for n in (0..jumps.len().saturating_sub(1)).rev() {
            out[n] -= ratio[n] * out[n + 1];
        }
        stable
    }
}
