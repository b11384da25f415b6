//! The paper's rule: shared slopes of the smallest norm of the horizontal forces, eq. (9) of
//! `docs/theory/equilibrium.md`.
//!
//! With every length met, ½‖H‖² is a function of the shared slopes alone. The residual is its gradient and the matrix
//! its Hessian, eq. (9b): sums over elements. An edge sees two slopes; a diagonal sees the four edge slopes of its
//! ends, of which the free ones follow their edge. A step minimizes the quadratic model within the bounds, which is
//! sequential quadratic programming on the slopes; its cost grows with the number of cells.

use super::Number;
use super::hessian::Hessian;
use super::problem::{End, Problem, SlopeSource};
use super::rule::{Iterate, Response, Rule, Step, Trial};
use super::state::State;
use super::status::EarlyEnds;
use super::tuning::EquilibriumTuning;
use num_dual::Dual64;

/// The rule of least forces.
#[derive(Debug, Clone, Default)]
pub struct MinForce {
    /// Gradient of ½‖H‖² to the free end slopes of every edge element.
    adjoint: Vec<[f64; 2]>,
    hessian: Hessian,
}

impl Rule for MinForce {
    fn residual(&mut self, problem: &Problem<f64>, state: &State, out: &mut [f64]) -> f64 {
        self.adjoint.resize(problem.elements.len(), [0.0; 2]);
        gradient(problem, |n| Response::from(state.element(n)), out, &mut self.adjoint);
        state.half_square()
    }

    fn residual_change(&self, problem: &Problem<Dual64>, along: &[Response<Dual64>]) -> Vec<f64> {
        let zero = Dual64::from(0.0);
        let mut out = vec![zero; problem.shared_slopes().len()];
        let mut adjoint = vec![[zero; 2]; problem.elements.len()];
        gradient(problem, |n| along[n], &mut out, &mut adjoint);
        out.iter().map(|g| g.eps).collect()
    }

    fn linearize(&mut self, problem: &Problem<f64>, state: &State) {
        self.hessian.assemble(problem, state, &self.adjoint);
    }

    fn diagonal(&self, slope: usize) -> f64 {
        self.hessian.diagonal(slope)
    }

    fn step(&mut self, from: &Iterate, step: &mut Step) {
        // looser far away: a Newton step is worth no more digits than it will have
        let EquilibriumTuning { few_unknowns, linear_exact, linear_share, .. } = *from.tuning;
        let [least, most] = from.tuning.linear_tolerance;
        let few = from.slopes.len() <= few_unknowns;
        let loose = (linear_share * from.last_step).clamp(least, most);
        self.hessian.bounded_step(from, if few { linear_exact } else { loose }, step);
    }

    fn improves(&self, trial: &Trial, tuning: &EquilibriumTuning) -> bool {
        let ([before, after], [promise, _]) = (trial.merit, trial.work);
        after <= before + tuning.decrease * promise + tuning.objective_rounding * before
    }

    fn respond(
        &mut self,
        change: &[f64],
        active: &[bool],
        tuning: &EquilibriumTuning,
    ) -> (Vec<f64>, bool) {
        let held = change.iter().zip(active);
        let right: Vec<f64> = held.map(|(g, held)| if *held { 0.0 } else { -g }).collect();
        let (mut out, mut ends) = (vec![0.0; right.len()], EarlyEnds::default());
        let tolerance = tuning.tangent_tolerance;
        let solved = self.hessian.solve(&right, active, tolerance, tuning, &mut ends, &mut out);
        (out, solved)
    }
}

/// Gradient of ½‖H‖² to the shared slopes (N²), and on the way its gradient to the free end slopes
/// of every edge element.
fn gradient<T: Number>(
    problem: &Problem<T>,
    response: impl Fn(usize) -> Response<T>,
    out: &mut [T],
    adjoint: &mut [[T; 2]],
) {
    out.fill(T::from(0.0));
    adjoint.fill([T::from(0.0); 2]);
    // a diagonal depends on the edge slopes of its planes: shared ones, and free ones that follow their edge
    for (n, element) in problem.elements.iter().enumerate().skip(problem.edge_elements) {
        let (force, slopes) = response(n).force;
        for end in 0..2 {
            let End::Plane(plane) = element.ends[end] else {
                continue;
            };
            let weight = force * slopes[end];
            for (share, source) in plane.share.into_iter().zip(plane.source) {
                match source {
                    SlopeSource::Prescribed(_) => {}
                    SlopeSource::Shared(shared) => out[shared] += weight * share,
                    SlopeSource::Outcome(edge, end) => adjoint[edge][end] += weight * share,
                }
            }
        }
    }

    // an edge depends on its shared slopes by its own force and by its free end, which diagonals see
    for (n, element) in problem.elements[..problem.edge_elements].iter().enumerate() {
        for end in 0..2 {
            let End::Shared(shared) = element.ends[end] else {
                continue;
            };
            let Response { force: (force, slopes), slope, .. } = response(n);
            let mut sum = force * slopes[end];
            for other in 0..2 {
                sum += adjoint[n][other] * slope[other].1[end];
            }
            out[shared] += sum;
        }
    }
}
