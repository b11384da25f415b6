//! The time-optimal law: the same path in the least time that everything which moves with it allows.
//!
//! A motion q(τ) that keeps its limits is run at another pace: with the square of the pace, `b(τ) = (dτ/dt)²`, the chain rule gives
//!
//! `q̇ = √b q'`, `q̈ = b q'' + ½ b' q'`, `q⃛ = √b (b q''' + 3/2 b' q'' + ½ b'' q')`,
//!
//! and the time is `∫ dτ/√b`. Bounds of q̇ and q̈ are convex in b, and so is the time (Verscheure et al. 2009). A bound of q⃛ is the
//! difference of two convex functions, `|b q''' + 3/2 b' q'' + ½ b'' q'| ≤ J/√b`: its right side is replaced by its tangent, which
//! lies below it, and the program is solved again from where it came to. So each solution keeps the bounds of its program, and with
//! the same bounds none takes longer than the one before. The motion itself is b = 1. It begins and ends at rest, and at any pace it
//! still does.
//!
//! 1. `pace`: b as a spline of parabolas;
//! 2. `program`: one convex program;
//! 3. here: what moves with the motion, the rounds, and the time law that comes of a pace.

mod pace;
mod program;
#[cfg(test)]
mod tests;

use super::path::Vector;
use super::peaks::{peaks, peaks_within};
use super::time_law::TimeLaw;
use super::tuning::TUNING;
use super::{Bounds, TimedMotion};
use crate::geometry::vector::norm;
use pace::{Jet, Pace};
use program::Program;

/// What moves with a motion, and how fast it may.
#[derive(Debug, Clone, PartialEq)]
pub struct Moving {
    /// First, second and third derivative to the time of the motion as it is, at each of [`Quickening::times`].
    pub rates: Vec<[[f64; 3]; 3]>,
    /// Largest norm of each; infinite where there is no limit.
    pub bounds: [f64; 3],
    /// How many of the first times have other bounds, and these bounds; `None` if the bounds are the same at all times.
    pub early: Option<(usize, [f64; 3])>,
}

impl Moving {
    /// Derivatives to the time as shares of their bounds, at one of the times and at a pace.
    fn shares(&self, jet: &Jet, n: usize) -> [f64; 3] {
        jet.shares(&self.rates[n], &self.bounds_at(n))
    }

    /// The bounds at one of the times.
    fn bounds_at(&self, n: usize) -> [f64; 3] {
        self.early.filter(|(count, _)| n < *count).map_or(self.bounds, |(_, bounds)| bounds)
    }
}

/// Which bound is nearest to its limit, at a time of the quickest motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limiting {
    /// How long the part of the motion is in which it is the nearest (s).
    pub time: f64,
    /// Which of those that move.
    pub moving: usize,
    /// 0 for its first derivative, 1 for its second, 2 for its third.
    pub order: usize,
    /// Share of the limit.
    pub share: f64,
    /// Whether it is one of [`Moving::early`].
    pub early: bool,
}

/// The motion that is to be made quicker, and the times at which its bounds are looked at.
#[derive(Debug)]
pub struct Quickening<'a> {
    motion: &'a TimedMotion,
    pace: Pace,
    /// Three in each part of the pace.
    times: Vec<f64>,
    /// The time of the motion as it is until which other bounds hold (s), and these.
    early: Option<(f64, Bounds)>,
}

impl<'a> Quickening<'a> {
    /// The course of a motion that takes some time; none of a motion of duration 0.
    #[must_use]
    pub fn new(motion: &'a TimedMotion) -> Option<Self> {
        let path = motion.path.as_ref()?;
        let mut ends = motion.law.breaks();
        ends.extend(path.knots.iter().map(|u| motion.law.time(*u)));
        ends.sort_by(f64::total_cmp);
        let pace = Pace::over(&ends, TUNING.pace_parts.map(|share| share * motion.duration()))?;
        let inside = TUNING.pace_inside;
        let times = pace.parts().flat_map(|(begin, end)| {
            [inside, 0.5, 1.0 - inside].map(|share| begin + share * (end - begin))
        });
        Some(Quickening { motion, times: times.collect(), pace, early: None })
    }

    /// The course with other bounds of the grippers until one of the times of the motion's steps (s).
    #[must_use]
    pub fn with_early(self, until: f64, bounds: Bounds) -> Self {
        Quickening { early: Some((until, bounds)), ..self }
    }

    /// Times of the motion as it is (s), ascending: where the rates of what moves are asked for.
    #[must_use]
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// The grippers, each under the bounds.
    #[must_use]
    pub fn grippers(&self, bounds: &Bounds) -> Vec<Moving> {
        let norms = |bounds: &Bounds| [bounds.speed, bounds.acceleration, bounds.jerk];
        let early = self
            .early
            .as_ref()
            .map(|(until, bounds)| (self.times.partition_point(|t| t < until), norms(bounds)));
        let bounds = norms(bounds);
        let moving = |g: usize| {
            let rates = self.times.iter().map(|t| [0, 1, 2].map(|n| self.motion.rate_of(g, *t, n)));
            Moving { rates: rates.collect(), bounds, early }
        };
        (0..self.motion.grippers()).map(moving).collect()
    }

    /// The quickest motion found along the same path, and what limits it; the motion as it is where none is quicker.
    ///
    /// Grippers keep `bounds`, and those of [`Self::with_early`], at every time; what else moves does at the times of the course.
    #[must_use]
    pub fn quickest(&self, bounds: &Bounds, moving: &[Moving]) -> (TimedMotion, Vec<Limiting>) {
        let pace = self.fastest_pace(moving);
        let first = self.stretch(&pace, moving);
        let law = self.law(&pace).map(|law| law.stretched(first));
        match law.and_then(|law| self.within(law, bounds)) {
            Some((motion, second)) if motion.duration() < self.motion.duration() => {
                let limiting = self.limiting(&pace, moving, first * second);
                (motion, limiting)
            }
            _ => (self.motion.clone(), self.limiting(&self.pace, moving, 1.0)),
        }
    }

    /// The pace that takes the least time; some bounds may be passed by a little.
    fn fastest_pace(&self, moving: &[Moving]) -> Pace {
        let mut pace = self.pace.clone();
        let mut program = Program::new(&self.times, moving);
        for _ in 0..TUNING.pace_rounds {
            program.meet(&pace);
            let Some(found) = program.solve(&pace) else { break };
            let gained = (1.0 - found.time() / pace.time()).abs();
            pace = found;
            if gained < TUNING.pace_gain && self.stretch(&pace, moving) < 1.0 + TUNING.tolerance {
                break;
            }
        }
        pace
    }

    /// How much longer a pace has to be for all that moves to keep its bounds at the times of the course; 1 where it does.
    fn stretch(&self, pace: &Pace, moving: &[Moving]) -> f64 {
        let shares = self.times.iter().enumerate().flat_map(|(n, t)| {
            let jet = pace.jet_at(*t);
            moving.iter().flat_map(move |one| one.shares(&jet, n).into_iter().enumerate())
        });
        let longer = shares.map(|(order, share)| share.powf(1.0 / (order + 1) as f64));
        longer.fold(1.0, f64::max)
    }

    /// The time law of a pace; none of one that stands still.
    fn law(&self, pace: &Pace) -> Option<TimeLaw> {
        let mut time = 0.0;
        let mut states = Vec::new();
        for (part, (begin, end)) in pace.parts().enumerate() {
            if part == 0 {
                states.push((0.0, self.state(pace, begin)));
            }
            time += pace.time_of(part);
            states.push((time, self.state(pace, end)));
        }
        let last = states.len().checked_sub(1)?;
        let length = self.motion.path.as_ref()?.length();
        states[0].1 = [0.0; 3];
        states[last].1 = [length, 0.0, 0.0];
        let law = TimeLaw::through(&states);
        TimeLaw::of_rows(&law.rows(), length)
    }

    /// The state of the path's parameter at a time of the motion as it is, at a pace.
    fn state(&self, pace: &Pace, t: f64) -> [f64; 3] {
        let [s, v, a, _] = self.motion.law.state_at(t);
        let Jet { value, slope, .. } = pace.jet_at(t);
        [s, v * value.sqrt(), a * value + 0.5 * v * slope]
    }

    /// The motion with a time law, so much longer that no gripper passes its bounds, and how much that is.
    fn within(&self, law: TimeLaw, bounds: &Bounds) -> Option<(TimedMotion, f64)> {
        let path = self.motion.path.as_ref()?;
        let tolerance = TUNING.tolerance;
        let stretch = match &self.early {
            None => peaks(path, &law, tolerance).stretch(bounds),
            Some((until, early)) => {
                let until = law.time(self.motion.law.state_at(*until)[0]);
                let part = |times| peaks_within(path, &law, tolerance, times);
                let first = part([0.0, until]).stretch(early);
                part([until, law.duration]).stretch(bounds).max(first)
            }
        };
        let longer = (stretch * (1.0 + tolerance)).max(1.0);
        Some((TimedMotion::timed(path.clone(), law.stretched(longer)), longer))
    }

    /// What is nearest to its limit, at each time of the course.
    fn limiting(&self, pace: &Pace, moving: &[Moving], longer: f64) -> Vec<Limiting> {
        let jets = self.times.iter().map(|t| pace.jet_at(*t));
        let lasts = pace.parts().enumerate().flat_map(|(part, _)| [pace.time_of(part) / 3.0; 3]);
        let nearest = |(n, (jet, lasts)): (usize, (Jet, f64))| {
            let time = lasts * longer;
            let mut most = Limiting { time, moving: 0, order: 0, share: 0.0, early: false };
            for (k, one) in moving.iter().enumerate() {
                for (order, share) in one.shares(&jet, n).into_iter().enumerate() {
                    let share = share / longer.powi(order as i32 + 1);
                    if share > most.share {
                        let early = one.early.is_some_and(|(count, _)| n < count);
                        most = Limiting { moving: k, order, share, early, ..most };
                    }
                }
            }
            most
        };
        jets.zip(lasts).enumerate().map(nearest).collect()
    }
}

impl Jet {
    /// Derivatives to time at this pace, as shares of their bounds.
    fn shares(&self, [first, second, third]: &[Vector; 3], bounds: &[f64; 3]) -> [f64; 3] {
        let Jet { value, slope, curvature } = *self;
        let root = value.max(0.0).sqrt();
        let sum = |x: f64, y: f64, z: f64| {
            norm([0, 1, 2].map(|c| x * first[c] + y * second[c] + z * third[c]))
        };
        let rates = [
            root * sum(1.0, 0.0, 0.0),
            sum(0.5 * slope, value, 0.0),
            root * sum(0.5 * curvature, 1.5 * slope, value),
        ];
        [0, 1, 2].map(|n| rates[n] / bounds[n])
    }
}
