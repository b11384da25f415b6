//! The paper's rule: shared slopes of the smallest norm of the horizontal forces, eq. (9) of
//! `docs/theory.md`.
//!
//! With every length met, ½‖H‖² is a function of the shared slopes alone. Its gradient and Hessian are
//! sums over elements: an edge sees two slopes; a diagonal sees the four edge slopes of its ends, of
//! which the free ones follow their edge. Sequential quadratic programming on the slopes: `hessian`
//! minimizes the quadratic model within the bounds by conjugate gradients, so that cost grows with the
//! number of cells.

use super::Number;
use super::assembly::{Assembly, End, SlopeSource};
use super::hessian::{assemble, bounded_step, solve_linear};
use super::solver::{Equilibrium, MAX_ITERATIONS, Solver, Status, error_after};

/// An element's force and end slopes with their derivatives to its own end slopes.
#[derive(Debug, Clone, Copy)]
pub struct Response<T> {
    /// H and ∂H/∂s (N).
    pub force: (T, [T; 2]),
    /// End slopes and their derivatives.
    pub slope: [(T, [T; 2]); 2],
}

/// Gradient of ½‖H‖² to the shared slopes (N²), and on the way its gradient to the free end slopes
/// of every edge element.
pub fn gradient<T: Number>(
    assembly: &Assembly<T>,
    response: impl Fn(usize) -> Response<T>,
    out: &mut [T],
    adjoint: &mut [[T; 2]],
) {
    out.fill(T::from(0.0));
    adjoint.fill([T::from(0.0); 2]);
    for (n, element) in assembly.elements.iter().enumerate().skip(assembly.edge_elements) {
        let (force, slopes) = response(n).force;
        for end in 0..2 {
            let End::Plane(plane) = element.ends[end] else {
                continue;
            };
            let pull = force * slopes[end];
            for (share, source) in plane.share.into_iter().zip(plane.source) {
                match source {
                    SlopeSource::Given(_) => {}
                    SlopeSource::Joint(joint) => out[joint] += pull * share,
                    SlopeSource::Outcome(edge, end) => adjoint[edge][end] += pull * share,
                }
            }
        }
    }
    for (n, element) in assembly.elements[..assembly.edge_elements].iter().enumerate() {
        for end in 0..2 {
            let End::Joint(joint) = element.ends[end] else {
                continue;
            };
            let Response { force: (force, slopes), slope } = response(n);
            let mut sum = force * slopes[end];
            for other in 0..2 {
                sum += adjoint[n][other] * slope[other].1[end];
            }
            out[joint] += sum;
        }
    }
}

/// Derivative of the slopes for a change of the gradient: −B⁻¹ `change`, active bounds held. The Hessian B
/// must have been assembled at the solution.
pub(super) fn respond(solver: &mut Solver, change: &[f64], out: &mut [f64]) {
    let right: Vec<f64> =
        change.iter().zip(&solver.work.active).map(|(g, a)| if *a { 0.0 } else { -g }).collect();
    solve_linear(solver, &right, 1e-14, out);
}

impl Solver {
    /// Settles everything and evaluates ½‖H‖² (N²) and its gradient.
    fn evaluate(&mut self) -> f64 {
        let (edges, all) = (self.assembly.edge_elements, self.assembly.elements.len());
        self.settle(0..edges);
        self.settle(edges..all);
        let settled = &self.settled;
        self.work.gradient.resize(self.slopes.len(), 0.0);
        self.work.adjoint.resize(all, [0.0; 2]);
        let response = |n: usize| Response {
            force: (settled[n].force.value, settled[n].force.gradient),
            slope: settled[n].slope.map(|s| (s.value, s.gradient)),
        };
        gradient(&self.assembly, response, &mut self.work.gradient, &mut self.work.adjoint);
        0.5 * settled.iter().map(|s| s.force.value * s.force.value).sum::<f64>()
    }
}

/// Minimizes ½‖H‖² over the shared slopes.
pub fn solve(solver: &mut Solver) -> Equilibrium {
    let (count, bound) = (solver.slopes.len(), solver.bound());
    // an edge's free end follows its other end: its slope is needed where a diagonal looks at it
    let mut objective = solver.evaluate();
    if count == 0 {
        solver.read_free_ends();
        return Equilibrium { status: Status::Converged, iterations: 1, residual: 0.0 };
    }
    let (mut status, mut residual, mut iterations) = (Status::IterationLimit, f64::INFINITY, 0);
    let mut before = f64::INFINITY;
    while iterations < MAX_ITERATIONS {
        iterations += 1;
        solver.mark_active();
        assemble(solver);
        let mut step = std::mem::take(&mut solver.work.step);
        let mut trial = std::mem::take(&mut solver.work.trial);
        step.resize(count, 0.0);
        trial.resize(count, 0.0);
        // looser far away: a Newton step is worth no more digits than it will have
        let tolerance = if count <= 64 { 1e-13 } else { (0.01 * before).clamp(1e-12, 1e-4) };
        let settled = bounded_step(solver, tolerance, &mut step);
        let mut start = std::mem::take(&mut solver.work.start);
        start.clear();
        start.extend_from_slice(&solver.slopes);
        let projected =
            |fraction: f64, n: usize| (start[n] + fraction * step[n]).clamp(-bound, bound);
        let size = (0..count).map(|n| (projected(1.0, n) - start[n]).abs()).fold(0.0, f64::max);
        let mut accepted = false;
        if settled && tolerance * size <= 1e-12 && solver.may_finish(size, before) {
            solver.slopes.clear();
            solver.slopes.extend((0..count).map(|n| projected(1.0, n)));
            solver.finish(0..solver.assembly.elements.len());
            residual = error_after(size, before).min(size);
            status = Status::Converged;
            accepted = true;
        } else {
            let mut fraction = 1.0;
            while fraction > 1e-9 {
                solver.slopes.clear();
                solver.slopes.extend((0..count).map(|n| projected(fraction, n)));
                let descent: f64 = (0..count)
                    .map(|n| solver.work.gradient[n] * (solver.slopes[n] - start[n]))
                    .sum();
                trial.copy_from_slice(&solver.work.gradient);
                let next = solver.evaluate();
                if next <= objective + 1e-4 * descent + 1e-11 * objective {
                    objective = next;
                    accepted = true;
                    break;
                }
                solver.work.gradient.copy_from_slice(&trial);
                fraction *= 0.5;
            }
            residual = size;
        }
        if !accepted {
            solver.slopes.clear();
            solver.slopes.extend_from_slice(&start);
            solver.evaluate();
        }
        solver.work.step = step;
        solver.work.start = start;
        solver.work.trial = trial;
        if status == Status::Converged {
            break;
        }
        if !accepted {
            // no descent left to find: converged as far as the objective can tell, or stalled
            status = if size <= 1e-6 { Status::Converged } else { Status::Stalled };
            break;
        }
        before = size;
    }
    solver.read_free_ends();
    Equilibrium { status, iterations, residual }
}
