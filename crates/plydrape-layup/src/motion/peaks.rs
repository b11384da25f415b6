//! The largest speed, acceleration and jerk of a motion, found with a bound that no sampling misses.
//!
//! Between knots of the path and jumps of the time law, s(t) is a cubic and p(s) is one: everything is smooth.
//! With bounds P', P'', P''' of the path's derivatives and V, A, J of the time law's on an interval Δt, the
//! chain rule bounds the rates of change,
//! `|d jerk/dt| ≤ 6 P''' V² A + 4 P'' V J + 3 P'' A²`, so that no value inside exceeds the mean of the
//! end values by more than Δt/2 times that. Intervals that could still hold a larger value are halved.

use super::Bounds;
use super::path::Path;
use super::rates;
use super::time_law::{State, TimeLaw, advance};
use super::tuning::TUNING;
use crate::geometry::vector::norm;

/// The largest value of one quantity.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Peak {
    /// The value (m/s, m/s² or m/s³).
    pub value: f64,
    /// Index of the gripper.
    pub gripper: usize,
    /// Where in time (s).
    pub time: f64,
}

/// The largest speed, acceleration and jerk of any gripper at any time.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Peaks {
    /// Largest speed (m/s).
    pub speed: Peak,
    /// Largest acceleration (m/s²).
    pub acceleration: Peak,
    /// Largest jerk (m/s³).
    pub jerk: Peak,
}

impl Peaks {
    /// The larger ones of these and of others that come a time (s) later.
    pub(super) fn and(self, others: &Peaks, later: f64) -> Peaks {
        let larger = |own: Peak, other: Peak| match other.value > own.value {
            true => Peak { time: other.time + later, ..other },
            false => own,
        };
        Peaks {
            speed: larger(self.speed, others.speed),
            acceleration: larger(self.acceleration, others.acceleration),
            jerk: larger(self.jerk, others.jerk),
        }
    }

    /// How many times longer the motion must take for these peaks to keep to the bounds.
    pub(super) fn stretch(&self, bounds: &Bounds) -> f64 {
        let speed = self.speed.value / bounds.speed;
        let acceleration = (self.acceleration.value / bounds.acceleration).sqrt();
        let jerk = (self.jerk.value / bounds.jerk).cbrt();
        speed.max(acceleration).max(jerk)
    }
}

/// An interval of time in which path and time law are polynomials.
struct Piece {
    span: usize,
    begin: f64,
    state: State,
}

/// Values of one gripper at one time: the state of the time law, |p'|, |p''|, |p'''|, then speed, acceleration, jerk.
struct Values {
    state: State,
    path: [f64; 3],
    motion: [f64; 3],
}

/// The peaks, none smaller than the true one by more than a share `tolerance`.
pub(super) fn peaks(path: &Path, law: &TimeLaw, tolerance: f64) -> Peaks {
    peaks_within(path, law, tolerance, [0.0, law.duration])
}

/// The peaks from one time to another (s), none smaller than the true one by more than a share `tolerance`.
pub(super) fn peaks_within(
    path: &Path,
    law: &TimeLaw,
    tolerance: f64,
    [from, to]: [f64; 2],
) -> Peaks {
    let mut times = law.breaks();
    times.extend([from, to]);
    times.extend(path.knots.iter().map(|u| law.time(*u)));
    times.sort_by(f64::total_cmp);
    // a knot and a jump of the law at the same place are one, whatever rounding makes of their times
    let rounding = TUNING.law_rounding * law.duration;
    times.retain(|t| (from - rounding..=to + rounding).contains(t));
    times.dedup_by(|later, earlier| *later - *earlier <= rounding);
    let mut search = Search { path, tolerance, found: [Peak::default(); 3] };
    let pieces = times.windows(2).filter(|pair| pair[1] > pair[0]).map(|pair| {
        // Which span and which jerk: those in the middle.
        let middle = law.state_at(0.5 * (pair[0] + pair[1]));
        let [s, v, a, _] = law.state_at(pair[0]);
        let piece =
            Piece { span: path.span(middle[0]), begin: pair[0], state: [s, v, a, middle[3]] };
        (piece, pair[1] - pair[0])
    });
    let pieces: Vec<(Piece, f64)> = pieces.collect();
    let ends = |search: &mut Search, piece: &Piece, time: f64, gripper: usize| {
        let ends = [0.0, time].map(|t| search.values(piece, t, gripper));
        for (t, values) in [0.0, time].into_iter().zip(&ends) {
            search.note(piece.begin + t, gripper, values);
        }
        ends
    };
    // All ends first, so that the search can drop most intervals at once.
    for (piece, time) in &pieces {
        for gripper in 0..path.grippers {
            ends(&mut search, piece, *time, gripper);
        }
    }
    for (piece, time) in &pieces {
        for gripper in 0..path.grippers {
            let [from, to] = ends(&mut search, piece, *time, gripper);
            search.halve(piece, gripper, (0.0, &from), (*time, &to), TUNING.halvings);
        }
    }
    let [speed, acceleration, jerk] = search.found;
    Peaks { speed, acceleration, jerk }
}

struct Search<'a> {
    path: &'a Path,
    tolerance: f64,
    found: [Peak; 3],
}

impl Search<'_> {
    fn values(&self, piece: &Piece, t: f64, gripper: usize) -> Values {
        let state = advance(piece.state, t);
        let jet = self.path.jet(piece.span, gripper, state[0]);
        let motion = rates(&jet, &state).map(norm);
        Values { state, path: [norm(jet[1]), norm(jet[2]), norm(jet[3])], motion }
    }

    fn note(&mut self, time: f64, gripper: usize, values: &Values) {
        for (peak, value) in self.found.iter_mut().zip(values.motion) {
            if value > peak.value {
                *peak = Peak { value, gripper, time };
            }
        }
    }

    /// Halves an interval in which a value could exceed the largest known one.
    fn halve(
        &mut self,
        piece: &Piece,
        gripper: usize,
        (t0, from): (f64, &Values),
        (t1, to): (f64, &Values),
        depth: u32,
    ) {
        let bounds = bounds(t1 - t0, from, to);
        let within = |(bound, peak): (&f64, &Peak)| *bound <= peak.value * (1.0 + self.tolerance);
        if depth == 0 || bounds.iter().zip(&self.found).all(within) {
            return;
        }
        let t = 0.5 * (t0 + t1);
        let middle = self.values(piece, t, gripper);
        self.note(piece.begin + t, gripper, &middle);
        self.halve(piece, gripper, (t0, from), (t, &middle), depth - 1);
        self.halve(piece, gripper, (t, &middle), (t1, to), depth - 1);
    }
}

/// Upper bounds of speed, acceleration and jerk between two times.
fn bounds(time: f64, from: &Values, to: &Values) -> [f64; 3] {
    // Of the time law: ṡ is a parabola, s̈ a line.
    let larger = |k: usize| from.state[k].abs().max(to.state[k].abs());
    let j = from.state[3].abs();
    let v = larger(1) + j * time.powi(2) / 8.0;
    let a = larger(2);
    // Of the path: p' is a parabola, p'' a line.
    let way = to.state[0] - from.state[0];
    let third = from.path[2];
    let second = from.path[1].max(to.path[1]);
    let first = from.path[0].max(to.path[0]) + third * way.powi(2) / 8.0;
    // Each rate of change.
    let snap = 6.0 * third * v.powi(2) * a + 4.0 * second * v * j + 3.0 * second * a.powi(2);
    let jerk = third * v.powi(3) + 3.0 * second * v * a + first * j;
    let acceleration = second * v.powi(2) + first * a;
    let rate = [acceleration, jerk, snap];
    [0, 1, 2].map(|k| 0.5 * (from.motion[k] + to.motion[k] + time * rate[k]))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// No value of a fine sampling exceeds the peaks by more than their tolerance, coarse or fine.
    #[test]
    fn no_sample_exceeds_the_peaks() {
        let rows: Vec<Vec<[f64; 3]>> = (0..9)
            .map(|k| f64::from(k) * 0.6)
            .map(|x| vec![[x.cos(), x.sin(), 0.1 * x], [0.0, 0.3 * x, (2.0 * x).sin()]])
            .collect();
        let planned: Vec<&[[f64; 3]]> = rows.iter().map(Vec::as_slice).collect();
        let path = Path::new(&planned, &[0.6, 0.7, 0.5, 0.6, 0.9, 0.6, 0.3, 0.6]);
        let bounds = Bounds { speed: 0.8, acceleration: 2.0, jerk: 20.0 };
        let law = TimeLaw::new(path.length(), &bounds);
        for tolerance in [0.1, 1e-4] {
            let peaks = peaks(&path, &law, tolerance);
            let peaks = [peaks.speed, peaks.acceleration, peaks.jerk].map(|peak| peak.value);
            for k in 0..=20_000 {
                let state = law.state_at(law.duration * f64::from(k) / 20_000.0);
                for g in 0..2 {
                    let values =
                        rates(&path.jet(path.span(state[0]), g, state[0]), &state).map(norm);
                    assert!((0..3).all(|n| values[n] <= peaks[n] * (1.0 + tolerance)));
                }
            }
        }
    }
}
