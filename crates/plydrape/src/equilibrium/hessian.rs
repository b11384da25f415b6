//! The quadratic model of ½‖H‖² over the shared slopes, eq. (9b) of `docs/theory/equilibrium.md`, and its minimum
//! within the bounds.
//!
//! The Hessian is never formed: it is a 2×2 matrix for each element and a list of the joints that its
//! ends follow.

use super::assembly::{End, SlopeSource};
use super::solver::Solver;
use super::tuning::Tuning;

/// Element matrices of the Hessian: 2×2 of each element, and what a diagonal's ends are made of.
pub fn assemble(solver: &mut Solver) {
    let work = &mut solver.work;
    let (assembly, evaluated) = (&solver.assembly, &solver.evaluated);
    let joints = assembly.joints.len();
    work.blocks.clear();
    work.rows.clear();
    work.diagonal.clear();
    work.diagonal.resize(joints, 0.0);
    for (n, element) in assembly.elements.iter().enumerate() {
        let jet = &evaluated[n].force;
        let mut block = [[0.0; 2]; 2];
        for i in 0..2 {
            for j in 0..2 {
                block[i][j] = jet.gradient[i] * jet.gradient[j] + jet.value * jet.hessian[i][j];
                if n < assembly.edge_elements {
                    for end in 0..2 {
                        block[i][j] += work.adjoint[n][end] * evaluated[n].slope[end].hessian[i][j];
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
                            SlopeSource::Outcome(edge, at) => {
                                match assembly.elements[edge].ends[1 - at] {
                                    End::Joint(joint) => (
                                        joint,
                                        plane.share[m] * evaluated[edge].slope[at].gradient[1 - at],
                                    ),
                                    _ => (0, 0.0),
                                }
                            }
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
            end.iter().map(|&(n, c)| if c == 0.0 { 0.0 } else { c * x[n] }).sum::<f64>()
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
///
/// Returns whether the system was solved; if not, `early_ends` says why.
pub fn solve_linear(solver: &mut Solver, right: &[f64], tolerance: f64, out: &mut [f64]) -> bool {
    let Tuning { far_step, linear_iterations, .. } = solver.tuning;
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
        if work.diagonal[n] > 0.0 { 1.0 / work.diagonal[n] } else { 1.0 }
    };
    let mut rz = 0.0;
    for n in 0..count {
        z[n] = scale(n) * r[n];
        d[n] = z[n];
        rz += r[n] * z[n];
    }
    let (start, goal) = (rz, rz * tolerance * tolerance);
    for _ in 0..=linear_iterations * count.min(500) {
        if rz <= goal || rz == 0.0 {
            return true;
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
                out[n] += far_step / size * d[n];
            }
            work.early_ends.negative_curvatures += 1;
            return false;
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
    // rounding may keep the residual of a system of few unknowns above a tolerance of 1e-13
    let solved = rz <= goal.max(start * ROUNDING * ROUNDING);
    work.early_ends.linear_solves += u32::from(!solved);
    solved
}

/// The step p that minimizes ½pᵀBp + gᵀp within the bounds of the slopes, by a primal-dual active set:
/// a joint is at its bound if its step would leave it, and stays while its multiplier pushes outwards.
pub fn bounded_step(solver: &mut Solver, tolerance: f64, step: &mut [f64]) {
    let mut found = false;
    let bound = solver.bound();
    let count = step.len();
    let mut right = std::mem::take(&mut solver.work.right);
    let mut product = std::mem::take(&mut solver.work.product);
    product.resize(count, 0.0);
    let mut free = std::mem::take(&mut solver.work.free);
    free.resize(count, 0.0);
    step.fill(0.0);
    for _ in 0..solver.tuning.active_sets {
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
            right.push(if work.active[n] { 0.0 } else { -work.gradient[n] - product[n] });
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
            found = true;
            break;
        }
    }
    solver.work.early_ends.active_sets += u32::from(!found);
    solver.work.right = right;
    solver.work.product = product;
    solver.work.free = free;
}

/// Relative residual of a linear system that rounding may leave.
const ROUNDING: f64 = 1e-10;

/// Which bound a joint with this slope is held by, or driven to by this step.
fn side(step: f64, slope: f64) -> f64 {
    if slope + step >= 0.0 { 1.0 } else { -1.0 }
}
