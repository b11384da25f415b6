//! The time law s(t) of all grippers: from rest to rest, with constant jerk in each of its phases.
//!
//! The fastest one over a length L with bounded speed, acceleration and jerk is the seven-phase profile of robotics (Biagiotti and
//! Melchiorri 2008, section 3.4): the jerk is j, 0, −j while it speeds up, 0 while it cruises, and −j, 0, j while it slows down.
//! With the duration T_j of a phase of jerk, T_a of the phase of constant acceleration and T_v of cruising, the
//! acceleration reaches jT_j, the speed jT_j(T_j + T_a), and `L = jT_j(T_j + T_a)(2T_j + T_a + T_v)`. Each limit that is
//! reached gives one of the durations; the others are 0 or follow from L. This law is its own mirror image,
//! `s(T − t) = L − s(t)`.
//!
//! A law that goes through given states (`through`) has three phases of the same length between two of them: their three jerks
//! are those that lead from one state to the next.

use super::Bounds;
use super::tuning::TUNING;

/// The state of the time law at a time: s (m), ṡ (m/s), s̈ (m/s²) and s⃛ (m/s³).
pub(super) type State = [f64; 4];

/// A time law from rest to rest.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct TimeLaw {
    /// How long it takes T (s).
    pub duration: f64,
    /// Where it ends S (m).
    length: f64,
    /// Beginning (s) and state of every phase.
    phases: Vec<(f64, State)>,
}

impl TimeLaw {
    /// The time law of no motion.
    pub fn rest() -> Self {
        TimeLaw { length: 0.0, duration: 0.0, phases: vec![(0.0, [0.0; 4])] }
    }

    /// The fastest time law over a length (m, positive) within bounds.
    pub fn new(length: f64, bounds: &Bounds) -> Self {
        let Bounds { speed, acceleration, jerk } = *bounds;
        // The speed is reached: with constant acceleration on the way, or without.
        let ramp = acceleration / jerk;
        let reached = (speed / jerk).sqrt();
        let (mut jerking, mut steady) =
            if reached >= ramp { (ramp, speed / acceleration - ramp) } else { (reached, 0.0) };
        let mut cruising = length / speed - (2.0 * jerking + steady);
        if cruising < 0.0 {
            // It is not: L = a(T_j + T_a)(2T_j + T_a), or L = 2jT_j³ where the acceleration is not reached either.
            cruising = 0.0;
            jerking = (0.5 * length / jerk).cbrt().min(ramp);
            steady = ((length / acceleration + 0.25 * ramp * ramp).sqrt() - 1.5 * ramp).max(0.0);
        }

        let half: Vec<(f64, f64)> =
            [(jerking, jerk), (steady, 0.0), (jerking, -jerk), (0.5 * cruising, 0.0)]
                .into_iter()
                .filter(|(time, _)| *time > 0.0)
                .collect();
        let mut phases: Vec<(f64, State)> = Vec::with_capacity(2 * half.len());
        let (mut begin, mut state) = (0.0, [0.0; 4]);
        let mut ends = Vec::with_capacity(half.len());
        for (time, jerk) in half {
            state[3] = jerk;
            phases.push((begin, state));
            state = advance(state, time);
            begin += time;
            ends.push((begin, state));
        }
        let duration = 2.0 * begin;
        // the second half is the mirror image of the first
        phases.extend(
            ends.iter().rev().map(|(end, [s, v, a, j])| (duration - end, [length - s, *v, -a, *j])),
        );
        TimeLaw { length, duration, phases }
    }

    /// The time law through states s, ṡ, s̈ at times (s), the first at 0, the first and the last at rest.
    pub fn through(states: &[(f64, [f64; 3])]) -> Self {
        let mut phases = Vec::with_capacity(3 * states.len());
        for pair in states.windows(2) {
            let ((begin, from), (end, to)) = (pair[0], pair[1]);
            let third = (end - begin) / 3.0;
            let mut state = [from[0], from[1], from[2], 0.0];
            for (n, jerk) in jerks(from, to, third).into_iter().enumerate() {
                state[3] = jerk;
                phases.push((begin + third * n as f64, state));
                state = advance(state, third);
            }
        }
        let (duration, [length, ..]) = states.last().copied().unwrap_or_default();
        TimeLaw { length, duration, phases }
    }

    /// The time law of rows of time (s) and state, one for each phase, and a last one for the end; none of rows that are no such
    /// law over a length (m).
    pub fn of_rows(rows: &[[f64; 5]], length: f64) -> Option<Self> {
        let [phases @ .., last] = rows else { return None };
        let first = phases.first()?;
        let finite = rows.iter().flatten().all(|x| x.is_finite());
        let ascend =
            rows.windows(2).all(|pair| pair[0][0] < pair[1][0] && pair[0][1] <= pair[1][1]);
        // what a phase leads to is where the next one begins, to rounding
        let near = |a: f64, b: f64, size: f64| (a - b).abs() <= TUNING.law_rounding * size;
        let largest = |n: usize| rows.iter().map(|row| row[n].abs()).fold(0.0, f64::max);
        let sizes = [1, 2, 3].map(largest);
        let meets = rows.windows(2).all(|pair| {
            let [begin, state @ ..] = pair[0];
            let reached = advance(state, pair[1][0] - begin);
            (0..3).all(|n| near(reached[n], pair[1][n + 1], sizes[n]))
        });
        let rests = first[..4] == [0.0; 4] && last[2..] == [0.0; 3];
        if !(finite && ascend && meets && rests && near(last[1], length, length)) {
            return None;
        }
        let phases = phases.iter().map(|[begin, state @ ..]| (*begin, *state)).collect();
        Some(TimeLaw { length, duration: last[0], phases })
    }

    /// This law, a rest for a time (s), and then another law.
    pub fn then(mut self, rest: f64, next: &TimeLaw) -> Self {
        let (end, length) = (self.duration, self.length);
        if rest > 0.0 {
            self.phases.push((end, [length, 0.0, 0.0, 0.0]));
        }
        let begin = end + rest;
        let later = |(time, [s, v, a, j]): &(f64, State)| (begin + time, [length + s, *v, *a, *j]);
        self.phases.extend(next.phases.iter().map(later));
        TimeLaw { length: length + next.length, duration: begin + next.duration, ..self }
    }

    /// The rows of the law, see [`Self::of_rows`].
    pub fn rows(&self) -> Vec<[f64; 5]> {
        let row = |(begin, [s, v, a, j]): &(f64, State)| [*begin, *s, *v, *a, *j];
        let mut rows: Vec<[f64; 5]> = self.phases.iter().map(row).collect();
        rows.push([self.duration, self.length, 0.0, 0.0, 0.0]);
        rows
    }

    /// This time law over a time λ times as long.
    pub fn stretched(&self, factor: f64) -> Self {
        let phase = |(begin, [s, v, a, j]): &(f64, State)| {
            (begin * factor, [*s, v / factor, a / factor.powi(2), j / factor.powi(3)])
        };
        TimeLaw {
            length: self.length,
            duration: self.duration * factor,
            phases: self.phases.iter().map(phase).collect(),
        }
    }

    /// The state at a time (s), which is taken into 0 … T; where the jerk jumps, that after the jump.
    pub fn state_at(&self, t: f64) -> State {
        let t = t.max(0.0);
        let phase = self.phases.partition_point(|(begin, _)| *begin <= t).saturating_sub(1);
        let (begin, state) = self.phases[phase];
        if t >= self.duration {
            return [self.length, 0.0, 0.0, state[3]];
        }
        let [s, v, a, j] = advance(state, t - begin);
        [s.min(self.length), v, a, j]
    }

    /// The time at which it passes s (m).
    pub fn time(&self, s: f64) -> f64 {
        if s <= 0.0 {
            return 0.0;
        }
        if s >= self.length {
            return self.duration;
        }
        let phase = self.phases.partition_point(|(_, state)| state[0] <= s).saturating_sub(1);
        // s grows: halve until the doubles have no middle, which takes fewer times than they have exponents and digits
        const HALVINGS: usize = 2200;
        let mut low = self.phases[phase].0;
        let mut high = self.phases.get(phase + 1).map_or(self.duration, |(end, _)| *end);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                break;
            }
            if self.state_at(middle)[0] < s {
                low = middle;
            } else {
                high = middle;
            }
        }
        high
    }

    /// Times at which the jerk may jump (s), ascending, with 0 and T.
    pub fn breaks(&self) -> Vec<f64> {
        self.phases.iter().map(|(begin, _)| *begin).chain([self.duration]).collect()
    }
}

/// A state after some time (s) of constant jerk.
pub(super) fn advance([s, v, a, j]: State, t: f64) -> State {
    [s + t * (v + t * (a / 2.0 + t * (j / 6.0))), v + t * (a + t * (j / 2.0)), a + t * j, j]
}

/// The jerks of three phases of the same time (s) that lead from one state to another.
fn jerks(from: [f64; 3], to: [f64; 3], third: f64) -> [f64; 3] {
    let [s, v, a, _] = advance([from[0], from[1], from[2], 0.0], 3.0 * third);
    // what the jerks have to add: to s̈ their sum, to ṡ and s what they have grown to at the end
    let [x, y, z] = [(to[2] - a) / third, (to[1] - v) / third.powi(2), (to[0] - s) / third.powi(3)];
    let first = z - y + x / 3.0;
    let second = y - 0.5 * x - 2.0 * first;
    [first, second, x - first - second]
}

#[cfg(test)]
mod tests {
    use super::*;

    use clarabel::algebra::CscMatrix;
    use clarabel::solver::{
        DefaultSettings, DefaultSolver, IPSolver, SolverStatus, SupportedConeT,
    };

    const BOUNDS: Bounds = Bounds { speed: 0.25, acceleration: 1.0, jerk: 10.0 };

    /// Bounds and lengths of all four cases: speed and acceleration reached or not.
    const CASES: [(f64, Bounds); 5] = [
        (0.4, BOUNDS),
        (0.05, BOUNDS),
        (1e-3, BOUNDS),
        (0.4, Bounds { acceleration: 2.0, ..BOUNDS }),
        // The speed is just reached, and so is the acceleration.
        (0.5, Bounds { speed: 0.5, acceleration: 1.0, jerk: 2.0 }),
    ];

    /// At every time the jerk, the acceleration or the speed is at its limit, and none is beyond: to rounding.
    #[test]
    fn some_limit_is_reached_in_every_phase_and_none_is_exceeded() {
        for (length, bounds) in CASES {
            let law = TimeLaw::new(length, &bounds);
            for k in 0..1000 {
                let [_, v, a, j] = law.state_at(law.duration * (f64::from(k) + 0.5) / 1000.0);
                let shares = [v / bounds.speed, a / bounds.acceleration, j / bounds.jerk];
                let most = shares.iter().fold(0.0, |most: f64, share| most.max(share.abs()));
                assert!((most - 1.0).abs() < 1e-14, "{length} {bounds:?} {shares:?}");
            }
        }
    }

    /// Rest at 0 and at the length to the last bit; both halves meet in the middle of the length to rounding.
    #[test]
    fn it_begins_and_ends_at_rest_and_is_halfway_at_half_time() {
        for (length, bounds) in CASES {
            let law = TimeLaw::new(length, &bounds);
            assert_eq!(law.state_at(0.0)[..3], [0.0; 3]);
            assert_eq!(law.state_at(law.duration)[..3], [length, 0.0, 0.0]);
            let before = law.state_at(0.5 * law.duration * (1.0 - 1e-16))[0];
            assert!((before - 0.5 * length).abs() < 1e-15 * length, "{before} {length}");
        }
    }

    /// A linear program finds no motion from rest to rest that comes farther in the same time. Its jerk is constant in
    /// each of 80 intervals and its speed is bounded at their ends, so it misses the optimum by the square of an
    /// interval, some 1e-3 of the length.
    #[test]
    fn no_motion_comes_farther_in_the_same_time() {
        for (length, bounds) in CASES {
            let time = TimeLaw::new(length, &bounds).duration;
            let farthest = farthest_in(time, &bounds);
            assert!((farthest / length - 1.0).abs() < 2e-3, "{farthest} {length} {bounds:?}");
        }
    }

    /// The farthest (m) that a motion from rest to rest comes in a time (s).
    fn farthest_in(time: f64, bounds: &Bounds) -> f64 {
        const COUNT: usize = 80;
        let step = time / COUNT as f64;
        // Jerk as a share of its limit in every interval; what a unit of it gives at the end of interval n.
        let response = |n: usize, k: usize| {
            let later = (n - k) as f64 * step;
            let start = [0.0, 0.0, 0.0, bounds.jerk];
            let [s, v, a, _] = advance(start, step);
            advance([s, v, a, 0.0], later)
        };
        let (mut rows, mut columns, mut values, mut limits) =
            (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        let mut put = |n: usize, quantity: usize, scale: f64, limit: f64| {
            for k in 0..=n {
                rows.push(limits.len());
                columns.push(k);
                values.push(scale * response(n, k)[quantity]);
            }
            limits.push(limit);
        };
        put(COUNT - 1, 1, 1.0 / bounds.speed, 0.0);
        put(COUNT - 1, 2, 1.0 / bounds.acceleration, 0.0);
        for n in 0..COUNT {
            for sign in [1.0, -1.0] {
                put(n, 1, sign / bounds.speed, 1.0);
                put(n, 2, sign / bounds.acceleration, 1.0);
            }
        }
        for k in 0..COUNT {
            for sign in [1.0, -1.0] {
                rows.push(limits.len());
                columns.push(k);
                values.push(sign);
                limits.push(1.0);
            }
        }
        let reach = |k: usize| response(COUNT - 1, k)[0];
        let goal: Vec<f64> = (0..COUNT).map(|k| -reach(k) / reach(0)).collect();
        let cones =
            [SupportedConeT::ZeroConeT(2), SupportedConeT::NonnegativeConeT(limits.len() - 2)];
        let matrix = CscMatrix::new_from_triplets(limits.len(), COUNT, rows, columns, values);
        let objective = CscMatrix::zeros((COUNT, COUNT));
        let settings = DefaultSettings { verbose: false, ..DefaultSettings::default() };
        let mut solver =
            DefaultSolver::new(&objective, &goal, &matrix, &limits, &cones, settings).unwrap();
        solver.solve();
        assert_eq!(solver.solution.status, SolverStatus::Solved);
        solver.solution.x.iter().enumerate().map(|(k, share)| share * reach(k)).sum()
    }

    /// A time law in other units of length and time is the same: lengths 1e-9 … 1e6 m, times 1e-3 … 1e3 s a second.
    #[test]
    fn the_time_law_does_not_depend_on_units() {
        for (length, bounds) in CASES {
            let duration = TimeLaw::new(length, &bounds).duration;
            for (meter, second) in [(1e-9, 1.0), (1e6, 1.0), (1.0, 1e-3), (1e-9, 1e3)] {
                let scaled = Bounds {
                    speed: bounds.speed * meter / second,
                    acceleration: bounds.acceleration * meter / (second * second),
                    jerk: bounds.jerk * meter / (second * second * second),
                };
                let ratio = TimeLaw::new(length * meter, &scaled).duration / (duration * second);
                assert!((ratio - 1.0).abs() < 1e-14, "{ratio} {meter} {second}");
            }
        }
    }

    /// The time of a place is the inverse of the place at a time, in both halves and in every phase.
    #[test]
    fn time_and_place_are_inverse() {
        let law = TimeLaw::new(0.4, &BOUNDS).stretched(1.3);
        for k in 1..100 {
            let t = law.duration * f64::from(k) / 100.0;
            let [s, v, ..] = law.state_at(t);
            // A rounding of s is one of t, over ṡ.
            assert!((law.time(s) - t).abs() < 1e-15 + 1e-15 / v, "{t}");
        }
        assert_eq!((law.time(0.0), law.time(0.4)), (0.0, law.duration));
    }

    /// s, ṡ and s̈ are continuous at every jump of the jerk, and in the middle.
    #[test]
    fn nothing_but_the_jerk_jumps() {
        for length in [1e-3, 0.05, 0.4] {
            let law = TimeLaw::new(length, &BOUNDS);
            let mut breaks = law.breaks();
            breaks.push(0.5 * law.duration);
            for t in breaks {
                let [before, after] = [-1e-9, 1e-9].map(|h| law.state_at(t + h));
                // In 2 ns a state moves by its rate; the jerk is at most 10 m/s³.
                assert!(
                    (0..3).all(|k| (before[k] - after[k]).abs() < 3e-8),
                    "{before:?} {after:?}"
                );
            }
        }
    }
}
