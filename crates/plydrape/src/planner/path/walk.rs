//! A walk downhill from a good front, one of its numbers after the other: those of cells that land in another order first.
//!
//! A pattern search (Hooke and Jeeves 1961, "Direct search"): each number is made larger and smaller by a step, a gain is kept and makes the step longer, and
//! no gain makes it shorter.

use super::strategy::Strategy;
use super::tuning::TUNING;
use std::f64::consts::FRAC_PI_2;

/// One number of a front, changed by a share of its first step.
type Move = fn(Strategy, f64) -> Strategy;

/// The moves of a walk. What decides which lines of cups land together comes first.
const MOVES: [Move; 10] = [
    |front, step| match (front.ratio.ln() + TUNING.walk.ratio * step).exp() {
        ratio if ratio >= 1.0 => Strategy { ratio, ..front },
        ratio => Strategy { ratio: ratio.recip(), angle: turned(front.angle, FRAC_PI_2), ..front },
    },
    |front, step| Strategy {
        squareness: (front.squareness + TUNING.walk.squareness * step)
            .clamp(TUNING.walk.square[0], TUNING.walk.square[1]),
        ..front
    },
    |front, step| Strategy {
        curvature: front.curvature * (TUNING.walk.curvature * step).exp(),
        ..front
    },
    |front, step| Strategy { slope: front.slope * (TUNING.walk.slope * step).exp(), ..front },
    |front, step| Strategy {
        pull: (front.pull + TUNING.walk.load * step).clamp(0.0, 1.0),
        ..front
    },
    |front, step| Strategy {
        pretension: (front.pretension + TUNING.walk.pretension * step).max(0.0),
        ..front
    },
    |front, step| Strategy {
        press: (front.press + TUNING.walk.load * step).clamp(0.0, 1.0),
        ..front
    },
    |front, step| Strategy { angle: turned(front.angle, TUNING.walk.angle * step), ..front },
    |front, step| Strategy {
        start: [front.start[0] + TUNING.walk.start * step, front.start[1]],
        ..front
    },
    |front, step| Strategy {
        start: [front.start[0], front.start[1] + TUNING.walk.start * step],
        ..front
    },
];

/// A walk under way.
#[derive(Debug, Clone)]
pub struct Walk {
    /// Where it is.
    pub front: Strategy,
    /// The step of each number, in its first steps.
    steps: [f64; MOVES.len()],
}

impl Walk {
    /// How many numbers there are to change.
    pub const NUMBERS: usize = MOVES.len();

    /// A walk that begins at a front.
    #[must_use]
    pub fn new(front: Strategy) -> Self {
        Walk { front, steps: [1.0; MOVES.len()] }
    }

    /// The fronts with a larger and with a smaller number; none that is where it is already.
    #[must_use]
    pub fn beside(&self, number: usize) -> Vec<Strategy> {
        let moved = [1.0, -1.0].map(|sign| MOVES[number](self.front, sign * self.steps[number]));
        moved.into_iter().filter(|front| *front != self.front).collect()
    }

    /// Goes to a front that is better, or stays where none is.
    pub fn go(&mut self, number: usize, better: Option<Strategy>) {
        self.steps[number] *=
            if better.is_some() { TUNING.walk.longer } else { TUNING.walk.shorter };
        self.front = better.unwrap_or(self.front);
    }

    /// Whether all steps have become too short to find anything.
    #[must_use]
    pub fn is_over(&self) -> bool {
        self.steps.iter().all(|step| *step < TUNING.walk.shortest)
    }
}

/// A direction without a sense that is turned by an angle (rad).
fn turned(angle: f64, by: f64) -> f64 {
    let pi = std::f64::consts::PI;
    (angle + by + 0.5 * pi).rem_euclid(pi) - 0.5 * pi
}
