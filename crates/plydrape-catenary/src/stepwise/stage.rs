//! The stages of the front: the ply takes its form, comes down, and is rolled on.

use super::StepwisePlanner;
use super::step::target_stretch;
use super::tuning::TUNING;
use crate::geometry::vector::norm;

/// A stage of the front.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stage {
    /// The ply takes its form above the mold.
    Form,
    /// It comes down.
    Lower,
    /// It is rolled on.
    Roll,
}

impl StepwisePlanner<'_> {
    /// Moves the front on, as far as the grippers can follow.
    pub(super) fn advance_front(&mut self, remaining: usize) {
        let late = (0..self.targets.len())
            .map(|n| (self.height(n) - self.front.height(n)).abs())
            .fold(0.0, f64::max);
        let pace = TUNING.pace * self.reach;
        if self.stage == Stage::Form {
            // the form is taken: heights reached, edges as long as they should be
            let slack = self.slack();
            let near = TUNING.formed * self.task.layup.ply.shorter_side();
            let formed = late < near && slack < near;
            let still = self.moves.iter().all(|m| norm(*m) < TUNING.still * self.reach);
            let steps = TUNING.forming_share * self.task.steps as f64;
            let late = self.positions.len() > steps as usize;
            if formed || still && self.positions.len() > 1 || late {
                self.stage = Stage::Lower;
            }
        }
        if late > self.reach && self.stage != Stage::Form {
            return;
        }
        if self.stage == Stage::Lower {
            self.front.base = (self.front.base - pace).max(0.0);
            if self.front.base == 0.0 {
                self.stage = Stage::Roll;
                return;
            }
        }
        if self.stage == Stage::Roll {
            let end = self.front.farthest() + TUNING.beyond * self.task.layup.ply.shorter_side();
            let left = end - self.front.radius;
            let mut grow = left / (remaining.saturating_sub(TUNING.late).max(1)) as f64;
            if self.front.rise == 0.0 {
                grow = left;
            }
            let (factor, most) = TUNING.reduction;
            for _ in 0..most {
                if self.front.drop(self.front.radius + grow) <= pace {
                    break;
                }
                grow *= factor;
            }
            self.front.radius += grow.min(left);
        }
    }

    /// Largest difference of a hanging edge from the length that it should have (m).
    fn slack(&self) -> f64 {
        let edges = self.task.layup.ply.lines().edges();
        self.shape
            .spans
            .iter()
            .filter(|span| span.catenary < edges)
            .map(|span| span.length - span.chord() + target_stretch(self.task, span))
            .fold(0.0, |most, slack| most.max(slack.abs()))
    }
}
