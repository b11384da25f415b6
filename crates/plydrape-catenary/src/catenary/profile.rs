//! The closed form of a span at a given H: amplitudes of the basis from the end conditions.
//!
//! Each end gives one row of a 2×2 system for (α, β), eq. (3) of `docs/theory/span.md`. Everything else is
//! linear in (θ, ρ, s₁, s₂), so all first and second derivatives follow from the same small matrix.

use super::basis::{Form, Values};
use super::quadrature::{Stretches, Sweep};
use super::{EndCondition, Span};

/// Inner parameters of a span, in this order: shape χ, load ρ, chord slope θ, end slopes s₁, s₂.
pub const INNER: usize = 5;

/// A span at a given horizontal force.
#[derive(Debug, Clone, Copy)]
pub struct Profile {
    /// The span.
    pub(super) span: Span,
    /// Horizontal force H (N).
    pub(super) force: f64,
    /// Basis functions.
    pub(super) form: Form,
    /// Load parameter ρ.
    pub(super) rho: f64,
    /// Chord slope θ = h/ℓ.
    pub(super) theta: f64,
    /// (α, β).
    pub(super) amplitude: [f64; 2],
    inverse: [[f64; 2]; 2],
    rows: [Values; 2],
}

/// Derivatives of (α, β) to the inner parameters.
#[derive(Debug, Clone, Copy)]
pub struct Response {
    /// To χ, ρ, θ, s₁, s₂.
    pub first: [[f64; 2]; INNER],
    /// To χ and each of χ, ρ, θ, s₁, s₂; all others vanish.
    pub second: [[f64; 2]; INNER],
}

/// A slope or a curvature with its first derivatives and its second ones to χ and each other.
#[derive(Debug, Clone, Copy, Default)]
pub struct Local {
    /// The value.
    pub value: f64,
    /// To χ, ρ, θ, s₁, s₂.
    pub first: [f64; INNER],
    /// To χ and each of χ, ρ, θ, s₁, s₂.
    pub second: [f64; INNER],
}

fn apply(m: &[[f64; 2]; 2], v: [f64; 2]) -> [f64; 2] {
    [m[0][0] * v[0] + m[0][1] * v[1], m[1][0] * v[0] + m[1][1] * v[1]]
}

impl Profile {
    /// The closed form of `span` at horizontal force `force` (N).
    ///
    /// The force must lie above [`Span::buckling_force`]; with EI = 0 it must be positive.
    #[must_use]
    pub fn new(span: &Span, force: f64) -> Profile {
        let form = Form::new(span, force);
        let (theta, load) = (span.rise / span.run, span.load());
        let rho = match form {
            Form::Stiff { .. } => load * span.run.powi(3) / span.flexural_rigidity,
            Form::Taut { .. } | Form::Limp => load * span.run / force,
        };
        if matches!(form, Form::Limp) {
            let rows = [Values::default(); 2];
            let (inverse, amplitude) = ([[0.0; 2]; 2], [0.0; 2]);
            return Profile { span: *span, force, form, rho, theta, amplitude, inverse, rows };
        }
        // a free end: z'' = 0; a held one: z' = s
        let mut rows = [Values::default(); 2];
        let mut right = [0.0; 2];
        for end in 0..2 {
            match span.ends[end] {
                EndCondition::Free => {
                    rows[end] = form.end_derivative(end);
                    right[end] = -rho * rows[end].value[2];
                }
                EndCondition::Slope(s) => {
                    rows[end] = form.slope(end as f64);
                    right[end] = s - theta - rho * rows[end].value[2];
                }
            }
        }
        let ([a, b], [c, d]) =
            ([rows[0].value[0], rows[0].value[1]], [rows[1].value[0], rows[1].value[1]]);
        let determinant = a * d - b * c;
        let inverse = [[d / determinant, -b / determinant], [-c / determinant, a / determinant]];
        let amplitude = apply(&inverse, right);
        Profile { span: *span, force, form, rho, theta, amplitude, inverse, rows }
    }

    fn is_held(&self, end: usize) -> bool {
        matches!(self.span.ends[end], EndCondition::Slope(_))
    }

    /// Derivatives of the amplitudes to χ and ρ alone, through which H acts.
    pub(super) fn response_to_force(&self) -> [[f64; 2]; 2] {
        if matches!(self.form, Form::Limp) {
            return [[0.0; 2]; 2];
        }
        let (rows, [a, b]) = (&self.rows, self.amplitude);
        let chi = [0, 1].map(|e| {
            let [u, v, g] = rows[e].first;
            -self.rho * g - u * a - v * b
        });
        let rho = [-rows[0].value[2], -rows[1].value[2]];
        [apply(&self.inverse, chi), apply(&self.inverse, rho)]
    }

    /// Derivatives of the amplitudes.
    pub(super) fn response(&self) -> Response {
        let (rows, x) = (&self.rows, self.amplitude);
        let mut first = [[0.0; 2]; INNER];
        let mut second = [[0.0; 2]; INNER];
        if matches!(self.form, Form::Limp) {
            return Response { first, second };
        }
        let solve = |v: [f64; 2]| apply(&self.inverse, v);
        // rows of the derivative of the matrix, times a vector
        let d1 = |v: [f64; 2]| [0, 1].map(|e| rows[e].first[0] * v[0] + rows[e].first[1] * v[1]);
        let d2 = |v: [f64; 2]| [0, 1].map(|e| rows[e].second[0] * v[0] + rows[e].second[1] * v[1]);
        let minus = |v: [f64; 2]| [-v[0], -v[1]];

        first[1] = solve([-rows[0].value[2], -rows[1].value[2]]);
        for end in 0..2 {
            if self.is_held(end) {
                let mut unit = [0.0; 2];
                unit[end] = 1.0;
                first[3 + end] = solve(unit);
            }
        }
        let m = d1(x);
        first[0] = solve([0, 1].map(|e| -self.rho * rows[e].first[2] - m[e]));
        first[2] = [0, 1].map(|n| -first[3][n] - first[4][n]);

        let (m, mx) = (d2(x), d1(first[0]));
        second[0] = solve([0, 1].map(|e| -self.rho * rows[e].second[2] - m[e] - 2.0 * mx[e]));
        let m = d1(first[1]);
        second[1] = solve([0, 1].map(|e| -rows[e].first[2] - m[e]));
        second[3] = solve(minus(d1(first[3])));
        second[4] = solve(minus(d1(first[4])));
        second[2] = [0, 1].map(|n| -second[3][n] - second[4][n]);
        Response { first, second }
    }

    /// A quantity `unit·θ + ρ G + α U + β V` of the span with its derivatives.
    pub(super) fn local(&self, r: &Response, basis: &Values, unit: f64) -> Local {
        let ([u, v, g], x) = (basis.value, self.amplitude);
        let combine = |f: &[f64; 3]| x[0] * f[0] + x[1] * f[1] + self.rho * f[2];
        let project = |y: [f64; 2]| y[0] * u + y[1] * v;
        let drift = |y: [f64; 2]| y[0] * basis.first[0] + y[1] * basis.first[1];
        let mut first = r.first.map(project);
        first[0] += combine(&basis.first);
        first[1] += g;
        first[2] += unit;
        let mut second = r.second.map(project);
        second[0] += combine(&basis.second) + 2.0 * drift(r.first[0]);
        second[1] += basis.first[2] + drift(r.first[1]);
        for n in 2..INNER {
            second[n] += drift(r.first[n]);
        }
        Local { value: unit * self.theta + combine(&basis.value), first, second }
    }

    /// Slope z' at an end, with derivatives.
    pub(super) fn end_slope_local(&self, r: &Response, end: usize) -> Local {
        self.local(r, &self.form.slope(end as f64), 1.0)
    }

    /// ℓ z'' at an end, with derivatives.
    pub(super) fn end_curvature_local(&self, r: &Response, end: usize) -> Local {
        self.local(r, &self.form.end_derivative(end), 0.0)
    }

    /// Slope z' at the first (0) or second (1) end.
    #[must_use]
    pub fn end_slope(&self, end: usize) -> f64 {
        let [u, v, g] = self.form.slope(end as f64).value;
        self.theta + self.rho * g + self.amplitude[0] * u + self.amplitude[1] * v
    }

    /// Where the arc length of the span is sampled.
    pub(super) fn stretches(&self) -> Stretches {
        let [alpha, beta] = self.amplitude;
        let load = self.rho.abs();
        Stretches::new(match self.form {
            Form::Taut { k, .. } => {
                Sweep::Layered { k, load, amplitude: alpha.abs().max(beta.abs()) }
            }
            Form::Limp => Sweep::Even(load),
            Form::Stiff { .. } => {
                // how far the slope would sweep at its fastest, from nine samples
                let t: [f64; 9] = std::array::from_fn(|n| n as f64 / 8.0);
                let slope = |[u, v, g]: [f64; 3]| self.rho * g + alpha * u + beta * v;
                let slopes = self.form.slopes(&t).map(slope);
                let fastest = (1..9).map(|n| (slopes[n] - slopes[n - 1]).abs()).fold(0.0, f64::max);
                Sweep::Even(8.0 * fastest)
            }
        })
    }

    /// Horizontal force H (N).
    #[must_use]
    pub fn force(&self) -> f64 {
        self.force
    }
}
