//! The time law s(t) of all grippers: from rest to rest, with bounded speed, acceleration and jerk.
//!
//! The fastest such law has at most seven phases of constant jerk; rsruckig, after Berscheid and Kröger
//! 2021, finds them. It is its own mirror image, `s(T − t) = S − s(t)`, so only the first half
//! is kept: the law ends as exactly at rest as it begins.

use super::{Bounds, MotionError};
use rsruckig::prelude::{InputParameter, Ruckig, RuckigResult, ThrowErrorHandler, Trajectory};

/// Limits as a multiple of what one of them alone would need; beyond, a limit has no effect.
const LOOSEST: f64 = 1e9;

/// The state of the law at a time: s (m), ṡ (m/s), s̈ (m/s²) and s⃛ (m/s³).
pub(super) type State = [f64; 4];

/// A symmetric law from rest to rest.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Law {
    /// Where it ends S (m).
    length: f64,
    /// How long it takes T (s).
    pub duration: f64,
    /// Beginning (s) and state of every phase of the first half.
    phases: Vec<(f64, State)>,
}

impl Law {
    /// The law that does not move.
    pub fn rest() -> Self {
        Law { length: 0.0, duration: 0.0, phases: vec![(0.0, [0.0; 4])] }
    }

    /// The fastest law over a length (m, positive) within bounds.
    ///
    /// # Errors
    /// [`MotionError::NoLaw`] if the library finds none.
    pub fn new(length: f64, bounds: &Bounds) -> Result<Self, MotionError> {
        // Unit length, and the time that the tightest bound alone would need.
        let Bounds { speed, acceleration, jerk } = *bounds;
        let unit = (length / speed).max((length / acceleration).sqrt()).max((length / jerk).cbrt());
        let mut input = InputParameter::<1>::new(None);
        input.target_position[0] = 1.0;
        input.max_velocity[0] = (speed * unit / length).min(LOOSEST);
        input.max_acceleration[0] = (acceleration * unit.powi(2) / length).min(LOOSEST);
        input.max_jerk[0] = (jerk * unit.powi(3) / length).min(LOOSEST);
        let mut trajectory = Trajectory::new(None);
        let fault = |cause: String| MotionError::NoLaw { length, cause };
        let found = Ruckig::<1, ThrowErrorHandler>::new(None, 1e-3)
            .calculate(&input, &mut trajectory)
            .map_err(|e| fault(e.to_string()))?;
        if !matches!(found, RuckigResult::Working | RuckigResult::Finished) {
            return Err(fault(format!("{found:?}")));
        }

        // The phases of the first half.
        let profile = &trajectory.get_profiles()[0][0];
        let half = 0.5 * profile.t.iter().sum::<f64>();
        let mut phases: Vec<(f64, State)> = Vec::with_capacity(4);
        let (mut begin, mut state) = (0.0, [0.0; 4]);
        for (time, jerk) in profile.t.iter().zip(profile.j) {
            let time = time.min(half - begin);
            if time <= 0.0 {
                continue;
            }
            state[3] = jerk;
            phases.push((begin, state));
            state = advance(state, time);
            begin += time;
        }
        // Back to metres and seconds; s(T/2) = S/2 to the last digit.
        let scale = 0.5 * length / state[0];
        if !(half > 0.0 && scale.is_finite() && scale > 0.0) {
            return Err(fault(format!("half of it ends at {}", state[0])));
        }
        let law = Law { length, duration: 2.0 * half, phases };
        Ok(law.scaled(scale, unit))
    }

    /// The same law over a time λ times as long.
    pub fn stretched(&self, factor: f64) -> Self {
        self.scaled(1.0, factor)
    }

    fn scaled(&self, length: f64, time: f64) -> Self {
        let phase = |(begin, [s, v, a, j]): &(f64, State)| {
            let state = [
                s * length,
                v * length / time,
                a * length / time.powi(2),
                j * length / time.powi(3),
            ];
            (begin * time, state)
        };
        Law {
            length: self.length,
            duration: self.duration * time,
            phases: self.phases.iter().map(phase).collect(),
        }
    }

    /// The state at a time (s), which is taken into 0 … T; where the jerk jumps, that after the jump.
    pub fn at(&self, t: f64) -> State {
        let t = t.max(0.0).min(self.duration);
        if t < 0.5 * self.duration {
            return self.first_half(t, |begin| begin <= t);
        }
        let t = self.duration - t;
        let [s, v, a, j] = self.first_half(t, |begin| begin < t);
        [self.length - s, v, -a, j]
    }

    fn first_half(&self, t: f64, begun: impl Fn(f64) -> bool) -> State {
        let phase = self.phases.partition_point(|(begin, _)| begun(*begin)).saturating_sub(1);
        let (begin, state) = self.phases[phase];
        advance(state, t - begin)
    }

    /// The time at which it passes s (m).
    pub fn time(&self, s: f64) -> f64 {
        if s <= 0.0 {
            return 0.0;
        }
        if s > 0.5 * self.length {
            return self.duration - self.time(self.length - s);
        }
        // s grows: halve until the doubles have no middle, which takes fewer times than they have exponents and digits
        const HALVINGS: usize = 2200;
        let (mut low, mut high) = (0.0, 0.5 * self.duration);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                break;
            }
            if self.at(middle)[0] < s {
                low = middle;
            } else {
                high = middle;
            }
        }
        high
    }

    /// Times at which the jerk may jump (s), ascending, with 0 and T.
    pub fn breaks(&self) -> Vec<f64> {
        let half = self.phases.iter().map(|(begin, _)| *begin);
        let mirrored = self.phases.iter().rev().map(|(begin, _)| self.duration - begin);
        half.chain(mirrored).collect()
    }
}

/// A state after some time (s) of constant jerk.
pub(super) fn advance([s, v, a, j]: State, t: f64) -> State {
    [s + t * (v + t * (a / 2.0 + t * (j / 6.0))), v + t * (a + t * (j / 2.0)), a + t * j, j]
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOUNDS: Bounds = Bounds { speed: 0.25, acceleration: 1.0, jerk: 10.0 };

    /// The time of a place is the inverse of the place at a time, in both halves and in every phase.
    #[test]
    fn time_and_place_are_inverse() {
        let law = Law::new(0.4, &BOUNDS).unwrap().stretched(1.3);
        for k in 1..100 {
            let t = law.duration * f64::from(k) / 100.0;
            let [s, v, ..] = law.at(t);
            // A rounding of s is one of t, over ṡ.
            assert!((law.time(s) - t).abs() < 1e-15 + 1e-15 / v, "{t}");
        }
        assert_eq!((law.time(0.0), law.time(0.4)), (0.0, law.duration));
    }

    /// s, ṡ and s̈ are continuous at every jump of the jerk, and in the middle.
    #[test]
    fn nothing_but_the_jerk_jumps() {
        for length in [1e-3, 0.05, 0.4] {
            let law = Law::new(length, &BOUNDS).unwrap();
            let mut breaks = law.breaks();
            breaks.push(0.5 * law.duration);
            for t in breaks {
                let [before, after] = [-1e-9, 1e-9].map(|h| law.at(t + h));
                // In 2 ns a state moves by its rate; the jerk is at most 10 m/s³.
                assert!(
                    (0..3).all(|k| (before[k] - after[k]).abs() < 3e-8),
                    "{before:?} {after:?}"
                );
            }
        }
    }
}
