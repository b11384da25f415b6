//! A rule for the shared slopes s: a residual R(s) that vanishes, and the step that Newton's method takes to it.
//!
//! Within the bounds |s| ≤ tan φ_max a rule asks for R = 0, and for a residual that pushes outwards at a bound. There
//! are two: `min_force`, eq. (9) of `docs/theory/equilibrium.md`, and `moment_balance`, eq. (10).

use super::Number;
use super::force::Evaluated;
use super::problem::Problem;
use super::state::State;
use super::status::EarlyEnds;
use super::tuning::EquilibriumTuning;
use num_dual::Dual64;
use std::ops::Range;

/// What a rule sees of an element: its values, and their derivatives to its own end slopes.
#[derive(Debug, Clone, Copy)]
pub struct Response<T> {
    /// H and ∂H/∂s (N).
    pub force: (T, [T; 2]),
    /// End slopes and their derivatives.
    pub slope: [(T, [T; 2]); 2],
    /// End curvatures z'' (1/m).
    pub curvature: [T; 2],
}

impl<T: Number> Response<T> {
    /// The response of a straight element, which has no force.
    pub fn straight(slope: T) -> Response<T> {
        let zero = T::from(0.0);
        Response { force: (zero, [zero; 2]), slope: [(slope, [zero; 2]); 2], curvature: [zero; 2] }
    }
}

impl From<&Evaluated<2>> for Response<f64> {
    fn from(element: &Evaluated<2>) -> Self {
        Response {
            force: (element.force.value, element.force.gradient),
            slope: [0, 1].map(|n| (element.slope[n].value, element.slope[n].gradient)),
            curvature: [0, 1].map(|n| element.curvature[n].value),
        }
    }
}

/// Where a step starts.
pub struct Iterate<'a> {
    /// Shared slopes s.
    pub slopes: &'a [f64],
    /// R(s).
    pub residual: &'a [f64],
    /// Largest size of a slope.
    pub bound: f64,
    /// Largest change of a slope in the step before; infinite in the first.
    pub last_step: f64,
    /// Constants of the method.
    pub tuning: &'a EquilibriumTuning,
}

/// A step of the slopes.
#[derive(Debug, Clone, Default)]
pub struct Step {
    /// Which slopes are held at their bounds.
    pub active: Vec<bool>,
    /// Change of each slope.
    pub change: Vec<f64>,
    /// What was cut short on the way to it, and to those before it.
    pub early_ends: EarlyEnds,
}

/// How a step went.
pub struct Trial {
    /// The rule's merit at its start and at its end.
    pub merit: [f64; 2],
    /// The residual at its start, and at its end, times the step.
    pub work: [f64; 2],
}

/// A rule for the shared slopes, with the matrix of its last linearization.
pub trait Rule {
    /// The elements that the residual depends on; others follow at the end.
    fn elements(&self, problem: &Problem<f64>) -> Range<usize> {
        0..problem.elements.len()
    }

    /// Reports the needs of the rule beside the forces of the elements.
    fn prepare(&self, _problem: &Problem<f64>, _state: &mut State) {}

    /// Writes R of an evaluated state, and returns the merit that steps are to lower, where the rule has one.
    fn residual(&mut self, problem: &Problem<f64>, state: &State, out: &mut [f64]) -> f64;

    /// Change of R along a direction, which the problem and the elements contain as dual numbers.
    fn residual_change(&self, problem: &Problem<Dual64>, along: &[Response<Dual64>]) -> Vec<f64>;

    /// Makes the matrix R_s of an evaluated state whose residual was taken last.
    fn linearize(&mut self, problem: &Problem<f64>, state: &State);

    /// Diagonal entry of R_s.
    fn diagonal(&self, slope: usize) -> f64;

    /// Writes the step from an iterate, whose active bounds are marked in it.
    fn step(&mut self, from: &Iterate, step: &mut Step);

    /// Whether a step has led to a better state.
    fn improves(&self, trial: &Trial, tuning: &EquilibriumTuning) -> bool;

    /// Answer of the slopes to a change of R: −R_s⁻¹ `change`, active slopes held. Also whether there is one: where
    /// R_s is not positive the state is no strict minimum, or not stable, and the slopes have no derivative.
    fn respond(
        &mut self,
        change: &[f64],
        active: &[bool],
        tuning: &EquilibriumTuning,
    ) -> (Vec<f64>, bool);
}
