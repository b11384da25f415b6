//! The horizontal force at which a span has its length, eq. (5) of `docs/theory/span.md`.
//!
//! The excess over the chord behaves like D/(H − a)² nearly everywhere: D = q²ℓ²cos³θ/24 far from
//! buckling, a close to the buckling force. Each iteration fits D and a to the excess and its
//! derivative and meets `D/(H − a)² = e₀ + c H` exactly, with e₀ the set excess and c the axial
//! compliance; for an inextensible span this is Newton's method on (L − chord)^(−1/2). A bracket keeps
//! it on the hanging branch, from H = +∞ down to buckling.

use super::tuning::TUNING;
use super::{Excess, Profile, Span};

/// How a span holds its length.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SpanState {
    /// Longer than its chord.
    Hanging,
    /// Chord longer than the set length: all but straight, held by the axial stiffness.
    Overstretched,
    /// Inextensible and not longer than its chord: a straight line without a force.
    Straight,
}

/// The force of a span of given length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Root {
    /// Horizontal force H (N); `None` for a straight inextensible span.
    pub force: Option<f64>,
    /// How it holds its length.
    pub state: SpanState,
    /// Evaluations of the arc length.
    pub evaluations: usize,
    /// Relative error of the length that is left, |L − L_set(1 + H sec θ/EA)| / L_set.
    pub residual: f64,
}

/// Excess to reach, per run: e₀ + c H.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Goal {
    /// (L_set − chord)/ℓ.
    pub excess: f64,
    /// L_set sec θ/(EA ℓ) (1/N).
    pub compliance: f64,
}

impl Span {
    pub(crate) fn goal(&self) -> Goal {
        let chord = self.chord();
        Goal {
            excess: (self.length - chord) / self.run,
            compliance: self.length * chord / (self.axial_stiffness * self.run * self.run),
        }
    }

    /// How the span will hold its length.
    #[must_use]
    pub fn state(&self) -> SpanState {
        // a chord that equals the length but for rounding is taut, not hanging
        let slack = self.length - self.chord();
        match (slack > TUNING.slack * self.length, self.axial_stiffness.is_infinite()) {
            (true, _) => SpanState::Hanging,
            (false, true) => SpanState::Straight,
            (false, false) if slack < 0.0 => SpanState::Overstretched,
            (false, false) => SpanState::Hanging,
        }
    }

    /// Smallest force that the search may try (N).
    fn lowest_force(&self, goal: Goal) -> f64 {
        let stretched = if goal.compliance > 0.0 && goal.excess < 0.0 {
            -goal.excess / goal.compliance
        } else {
            f64::NEG_INFINITY
        };
        stretched.max(self.buckling_force())
    }

    /// The force of the small-sag parabola, shifted by the buckling force (N).
    #[must_use]
    pub(crate) fn first_guess(&self) -> f64 {
        let goal = self.goal();
        let cosine = self.run / self.chord();
        let strength = (self.load() * self.run).powi(2) * cosine.powi(3) / 24.0;
        meet(strength, self.buckling_force(), goal)
    }

    /// One step towards the force of the span from the excess at `force`.
    pub(crate) fn advance(&self, goal: Goal, force: f64, excess: Excess) -> f64 {
        let distance = -2.0 * excess.value / excess.to_force;
        meet(excess.value * distance * distance, force - distance, goal)
    }

    /// Finds the horizontal force, starting from `guess` (N) or from the parabola.
    #[must_use]
    pub fn solve(&self, guess: Option<f64>) -> Root {
        let state = self.state();
        if state == SpanState::Straight {
            return Root { force: None, state, evaluations: 0, residual: 0.0 };
        }
        let goal = self.goal();
        let (mut low, mut high) = (self.lowest_force(goal), f64::INFINITY);
        let mut force = guess.filter(|h| *h > low).unwrap_or_else(|| self.first_guess());
        if !(force > low && force.is_finite()) {
            force = step_up(low, low);
        }
        let mut residual = f64::INFINITY;
        for evaluations in 1..=TUNING.evaluations {
            let excess = Profile::new(self, force).excess();
            let error = excess.value - goal.excess - goal.compliance * force;
            residual = (error * self.run / self.length).abs();
            if error > 0.0 {
                low = force
            } else {
                high = force
            }
            let mut next = self.advance(goal, force, excess);
            // where the excess does not fall with H, or the step leaves the bracket: halve
            let falls = excess.to_force < 0.0 && next.is_finite();
            if !(falls && next > low && next < high) {
                if falls
                    && (next - force).abs() <= TUNING.small_step * (force - self.buckling_force())
                {
                    return Root { force: Some(force), state, evaluations, residual };
                }
                next = if high.is_infinite() { step_up(force, low) } else { 0.5 * (low + high) };
                if next <= low || next >= high {
                    // the bracket has closed to neighboring numbers
                    return Root { force: Some(force), state, evaluations, residual };
                }
            } else if (next - force).abs() <= TUNING.small_step * (next - self.buckling_force()) {
                // quadratic convergence: the error of `next` is the square of this step
                let error = residual * TUNING.small_step;
                return Root { force: Some(next), state, evaluations, residual: error };
            }
            force = next;
        }
        Root { force: Some(force), state, evaluations: TUNING.evaluations, residual }
    }

    /// Whether a root gives this span its length, in a shape of finite numbers.
    #[must_use]
    pub fn is_solved_by(&self, root: &Root) -> bool {
        let is_finite = |force: f64| {
            let profile = Profile::new(self, force);
            let stations = [0.0, 0.5, 1.0].map(|share| profile.station(share * self.run));
            stations.iter().all(|station| station.z.is_finite() && station.moment.is_finite())
        };
        root.residual <= TUNING.length_error && root.force.is_none_or(is_finite)
    }
}

/// A force well above `force`.
fn step_up(force: f64, low: f64) -> f64 {
    let distance = (force - low).abs().max(force.abs()).max(1e-300);
    force + if distance.is_finite() { distance } else { 1.0 }
}

/// The H above `pole` at which D/(H − pole)² = e₀ + c H.
fn meet(strength: f64, pole: f64, goal: Goal) -> f64 {
    // h(ξ) = c ξ³ + e ξ² − D with ξ = H − pole, e = e₀ + c·pole: one positive root
    let (c, e) = (goal.compliance, goal.excess + goal.compliance * pole);
    if c == 0.0 {
        return pole + (strength / e).sqrt();
    }
    // from above, where h is convex and rising, Newton falls on the root without overshoot
    let mut xi = (strength / c).cbrt() + (-e / c).max(0.0);
    if e > 0.0 {
        xi = xi.min((strength / e).sqrt());
    }
    for _ in 0..50 {
        let step = ((c * xi + e) * xi * xi - strength) / ((3.0 * c * xi + 2.0 * e) * xi);
        xi -= step;
        if step.abs() <= 1e-15 * xi {
            break;
        }
    }
    pole + xi
}
