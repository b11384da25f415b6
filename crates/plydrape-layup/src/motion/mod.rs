//! Time: planned gripper positions become a motion that robots can run.
//!
//! 1. `path`: one smooth path for all grippers, a B-spline whose control points are what was planned;
//! 2. `spacing`: where the path bends, its parameter is long, so that one time law suits all of it;
//! 3. `time_law`: the parameter over time, from rest to rest with bounded jerk;
//! 4. `peaks`: the largest speed, acceleration and jerk of the grippers, and the least stretch of time that keeps the limits;
//! 5. `timing`: the shortest motion of a few spacings and time laws;
//! 6. `quickest`: the time-optimal law of the same path, under all that bounds it;
//! 7. `attitude`: orientations between the steps.
//!
//! All grippers share the parameter, so the shapes of the ply come in the planned order at any speed.

mod attitude;
mod check;
mod path;
mod peaks;
mod quickest;
mod spacing;
mod steps;
mod time_law;
mod timing;
pub mod tuning;

pub use attitude::Attitudes;
pub(crate) use attitude::{slerp, turn};
pub use check::{MOST_POSITIONS, MOST_STEPS};
pub use peaks::{Peak, Peaks};
pub use quickest::{Limiting, Moving, Quickening};
pub use spacing::farthest;
pub use steps::{Motion, SHORTEST_STEP, is_too_short};

use crate::Error;
use crate::geometry::vector::{norm, sub};
use path::{Path, Vector};
use time_law::{State, TimeLaw};
use tuning::TUNING;

/// Bounds that no gripper exceeds at any time; of the norms of vectors in space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Speed (m/s).
    pub speed: f64,
    /// Acceleration (m/s²).
    pub acceleration: f64,
    /// Jerk (m/s³).
    pub jerk: f64,
}

/// A motion of all grippers from rest to rest.
#[derive(Debug, Clone, PartialEq)]
pub struct TimedMotion {
    /// None where nothing moves.
    path: Option<Path>,
    law: TimeLaw,
    times: Vec<f64>,
    positions: Vec<Vec<Vector>>,
    peaks: Peaks,
}

impl TimedMotion {
    /// The motion of planned positions (m): one list of all grippers a step, the first the start, the last
    /// the target.
    ///
    /// A step that moves no gripper by more than a hundredth of the mean step is merged with the one
    /// before. One position, or none a nanometer from the first, gives a motion of duration 0 at the target.
    ///
    /// # Errors
    /// [`Error::MotionEmpty`] without a position, [`Error::MotionUnequal`] if a step lacks grippers, [`Error::MotionFar`] if a
    /// coordinate is not a number up to 10⁶ m, [`Error::MotionLimit`] if a bound is none from 10⁻⁶ to 10⁹.
    pub fn new(planned: &[Vec<[f64; 3]>], bounds: &Bounds) -> Result<Self, Error> {
        check::positions(planned)?;
        check::bounds(bounds)?;
        let steps = check::moving(planned);
        let [.., target] = steps[..] else { return Err(Error::MotionEmpty) };
        if steps.len() == 1 {
            return Ok(Self::resting(target));
        }

        let (path, law) = timing::fastest(&steps, bounds).ok_or(Error::MotionEmpty)?;
        Ok(Self::timed(path, law))
    }

    /// A motion that was timed before: planned positions (m) as in [`Self::new`], the distances of the knots of their path, and rows
    /// of the time law, see [`Self::spacing`] and [`Self::law`].
    ///
    /// # Errors
    /// The errors of positions as [`Self::new`], and [`Error::MotionLaw`] if knots and rows do not fit these positions.
    pub fn recorded(
        planned: &[Vec<[f64; 3]>],
        spacing: &[f64],
        law: &[[f64; 5]],
    ) -> Result<Self, Error> {
        check::positions(planned)?;
        // a path that was corrected has a row for each knot, others may have steps that hardly move
        let steps = match planned.len() == spacing.len() + 1 {
            true => planned.iter().map(Vec::as_slice).collect(),
            false => check::moving(planned),
        };
        if spacing.is_empty() && law.is_empty() && steps.len() == 1 {
            return Ok(Self::resting(steps[0]));
        }
        let positive = spacing.iter().all(|h| *h > 0.0 && h.is_finite());
        if spacing.len() + 1 != steps.len() || steps.len() < 2 || !positive {
            return Err(Error::MotionLaw);
        }
        let path = Path::new(&steps, spacing);
        let law = TimeLaw::of_rows(law, path.length()).ok_or(Error::MotionLaw)?;
        Ok(Self::timed(path, law))
    }

    fn resting(places: &[Vector]) -> Self {
        TimedMotion {
            path: None,
            law: TimeLaw::rest(),
            times: vec![0.0],
            positions: vec![places.to_vec()],
            peaks: Peaks::default(),
        }
    }

    fn timed(path: Path, law: TimeLaw) -> Self {
        let last = path.knots.len() - 1;
        let mut times: Vec<f64> = path.knots.iter().map(|u| law.time(*u)).collect();
        times[last] = law.duration;
        let positions = path.at_knots();
        let peaks = peaks::peaks(&path, &law, TUNING.tolerance);
        TimedMotion { times, positions, law, peaks, path: Some(path) }
    }

    /// This motion and another of the same grippers after it, which begins where this one ends, with a rest (s) between them. Steps are still
    /// those of this motion.
    ///
    /// # Errors
    /// [`Error::MotionGrippers`] if they are not of the same number of grippers.
    pub fn then(&self, rest: f64, next: &TimedMotion) -> Result<Self, Error> {
        let (found, expected) = (next.grippers(), self.grippers());
        if found != expected {
            return Err(Error::MotionGrippers { found, expected });
        }
        let law = self.law.clone().then(rest, &next.law);
        let peaks = self.peaks.and(&next.peaks, self.law.duration + rest);
        let path = match (&self.path, &next.path) {
            (Some(own), Some(next)) => Some(own.clone().then(next)),
            (own, next) => own.clone().or(next.clone()),
        };
        Ok(TimedMotion { path, law, peaks, ..self.clone() })
    }

    /// This motion after another of the same grippers, as [`Self::then`]; steps are those of this motion, at later times.
    ///
    /// # Errors
    /// As [`Self::then`].
    pub fn after(&self, before: &TimedMotion, rest: f64) -> Result<Self, Error> {
        let later = before.law.duration + rest;
        let times = self.times.iter().map(|time| later + time).collect();
        Ok(TimedMotion { times, positions: self.positions.clone(), ..before.then(rest, self)? })
    }

    /// Distances of the knots of the path (m), one less than steps that move; empty where nothing moves.
    #[must_use]
    pub fn spacing(&self) -> Vec<f64> {
        self.path.as_ref().map_or_else(Vec::new, |path| path.spacing.clone())
    }

    /// Rows of the time law: beginning (s) of each of its phases, and there the path's parameter (m), its first and second derivative to
    /// time (m/s, m/s²), and its third one (m/s³), which is constant in the phase. The last row is the end. Empty where nothing moves.
    #[must_use]
    pub fn law(&self) -> Vec<[f64; 5]> {
        self.path.as_ref().map_or_else(Vec::new, |_| self.law.rows())
    }

    /// When this motion is where another motion along the same path is at a time (s).
    #[must_use]
    pub fn same_place(&self, other: &TimedMotion, t: f64) -> f64 {
        self.law.time(other.law.state_at(t)[0])
    }

    /// The motion of other planned positions (m), one list of all grippers for each of [`Self::times`]: with the same spacing of the
    /// knots and the same time law, over a time that is longer by the least factor that keeps the bounds, and by none where they are kept
    /// as this motion keeps them.
    ///
    /// # Errors
    /// The errors of [`Self::new`], and [`Error::MotionSteps`] or [`Error::MotionGrippers`] if there are not as many positions as steps
    /// and grippers.
    pub fn moved(&self, planned: &[Vec<[f64; 3]>], bounds: &Bounds) -> Result<Self, Error> {
        check::positions(planned)?;
        check::bounds(bounds)?;
        let (steps, found) = (self.times.len(), planned.len());
        if found != steps {
            return Err(Error::MotionSteps { found, expected: steps });
        }
        if planned[0].len() != self.grippers() {
            let (found, expected) = (planned[0].len(), self.grippers());
            return Err(Error::MotionGrippers { found, expected });
        }
        let Some(path) = &self.path else {
            return Ok(TimedMotion { positions: planned.to_vec(), ..self.clone() });
        };
        let steps: Vec<&[Vector]> = planned.iter().map(Vec::as_slice).collect();
        let path = path.through(&steps);
        let moved = Self::timed(path, self.law.clone());
        // as near to the bounds as this motion is, or as any motion may be
        let allowed = self.peaks.stretch(bounds).max(1.0 / (1.0 + TUNING.tolerance));
        let factor = moved.peaks.stretch(bounds) / allowed;
        Ok(if factor > 1.0 { moved.slowed(factor) } else { moved })
    }

    /// Where the path of other positions (m), one list of all grippers for each of [`Self::times`], is at these times (m): each of its places
    /// is a mean of neighboring positions.
    #[must_use]
    pub fn means(&self, planned: &[Vec<[f64; 3]>]) -> Vec<Vec<[f64; 3]>> {
        let steps: Vec<&[Vector]> = planned.iter().map(Vec::as_slice).collect();
        self.path.as_ref().map_or_else(|| planned.to_vec(), |path| path.through(&steps).at_knots())
    }

    /// The parameter of the path (m) at [`Self::times`].
    #[must_use]
    pub fn parameter(&self) -> &[f64] {
        self.path.as_ref().map_or(&[0.0], |path| &path.knots)
    }

    /// The planned positions (m) that stand for a step of the motion each: without those that move hardly a gripper.
    #[must_use]
    pub fn moving(planned: &[Vec<[f64; 3]>]) -> Vec<Vec<[f64; 3]>> {
        check::moving(planned).into_iter().map(<[Vector]>::to_vec).collect()
    }

    /// This motion over a time λ times as long: the same shapes of the ply, in the same order.
    #[must_use]
    pub fn slowed(&self, factor: f64) -> Self {
        match &self.path {
            Some(path) => Self::timed(path.clone(), self.law.stretched(factor)),
            None => self.clone(),
        }
    }

    /// Number of grippers.
    #[must_use]
    pub fn grippers(&self) -> usize {
        self.positions[0].len()
    }

    /// How long the motion takes (s).
    #[must_use]
    pub fn duration(&self) -> f64 {
        self.law.duration
    }

    /// The times (s) of the planned steps, strictly ascending from 0 to [`Self::duration`].
    #[must_use]
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// Where the grippers are at [`Self::times`] (m): the first exactly the start, the last the target.
    #[must_use]
    pub fn positions(&self) -> &[Vec<[f64; 3]>] {
        &self.positions
    }

    /// Where the grippers are at a time (m); before 0 the start, after the end the target.
    #[must_use]
    pub fn at(&self, t: f64) -> Vec<[f64; 3]> {
        let Some(path) = &self.path else { return self.positions[0].clone() };
        let s = self.law.state_at(t)[0];
        let span = path.span(s);
        (0..path.grippers).map(|g| path.jet(span, g, s)[0]).collect()
    }

    /// Where one gripper is at a time (m), as in [`Self::at`].
    #[must_use]
    pub fn gripper_at(&self, gripper: usize, t: f64) -> [f64; 3] {
        let Some(path) = &self.path else { return self.positions[0][gripper] };
        let s = self.law.state_at(t)[0];
        path.jet(path.span(s), gripper, s)[0]
    }

    /// How far a gripper goes at most between two times (m), as seen from another one or in space.
    ///
    /// Along a span of the path the derivative p' is a parabola, so |p'| is at most the larger one of its ends and |p'''| Δs²/8. The
    /// difference of two grippers' paths is such a path, too.
    #[must_use]
    pub fn travel(&self, gripper: usize, seen_from: Option<usize>, [t0, t1]: [f64; 2]) -> f64 {
        let Some(path) = &self.path else { return 0.0 };
        let [from, to] = [t0, t1].map(|t| self.law.state_at(t)[0]);
        let mut travel = 0.0;
        for span in path.span(from)..=path.span(to) {
            let begin = from.max(path.knots[span]);
            let end = to.min(path.knots[span + 1]);
            let slope = |s: f64| {
                let own = path.jet(span, gripper, s);
                let other = seen_from.map_or([[0.0; 3]; 4], |other| path.jet(span, other, s));
                [1, 3].map(|order| norm(sub(own[order], other[order])))
            };
            let ([first, third], [last, _]) = (slope(begin), slope(end));
            let parts = (end - begin).max(0.0);
            travel += parts * (first.max(last) + third * parts.powi(2) / 8.0);
        }
        travel
    }

    /// Velocity of the grippers at a time from 0 to the end (m/s).
    #[must_use]
    pub fn velocity(&self, t: f64) -> Vec<[f64; 3]> {
        self.rate(t, 0)
    }

    /// Acceleration of the grippers at a time from 0 to the end (m/s²).
    #[must_use]
    pub fn acceleration(&self, t: f64) -> Vec<[f64; 3]> {
        self.rate(t, 1)
    }

    /// Jerk of the grippers at a time from 0 to the end (m/s³); where it jumps, that after the jump.
    #[must_use]
    pub fn jerk(&self, t: f64) -> Vec<[f64; 3]> {
        self.rate(t, 2)
    }

    /// The velocity, acceleration or jerk of one gripper at a time.
    fn rate_of(&self, gripper: usize, t: f64, order: usize) -> Vector {
        let Some(path) = &self.path else { return [0.0; 3] };
        let state = self.law.state_at(t);
        rates(&path.jet(path.span(state[0]), gripper, state[0]), &state)[order]
    }

    fn rate(&self, t: f64, order: usize) -> Vec<Vector> {
        (0..self.grippers()).map(|g| self.rate_of(g, t, order)).collect()
    }

    /// The largest speed, acceleration and jerk, and where they are.
    #[must_use]
    pub fn peaks(&self) -> &Peaks {
        &self.peaks
    }

    /// The largest speed, acceleration and jerk from one time to another (s).
    #[must_use]
    pub fn peaks_within(&self, times: [f64; 2]) -> Peaks {
        let tolerance = TUNING.tolerance;
        let path = self.path.as_ref();
        path.map_or_else(Peaks::default, |path| {
            peaks::peaks_within(path, &self.law, tolerance, times)
        })
    }

    /// The motion at [`Self::times`], one step for every planned step that moves.
    #[must_use]
    pub fn steps(&self) -> Motion {
        Motion { times: self.times.clone(), positions: self.positions.clone() }
    }

    /// A rate (Hz), or, if the motion has more samples with it than a motion may have, one with a hundredth of those at most, in two digits: who
    /// asked for no such motion wants no files as large as possible of it.
    #[must_use]
    pub fn fitting_rate(&self, rate: f64) -> f64 {
        match check::sample_count(rate, self.duration(), self.grippers()) {
            Err(Error::MotionTooManySamples { largest_rate, .. }) => {
                let rate = 0.01 * largest_rate;
                let digits = 10.0_f64.powf(rate.log10().floor() - 1.0);
                (rate / digits).floor() * digits
            }
            _ => rate,
        }
    }

    /// Times (s) from 0 at a rate (Hz), the last exactly [`Self::duration`].
    ///
    /// # Errors
    /// [`Error::MotionRate`] if the rate is no number above 0, [`Error::MotionTooManySamples`] if a motion
    /// with all of these steps would be larger than a scene's may be.
    pub fn samples(&self, rate: f64) -> Result<Vec<f64>, Error> {
        check::samples(rate, self.duration(), self.grippers())
    }

    /// Times (s) at a rate (Hz) after its end for which the grippers stand there for so long (s), without the first and the last
    /// moment.
    ///
    /// # Errors
    /// The errors of [`Self::samples`].
    pub fn standing_samples(&self, rate: f64, standing: f64) -> Result<Vec<f64>, Error> {
        let times = check::samples(rate, standing, self.grippers())?;
        let between = times.get(1..times.len().saturating_sub(1)).unwrap_or_default();
        Ok(between.iter().map(|t| self.duration() + t).collect())
    }

    /// The motion at [`Self::samples`]; more steps than were planned, or fewer.
    ///
    /// # Errors
    /// The errors of [`Self::samples`].
    pub fn sampled(&self, rate: f64) -> Result<Motion, Error> {
        let times = self.samples(rate)?;
        let positions = times.iter().map(|t| self.at(*t)).collect();
        Ok(Motion { times, positions })
    }
}

/// Velocity, acceleration and jerk from the derivatives of path and time law, by the chain rule.
fn rates([_, d, e, f]: &[Vector; 4], [_, v, a, j]: &State) -> [Vector; 3] {
    let sum = |x: f64, y: f64, z: f64| [0, 1, 2].map(|k| x * d[k] + y * e[k] + z * f[k]);
    [sum(*v, 0.0, 0.0), sum(*a, v * v, 0.0), sum(*j, 3.0 * v * a, v.powi(3))]
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOUNDS: Bounds = Bounds { speed: 0.25, acceleration: 1.0, jerk: 10.0 };

    fn motion(heights: &[f64]) -> TimedMotion {
        let planned: Vec<_> =
            heights.iter().map(|z| vec![[0.0, 0.1, *z], [0.2, 0.1, *z]]).collect();
        TimedMotion::new(&planned, &BOUNDS).unwrap()
    }

    /// A motion between two others is each of them in its time and stands in between; its steps are its own, and its peaks the largest of all.
    #[test]
    fn a_motion_between_two_others_goes_through_all_three() {
        let [down, own, up] = [vec![0.3, 0.1], vec![0.1, 0.4, 0.5], vec![0.5, 0.52, 0.9]];
        let [down, own, up] = [down, own, up].map(|heights| motion(&heights));
        let (grip, press) = (0.5, 1.5);
        let whole = own.then(press, &up).unwrap().after(&down, grip).unwrap();
        let begins = down.duration() + grip;
        let ends = begins + own.duration();
        assert!((whole.duration() - (ends + press + up.duration())).abs() < 1e-12);
        assert_eq!(whole.positions(), own.positions());
        assert_eq!(whole.times()[0], begins);

        let near = |a: Vec<[f64; 3]>, b: Vec<[f64; 3]>| {
            a.iter().zip(&b).all(|(a, b)| (0..3).all(|c| (a[c] - b[c]).abs() < 1e-12))
        };
        for k in 0..=1000 {
            let t = whole.duration() * f64::from(k) / 1000.0;
            let expected = match t {
                _ if t < begins => down.at(t),
                _ if t < ends => own.at(t - begins),
                _ => up.at(t - ends - press),
            };
            assert!(near(whole.at(t), expected), "{t}");
        }
        let largest = [&down, &own, &up].map(|motion| motion.peaks().speed.value);
        let speed = whole.peaks().speed;
        assert_eq!(speed.value, largest.into_iter().fold(0.0, f64::max));
        assert!((norm(whole.velocity(speed.time)[0]) - speed.value).abs() < 1e-3 * speed.value);
    }
}
