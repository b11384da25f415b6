//! Newton's method on the shared slopes, for either rule: sections 9 and 10 of `docs/theory/equilibrium.md`.
//!
//! Evaluate every element, take the residual R, mark the bounds that hold a slope, make the matrix R_s, and step;
//! halve the step until it leads to a better state. A state has converged when what is left of R, as a change of
//! slope, is below the tolerance.

use super::problem::Problem;
use super::rule::{Iterate, Rule, Step, Trial};
use super::state::State;
use super::status::{EarlyEnds, Solved, Status};
use super::tuning::EquilibriumTuning;

/// How far the iteration goes along each Newton step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StepLength {
    /// Halved until the step leads to a better state.
    LineSearch,
    /// The whole step, even where the merit rises.
    Whole,
}

/// Buffers of the iteration, which allocates nothing once they have grown.
#[derive(Debug, Clone, Default)]
pub struct Newton {
    residual: Vec<f64>,
    step: Step,
    start: Vec<f64>,
    start_residual: Vec<f64>,
}

/// Marks the bounds that hold a slope: where the residual would push it farther.
pub fn mark_active(bound: f64, slopes: &[f64], residual: &[f64], active: &mut Vec<bool>) {
    active.clear();
    let pushed = |(s, r): (&f64, &f64)| (*s >= bound && *r < 0.0) || (*s <= -bound && *r > 0.0);
    active.extend(slopes.iter().zip(residual).map(pushed));
}

/// Σ residual·(slopes − start): the work of the residual along a step.
fn work(residual: &[f64], slopes: &[f64], start: &[f64]) -> f64 {
    let way = slopes.iter().zip(start).map(|(s, start)| s - start);
    residual.iter().zip(way).map(|(r, way)| r * way).sum()
}

impl Newton {
    /// Solves R(s) = 0 within ±`bound` from the slopes of a state.
    pub fn solve(
        &mut self,
        rule: &mut dyn Rule,
        problem: &Problem<f64>,
        state: &mut State,
        bound: f64,
        step_length: StepLength,
        tuning: &EquilibriumTuning,
    ) -> Solved {
        let count = problem.shared_slopes().len();
        self.residual.resize(count, 0.0);
        self.step.change.resize(count, 0.0);
        self.step.early_ends = EarlyEnds::default();
        rule.prepare(problem, state);
        let (status, iterations, residual) =
            self.iterate(rule, problem, state, bound, step_length, tuning);
        let all = problem.elements.len();
        state.evaluate(problem, rule.elements(problem).end..all);
        let length_residual = state.measure_lengths(problem);
        // a span that could not meet its length spoils the whole
        let met = length_residual <= tuning.length_tolerance;
        let status = if met { status } else { Status::LengthNotMet };
        let early_ends = self.step.early_ends;
        Solved { status, iterations, residual, length_residual, early_ends }
    }

    fn iterate(
        &mut self,
        rule: &mut dyn Rule,
        problem: &Problem<f64>,
        state: &mut State,
        bound: f64,
        step_length: StepLength,
        tuning: &EquilibriumTuning,
    ) -> (Status, usize, f64) {
        let mut merit = self.evaluate(rule, problem, state);
        if state.slopes().is_empty() {
            return (Status::Converged, 1, 0.0);
        }
        let (mut iterations, mut last_step) = (0, f64::INFINITY);
        loop {
            // the matrix, and what is left of the residual
            iterations += 1;
            mark_active(bound, state.slopes(), &self.residual, &mut self.step.active);
            rule.linearize(problem, state);
            let left = self.slope_residual(rule);
            if left <= tuning.slope_tolerance {
                if state.is_exact() {
                    return (Status::Converged, iterations, left);
                }
                // derivatives that were extrapolated too far are renewed
                merit = self.evaluate(rule, problem, state);
                continue;
            }
            if iterations > tuning.iterations {
                return (Status::IterationLimit, iterations, left);
            }

            // the step
            let (slopes, residual) = (state.slopes(), &self.residual);
            rule.step(&Iterate { slopes, residual, bound, last_step, tuning }, &mut self.step);
            self.start.clear();
            self.start.extend_from_slice(state.slopes());
            self.start_residual.clear();
            self.start_residual.extend_from_slice(&self.residual);

            // halved until it leads to a better state
            let (mut share, mut better) = (1.0, false);
            while !better && share > tuning.smallest_share {
                let way = self.start.iter().zip(&self.step.change);
                state.put(way.map(|(start, change)| (start + share * change).clamp(-bound, bound)));
                if share == 1.0 {
                    let way = state.slopes().iter().zip(&self.start).map(|(s, start)| s - start);
                    last_step = way.fold(0.0, |size: f64, way| size.max(way.abs()));
                }
                let next = self.evaluate(rule, problem, state);
                let work_of = |residual: &[f64]| work(residual, state.slopes(), &self.start);
                let work = [work_of(&self.start_residual), work_of(&self.residual)];
                better = match step_length {
                    StepLength::LineSearch => {
                        rule.improves(&Trial { merit: [merit, next], work }, tuning)
                    }
                    StepLength::Whole => next.is_finite(),
                };
                if better {
                    merit = next;
                }
                share *= 0.5;
            }
            if !better {
                // none is left to find: converged as far as rounding lets a sum tell, or stalled
                state.put(self.start.iter().copied());
                self.evaluate(rule, problem, state);
                self.step.early_ends.line_searches += 1;
                let rounding = left <= tuning.rounding_residual;
                let status = if rounding { Status::Converged } else { Status::Stalled };
                return (status, iterations, left);
            }
        }
    }

    /// Evaluates the elements that the rule needs, takes the residual, and returns the merit.
    fn evaluate(&mut self, rule: &mut dyn Rule, problem: &Problem<f64>, state: &mut State) -> f64 {
        state.evaluate(problem, rule.elements(problem));
        rule.residual(problem, state, &mut self.residual)
    }

    /// The residual that is left at slopes that no bound holds, as a change of slope: divided by its own derivative
    /// to the slope. Infinite where that derivative is not positive, as in a state that is no minimum, or not stable.
    fn slope_residual(&self, rule: &dyn Rule) -> f64 {
        let free = (0..self.residual.len()).filter(|n| !self.step.active[*n]);
        let left = free.map(|n| match (self.residual[n], rule.diagonal(n)) {
            (residual, diagonal) if diagonal > 0.0 => (residual / diagonal).abs(),
            // nothing depends on this slope
            (0.0, 0.0) => 0.0,
            _ => f64::INFINITY,
        });
        left.fold(0.0, f64::max)
    }
}
