//! A walk downhill from a good front, one of its numbers after the other: those of cells that land in another order first.
//!
//! A pattern search (Hooke and Jeeves 1961, "Direct search"): each number is made larger and smaller by a step, a gain is kept,
//! and without one the step becomes shorter. Numbers stay in their ranges.

use crate::planner::path::strategy::Strategy;
use crate::planner::path::tuning::TUNING;
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
        squareness: (1.0 - (1.0 - front.squareness) * (-TUNING.walk.squareness * step).exp())
            .clamp(TUNING.walk.square[0], TUNING.walk.square[1]),
        ..front
    },
    |front, step| Strategy {
        curvature: front.curvature * (TUNING.walk.curvature * step).exp(),
        ..front
    },
    |front, step| Strategy {
        slope: (front.slope * (TUNING.walk.slope * step).exp())
            .min(TUNING.front.ranges[5][1].exp()),
        ..front
    },
    |front, step| Strategy {
        pull: (front.pull + TUNING.walk.load * step).clamp(0.0, TUNING.preload.most_pull),
        ..front
    },
    |front, step| Strategy {
        pretension: within(front.pretension + TUNING.walk.pretension * step, 6),
        ..front
    },
    |front, step| Strategy {
        press: (front.press + TUNING.walk.load * step).clamp(0.0, 1.0),
        ..front
    },
    |front, step| Strategy { angle: turned(front.angle, TUNING.walk.angle * step), ..front },
    |front, step| Strategy {
        start: [within(front.start[0] + TUNING.walk.start * step, 0), front.start[1]],
        ..front
    },
    |front, step| Strategy {
        start: [front.start[0], within(front.start[1] + TUNING.walk.start * step, 1)],
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
        if better.is_none() {
            self.steps[number] *= TUNING.walk.shorter;
        }
        self.front = better.unwrap_or(self.front);
    }

    /// Whether all steps have become too short to find anything.
    #[must_use]
    pub fn is_over(&self) -> bool {
        self.steps.iter().all(|step| *step < TUNING.walk.shortest)
    }
}

/// A value in the range of a number of the front.
fn within(value: f64, number: usize) -> f64 {
    let [low, high] = TUNING.front.ranges[number];
    value.clamp(low, high)
}

/// A direction without a sense that is turned by an angle (rad).
fn turned(angle: f64, by: f64) -> f64 {
    let pi = std::f64::consts::PI;
    (angle + by + 0.5 * pi).rem_euclid(pi) - 0.5 * pi
}

#[cfg(test)]
mod tests {
    use super::*;

    const RING: Strategy = Strategy {
        start: [0.5; 2],
        ratio: 1.0,
        angle: 0.2,
        squareness: 0.0,
        curvature: 8.0,
        slope: 0.4,
        pretension: 1e-3,
        press: 0.6,
        pull: 0.6,
    };

    /// A circle becomes an ellipse along its axis or across it: less than a circle along one is more than one across.
    #[test]
    fn a_circle_becomes_an_ellipse_along_its_axis_or_across() {
        let [along, across] = Walk::new(RING).beside(0)[..] else { panic!("two fronts") };
        assert!((along.ratio - across.ratio).abs() < 1e-12 && along.ratio > 1.0);
        assert_eq!(along.angle, RING.angle);
        assert!((turned(across.angle, FRAC_PI_2) - RING.angle).abs() < 1e-12);
    }

    /// A walk finds where a sum of squares is least, in numbers that are changed by addition and by factors, and then it is over.
    #[test]
    fn a_walk_comes_to_the_least_cost_and_ends() {
        let cost = |front: &Strategy| {
            (front.squareness - 0.4).powi(2)
                + (front.curvature / 13.0).ln().powi(2)
                + (front.pull - 0.45).powi(2)
        };
        let mut walk = Walk::new(RING);
        let mut rounds = 0;
        while !walk.is_over() {
            for number in 0..Walk::NUMBERS {
                let better =
                    walk.beside(number).into_iter().filter(|front| cost(front) < cost(&walk.front));
                let better = better.min_by(|a, b| cost(a).total_cmp(&cost(b)));
                walk.go(number, better);
            }
            rounds += 1;
            assert!(rounds < 100, "it does not end");
        }
        // the shortest steps that are tried
        let within = |value: f64, best: f64, step: f64| (value - best).abs() < step;
        assert!(within(walk.front.squareness, 0.4, 0.5 * TUNING.walk.squareness), "{walk:?}");
        assert!(
            within(walk.front.curvature.ln(), 13.0_f64.ln(), 0.5 * TUNING.walk.curvature),
            "{walk:?}"
        );
        assert!(within(walk.front.pull, 0.45, 0.5 * TUNING.walk.load), "{walk:?}");
    }

    /// However far a walk goes in one direction, its front is one that can be.
    #[test]
    fn a_walk_stays_in_its_ranges() {
        for sign in [0, 1] {
            let mut walk = Walk::new(RING);
            for number in (0..Walk::NUMBERS).cycle().take(20 * Walk::NUMBERS) {
                let beside = walk.beside(number);
                let next = beside.get(sign.min(beside.len().saturating_sub(1))).copied();
                walk.go(number, next);
                assert!(walk.front.is_sound() && walk.front.slope <= 1.0, "{walk:?}");
                assert!(walk.front.start.iter().all(|share| (0.0..=1.0).contains(share)));
                assert!((0.0..=2.5e-3).contains(&walk.front.pretension));
            }
        }
    }
}
