//! The physical rule: a ball joint passes no moment, so EI z'' is continuous across each gripper along
//! each line of edges, eq. (10) of `docs/theory.md`.
//!
//! One equation for each shared slope, tridiagonal line by line. A slope at its limit carries the jump
//! of moment instead. Newton's method on the active set; each edge force follows its own length.

use super::Number;
use super::net::{End, Net};
use super::solver::{Equilibrium, MAX_ITERATIONS, Solver, Status, error_after};

/// Jump of moment across a joint (N·m): EI z'' before the gripper minus EI z'' after it. It grows
/// with the joint's slope.
pub fn jump<T: Number>(net: &Net<T>, joint: usize, curvature: impl Fn(usize, usize) -> T) -> T {
    let [a, b] = net.joints[joint].elements;
    let [end_a, end_b] = [a, b].map(|e| end_at(net, e, joint));
    net.elements[a].rigidity * curvature(a, end_a) - net.elements[b].rigidity * curvature(b, end_b)
}

/// Which end of an element is held by a joint.
fn end_at<T>(net: &Net<T>, element: usize, joint: usize) -> usize {
    usize::from(!matches!(net.elements[element].ends[0], End::Joint(j) if j == joint))
}

/// One row of the tridiagonal system: below, on and above the diagonal.
fn row(solver: &Solver, joint: usize) -> [f64; 3] {
    let net = &solver.net;
    let mut row = [0.0; 3];
    for (element, sign) in net.joints[joint].elements.into_iter().zip([1.0, -1.0]) {
        let end = end_at(net, element, joint);
        let gradient = solver.settled[element].curvature[end].gradient;
        let factor = sign * net.elements[element].rigidity;
        row[1] += factor * gradient[end];
        if let End::Joint(other) = net.elements[element].ends[1 - end] {
            row[if other < joint { 0 } else { 2 }] += factor * gradient[1 - end];
        }
    }
    row
}

/// Solves the tridiagonal system J x = right with the rows of active bounds replaced by x = 0.
///
/// Every line of edges is a block of its own: the couplings between lines are zero.
fn solve_linear(solver: &Solver, right: &[f64], ratio: &mut [f64], out: &mut [f64]) {
    for joint in 0..right.len() {
        let ([below, on, above], value) = if solver.work.active[joint] {
            ([0.0, 1.0, 0.0], 0.0)
        } else {
            (row(solver, joint), right[joint])
        };
        let (last, before) = if joint > 0 {
            (ratio[joint - 1], out[joint - 1])
        } else {
            (0.0, 0.0)
        };
        let pivot = on - below * last;
        ratio[joint] = above / pivot;
        out[joint] = (value - below * before) / pivot;
    }
    for joint in (0..right.len().saturating_sub(1)).rev() {
        out[joint] -= ratio[joint] * out[joint + 1];
    }
}

/// Derivative of the slopes for a change of the jumps: −J⁻¹ `change`, active bounds held.
pub(super) fn respond(solver: &mut Solver, change: &[f64], out: &mut [f64]) {
    let right: Vec<f64> = change.iter().map(|c| -c).collect();
    let mut ratio = vec![0.0; right.len()];
    solve_linear(solver, &right, &mut ratio, out);
}

impl Solver {
    /// Settles the edges and evaluates all jumps; returns the largest Newton-scaled one that no bound
    /// carries.
    fn evaluate_jumps(&mut self) -> f64 {
        self.settle(0..self.net.edge_elements);
        let count = self.slopes.len();
        self.work.gradient.resize(count, 0.0);
        for joint in 0..count {
            let settled = &self.settled;
            let jump = jump(&self.net, joint, |e, end| settled[e].curvature[end].value);
            self.work.gradient[joint] = jump;
        }
        self.mark_active();
        (0..count)
            .filter(|&joint| !self.work.active[joint])
            .map(|joint| (self.work.gradient[joint] / row(self, joint)[1]).abs())
            .fold(0.0, f64::max)
    }
}

/// Balances the moments at every joint, then lets the diagonals follow.
pub fn solve(solver: &mut Solver) -> Equilibrium {
    let (count, bound) = (solver.slopes.len(), solver.bound());
    for joint in 0..count {
        for element in solver.net.joints[joint].elements {
            let end = end_at(&solver.net, element, joint);
            solver.wanted[element].curvature[end] = true;
        }
    }
    let mut merit = solver.evaluate_jumps();
    let (mut status, mut residual, mut iterations) = (Status::IterationLimit, merit, 1);
    if count == 0 {
        status = Status::Converged;
        residual = 0.0;
    }
    let mut before = f64::INFINITY;
    while count > 0 && iterations < MAX_ITERATIONS {
        iterations += 1;
        let mut step = std::mem::take(&mut solver.work.step);
        let mut start = std::mem::take(&mut solver.work.trial);
        let mut ratio = std::mem::take(&mut solver.work.diagonal);
        step.resize(count, 0.0);
        ratio.resize(count, 0.0);
        let right = &mut solver.work.vectors[0];
        right.clear();
        right.extend(solver.work.gradient.iter().map(|jump| -jump));
        let right = std::mem::take(&mut solver.work.vectors[0]);
        solve_linear(solver, &right, &mut ratio, &mut step);
        solver.work.vectors[0] = right;
        start.clear();
        start.extend_from_slice(&solver.slopes);
        let projected =
            |fraction: f64, n: usize| (start[n] + fraction * step[n]).clamp(-bound, bound);
        let size = (0..count)
            .map(|n| (projected(1.0, n) - start[n]).abs())
            .fold(0.0, f64::max);
        let mut fraction = 1.0;
        let mut accepted = false;
        if solver.may_finish(size, before) {
            for n in 0..count {
                solver.slopes[n] = projected(1.0, n);
            }
            solver.finish(0..solver.net.edge_elements);
            residual = error_after(size, before).min(size);
            status = Status::Converged;
        } else {
            while fraction > 1e-9 {
                for n in 0..count {
                    solver.slopes[n] = projected(fraction, n);
                }
                let next = solver.evaluate_jumps();
                if next < merit || next <= 1e-13 {
                    merit = next;
                    accepted = true;
                    break;
                }
                fraction *= 0.5;
            }
            residual = merit;
            if !accepted {
                solver.slopes.copy_from_slice(&start);
                solver.evaluate_jumps();
                status = if merit <= 1e-9 {
                    Status::Converged
                } else {
                    Status::Stalled
                };
            }
        }
        solver.work.step = step;
        solver.work.trial = start;
        solver.work.diagonal = ratio;
        if status != Status::IterationLimit {
            break;
        }
        before = size;
    }
    // diagonals are no tows: they follow
    let (edges, all) = (solver.net.edge_elements, solver.net.elements.len());
    solver.settle(edges..all);
    solver.read_free_ends();
    Equilibrium {
        status,
        iterations,
        residual,
    }
}
