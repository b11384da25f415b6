//! The physical rule: a ball joint passes no moment, so EI z'' is continuous across each gripper along
//! each line of edges, eq. (10) of `docs/theory/equilibrium.md`.
//!
//! One equation for each shared slope, tridiagonal line by line. A slope at its limit carries the jump
//! of moment instead. Newton's method on the active set; each edge force follows its own length.

use super::Number;
use super::assembly::{Assembly, End};
use super::solver::Solver;
use super::status::{EarlyEnds, Equilibrium, Status};

/// Jump of moment across a joint (N·m): EI z'' before the gripper minus EI z'' after it. It grows
/// with the joint's slope.
pub fn jump<T: Number>(
    assembly: &Assembly<T>,
    joint: usize,
    curvature: impl Fn(usize, usize) -> T,
) -> T {
    let [a, b] = assembly.joints[joint].elements;
    let [end_a, end_b] = [a, b].map(|e| end_at(assembly, e, joint));
    assembly.elements[a].rigidity * curvature(a, end_a)
        - assembly.elements[b].rigidity * curvature(b, end_b)
}

/// Which end of an element is held by a joint.
fn end_at<T>(assembly: &Assembly<T>, element: usize, joint: usize) -> usize {
    usize::from(!matches!(assembly.elements[element].ends[0], End::Joint(j) if j == joint))
}

/// One row of the tridiagonal system: below, on and above the diagonal.
fn row(solver: &Solver, joint: usize) -> [f64; 3] {
    let assembly = &solver.assembly;
    let mut row = [0.0; 3];
    for (element, sign) in assembly.joints[joint].elements.into_iter().zip([1.0, -1.0]) {
        let end = end_at(assembly, element, joint);
        let gradient = solver.evaluated[element].curvature[end].gradient;
        let factor = sign * assembly.elements[element].rigidity;
        row[1] += factor * gradient[end];
        if let End::Joint(other) = assembly.elements[element].ends[1 - end] {
            row[if other < joint { 0 } else { 2 }] += factor * gradient[1 - end];
        }
    }
    row
}

/// Solves the tridiagonal system J x = right with the rows of active bounds replaced by x = 0.
///
/// Every line of edges is a block of its own: the couplings between lines are zero.
///
/// `shift` is added to the diagonal; returns false if a pivot is not positive, as on the way to a state
/// that is no stable one.
fn solve_linear(
    solver: &Solver,
    right: &[f64],
    shift: f64,
    ratio: &mut [f64],
    out: &mut [f64],
) -> bool {
    let mut stable = true;
    for joint in 0..right.len() {
        let ([below, on, above], value) = if solver.work.active[joint] {
            ([0.0, 1.0, 0.0], 0.0)
        } else {
            (row(solver, joint), right[joint])
        };
        let (last, before) =
            if joint > 0 { (ratio[joint - 1], out[joint - 1]) } else { (0.0, 0.0) };
        let pivot = on + shift - below * last;
        stable &= pivot > 0.0;
        ratio[joint] = above / pivot;
        out[joint] = (value - below * before) / pivot;
    }
    for joint in (0..right.len().saturating_sub(1)).rev() {
        out[joint] -= ratio[joint] * out[joint + 1];
    }
    stable
}

/// Derivative of the slopes for a change of the jumps: −J⁻¹ `change`, active bounds held.
/// Returns whether the state is a stable one: elsewhere the slopes have no derivative.
pub(super) fn respond(solver: &mut Solver, change: &[f64], out: &mut [f64]) -> bool {
    let right: Vec<f64> = change.iter().map(|c| -c).collect();
    let mut ratio = vec![0.0; right.len()];
    solve_linear(solver, &right, 0.0, &mut ratio, out)
}

impl Solver {
    /// Evaluates the edges and all jumps.
    fn evaluate_jumps(&mut self) {
        self.evaluate_elements(0..self.assembly.edge_elements);
        let count = self.slopes.len();
        self.work.gradient.resize(count, 0.0);
        for joint in 0..count {
            let evaluated = &self.evaluated;
            let jump = jump(&self.assembly, joint, |e, end| evaluated[e].curvature[end].value);
            self.work.gradient[joint] = jump;
        }
        self.mark_active();
    }

    /// The Newton step of the slopes into `work.step`; where the state is no stable one, the diagonal
    /// is raised until the step goes down the potential energy, whose gradient the jumps are.
    fn moment_step(&mut self) {
        let count = self.slopes.len();
        let mut step = std::mem::take(&mut self.work.step);
        let mut ratio = std::mem::take(&mut self.work.diagonal);
        let mut right = std::mem::take(&mut self.work.right);
        step.resize(count, 0.0);
        ratio.resize(count, 0.0);
        right.clear();
        right.extend(self.work.gradient.iter().map(|jump| -jump));
        let mut shift = 0.0;
        let largest = (0..count).map(|n| row(self, n)[1].abs()).fold(0.0, f64::max);
        while !solve_linear(self, &right, shift, &mut ratio, &mut step) {
            self.work.early_ends.negative_curvatures += u32::from(shift == 0.0);
            // no shift grows from zero or beyond infinity
            let grows = largest > 0.0 && largest.is_finite();
            if !grows || shift > self.tuning.largest_shift * largest {
                self.work.early_ends.damping_limits += 1;
                break;
            }
            shift = if shift == 0.0 { FIRST_SHIFT * largest } else { 4.0 * shift };
        }
        // far from the solution no step is worth more than a fraction of a right angle
        let size = step.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
        if size > FAR_STEP {
            step.iter_mut().for_each(|x| *x *= FAR_STEP / size);
        }
        self.work.step = step;
        self.work.diagonal = ratio;
        self.work.right = right;
    }

    /// The jumps that are left at slopes that are not at their limits, as a change of slope: divided by their own
    /// derivatives. Infinite where such a derivative is not positive, as in a state that is not stable.
    fn jump_residual(&self) -> f64 {
        let left = |n: usize| {
            let jump = self.work.gradient[n];
            let on = row(self, n)[1];
            if on > 0.0 { (jump / on).abs() } else { f64::INFINITY }
        };
        let free = (0..self.slopes.len()).filter(|n| !self.work.active[*n]);
        free.map(left).fold(0.0, f64::max)
    }

    /// Work of the jumps along the way from `start` to the present slopes: how the energy changes there.
    fn work_along(&self, start: &[f64]) -> f64 {
        let way = self.slopes.iter().zip(start).map(|(s, start)| s - start);
        way.zip(&self.work.gradient).map(|(way, jump)| way * jump).sum()
    }
}

/// Largest slope change of one step.
const FAR_STEP: f64 = 0.3;

/// First shift of the diagonal, as a share of its largest entry.
const FIRST_SHIFT: f64 = 1.0 / 64.0;

/// Balances the moments at every joint, then lets the diagonals follow.
pub fn solve(solver: &mut Solver) -> Equilibrium {
    let (count, bound) = (solver.slopes.len(), solver.bound());
    for joint in 0..count {
        for element in solver.assembly.joints[joint].elements {
            let end = end_at(&solver.assembly, element, joint);
            solver.wanted[element].curvature[end] = true;
        }
    }
    let diagonals = solver.assembly.edge_elements..solver.assembly.elements.len();
    for wanted in &mut solver.wanted[diagonals] {
        wanted.derivatives = false;
    }
    solver.evaluate_jumps();
    let outcome =
        if count == 0 { ended(Status::Converged, 1, 0.0) } else { balance(solver, bound) };
    // diagonals are no tows: they follow
    let (edges, all) = (solver.assembly.edge_elements, solver.assembly.elements.len());
    solver.evaluate_elements(edges..all);
    outcome
}

fn ended(status: Status, iterations: usize, residual: f64) -> Equilibrium {
    let early_ends = EarlyEnds::default();
    Equilibrium { status, iterations, residual, length_residual: 0.0, early_ends }
}

/// Newton's method down the energy, from the jumps at the present slopes.
fn balance(solver: &mut Solver, bound: f64) -> Equilibrium {
    let (count, tuning) = (solver.slopes.len(), solver.tuning);
    for iterations in 1.. {
        let residual = solver.jump_residual();
        if iterations > tuning.iterations && residual > tuning.slope_tolerance {
            return ended(Status::IterationLimit, iterations, residual);
        }
        if residual <= tuning.slope_tolerance {
            if solver.is_sharp() {
                return ended(Status::Converged, iterations, residual);
            }
            solver.evaluate_jumps();
            continue;
        }
        solver.moment_step();
        let mut start = std::mem::take(&mut solver.work.trial);
        start.clear();
        start.extend_from_slice(&solver.slopes);
        let move_by = |solver: &mut Solver, fraction: f64| {
            for n in 0..count {
                let slope = start[n] + fraction * solver.work.step[n];
                solver.slopes[n] = slope.clamp(-bound, bound);
            }
        };
        move_by(solver, 1.0);
        // a step is good if the energy still falls at its end, or nearly stands still
        let down = solver.work_along(&start);
        let (mut accepted, mut fraction) = (false, 1.0);
        while fraction > tuning.smallest_share {
            solver.evaluate_jumps();
            let uphill = solver.work_along(&start) / fraction;
            if uphill <= 0.5 * down.abs() {
                accepted = true;
                break;
            }
            fraction *= 0.5;
            move_by(solver, fraction);
        }
        if !accepted {
            solver.slopes.copy_from_slice(&start);
            solver.evaluate_jumps();
            solver.work.early_ends.line_searches += 1;
        }
        solver.work.trial = start;
        if !accepted {
            let rounding = residual <= tuning.rounding_residual;
            let status = if rounding { Status::Converged } else { Status::Stalled };
            return ended(status, iterations, residual);
        }
    }
    unreachable!("the loop ends at the limit of iterations")
}
