//! Gripper positions over the steps of a motion.
//!
//! A motion of steps says where the grippers are at some times, and not how they go from one to the next. By the mean value theorem every motion
//! that is there at these times is at least as fast somewhere as the mean velocity from one step to the next, and has at least the acceleration
//! and the jerk of the second and the third divided difference. Before its first step and behind its last one it is at rest.

use super::{Peak, Peaks};
use crate::geometry::vector::{between, norm};

/// Shortest time (s) from one step to the next: that which a program of a robot can still say.
pub const SHORTEST_STEP: f64 = 1e-6;

/// Whether a time (s) is too short for one from a step to the next, but for the rounding of times.
#[must_use]
pub fn is_too_short(time: f64) -> bool {
    time.is_nan() || time < SHORTEST_STEP * (1.0 - 1e-3)
}

/// Gripper positions over the steps.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    /// Time of each step (s), from 0, each at least [`SHORTEST_STEP`] after the one before.
    pub times: Vec<f64>,
    /// Positions (m) of each step, in the order of [`crate::ply::Ply::index`].
    pub positions: Vec<Vec<[f64; 3]>>,
}

impl Motion {
    /// The speed, acceleration and jerk that every motion has which passes these steps from rest to rest. A difference of accelerations is
    /// taken over a `window` (s) at least, because over shorter times it is mostly the rounding of the positions.
    #[must_use]
    pub fn least_peaks(&self, window: f64) -> Peaks {
        self.least_peaks_within(window, [0.0, f64::INFINITY])
    }

    /// As [`Self::least_peaks`], of what begins from one time on and before another (s).
    #[must_use]
    pub fn least_peaks_within(&self, window: f64, [from, to]: [f64; 2]) -> Peaks {
        let all: Vec<usize> = (0..self.times.len()).collect();
        let begins = |time: f64| from <= time && time < to;
        let [speed, ..] = self.differences(&all, begins);
        let [_, acceleration, jerk] = self.differences(&self.apart(window), begins);
        Peaks { speed, acceleration, jerk }
    }

    /// Steps that are a time (s) apart at least, the first and the last among them.
    #[must_use]
    pub fn apart(&self, window: f64) -> Vec<usize> {
        let Some(last) = self.times.len().checked_sub(1) else { return Vec::new() };
        // a window of a number of steps is one of as many, whatever rounding makes of their times
        let window = window * (1.0 - 1e-9);
        let mut steps = vec![0];
        for k in 1..last {
            let [since, left] = [
                self.times[k] - self.times[steps[steps.len() - 1]],
                self.times[last] - self.times[k],
            ];
            if since >= window && left >= window {
                steps.push(k);
            }
        }
        steps.extend((last > 0).then_some(last));
        steps
    }

    /// Where a gripper is at a time (s), on straight lines between the steps (m).
    #[must_use]
    pub fn gripper_at(&self, gripper: usize, t: f64) -> [f64; 3] {
        let next = self.times.partition_point(|time| *time < t).min(self.times.len() - 1);
        let before = next.saturating_sub(1);
        let [from, to] = [before, next].map(|k| (self.times[k], self.positions[k][gripper]));
        let takes = to.0 - from.0;
        let share = if takes > 0.0 { ((t - from.0) / takes).clamp(0.0, 1.0) } else { 1.0 };
        between(from.1, to.1, share)
    }

    /// The largest of the first three divided differences over some steps, times 1, 2 and 6; of those that begin at some times (s).
    fn differences(&self, steps: &[usize], begins: impl Fn(f64) -> bool) -> [Peak; 3] {
        let mut found = [Peak::default(); 3];
        let (Some(first), Some(last)) = (steps.first(), steps.last()) else { return found };
        // at rest, a step counts as three at the same time
        let rows: Vec<usize> =
            [&[*first; 2], steps, &[*last; 2]].into_iter().flatten().copied().collect();
        let times: Vec<f64> = rows.iter().map(|k| self.times[*k]).collect();
        for gripper in 0..self.positions[*first].len() {
            let mut values: Vec<[f64; 3]> =
                rows.iter().map(|k| self.positions[*k][gripper]).collect();
            for (order, peak) in (1..).zip(&mut found) {
                for k in 0..values.len() - 1 {
                    let takes = times[k + order] - times[k];
                    let rate = |c: usize| match takes > 0.0 {
                        true => order as f64 * (values[k + 1][c] - values[k][c]) / takes,
                        false => 0.0,
                    };
                    values[k] = [0, 1, 2].map(rate);
                    let value = norm(values[k]);
                    if value > peak.value && begins(times[k]) {
                        *peak = Peak { value, gripper, time: 0.5 * (times[k] + times[k + order]) };
                    }
                }
                values.pop();
            }
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Bounds, TimedMotion};
    use super::*;

    fn along_x(times: &[f64], x: impl Fn(f64) -> f64) -> Motion {
        let positions = times.iter().map(|t| vec![[0.0; 3], [x(*t), 0.0, 0.3]]).collect();
        Motion { times: times.to_vec(), positions }
    }

    /// 1 m aside within 0.5 s and back: 2 m/s. At rest before and at 1 m after 0.5 s, it accelerates by 2·2/0.5 m/s² at least, but in the middle it
    /// turns round, by 4 m/s within 0.5 s. The jerk is that of 6·1/0.5³ m/s³ of the start, and in the middle (−8 − 8)·3/1.
    #[test]
    fn a_jump_is_as_fast_as_its_way_takes_time() {
        let motion = along_x(&[0.0, 0.5, 1.0], |t| if t == 0.5 { 1.0 } else { 0.0 });
        let Peaks { speed, acceleration, jerk } = motion.least_peaks(0.01);
        assert_eq!((speed.value, speed.gripper, speed.time), (2.0, 1, 0.25));
        assert_eq!((acceleration.value, jerk.value), (8.0, 48.0));
        assert_eq!(motion.gripper_at(1, 0.25), [0.5, 0.0, 0.3]);
    }

    /// A motion in time between bounds, sampled at any rate: no difference of its samples exceeds its peaks, and fine ones come near to them.
    #[test]
    fn the_steps_of_a_motion_never_exceed_its_peaks() {
        let planned: Vec<_> =
            (0..7).map(f64::from).map(|k| vec![[0.05 * k, 0.01 * k * k, 0.1 - 0.01 * k]]).collect();
        let bounds = Bounds { speed: 0.2, acceleration: 0.5, jerk: 5.0 };
        let motion = TimedMotion::new(&planned, &bounds).unwrap();
        let own = motion.peaks();
        for rate in [1.0, 7.0, 50.0, 400.0] {
            let found = motion.sampled(rate).unwrap().least_peaks(0.01 * motion.duration());
            for (found, own) in [
                (found.speed, own.speed),
                (found.acceleration, own.acceleration),
                (found.jerk, own.jerk),
            ] {
                assert!(found.value <= own.value * 1.001, "{rate}: {found:?} {own:?}");
                assert!(rate < 10.0 || found.value > 0.8 * own.value, "{rate}: {found:?} {own:?}");
            }
        }
    }

    /// Positions that are rounded to a micrometer, a thousand times a second: the jerk of that rounding would be up to 4 km/s³. The motion has the jerk
    /// 0.1 m (2π)²/(5 s)³ = 0.032 m/s³, to which rounding may add 8·0.5 µm/(50 ms)³ = 0.032 m/s³.
    #[test]
    fn rounded_positions_make_no_jerk() {
        let times: Vec<f64> = (0..=5000).map(|k| f64::from(k) * 1e-3).collect();
        let turn = std::f64::consts::TAU;
        let smooth = |t: f64| 0.1 * (t / 5.0 - (turn * t / 5.0).sin() / turn);
        let rounded = along_x(&times, |t| (smooth(t) * 1e6).round() * 1e-6);
        let found = rounded.least_peaks(0.05).jerk.value;
        assert!((0.02..0.064).contains(&found), "{found}");
    }
}
