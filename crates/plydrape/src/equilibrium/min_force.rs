//! The paper's rule: shared slopes of the smallest norm of the horizontal forces, eq. (9) of
//! `docs/theory.md`.
//!
//! With every length met, ½‖H‖² is a function of the shared slopes alone. Its gradient and Hessian are
//! sums over elements: an edge sees two slopes; a diagonal sees the four edge slopes of its ends, of
//! which the free ones follow their edge. Newton's method with projection on the bounds; the linear
//! system, diagonally dominant and sparse, is solved by conjugate gradients, so that cost grows with
//! the number of cells.

use super::Number;
use super::net::{End, Net, SlopeSource};
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
    net: &Net<T>,
    response: impl Fn(usize) -> Response<T>,
    out: &mut [T],
    adjoint: &mut [[T; 2]],
) {
    out.fill(T::from(0.0));
    adjoint.fill([T::from(0.0); 2]);
    for (n, element) in net.elements.iter().enumerate().skip(net.edge_elements) {
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
    for (n, element) in net.elements[..net.edge_elements].iter().enumerate() {
        for end in 0..2 {
            let End::Joint(joint) = element.ends[end] else {
                continue;
            };
            let Response {
                force: (force, slopes),
                slope,
            } = response(n);
            let mut sum = force * slopes[end];
            for other in 0..2 {
                sum += adjoint[n][other] * slope[other].1[end];
            }
            out[joint] += sum;
        }
    }
}

/// Element matrices of the Hessian: 2×2 of each element, and what a diagonal's ends are made of.
fn assemble(solver: &mut Solver) {
    let work = &mut solver.work;
    let (net, settled) = (&solver.net, &solver.settled);
    let joints = net.joints.len();
    work.blocks.clear();
    work.rows.clear();
    work.diagonal.clear();
    work.diagonal.resize(joints, 0.0);
    for (n, element) in net.elements.iter().enumerate() {
        let jet = &settled[n].force;
        let mut block = [[0.0; 2]; 2];
        for i in 0..2 {
            for j in 0..2 {
                block[i][j] = jet.gradient[i] * jet.gradient[j] + jet.value * jet.hessian[i][j];
                if n < net.edge_elements {
                    for end in 0..2 {
                        block[i][j] += work.adjoint[n][end] * settled[n].slope[end].hessian[i][j];
                    }
                }
            }
        }
        work.blocks.push(block);
        // which joints each end follows, and how much; a factor of 0 where there is none
        let mut row = [[(0, 0.0); 2]; 2];
        for end in 0..2 {
            match element.ends[end] {
                End::Joint(joint) => row[end][0] = (joint, 1.0),
                End::Plane(plane) => {
                    for m in 0..2 {
                        row[end][m] = match plane.source[m] {
                            SlopeSource::Given(_) => (0, 0.0),
                            SlopeSource::Joint(joint) => (joint, plane.share[m]),
                            SlopeSource::Outcome(edge, at) => match net.elements[edge].ends[1 - at]
                            {
                                End::Joint(joint) => (
                                    joint,
                                    plane.share[m] * settled[edge].slope[at].gradient[1 - at],
                                ),
                                _ => (0, 0.0),
                            },
                        };
                    }
                }
                _ => {}
            }
        }
        for i in 0..2 {
            for j in 0..2 {
                for (a, x) in row[i] {
                    for (b, y) in row[j] {
                        if a == b && x * y != 0.0 {
                            work.diagonal[a] += x * block[i][j] * y;
                        }
                    }
                }
            }
        }
        work.rows.push(row);
    }
}

/// Hessian times `x`.
fn multiply(blocks: &[[[f64; 2]; 2]], rows: &[[[(usize, f64); 2]; 2]], x: &[f64], out: &mut [f64]) {
    out.fill(0.0);
    for (block, row) in blocks.iter().zip(rows) {
        let y = row.map(|end| {
            end.iter()
                .map(|&(n, c)| if c == 0.0 { 0.0 } else { c * x[n] })
                .sum::<f64>()
        });
        for i in 0..2 {
            let pull = block[i][0] * y[0] + block[i][1] * y[1];
            for &(n, c) in &row[i] {
                if c != 0.0 {
                    out[n] += c * pull;
                }
            }
        }
    }
}

/// Conjugate gradients for the step: B p = right, preconditioned by the diagonal; where the curvature
/// turns negative they end with a long step that way. The right side must vanish on active bounds.
fn solve_linear(solver: &mut Solver, right: &[f64], tolerance: f64, out: &mut [f64]) {
    let work = &mut solver.work;
    let count = right.len();
    let [r, z, d, q] = &mut work.vectors;
    for v in [&mut *r, &mut *z, &mut *d, &mut *q] {
        v.clear();
        v.resize(count, 0.0);
    }
    out.fill(0.0);
    r.copy_from_slice(right);
    let scale = |n: usize| {
        if work.diagonal[n] > 0.0 {
            1.0 / work.diagonal[n]
        } else {
            1.0
        }
    };
    let mut rz = 0.0;
    for n in 0..count {
        z[n] = scale(n) * r[n];
        d[n] = z[n];
        rz += r[n] * z[n];
    }
    let goal = rz * tolerance * tolerance;
    for _ in 0..=2 * count.min(500) {
        if rz <= goal || rz == 0.0 {
            break;
        }
        multiply(&work.blocks, &work.rows, d, q);
        for (q, active) in q.iter_mut().zip(&work.active) {
            if *active {
                *q = 0.0;
            }
        }
        let curvature: f64 = d.iter().zip(&*q).map(|(a, b)| a * b).sum();
        if curvature <= 0.0 {
            // downhill without end: go far, the search along the step will bring it back
            let size = d.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
            for n in 0..count {
                out[n] += FAR_STEP / size * d[n];
            }
            break;
        }
        let alpha = rz / curvature;
        let before = rz;
        rz = 0.0;
        for n in 0..count {
            out[n] += alpha * d[n];
            r[n] -= alpha * q[n];
            z[n] = scale(n) * r[n];
            rz += r[n] * z[n];
        }
        for n in 0..count {
            d[n] = z[n] + rz / before * d[n];
        }
    }
}

/// The step p that minimizes ½pᵀBp + gᵀp within the bounds of the slopes, by a primal-dual active set:
/// a joint is at its bound if its step would leave it, and stays while its multiplier pushes outwards.
fn bounded_step(solver: &mut Solver, tolerance: f64, step: &mut [f64]) {
    let bound = solver.bound();
    let count = step.len();
    let mut right = std::mem::take(&mut solver.work.right);
    let mut product = std::mem::take(&mut solver.work.product);
    product.resize(count, 0.0);
    let mut free = std::mem::take(&mut solver.work.free);
    free.resize(count, 0.0);
    step.fill(0.0);
    for _ in 0..MAX_ACTIVE_SETS {
        let work = &mut solver.work;
        // joints at a bound go there; what that does to the others is known
        for n in 0..count {
            step[n] = if work.active[n] {
                side(step[n], solver.slopes[n]) * bound - solver.slopes[n]
            } else {
                0.0
            };
        }
        multiply(&work.blocks, &work.rows, step, &mut product);
        right.clear();
        for n in 0..count {
            right.push(if work.active[n] {
                0.0
            } else {
                -work.gradient[n] - product[n]
            });
        }
        solve_linear(solver, &right, tolerance, &mut free);
        let work = &mut solver.work;
        for n in 0..count {
            if !work.active[n] {
                step[n] = free[n];
            }
        }
        multiply(&work.blocks, &work.rows, step, &mut product);
        let mut changed = false;
        for n in 0..count {
            let reached = solver.slopes[n] + step[n];
            let multiplier = work.gradient[n] + product[n];
            let active = if work.active[n] {
                multiplier * side(step[n], solver.slopes[n]) <= 0.0
            } else {
                reached.abs() > bound
            };
            changed |= active != work.active[n];
            work.active[n] = active;
        }
        if !changed {
            break;
        }
    }
    solver.work.right = right;
    solver.work.product = product;
    solver.work.free = free;
}

/// Slope change that is tried along a direction of negative curvature.
const FAR_STEP: f64 = 0.2;

/// Active sets tried for one step.
const MAX_ACTIVE_SETS: usize = 12;

/// Which bound a joint with this slope is held by, or driven to by this step.
fn side(step: f64, slope: f64) -> f64 {
    if slope + step >= 0.0 { 1.0 } else { -1.0 }
}

/// Derivative of the slopes for a change of the gradient: −B⁻¹ `change`, active bounds held.
pub(super) fn respond(solver: &mut Solver, change: &[f64], out: &mut [f64]) {
    assemble(solver);
    let right: Vec<f64> = change
        .iter()
        .zip(&solver.work.active)
        .map(|(g, a)| if *a { 0.0 } else { -g })
        .collect();
    solve_linear(solver, &right, 1e-14, out);
}

impl Solver {
    /// Settles everything and evaluates ½‖H‖² (N²) and its gradient.
    fn evaluate(&mut self) -> f64 {
        let (edges, all) = (self.net.edge_elements, self.net.elements.len());
        self.settle(0..edges);
        self.settle(edges..all);
        let settled = &self.settled;
        self.work.gradient.resize(self.slopes.len(), 0.0);
        self.work.adjoint.resize(all, [0.0; 2]);
        let response = |n: usize| Response {
            force: (settled[n].force.value, settled[n].force.gradient),
            slope: settled[n].slope.map(|s| (s.value, s.gradient)),
        };
        gradient(
            &self.net,
            response,
            &mut self.work.gradient,
            &mut self.work.adjoint,
        );
        0.5 * settled
            .iter()
            .map(|s| s.force.value * s.force.value)
            .sum::<f64>()
    }
}

/// Minimizes ½‖H‖² over the shared slopes.
pub fn solve(solver: &mut Solver) -> Equilibrium {
    let (count, bound) = (solver.slopes.len(), solver.bound());
    // an edge's free end follows its other end: its slope is needed where a diagonal looks at it
    let mut objective = solver.evaluate();
    if count == 0 {
        solver.read_free_ends();
        return Equilibrium {
            status: Status::Converged,
            iterations: 1,
            residual: 0.0,
        };
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
        let tolerance = if count <= 64 {
            1e-13
        } else {
            (0.01 * before).clamp(1e-12, 1e-4)
        };
        bounded_step(solver, tolerance, &mut step);
        let mut start = std::mem::take(&mut solver.work.start);
        start.clear();
        start.extend_from_slice(&solver.slopes);
        let projected =
            |fraction: f64, n: usize| (start[n] + fraction * step[n]).clamp(-bound, bound);
        let size = (0..count)
            .map(|n| (projected(1.0, n) - start[n]).abs())
            .fold(0.0, f64::max);
        let mut accepted = false;
        if tolerance * size <= 1e-12 && solver.may_finish(size, before) {
            solver.slopes.clear();
            solver.slopes.extend((0..count).map(|n| projected(1.0, n)));
            solver.finish(0..solver.net.elements.len());
            residual = error_after(size, before).min(size);
            status = Status::Converged;
            accepted = true;
        } else {
            let mut fraction = 1.0;
            while fraction > 1e-9 {
                solver.slopes.clear();
                solver
                    .slopes
                    .extend((0..count).map(|n| projected(fraction, n)));
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
            status = if size <= 1e-6 {
                Status::Converged
            } else {
                Status::Stalled
            };
            break;
        }
        before = size;
    }
    solver.read_free_ends();
    Equilibrium {
        status,
        iterations,
        residual,
    }
}
