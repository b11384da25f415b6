//! The quadratic model of ½‖H‖² over the shared slopes, eq. (9b) of `docs/theory/equilibrium.md`, and its minimum
//! within the bounds.
//!
//! The Hessian is never formed: it is a 2×2 matrix for each element and a list of the shared slopes that its
//! ends follow.

use super::problem::{End, Problem, SlopeSource};
use super::rule::{Iterate, Step};
use super::state::State;
use super::status::EarlyEnds;
use super::tuning::EquilibriumTuning;

/// The Hessian at a state, and buffers.
#[derive(Debug, Clone, Default)]
pub struct Hessian {
    /// 2×2 matrix of each element.
    blocks: Vec<[[f64; 2]; 2]>,
    /// The shared slopes that each end of an element follows, and how much.
    rows: Vec<[[(usize, f64); 2]; 2]>,
    diagonal: Vec<f64>,
    vectors: [Vec<f64>; 4],
    step: [Vec<f64>; 3],
}

impl Hessian {
    /// The Hessian of a state; `adjoint` is the gradient of the objective to the end slopes of edges.
    pub fn assemble(&mut self, problem: &Problem<f64>, state: &State, adjoint: &[[f64; 2]]) {
        self.blocks.clear();
        self.rows.clear();
        self.diagonal.clear();
        self.diagonal.resize(problem.shared_slopes().len(), 0.0);
        for (n, element) in problem.elements.iter().enumerate() {
            let (force, slope) = (&state.element(n).force, &state.element(n).slope);
            // second derivatives to its own end slopes: of ½H², and of an edge also of the free ends that diagonals follow
            let mut block = [[0.0; 2]; 2];
            for i in 0..2 {
                for j in 0..2 {
                    block[i][j] =
                        force.gradient[i] * force.gradient[j] + force.value * force.hessian[i][j];
                    if n < problem.edge_elements {
                        for end in 0..2 {
                            block[i][j] += adjoint[n][end] * slope[end].hessian[i][j];
                        }
                    }
                }
            }

            // from the end slopes to the shared slopes that they follow; their diagonal entries add up
            let row = element.ends.map(|end| followed(problem, state, end));
            for i in 0..2 {
                for j in 0..2 {
                    for (a, x) in row[i] {
                        for (b, y) in row[j] {
                            if a == b && x * y != 0.0 {
                                self.diagonal[a] += x * block[i][j] * y;
                            }
                        }
                    }
                }
            }
            self.blocks.push(block);
            self.rows.push(row);
        }
    }

    /// Diagonal entry.
    pub fn diagonal(&self, slope: usize) -> f64 {
        self.diagonal[slope]
    }

    /// Conjugate gradients for the step: B p = right, preconditioned by the diagonal; where the curvature
    /// turns negative they end with a long step that way. The right side must vanish on active bounds.
    ///
    /// Returns whether the system was solved; if not, `early_ends` says why.
    pub fn solve(
        &mut self,
        right: &[f64],
        active: &[bool],
        tolerance: f64,
        tuning: &EquilibriumTuning,
        early_ends: &mut EarlyEnds,
        out: &mut [f64],
    ) -> bool {
        let count = right.len();
        let diagonal = &self.diagonal;
        let [r, z, d, q] = &mut self.vectors;
        for v in [&mut *r, &mut *z, &mut *d, &mut *q] {
            v.clear();
            v.resize(count, 0.0);
        }
        out.fill(0.0);
        r.copy_from_slice(right);
        let scale = |n: usize| {
            if diagonal[n] > 0.0 { 1.0 / diagonal[n] } else { 1.0 }
        };
        let mut rz = 0.0;
        for n in 0..count {
            z[n] = scale(n) * r[n];
            d[n] = z[n];
            rz += r[n] * z[n];
        }
        let (start, goal) = (rz, rz * tolerance * tolerance);
        for _ in 0..=tuning.linear_iterations * count.min(tuning.linear_unknowns) {
            if rz <= goal || rz == 0.0 {
                return true;
            }
            multiply(&self.blocks, &self.rows, d, q);
            for (q, active) in q.iter_mut().zip(active) {
                if *active {
                    *q = 0.0;
                }
            }
            let curvature: f64 = d.iter().zip(&*q).map(|(a, b)| a * b).sum();
            if curvature <= 0.0 {
                // downhill without end: go far, the search along the step will bring it back
                let size = d.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
                for n in 0..count {
                    out[n] += tuning.far_step / size * d[n];
                }
                early_ends.negative_curvatures += 1;
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
        let rounding = tuning.linear_rounding * tuning.linear_rounding;
        let solved = rz <= goal.max(start * rounding);
        early_ends.linear_solves += u32::from(!solved);
        solved
    }

    /// The step p that minimizes ½pᵀBp + gᵀp within the bounds of the slopes, by a primal-dual active set:
    /// a slope is at its bound if its step would leave it, and stays while its multiplier pushes outwards.
    pub fn bounded_step(&mut self, from: &Iterate, tolerance: f64, out: &mut Step) {
        let Step { active, change: step, early_ends } = out;
        let (count, bound, tuning) = (step.len(), from.bound, from.tuning);
        let [mut right, mut product, mut free] = std::mem::take(&mut self.step);
        product.resize(count, 0.0);
        free.resize(count, 0.0);
        step.fill(0.0);
        let mut found = false;
        for _ in 0..tuning.active_sets {
            // slopes at a bound go there; what that does to the others is known
            for n in 0..count {
                step[n] = if active[n] {
                    side(step[n], from.slopes[n]) * bound - from.slopes[n]
                } else {
                    0.0
                };
            }
            multiply(&self.blocks, &self.rows, step, &mut product);
            right.clear();
            let remaining = |n: usize| if active[n] { 0.0 } else { -from.residual[n] - product[n] };
            right.extend((0..count).map(remaining));
            self.solve(&right, active, tolerance, tuning, early_ends, &mut free);
            for n in 0..count {
                if !active[n] {
                    step[n] = free[n];
                }
            }
            multiply(&self.blocks, &self.rows, step, &mut product);
            found = true;
            for n in 0..count {
                let reached = from.slopes[n] + step[n];
                let multiplier = from.residual[n] + product[n];
                let stays = if active[n] {
                    multiplier * side(step[n], from.slopes[n]) <= 0.0
                } else {
                    reached.abs() > bound
                };
                found &= stays == active[n];
                active[n] = stays;
            }
            if found {
                break;
            }
        }
        early_ends.active_sets += u32::from(!found);
        self.step = [right, product, free];
    }
}

/// Which shared slopes an end follows, and how much; a factor of 0 where there is none.
fn followed(problem: &Problem<f64>, state: &State, end: End<f64>) -> [(usize, f64); 2] {
    let none = (0, 0.0);
    let plane = match end {
        End::Free | End::Prescribed(_) => return [none; 2],
        End::Shared(slope) => return [(slope, 1.0), none],
        End::Plane(plane) => plane,
    };
    [0, 1].map(|m| match plane.source[m] {
        SlopeSource::Prescribed(_) => none,
        SlopeSource::Shared(slope) => (slope, plane.share[m]),
        SlopeSource::Outcome(edge, end) => match problem.elements[edge].ends[1 - end] {
            End::Shared(slope) => {
                (slope, plane.share[m] * state.element(edge).slope[end].gradient[1 - end])
            }
            _ => none,
        },
    })
}

/// Hessian times `x`.
fn multiply(blocks: &[[[f64; 2]; 2]], rows: &[[[(usize, f64); 2]; 2]], x: &[f64], out: &mut [f64]) {
    out.fill(0.0);
    for (block, row) in blocks.iter().zip(rows) {
        let y = row.map(|end| {
            end.iter().map(|&(n, c)| if c == 0.0 { 0.0 } else { c * x[n] }).sum::<f64>()
        });
        for i in 0..2 {
            let weight = block[i][0] * y[0] + block[i][1] * y[1];
            for &(n, c) in &row[i] {
                if c != 0.0 {
                    out[n] += c * weight;
                }
            }
        }
    }
}

/// Which bound a slope is held by, or driven to by this step.
fn side(step: f64, slope: f64) -> f64 {
    if slope + step >= 0.0 { 1.0 } else { -1.0 }
}
