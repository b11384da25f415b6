//! One span of the net with its force as a function of what holds it.
//!
//! The force H of a span is given implicitly by its length, C(H, x) = L − L_set(1 + H sec θ/EA) = 0.
//! Its derivatives follow from those of C: `H_x = −C_x/C_H` and, differentiating once more,
//! `H_xy = −(C_xy + C_Hx H_y + C_Hy H_x + C_HH H_x H_y)/C_H`.

use super::Number;
use super::net::{Element, End};
use crate::catenary::{
    EndCondition, Excess, Jet, Profile, Span, Variable, compose, power, product, variable,
};

/// What is needed of an element beside its force.
#[derive(Debug, Clone, Copy, Default)]
pub struct Wanted {
    /// Slopes at its ends.
    pub slope: [bool; 2],
    /// Curvatures at its ends.
    pub curvature: [bool; 2],
}

/// Force, end slopes and end curvatures as functions of the prescribed slopes s₁, s₂ and, if `M` is 7,
/// of run, rise, weight, rigidity and fabric length.
#[derive(Debug, Clone, Copy)]
pub struct Settled<const M: usize> {
    /// Horizontal force H (N).
    pub force: Jet<M>,
    /// Slopes at both ends.
    pub slope: [Jet<M>; 2],
    /// Curvatures z'' at both ends (1/m).
    pub curvature: [Jet<M>; 2],
}

impl<const M: usize> Default for Settled<M> {
    fn default() -> Self {
        Settled {
            force: Jet::default(),
            slope: [Jet::default(); 2],
            curvature: [Jet::default(); 2],
        }
    }
}

impl<T: Number> Element<T> {
    /// The span at given end slopes; an empty list leaves the ends free.
    pub fn span(&self, axial_stiffness: f64, slopes: &[f64]) -> Span {
        let end = |n: usize| match (self.ends[n], slopes.get(n)) {
            (End::Free, _) | (_, None) => EndCondition::Free,
            (_, Some(slope)) => EndCondition::Slope(*slope),
        };
        Span {
            run: self.run.re(),
            rise: self.rise.re(),
            length: self.length.re(),
            ends: [end(0), end(1)],
            weight: self.weight.re(),
            flexural_rigidity: self.rigidity.re(),
            axial_stiffness,
        }
    }
}

/// The constraint C with derivatives to H, s₁, s₂ (`N` = 3) or to all eight variables (`N` = 8).
fn constraint<const N: usize>(profile: &Profile, span: &Span) -> (Jet<N>, Excess) {
    let (mut c, excess) = profile.length_and_excess::<N>();
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
    let goal = product(&length, &stretch);
    c.value -= goal.value;
    for i in 0..N {
        c.gradient[i] -= goal.gradient[i];
        for j in 0..N {
            c.hessian[i][j] -= goal.hessian[i][j];
        }
    }
    (c, excess)
}

/// The force as a function of the other variables, from the constraint.
fn implicit<const N: usize, const M: usize>(c: &Jet<N>, force: f64) -> Jet<M> {
    let mut h = Jet {
        value: force,
        ..Jet::default()
    };
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
    let mut out = Jet {
        value: q.value,
        ..Jet::default()
    };
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

/// A jet in H and the rest, moved by a small step of H.
fn moved<const N: usize>(q: Jet<N>, step: f64) -> Jet<N> {
    let mut out = q;
    out.value += step * (q.gradient[0] + 0.5 * step * q.hessian[0][0]);
    for i in 0..N {
        out.gradient[i] += step * q.hessian[0][i];
    }
    out
}

/// Relative step of H below which the quadratic error of the next one is lost.
const SETTLED: f64 = 1e-6;

/// Newton steps on H with all derivatives, before the safeguarded search takes over.
const WARM_STEPS: usize = 2;

/// Finds the force of a span near `force` (N) (`None`: from scratch) with its derivatives.
pub fn settle<const N: usize, const M: usize>(
    span: &Span,
    force: Option<f64>,
    wanted: Wanted,
) -> Settled<M> {
    let pole = span.buckling_force();
    let goal = span.goal();
    let search = |guess| span.solve(guess).force.unwrap_or(0.0);
    let mut h = force
        .filter(|h| *h > pole && h.is_finite())
        .unwrap_or_else(|| search(None));
    let mut step = 0;
    loop {
        let profile = Profile::new(span, h);
        let (c, excess) = constraint::<N>(&profile, span);
        let next = span.advance(goal, h, excess);
        let error = (next - h).abs() / (h - pole).max(f64::MIN_POSITIVE);
        let good = error <= SETTLED && next > pole;
        if good || step > WARM_STEPS {
            let last = if good { next - h } else { 0.0 };
            let force = implicit::<N, M>(&moved(c, last), h + last);
            let mut out = Settled {
                force,
                ..Settled::default()
            };
            for end in 0..2 {
                if wanted.slope[end] {
                    out.slope[end] = follow(&moved(profile.end_slope_jet::<N>(end), last), &force);
                }
                if wanted.curvature[end] {
                    let curvature = moved(profile.end_curvature_jet::<N>(end), last);
                    out.curvature[end] = follow(&curvature, &force);
                }
            }
            return out;
        }
        step += 1;
        let trusted = step < WARM_STEPS && excess.to_force < 0.0 && next > pole && error < 0.1;
        if trusted {
            h = next;
        } else {
            h = search(Some(h));
            step = WARM_STEPS + 1;
        }
    }
}
