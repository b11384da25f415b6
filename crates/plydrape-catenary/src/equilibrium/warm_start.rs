//! The warm start of a solve from earlier solutions. They are stored by gripper and free segment, so that a problem that has gained
//! or lost a span starts warm too.

use super::problem::{Element, End, Problem};
use super::state::{Evaluation, State};
use crate::catenary::SpanState;
use crate::ply::Lines;

/// Earlier solutions of a ply.
#[derive(Debug, Clone)]
pub struct WarmStart {
    /// Slope of each gripper along u and v.
    slopes: Vec<[f64; 2]>,
    /// Height of each free segment's force above buckling, as a multiple of the parabola's, by catenary.
    ratios: Vec<[Option<f64>; 2]>,
    /// The last solution of each free segment: one that has not moved needs no other.
    solved: Vec<[Option<Solved>; 2]>,
}

/// A free segment as it was solved.
type Solved = (Element<f64>, Evaluation);

impl WarmStart {
    /// Without an earlier solution.
    pub fn new(lines: &Lines) -> WarmStart {
        WarmStart {
            slopes: vec![[0.0; 2]; lines.grippers()],
            ratios: vec![[None; 2]; lines.catenaries()],
            solved: vec![[None; 2]; lines.catenaries()],
        }
    }

    /// Removes all solutions.
    pub fn clear(&mut self) {
        self.slopes.fill([0.0; 2]);
        self.ratios.fill([None; 2]);
        self.solved.fill([None; 2]);
    }

    /// Starts a state from the last solutions at the same grippers and segments, its slopes within ±`bound`.
    pub fn start(&self, problem: &Problem<f64>, bound: f64, state: &mut State) {
        let slopes = (problem.shared_slopes().iter())
            .map(|slope| self.slopes[slope.gripper][slope.direction].clamp(-bound, bound));
        let ratio = |e: &Element<f64>| self.ratios[e.catenary][e.segment];
        let solved = |e: &Element<f64>| match &self.solved[e.catenary][e.segment] {
            Some((same, evaluation)) if same.is_same_span(e) => Some(evaluation),
            _ => None,
        };
        state.start(problem, slopes, ratio, solved);
    }

    /// Stores a solved state.
    pub fn store(&mut self, problem: &Problem<f64>, state: &State) {
        for (n, element) in problem.elements.iter().enumerate() {
            let mut evaluation = *state.evaluation(n);
            for end in 0..2 {
                // the slope of a free end is a result, and holds no other slope
                if matches!(element.ends[end], End::Free) {
                    evaluation.held[end] = 0.0;
                }
            }
            self.solved[element.catenary][element.segment] = Some((*element, evaluation));
            let ratio = state.ratio(n);
            let hangs = element.state != SpanState::Straight && ratio.is_finite();
            self.ratios[element.catenary][element.segment] = hangs.then_some(ratio);
        }
        for (shared, slope) in problem.shared_slopes().iter().zip(state.slopes()) {
            self.slopes[shared.gripper][shared.direction] = *slope;
        }
    }
}
