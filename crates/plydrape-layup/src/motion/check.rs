//! Checks of a given motion, and of positions, bounds and rates before one is made.

use super::path::Vector;
use super::spacing::farthest;
use super::tuning::TUNING;
use super::{Bounds, Motion, is_too_short};
use crate::Error;
use crate::ply::{FARTHEST, Ply, is_near};

/// Most steps of a motion.
pub const MOST_STEPS: usize = 1_000_000;

/// Most gripper positions of a motion: steps times grippers.
pub const MOST_POSITIONS: usize = 50_000_000;

/// Range of each bound (SI).
const RANGE: [f64; 2] = [1e-6, 1e9];

impl Ply {
    /// Refuses a motion that has no step, times that do not begin at 0 or rise by less than [`super::SHORTEST_STEP`], or positions as [`Ply::check_places`] does.
    ///
    /// # Errors
    /// [`Error::StepCount`], [`Error::StepTime`], or that of [`Ply::check_places`]: the first fault, with its step.
    pub fn check_motion(&self, motion: &Motion) -> Result<(), Error> {
        let (times, steps) = (motion.times.len(), motion.positions.len());
        if times != steps || times == 0 {
            return Err(Error::StepCount { times, steps });
        }
        let mut before: Option<f64> = None;
        for (k, (&time, positions)) in motion.times.iter().zip(&motion.positions).enumerate() {
            let late = |before: f64| !is_too_short(time - before);
            if !(time.is_finite() && before.map_or(time == 0.0, late)) {
                return Err(Error::StepTime { step: k + 1, time, before });
            }
            before = Some(time);
            self.check_places(positions).map_err(|fault| fault.at_step(k + 1))?;
        }
        Ok(())
    }
}

/// Refuses steps with different numbers of grippers, and positions that are not finite or too far away.
pub(super) fn positions(planned: &[Vec<Vector>]) -> Result<(), Error> {
    let expected = planned.first().map_or(0, Vec::len);
    if expected == 0 {
        return Err(Error::MotionEmpty);
    }
    for (k, step) in planned.iter().enumerate() {
        if step.len() != expected {
            return Err(Error::MotionUnequal { step: k + 1, found: step.len(), expected });
        }
        let strange = step.iter().position(|place| !is_near(place));
        if let Some(gripper) = strange {
            let position = step[gripper];
            return Err(Error::MotionFar { step: k + 1, gripper, position, most: FARTHEST });
        }
    }
    Ok(())
}

/// Refuses bounds that are no numbers above zero.
pub(super) fn bounds(bounds: &Bounds) -> Result<(), Error> {
    let Bounds { speed, acceleration, jerk } = *bounds;
    let [least, most] = RANGE;
    for (quantity, value) in [("speed", speed), ("acceleration", acceleration), ("jerk", jerk)] {
        if !(least..=most).contains(&value) {
            return Err(Error::MotionLimit { quantity, value, least, most });
        }
    }
    Ok(())
}

/// The steps that move a gripper, the first and the last among them; one step if none does.
pub(super) fn moving(planned: &[Vec<Vector>]) -> Vec<&[Vector]> {
    let (Some(start), Some(target)) = (planned.first(), planned.last()) else { return Vec::new() };
    let length: f64 = planned.windows(2).map(|step| farthest(&step[0], &step[1])).sum();
    let moves =
        planned.windows(2).filter(|step| farthest(&step[0], &step[1]) > TUNING.still).count();
    let least = (TUNING.shortest_step * length / moves.max(1) as f64).max(TUNING.still);
    let mut steps: Vec<&[Vector]> = vec![start];
    for step in &planned[1..] {
        if steps.last().is_some_and(|before| farthest(before, step) > least) {
            steps.push(step);
        }
    }
    // The motion ends at the target.
    match steps.len() {
        1 if farthest(start, target) > TUNING.still => steps.push(target),
        last => steps[last - 1] = target,
    }
    steps
}

/// Samples before the last one at a rate (Hz).
pub(super) fn sample_count(rate: f64, duration: f64, grippers: usize) -> Result<f64, Error> {
    if !(rate > 0.0 && rate.is_finite()) {
        return Err(Error::MotionRate { rate });
    }
    let most = MOST_STEPS.min(MOST_POSITIONS / grippers);
    let whole = (rate * duration - TUNING.last_sample).ceil().max(0.0);
    if whole + 1.0 > most as f64 {
        let largest_rate = (most - 1) as f64 / duration;
        let samples = whole + 1.0;
        return Err(Error::MotionTooManySamples {
            rate,
            duration,
            grippers,
            samples,
            most,
            largest_rate,
        });
    }
    Ok(whole)
}

/// Times (s) from 0 at a rate (Hz), the last exactly the duration.
pub(super) fn samples(rate: f64, duration: f64, grippers: usize) -> Result<Vec<f64>, Error> {
    let whole = sample_count(rate, duration, grippers)?;
    let mut times: Vec<f64> = (0..whole as usize).map(|k| k as f64 / rate).collect();
    times.push(duration);
    Ok(times)
}
