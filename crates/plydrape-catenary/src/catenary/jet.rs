//! Values with exact first and second derivatives to the physical variables of a span.

use super::basis::Form;
use super::profile::{INNER, Local, Profile};

/// What a span's length, slopes and moments depend on. The first three are the solver's unknowns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(usize)]
pub enum Variable {
    /// Horizontal force H (N).
    Force = 0,
    /// Prescribed slope at the first end.
    FirstSlope = 1,
    /// Prescribed slope at the second end.
    SecondSlope = 2,
    /// Run ℓ (m).
    Run = 3,
    /// Rise h (m).
    Rise = 4,
    /// Weight per length w (N/m).
    Weight = 5,
    /// Flexural rigidity EI (N·m²).
    Rigidity = 6,
    /// Fabric length to reach L_set (m), on which the shape at a given H does not depend.
    Length = 7,
}

/// A value with its gradient and Hessian to the first `N` [`Variable`]s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jet<const N: usize> {
    /// The value.
    pub value: f64,
    /// First derivatives.
    pub gradient: [f64; N],
    /// Second derivatives, symmetric.
    pub hessian: [[f64; N]; N],
}

impl<const N: usize> Default for Jet<N> {
    fn default() -> Self {
        Jet { value: 0.0, gradient: [0.0; N], hessian: [[0.0; N]; N] }
    }
}

impl<const N: usize> Jet<N> {
    /// This value as a function of the first `M` ≤ `N` variables.
    pub(crate) fn first<const M: usize>(&self) -> Jet<M> {
        let mut out = Jet { value: self.value, ..Jet::default() };
        for i in 0..M.min(N) {
            out.gradient[i] = self.gradient[i];
            for j in 0..M.min(N) {
                out.hessian[i][j] = self.hessian[i][j];
            }
        }
        out
    }
}

/// How the inner parameters χ, ρ, θ depend on the physical variables: first and second derivatives.
///
/// The slopes s₁, s₂ are the same inside and outside.
pub struct Chain<const N: usize> {
    first: [[f64; N]; INNER],
    second: [[[f64; N]; N]; 3],
}

/// f·g.
pub(crate) fn product<const N: usize>(f: &Jet<N>, g: &Jet<N>) -> Jet<N> {
    let mut out = Jet { value: f.value * g.value, ..Jet::default() };
    for i in 0..N {
        out.gradient[i] = f.gradient[i] * g.value + f.value * g.gradient[i];
        for j in 0..N {
            out.hessian[i][j] = f.hessian[i][j] * g.value
                + f.gradient[i] * g.gradient[j]
                + f.gradient[j] * g.gradient[i]
                + f.value * g.hessian[i][j];
        }
    }
    out
}

/// f(x) of one variable, from f and its first two derivatives there.
pub(crate) fn compose<const N: usize>(x: &Jet<N>, f: f64, d1: f64, d2: f64) -> Jet<N> {
    let mut out = Jet { value: f, ..Jet::default() };
    for i in 0..N {
        out.gradient[i] = d1 * x.gradient[i];
        for j in 0..N {
            out.hessian[i][j] = d1 * x.hessian[i][j] + d2 * x.gradient[i] * x.gradient[j];
        }
    }
    out
}

/// xᵖ.
pub(crate) fn power<const N: usize>(x: &Jet<N>, p: f64) -> Jet<N> {
    let v = x.value;
    compose(x, v.powf(p), p * v.powf(p - 1.0), p * (p - 1.0) * v.powf(p - 2.0))
}

/// A variable itself; one beyond the first N is a constant.
pub(crate) fn variable<const N: usize>(value: f64, which: Variable) -> Jet<N> {
    let mut out = Jet { value, ..Jet::default() };
    if let Some(slot) = out.gradient.get_mut(which as usize) {
        *slot = 1.0;
    }
    out
}

impl<const N: usize> Chain<N> {
    /// The chain rule at a profile.
    pub fn new(profile: &Profile) -> Chain<N> {
        let (chi, rho, theta) = if N <= 3 { Self::force_only(profile) } else { Self::all(profile) };
        let mut first = [[0.0; N]; INNER];
        first[0] = chi.gradient;
        first[1] = rho.gradient;
        first[2] = theta.gradient;
        for (row, which) in [(3, Variable::FirstSlope), (4, Variable::SecondSlope)] {
            first[row][which as usize] = 1.0;
        }
        Chain { first, second: [chi.hessian, rho.hessian, theta.hessian] }
    }

    /// Derivative of an inner parameter to H.
    pub fn to_force(&self, parameter: usize) -> f64 {
        self.first[parameter][Variable::Force as usize]
    }

    /// Second derivative of an inner parameter to H.
    pub fn second_to_force(&self, parameter: usize) -> f64 {
        self.second[parameter][Variable::Force as usize][Variable::Force as usize]
    }

    /// χ and ρ to H alone, which is all that the solver's iteration needs.
    fn force_only(profile: &Profile) -> (Jet<N>, Jet<N>, Jet<N>) {
        let (span, h) = (&profile.span, profile.force);
        let (mut chi, mut rho) = (Jet::default(), Jet::default());
        match profile.form {
            Form::Stiff { .. } => chi.gradient[0] = span.run * span.run / span.flexural_rigidity,
            Form::Taut { k, .. } => {
                chi.gradient[0] = 0.5 * k / h;
                chi.hessian[0][0] = -0.25 * k / (h * h);
                rho.gradient[0] = -profile.rho / h;
                rho.hessian[0][0] = 2.0 * profile.rho / (h * h);
            }
            Form::Limp => {
                rho.gradient[0] = -profile.rho / h;
                rho.hessian[0][0] = 2.0 * profile.rho / (h * h);
            }
        }
        (chi, rho, Jet::default())
    }

    fn all(profile: &Profile) -> (Jet<N>, Jet<N>, Jet<N>) {
        let span = &profile.span;
        let force: Jet<N> = variable(profile.force, Variable::Force);
        let run = variable(span.run, Variable::Run);
        let rise = variable(span.rise, Variable::Rise);
        let weight = variable(span.weight, Variable::Weight);
        let rigidity = variable(span.flexural_rigidity, Variable::Rigidity);
        let theta = product(&rise, &power(&run, -1.0));
        // q = w √(1+θ²)
        let (t, secant) = (theta.value, theta.value.hypot(1.0));
        let load = product(&weight, &compose(&theta, secant, t / secant, secant.powi(-3)));
        match profile.form {
            Form::Stiff { .. } => {
                let compliance = power(&rigidity, -1.0);
                let chi = product(&product(&force, &power(&run, 2.0)), &compliance);
                let rho = product(&product(&load, &power(&run, 3.0)), &compliance);
                (chi, rho, theta)
            }
            Form::Taut { .. } => {
                let chi = product(&run, &power(&product(&force, &power(&rigidity, -1.0)), 0.5));
                (chi, product(&product(&load, &run), &power(&force, -1.0)), theta)
            }
            Form::Limp => {
                (Jet::default(), product(&product(&load, &run), &power(&force, -1.0)), theta)
            }
        }
    }

    /// Gradient of a function of the inner parameters to the physical variables.
    pub fn gradient(&self, first: &[f64; INNER]) -> [f64; N] {
        let mut out = [0.0; N];
        for (inner, row) in first.iter().zip(&self.first) {
            for i in 0..N {
                out[i] += inner * row[i];
            }
        }
        out
    }

    /// A function of the inner parameters, as one of the physical variables.
    pub fn outer(
        &self,
        value: f64,
        first: &[f64; INNER],
        second: &[[f64; INNER]; INNER],
    ) -> Jet<N> {
        let mut out = Jet { value, ..Jet::default() };
        // columns of the inner Hessian times the chain, then the chain from the other side
        let mut half = [[0.0; N]; INNER];
        for a in 0..INNER {
            for b in 0..INNER {
                for j in 0..N {
                    half[a][j] += second[a][b] * self.first[b][j];
                }
            }
        }
        for i in 0..N {
            for a in 0..INNER {
                out.gradient[i] += first[a] * self.first[a][i];
            }
            for j in 0..N {
                let mut sum = 0.0;
                for a in 0..INNER {
                    sum += self.first[a][i] * half[a][j];
                }
                for a in 0..3 {
                    sum += first[a] * self.second[a][i][j];
                }
                out.hessian[i][j] = sum;
            }
        }
        out
    }

    /// A [`Local`] quantity as one of the physical variables.
    pub fn local(&self, local: &Local) -> Jet<N> {
        let mut second = [[0.0; INNER]; INNER];
        for n in 0..INNER {
            second[0][n] = local.second[n];
            second[n][0] = local.second[n];
        }
        self.outer(local.value, &local.first, &second)
    }
}

impl Profile {
    /// Slope z' at an end, with derivatives.
    #[must_use]
    pub fn end_slope_jet<const N: usize>(&self, end: usize) -> Jet<N> {
        Chain::new(self).local(&self.end_slope_local(&self.response(), end))
    }

    /// Curvature z'' (1/m) at an end, with derivatives.
    #[must_use]
    pub fn end_curvature_jet<const N: usize>(&self, end: usize) -> Jet<N> {
        let scaled = Chain::new(self).local(&self.end_curvature_local(&self.response(), end));
        product(&scaled, &power(&variable(self.span.run, Variable::Run), -1.0))
    }
}
