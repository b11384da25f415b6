//! The stages of the front: the ply takes its form, comes down, and is rolled on.

use super::Plan;
use super::step::target_stretch;
use crate::mold::vector::norm;

/// Share of the move limit by which the front moves the grippers.
const PACE: f64 = 0.7;

/// Distance (m) from the form above the mold at which the ply has taken it.
const FORMED: f64 = 1e-4;

/// Share of the move limit below which the grippers have come to rest.
const STILL: f64 = 0.03;

/// Steps that are left at the end of rolling, for grippers that are late.
const LATE: usize = 5;

/// Distance of the front beyond the farthest gripper at the end (m).
const BEYOND: f64 = 1e-3;

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

impl Plan<'_> {
    /// Moves the front on, as far as the grippers can follow.
    pub(super) fn advance_front(&mut self, remaining: usize) {
        let late = (0..self.targets.len())
            .map(|n| (self.height(n) - self.front.height(n)).abs())
            .fold(0.0, f64::max);
        let pace = PACE * self.reach;
        if self.stage == Stage::Form {
            // the form is taken: heights reached, edges as long as they should be
            let slack = self.slack();
            let formed = late < FORMED && slack < FORMED;
            let still = self.moves.iter().all(|m| norm(*m) < STILL * self.reach);
            let late = self.positions.len() > self.scene.plan.steps / 2;
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
            let end = self.front.farthest() + BEYOND;
            let left = end - self.front.radius;
            let mut grow = left / (remaining.saturating_sub(LATE).max(1)) as f64;
            if self.front.rise == 0.0 {
                grow = left;
            }
            for _ in 0..30 {
                if self.front.drop(self.front.radius + grow) <= pace {
                    break;
                }
                grow *= 0.8;
            }
            self.front.radius += grow.min(left);
        }
    }

    /// Largest difference of a hanging edge from the length that it should have (m).
    fn slack(&self) -> f64 {
        let edges = self.scene.ply.grid.edges();
        self.shape
            .spans
            .iter()
            .filter(|span| span.catenary < edges)
            .map(|span| span.length - span.chord() + target_stretch(self.scene, span))
            .fold(0.0, |most, slack| most.max(slack.abs()))
    }
}
