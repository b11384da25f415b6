//! The paper's rule: shared slopes of the smallest norm of the horizontal forces, eq. (9) of
//! `docs/theory/equilibrium.md`.
//!
//! With every length met, ½‖H‖² is a function of the shared slopes alone. Its gradient and Hessian are
//! sums over elements: an edge sees two slopes; a diagonal sees the four edge slopes of its ends, of
//! which the free ones follow their edge. Sequential quadratic programming on the slopes: `hessian`
//! minimizes the quadratic model within the bounds by conjugate gradients, so that cost grows with the
//! number of cells.

use super::Number;
use super::assembly::{Assembly, End, SlopeSource};
use super::hessian::{assemble, bounded_step, solve_linear};
use super::solver::{Solver, Work};
use super::status::{EarlyEnds, Equilibrium, Status};

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
/// must have been assembled at the solution. Returns whether the system could be solved: where B is not
/// positive the state is no strict minimum, and the slopes have no derivative.
pub(super) fn respond(solver: &mut Solver, change: &[f64], out: &mut [f64]) -> bool {
    let right: Vec<f64> =
        change.iter().zip(&solver.work.active).map(|(g, a)| if *a { 0.0 } else { -g }).collect();
    solve_linear(solver, &right, 1e-14, out)
}

impl Solver {
    /// Evaluates every element, ½‖H‖² (N²) and its gradient.
    fn evaluate(&mut self) -> f64 {
        let (edges, all) = (self.assembly.edge_elements, self.assembly.elements.len());
        self.evaluate_elements(0..edges);
        self.evaluate_elements(edges..all);
        let evaluated = &self.evaluated;
        self.work.gradient.resize(self.slopes.len(), 0.0);
        self.work.adjoint.resize(all, [0.0; 2]);
        let response = |n: usize| Response {
            force: (evaluated[n].force.value, evaluated[n].force.gradient),
            slope: evaluated[n].slope.map(|s| (s.value, s.gradient)),
        };
        gradient(&self.assembly, response, &mut self.work.gradient, &mut self.work.adjoint);
        0.5 * evaluated.iter().map(|s| s.force.value * s.force.value).sum::<f64>()
    }

    /// The gradient that is left at slopes that are not at their limits, as a change of slope: divided by the
    /// diagonal of the Hessian.
    fn slope_residual(&self) -> f64 {
        let Work { gradient, diagonal, active, .. } = &self.work;
        let left = gradient.iter().zip(diagonal).zip(active).map(|((g, d), active)| match active {
            true => 0.0,
            false if *d > 0.0 => (g / d).abs(),
            false if *g == 0.0 => 0.0,
            false => f64::INFINITY,
        });
        left.fold(0.0, f64::max)
    }
}

/// Minimizes ½‖H‖² over the shared slopes.
pub fn solve(solver: &mut Solver) -> Equilibrium {
    let (count, bound) = (solver.slopes.len(), solver.bound());
    let ended = |status, iterations, residual| Equilibrium {
        status,
        iterations,
        residual,
        length_residual: 0.0,
        early_ends: EarlyEnds::default(),
    };
    let mut objective = solver.evaluate();
    if count == 0 {
        return ended(Status::Converged, 1, 0.0);
    }
    let tuning = solver.tuning;
    let mut before = f64::INFINITY;
    for iterations in 1.. {
        solver.mark_active();
        assemble(solver);
        let residual = solver.slope_residual();
        if iterations > tuning.iterations && residual > tuning.slope_tolerance {
            return ended(Status::IterationLimit, iterations, residual);
        }
        if residual <= tuning.slope_tolerance {
            if solver.is_sharp() {
                return ended(Status::Converged, iterations, residual);
            }
            objective = solver.evaluate();
            continue;
        }
        let mut step = std::mem::take(&mut solver.work.step);
        let mut kept = std::mem::take(&mut solver.work.trial);
        step.resize(count, 0.0);
        kept.clear();
        kept.extend_from_slice(&solver.work.gradient);
        // looser far away: a Newton step is worth no more digits than it will have
        let tolerance = if count <= 64 { 1e-13 } else { (0.01 * before).clamp(1e-12, 1e-4) };
        bounded_step(solver, tolerance, &mut step);
        let mut start = std::mem::take(&mut solver.work.start);
        start.clear();
        start.extend_from_slice(&solver.slopes);
        let projected =
            |fraction: f64, n: usize| (start[n] + fraction * step[n]).clamp(-bound, bound);
        before = (0..count).map(|n| (projected(1.0, n) - start[n]).abs()).fold(0.0, f64::max);
        let (mut accepted, mut fraction) = (false, 1.0);
        while fraction > tuning.smallest_share {
            solver.slopes.clear();
            solver.slopes.extend((0..count).map(|n| projected(fraction, n)));
            let way = solver.slopes.iter().zip(&start).map(|(s, start)| s - start);
            let descent: f64 = kept.iter().zip(way).map(|(g, way)| g * way).sum();
            let next = solver.evaluate();
            let rounding = tuning.objective_rounding * objective;
            if next <= objective + tuning.decrease * descent + rounding {
                objective = next;
                accepted = true;
                break;
            }
            fraction *= 0.5;
        }
        if !accepted {
            solver.slopes.clear();
            solver.slopes.extend_from_slice(&start);
            solver.evaluate();
            solver.work.early_ends.line_searches += 1;
        }
        solver.work.step = step;
        solver.work.start = start;
        solver.work.trial = kept;
        if !accepted {
            // no descent left to find: converged as far as the objective can tell, or stalled
            solver.mark_active();
            let rounding = residual <= tuning.rounding_residual;
            let status = if rounding { Status::Converged } else { Status::Stalled };
            return ended(status, iterations, residual);
        }
    }
    unreachable!("the loop ends at the limit of iterations")
}
