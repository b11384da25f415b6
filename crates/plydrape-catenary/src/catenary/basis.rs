//! Slope functions U, V, G of zero mean that span the solutions of eq. (1), at a given H.
//!
//! With t = x/ℓ every solution has the slope `z' = θ + ρ G(t) + α U(t) + β V(t)`, θ = h/ℓ. Three forms
//! of the same thing, each accurate where it is used; χ is the shape parameter, ρ the load:
//!
//! | form | where | χ | ρ | U, V, G |
//! |---|---|---|---|---|
//! | stiff | κ < 25 | κ = Hℓ²/EI | qℓ³/EI | t c₁, t² c₂, −t³ c₃ of κt², less their means |
//! | taut | κ ≥ 25 | k = ℓ√(H/EI) | qℓ/H | e^(−kt), e^(−k(1−t)), t, less their means |
//! | limp | EI = 0 | – | qℓ/H | 0, 0, t − ½ |

use super::Span;
use super::decay::decay;
use super::entire::{curvature, entire, entire_at, slope, terms};
use super::quadrature::Rule;
use super::tuning::TUNING;

/// The functions of one span at one H.
#[derive(Debug, Clone, Copy)]
pub enum Form {
    /// Small or negative κ.
    Stiff {
        /// κ = Hℓ²/EI.
        kappa: f64,
        /// Terms of the series.
        terms: usize,
        /// c₀ … c₈ at κ: the means, and the values at t = 1.
        c: [f64; 9],
    },
    /// Large κ: boundary layers of width 1/k at the ends.
    Taut {
        /// k = ℓ√(H/EI).
        k: f64,
        /// e^(−k).
        far: f64,
        /// Mean of U and of V with its first and second derivative to k.
        mean: [f64; 3],
    },
    /// No bending stiffness.
    Limp,
}

/// Values of U, V, G (or of their t-derivatives) at one t, with first and second χ-derivatives.
#[derive(Debug, Clone, Copy, Default)]
pub struct Values {
    /// U, V, G.
    pub value: [f64; 3],
    /// ∂/∂χ of U, V, G.
    pub first: [f64; 3],
    /// ∂²/∂χ² of U, V, G.
    pub second: [f64; 3],
}

/// U, V, G at the points of a panel, as one of the forms gives them.
pub trait Panel {
    /// Values at a point of the panel.
    fn values(&self, point: usize) -> Values;
}

/// Points of the taut form: t, e^(−kt) and e^(−k(1−t)).
pub struct TautPanel<const P: usize> {
    t: [f64; P],
    layers: [[f64; P]; 2],
    mean: [f64; 3],
}

/// Points of the stiff form: t and c₀ … c₈ at κt².
pub struct StiffPanel<const P: usize> {
    t: [f64; P],
    c: [[f64; P]; 9],
    mean: [f64; 9],
}

/// Points of the limp form: t.
pub struct LimpPanel<const P: usize> {
    t: [f64; P],
}

impl<const P: usize> Panel for TautPanel<P> {
    #[inline(always)]
    fn values(&self, p: usize) -> Values {
        let (t, s, m) = (self.t[p], 1.0 - self.t[p], self.mean);
        let (near, far) = (self.layers[0][p], self.layers[1][p]);
        Values {
            value: [near - m[0], far - m[0], t - 0.5],
            first: [-t * near - m[1], -s * far - m[1], 0.0],
            second: [t * t * near - m[2], s * s * far - m[2], 0.0],
        }
    }
}

impl<const P: usize> Panel for StiffPanel<P> {
    #[inline(always)]
    fn values(&self, p: usize) -> Values {
        // tⁿ c_n(κt²) − c_{n+1}(κ); each κ-derivative brings t²
        let c: [f64; 9] = std::array::from_fn(|n| self.c[n][p]);
        let (mean, t) = (&self.mean, self.t[p]);
        let (t2, t3) = (t * t, t * t * t);
        let (t4, t5) = (t2 * t2, t2 * t3);
        Values {
            value: [t * c[1] - mean[2], t2 * c[2] - mean[3], mean[4] - t3 * c[3]],
            first: [
                t3 * slope(&c, 1) - slope(mean, 2),
                t4 * slope(&c, 2) - slope(mean, 3),
                slope(mean, 4) - t5 * slope(&c, 3),
            ],
            second: [
                t5 * curvature(&c, 1) - curvature(mean, 2),
                t3 * t3 * curvature(&c, 2) - curvature(mean, 3),
                curvature(mean, 4) - t4 * t3 * curvature(&c, 3),
            ],
        }
    }
}

impl<const P: usize> Panel for LimpPanel<P> {
    #[inline(always)]
    fn values(&self, p: usize) -> Values {
        Values { value: [0.0, 0.0, self.t[p] - 0.5], ..Values::default() }
    }
}

/// What is summed over the panels of a span.
pub trait Sum {
    /// Adds a panel; the weights of its points are `scale` times `weights`.
    fn add<const P: usize>(&mut self, scale: f64, weights: &[f64; P], panel: &impl Panel);
}

impl Form {
    /// The form that fits the span at horizontal force `force` (N).
    pub fn new(span: &Span, force: f64) -> Form {
        if span.flexural_rigidity == 0.0 {
            return Form::Limp;
        }
        let kappa = force * span.run * span.run / span.flexural_rigidity;
        if kappa < TUNING.taut_kappa {
            let terms = terms(kappa.abs());
            return Form::Stiff { kappa, terms, c: entire(kappa, terms) };
        }
        let k = kappa.sqrt();
        let far = (-k).exp();
        let mean = (1.0 - far) / k;
        let first = (far - mean) / k;
        let second = (-far - 2.0 * first) / k;
        Form::Taut { k, far, mean: [mean, first, second] }
    }

    /// e^(−kt) and e^(−k(1−t)) of the taut form; 0 where they no longer count.
    #[inline]
    pub fn layers(&self, t: f64) -> [f64; 2] {
        match *self {
            Form::Taut { k, .. } => [layer(k * t), layer(k * (1.0 - t))],
            _ => [0.0; 2],
        }
    }

    /// Adds the panel from `start` to `start + width` to a sum.
    #[inline(always)]
    pub fn add_panel<const P: usize>(
        &self,
        rule: &Rule<P>,
        start: f64,
        width: f64,
        sum: &mut impl Sum,
    ) {
        let t = rule.t.map(|s| start + width * s);
        match *self {
            Form::Taut { mean, .. } => {
                let layers = self.panel_layers(&rule.t, start, width);
                sum.add(width, &rule.weight, &TautPanel { t, layers, mean });
            }
            Form::Stiff { kappa, terms, c: mean } => {
                let c = entire_at(&t.map(|t| kappa * t * t), terms);
                sum.add(width, &rule.weight, &StiffPanel { t, c, mean });
            }
            Form::Limp => sum.add(width, &rule.weight, &LimpPanel { t }),
        }
    }

    /// e^(−kt) and e^(−k(1−t)) at the points `start + width·s` of a panel.
    #[inline(always)]
    fn panel_layers<const P: usize>(&self, s: &[f64; P], start: f64, width: f64) -> [[f64; P]; 2] {
        let Form::Taut { k, .. } = *self else {
            return [[0.0; P]; 2];
        };
        let exponents = |from: f64| s.map(|s| k * from + k * width * s);
        // the abscissas are symmetric: the second layer is the mirror image of the first
        let near = decay(&exponents(start));
        let whole = start == 0.0 && width == 1.0;
        let mut far = if whole { near } else { decay(&exponents(1.0 - start - width)) };
        far.reverse();
        [near, far]
    }

    /// U, V, G at t.
    pub fn slope(&self, t: f64) -> Values {
        match *self {
            Form::Taut { mean, .. } => {
                let layers = self.layers(t).map(|layer| [layer]);
                TautPanel { t: [t], layers, mean }.values(0)
            }
            Form::Stiff { kappa, terms, c: mean } => {
                StiffPanel { t: [t], c: entire_at(&[kappa * t * t], terms), mean }.values(0)
            }
            Form::Limp => LimpPanel { t: [t] }.values(0),
        }
    }

    /// U, V, G at several t at once.
    #[inline]
    pub fn slopes<const N: usize>(&self, t: &[f64; N]) -> [[f64; 3]; N] {
        match *self {
            Form::Stiff { kappa, terms, c: mean } => {
                let c = entire_at(&t.map(|t| kappa * t * t), terms);
                let panel = StiffPanel { t: *t, c, mean };
                std::array::from_fn(|n| panel.values(n).value)
            }
            _ => t.map(|t| self.slope(t).value),
        }
    }

    /// ∫₀ᵗ of U, V, G, with first χ-derivatives alone.
    pub fn integral(&self, t: f64) -> Values {
        let value = self.station(t)[0];
        let first = match *self {
            Form::Stiff { kappa, terms, c: mean } => {
                let (t2, c) = (t * t, entire(kappa * t * t, terms));
                [
                    t2 * t2 * slope(&c, 2) - t * slope(&mean, 2),
                    t2 * t2 * t * slope(&c, 3) - t * slope(&mean, 3),
                    t * slope(&mean, 4) - t2 * t2 * t2 * slope(&c, 4),
                ]
            }
            Form::Taut { k, far: e, mean } => {
                let [near, far] = self.layers(t);
                [
                    (t * near - (1.0 - near) / k) / k - mean[1] * t,
                    (e - (1.0 - t) * far - (far - e) / k) / k - mean[1] * t,
                    0.0,
                ]
            }
            Form::Limp => [0.0; 3],
        };
        Values { value, first, ..Values::default() }
    }

    /// ∫₀ᵗ of U, V, G at `N` equally spaced t from 0 to 1.
    pub fn integrals<const N: usize>(&self) -> [[f64; 3]; N] {
        let last = (N - 1) as f64;
        let t: [f64; N] = std::array::from_fn(|n| n as f64 / last);
        match *self {
            Form::Stiff { kappa, terms, c: mean } => {
                let c = entire_at(&t.map(|t| kappa * t * t), terms);
                std::array::from_fn(|n| {
                    let (t, t2) = (t[n], t[n] * t[n]);
                    let [u, v, g] = [t2 * c[2][n], t2 * t * c[3][n], -t2 * t2 * c[4][n]];
                    [u - t * mean[2], v - t * mean[3], t * mean[4] + g]
                })
            }
            Form::Taut { k, far: e, mean: [m, ..] } => {
                // a geometric series; the other layer is its mirror image
                let (step, mut near) = ((-k / last).exp(), [0.0; N]);
                near[0] = 1.0;
                for n in 1..N {
                    let next = step * near[n - 1];
                    if next < TUNING.vanishing_layer {
                        break;
                    }
                    near[n] = next;
                }
                std::array::from_fn(|n| {
                    let t = t[n];
                    let [u, v] = [(1.0 - near[n]) / k, (near[N - 1 - n] - e) / k];
                    [u - m * t, v - m * t, 0.5 * (t * t - t)]
                })
            }
            Form::Limp => t.map(|t| [0.0, 0.0, 0.5 * (t * t - t)]),
        }
    }

    /// ∂/∂t of U, V, G at t = 0 or t = 1.
    pub fn end_derivative(&self, end: usize) -> Values {
        match *self {
            Form::Stiff { c, .. } => {
                if end == 0 {
                    return Values { value: [1.0, 0.0, 0.0], ..Values::default() };
                }
                Values {
                    value: [c[0], c[1], -c[2]],
                    first: [slope(&c, 0), slope(&c, 1), -slope(&c, 2)],
                    second: [curvature(&c, 0), curvature(&c, 1), -curvature(&c, 2)],
                }
            }
            Form::Taut { k, far, .. } => {
                // −k e^(−kt) and k e^(−k(1−t)): `near` belongs to the layer of this end
                let (near, away) = ([k, 1.0, 0.0], [k * far, (1.0 - k) * far, (k - 2.0) * far]);
                let pick = |d: usize| {
                    if end == 0 { [-near[d], away[d]] } else { [-away[d], near[d]] }
                };
                Values {
                    value: [pick(0)[0], pick(0)[1], 1.0],
                    first: [pick(1)[0], pick(1)[1], 0.0],
                    second: [pick(2)[0], pick(2)[1], 0.0],
                }
            }
            Form::Limp => Values { value: [0.0, 0.0, 1.0], ..Values::default() },
        }
    }

    /// ∫₀ᵗ, value, ∂/∂t and ∂²/∂t² of U, V, G at t.
    pub fn station(&self, t: f64) -> [[f64; 3]; 4] {
        match *self {
            Form::Stiff { kappa, terms, c: mean } => {
                let (t2, c) = (t * t, entire(kappa * t * t, terms));
                let (t3, t4) = (t2 * t, t2 * t2);
                [
                    [t2 * c[2] - t * mean[2], t3 * c[3] - t * mean[3], t * mean[4] - t4 * c[4]],
                    [t * c[1] - mean[2], t2 * c[2] - mean[3], mean[4] - t3 * c[3]],
                    [c[0], t * c[1], -t2 * c[2]],
                    [kappa * t * c[1], c[0], -t * c[1]],
                ]
            }
            Form::Taut { k, far: e, mean } => {
                let [near, far] = self.layers(t);
                let m = mean[0];
                [
                    [(1.0 - near) / k - m * t, (far - e) / k - m * t, 0.5 * (t * t - t)],
                    [near - m, far - m, t - 0.5],
                    [-k * near, k * far, 1.0],
                    [k * k * near, k * k * far, 0.0],
                ]
            }
            Form::Limp => {
                [[0.0, 0.0, 0.5 * (t * t - t)], [0.0, 0.0, t - 0.5], [0.0, 0.0, 1.0], [0.0; 3]]
            }
        }
    }
}

/// e^(−x), 0 where it no longer counts.
#[inline]
fn layer(x: f64) -> f64 {
    if x > TUNING.vanishing_exponent { 0.0 } else { (-x).exp() }
}
