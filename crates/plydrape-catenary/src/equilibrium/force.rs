//! The force of one span as a function of what holds it, eq. (9a) of `docs/theory/equilibrium.md`.
//!
//! The force H of a span is given implicitly by its length, C(H, x) = L − L_set(1 + H sec θ/EA) = 0.
//! Its derivatives follow from those of C: `H_x = −C_x/C_H` and, differentiating once more,
//! `H_xy = −(C_xy + C_Hx H_y + C_Hy H_x + C_HH H_x H_y)/C_H`.

use super::tuning::EquilibriumTuning;
use crate::catenary::{Excess, Jet, Profile, Span, Variable, compose, power, product, variable};

/// What is needed of an element beside its force.
#[derive(Debug, Clone, Copy, Default)]
pub struct Needs {
    /// Slopes at its ends.
    pub slope: [bool; 2],
    /// Curvatures at its ends.
    pub curvature: [bool; 2],
    /// Derivatives: an unknown slope moves it.
    pub derivatives: bool,
}

impl Needs {
    /// Whether all of another's needs are among these.
    pub fn cover(self, other: Needs) -> bool {
        let all = |own: [bool; 2], needed: [bool; 2]| (0..2).all(|n| own[n] || !needed[n]);
        all(self.slope, other.slope)
            && all(self.curvature, other.curvature)
            && (self.derivatives || !other.derivatives)
    }
}

/// Force, end slopes and end curvatures as functions of the prescribed slopes s₁, s₂ and, if `M` is 7,
/// of run, rise, weight, rigidity and fabric length.
#[derive(Debug, Clone, Copy)]
pub struct Evaluated<const M: usize> {
    /// Horizontal force H (N).
    pub force: Jet<M>,
    /// Slopes at both ends.
    pub slope: [Jet<M>; 2],
    /// Curvatures z'' at both ends (1/m).
    pub curvature: [Jet<M>; 2],
    /// Relative step of H over which the derivatives were extrapolated: their error is its square, that of the values
    /// its cube.
    pub extrapolation: f64,
    /// Measured relative error of the length, |C|/L_set; NaN where the force has moved since it was measured.
    pub length_residual: f64,
}

impl<const M: usize> Default for Evaluated<M> {
    fn default() -> Self {
        Evaluated {
            force: Jet::default(),
            slope: [Jet::default(); 2],
            curvature: [Jet::default(); 2],
            extrapolation: 0.0,
            length_residual: 0.0,
        }
    }
}

impl Evaluated<2> {
    /// The force (N) at end slopes that are changed by `step`, by its second-order series.
    pub fn force_at(&self, step: [f64; 2]) -> f64 {
        series(&self.force, step)
    }

    /// Extrapolates everything to end slopes that are changed by `step`, by second-order series; the length is to be
    /// measured again.
    pub fn extrapolate(&mut self, step: [f64; 2]) {
        let Evaluated { force, slope, curvature, extrapolation, length_residual } = self;
        for jet in [force].into_iter().chain(slope).chain(curvature) {
            jet.value = series(jet, step);
            for i in 0..2 {
                jet.gradient[i] += jet.hessian[i][0] * step[0] + jet.hessian[i][1] * step[1];
            }
        }
        *extrapolation += step[0].abs().max(step[1].abs());
        *length_residual = f64::NAN;
    }

    /// The values and derivatives of a wider evaluation at the same place.
    pub fn refined(&self, jets: &Evaluated<7>) -> Evaluated<2> {
        Evaluated {
            force: jets.force.first(),
            slope: jets.slope.map(|jet| jet.first()),
            curvature: jets.curvature.map(|jet| jet.first()),
            ..*self
        }
    }
}

/// Second-order series of a jet about its point.
fn series(jet: &Jet<2>, step: [f64; 2]) -> f64 {
    let [a, b] = step;
    let [[aa, ab], [_, bb]] = jet.hessian;
    jet.value
        + jet.gradient[0] * a
        + jet.gradient[1] * b
        + 0.5 * (aa * a * a + bb * b * b)
        + ab * a * b
}

/// The constraint C with derivatives to H, s₁, s₂ (`N` = 3) or to all eight variables (`N` = 8).
fn constraint<const N: usize>(profile: &Profile, span: &Span) -> (Jet<N>, Excess) {
    let (length, excess) = profile.length_and_excess::<N>();
    let mut c = length;
    if N == 3 {
        // of L_set(1 + H sec θ/EA) only H is a variable here
        let compliance = span.length * span.chord() / (span.run * span.axial_stiffness);
        c.value -= span.length + compliance * profile.force();
        c.gradient[0] -= compliance;
        return (c, excess);
    }
    let goal = stretched_length::<N>(profile, span);
    c.value = length.value - goal.value;
    for i in 0..N {
        c.gradient[i] = length.gradient[i] - goal.gradient[i];
        for j in 0..N {
            c.hessian[i][j] = length.hessian[i][j] - goal.hessian[i][j];
        }
    }
    (c, excess)
}

/// L_set(1 + H sec θ/EA) with all its derivatives.
fn stretched_length<const N: usize>(profile: &Profile, span: &Span) -> Jet<N> {
    let force: Jet<N> = variable(profile.force(), Variable::Force);
    let length: Jet<N> = variable(span.length, Variable::Length);
    let run: Jet<N> = variable(span.run, Variable::Run);
    let rise: Jet<N> = variable(span.rise, Variable::Rise);
    let theta = product(&rise, &power(&run, -1.0));
    let (t, secant) = (theta.value, theta.value.hypot(1.0));
    let secant = compose(&theta, secant, t / secant, secant.powi(-3));
    let mut stretch = product(&force, &secant);
    for i in 0..N {
        stretch.gradient[i] /= span.axial_stiffness;
        for j in 0..N {
            stretch.hessian[i][j] /= span.axial_stiffness;
        }
    }
    stretch.value = 1.0 + stretch.value / span.axial_stiffness;
    product(&length, &stretch)
}

/// The force as a function of the other variables, from the constraint.
fn implicit<const N: usize, const M: usize>(c: &Jet<N>, force: f64) -> Jet<M> {
    let mut h = Jet { value: force, ..Jet::default() };
    for i in 0..M {
        h.gradient[i] = -c.gradient[i + 1] / c.gradient[0];
    }
    for i in 0..M {
        for j in 0..M {
            let sum = c.hessian[i + 1][j + 1]
                + c.hessian[0][i + 1] * h.gradient[j]
                + c.hessian[0][j + 1] * h.gradient[i]
                + c.hessian[0][0] * h.gradient[i] * h.gradient[j];
            h.hessian[i][j] = -sum / c.gradient[0];
        }
    }
    h
}

/// A quantity of the profile as a function of the other variables, the force following.
fn follow<const N: usize, const M: usize>(q: &Jet<N>, h: &Jet<M>) -> Jet<M> {
    let mut out = Jet { value: q.value, ..Jet::default() };
    for i in 0..M {
        out.gradient[i] = q.gradient[i + 1] + q.gradient[0] * h.gradient[i];
        for j in 0..M {
            out.hessian[i][j] = q.hessian[i + 1][j + 1]
                + q.hessian[0][i + 1] * h.gradient[j]
                + q.hessian[0][j + 1] * h.gradient[i]
                + q.hessian[0][0] * h.gradient[i] * h.gradient[j]
                + q.gradient[0] * h.hessian[i][j];
        }
    }
    out
}

/// A jet in H and other variables, moved by a small step of H.
fn moved<const N: usize>(q: Jet<N>, step: f64) -> Jet<N> {
    let mut out = q;
    out.value += step * (q.gradient[0] + 0.5 * step * q.hessian[0][0]);
    for i in 0..N {
        out.gradient[i] += step * q.hessian[0][i];
    }
    out
}

/// Finds the force of a span near `force` (N) (`None`: from scratch) with its derivatives.
pub fn evaluate<const N: usize, const M: usize>(
    span: &Span,
    force: Option<f64>,
    needs: Needs,
    tuning: &EquilibriumTuning,
) -> Evaluated<M> {
    let (pole, goal) = (span.buckling_force(), span.goal());
    let sound = |h: f64| h > pole && h.is_finite();
    let relative = |step: f64, h: f64| step.abs() / (h - pole).max(f64::MIN_POSITIVE);
    let mut h =
        force.filter(|h| sound(*h)).unwrap_or_else(|| approach(span, span.first_guess(), tuning));
    let mut searched = false;
    let (profile, c, next) = loop {
        let profile = Profile::new(span, h);
        let (c, excess) = constraint::<N>(&profile, span);
        let next = span.advance(goal, h, excess);
        let near =
            sound(next) && excess.to_force < 0.0 && relative(next - h, h) <= tuning.series_force;
        if near || searched {
            break (profile, c, if near { next } else { h });
        }
        h = approach(span, h, tuning);
        searched = true;
    };
    // what the derivatives need is near enough; the force itself is taken to its last digits, because the
    // line search compares sums of forces
    let error = |excess: f64, h: f64| excess - goal.excess - goal.compliance * h;
    let (mut last, mut measured) = (next - h, c.value.abs() / span.length);
    let mut next = next;
    for _ in 0..tuning.force_steps {
        if relative(last, next) <= tuning.exact_force {
            break;
        }
        let excess = Profile::new(span, next).excess();
        let better = span.advance(goal, next, excess);
        measured = error(excess.value, next).abs() * span.run / span.length;
        if !sound(better) {
            break;
        }
        last = better - next;
        next = better;
    }
    let step = next - h;
    let length_residual =
        if relative(last, next) <= tuning.small_force { measured } else { f64::NAN };
    let force = implicit::<N, M>(&moved(c, step), next);
    let extrapolation = relative(step, h);
    let mut out = Evaluated { force, extrapolation, length_residual, ..Evaluated::default() };
    for end in 0..2 {
        if needs.slope[end] {
            out.slope[end] = follow(&moved(profile.end_slope_jet::<N>(end), step), &force);
        }
        if needs.curvature[end] {
            let curvature = moved(profile.end_curvature_jet::<N>(end), step);
            out.curvature[end] = follow(&curvature, &force);
        }
    }
    out
}

/// Finds the force of a span that no unknown slope moves: no derivatives.
pub fn evaluate_still(
    span: &Span,
    force: Option<f64>,
    needs: Needs,
    tuning: &EquilibriumTuning,
) -> Evaluated<2> {
    let mut out = Evaluated::default();
    (out.force.value, out.length_residual) = meet_length(span, force, tuning);
    if needs.slope != [false; 2] {
        let profile = Profile::new(span, out.force.value);
        for end in 0..2 {
            out.slope[end].value = profile.end_slope(end);
        }
    }
    out
}

/// The force (N) that gives a span its length, from one close to it (`None`: from scratch), and the measured
/// relative error of the length: at that force, or one contracting step before it.
pub fn meet_length(span: &Span, force: Option<f64>, tuning: &EquilibriumTuning) -> (f64, f64) {
    let (pole, goal) = (span.buckling_force(), span.goal());
    let sound = |h: f64| h > pole && h.is_finite();
    let mut h = force.filter(|h| sound(*h)).unwrap_or_else(|| span.first_guess());
    for _ in 0..tuning.force_steps {
        if !sound(h) {
            break;
        }
        let excess = Profile::new(span, h).excess();
        let next = span.advance(goal, h, excess);
        if !(sound(next) && excess.to_force < 0.0) {
            break;
        }
        let step = next - h;
        let error = (excess.value - goal.excess - goal.compliance * h) * span.run / span.length;
        h = next;
        if step.abs() <= tuning.small_force * (h - pole) {
            return (h, error.abs());
        }
    }
    let h = span.solve(Some(h)).force.unwrap_or(h);
    (h, length_residual(span, h))
}

/// Relative error of a span's length at a force, |C|/L_set.
pub fn length_residual(span: &Span, force: f64) -> f64 {
    let goal = span.goal();
    let error = Profile::new(span, force).excess().value - goal.excess - goal.compliance * force;
    (error * span.run / span.length).abs()
}

/// A force close enough to start from, by a few cheap steps from a guess.
fn approach(span: &Span, guess: f64, tuning: &EquilibriumTuning) -> f64 {
    let (pole, goal) = (span.buckling_force(), span.goal());
    let mut h = guess;
    for _ in 1..tuning.force_steps {
        if !(h > pole && h.is_finite()) {
            break;
        }
        let next = span.advance(goal, h, Profile::new(span, h).excess());
        let step = (next - h).abs() / (h - pole);
        h = next;
        if step <= 3.0 * tuning.series_force {
            return h;
        }
    }
    span.solve(Some(h)).force.unwrap_or(guess)
}
