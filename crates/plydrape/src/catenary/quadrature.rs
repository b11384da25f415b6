//! Gauss–Legendre panels over a span, fine where its slope bends.
//!
//! The arc length integrand √(1+z'²) is analytic; what slows convergence is a boundary layer e^(−kt) and
//! a slope that sweeps past ±1 (the branch points are at z' = ±i). Panels are cut so that neither
//! happens within one.

use super::basis::Form;
use super::profile::Profile;

/// Points of a panel.
pub const POINTS: usize = 24;

/// Abscissas on [0, 1], ascending and symmetric: roots of P₂₄(2t−1).
pub const ABSCISSAS: [f64; POINTS] = [
    0.00240639000148932,
    0.012635722014345251,
    0.030862723998633622,
    0.056792236497799485,
    0.08999900701304854,
    0.12993790421072282,
    0.17595317403151223,
    0.22728926430558022,
    0.2831032461869774,
    0.3424786601519183,
    0.40444056626319186,
    0.4679715535686972,
    0.5320284464313028,
    0.5955594337368082,
    0.6575213398480817,
    0.7168967538130225,
    0.7727107356944197,
    0.8240468259684878,
    0.8700620957892772,
    0.9100009929869515,
    0.9432077635022005,
    0.9691372760013663,
    0.9873642779856547,
    0.9975936099985107,
];

/// Weights, adding up to 1.
pub const WEIGHTS: [f64; POINTS] = [
    0.0061706148999936,
    0.014265694314466832,
    0.022138719408709904,
    0.02964929245771839,
    0.03667324070554015,
    0.04309508076597664,
    0.04880932605205694,
    0.05372213505798282,
    0.0577528340268628,
    0.060835236463901696,
    0.06291872817341415,
    0.06396909767337608,
    0.06396909767337608,
    0.06291872817341415,
    0.060835236463901696,
    0.0577528340268628,
    0.05372213505798282,
    0.04880932605205694,
    0.04309508076597664,
    0.03667324070554015,
    0.02964929245771839,
    0.022138719408709904,
    0.014265694314466832,
    0.0061706148999936,
];

/// Slope range that one panel takes to the last digits.
const SWEEP: f64 = 2.5;

/// Width in units of 1/k beyond which a boundary layer no longer counts: e^(−24) = 4e-11.
const LAYER: f64 = 24.0;

/// Where the layer's panel is cut if its amplitude is large, in units of 1/k.
const GRADES: [f64; 3] = [3.0, 9.0, LAYER];

/// k(0.6 + amplitude) up to which 24 points take both layers of a span in one panel to about 1e-11.
const SINGLE_PANEL: f64 = 28.0;

/// Amplitude up to which one panel takes a whole layer to about 1e-11.
const WEAK_LAYER: f64 = 0.5;

/// Most stretches that a span is cut into.
const STRETCHES: usize = 2 * GRADES.len() + 1;

/// A stretch [start, end] of a span, cut into `panels` equal panels.
#[derive(Debug, Clone, Copy, Default)]
pub struct Stretch {
    /// First t.
    pub start: f64,
    /// Last t.
    pub end: f64,
    /// Equal panels.
    pub panels: usize,
}

/// The stretches of a span, few enough to live on the stack.
#[derive(Debug, Clone, Copy, Default)]
pub struct Stretches {
    list: [Stretch; STRETCHES],
    count: usize,
}

impl Stretches {
    fn push(&mut self, start: f64, end: f64, sweep: f64) {
        if end <= start {
            return;
        }
        // a slope of thousands is a fold that no quadrature needs to resolve
        let panels = (sweep / SWEEP).ceil().clamp(1.0, 256.0) as usize;
        self.list[self.count] = Stretch { start, end, panels };
        self.count += 1;
    }

    /// One panel is enough.
    pub fn is_single(&self) -> bool {
        self.count == 1 && self.list[0].panels == 1
    }

    /// The stretches, ascending.
    pub fn iter(&self) -> impl Iterator<Item = &Stretch> {
        self.list[..self.count].iter()
    }
}

/// Where the arc length of a span is sampled.
pub fn stretches(profile: &Profile) -> Stretches {
    let mut out = Stretches::default();
    let rho = profile.rho.abs();
    let [alpha, beta] = profile.amplitude.map(f64::abs);
    let Form::Taut { k, .. } = profile.form else {
        let sweep = match profile.form {
            Form::Limp => rho,
            _ => fastest_sweep(profile),
        };
        out.push(0.0, 1.0, sweep);
        return out;
    };
    let amplitude = alpha.max(beta);
    if k * (0.6 + amplitude) <= SINGLE_PANEL {
        out.push(0.0, 1.0, rho + amplitude);
        return out;
    }
    // a layer from each end, graded if it is strong, and what is between
    let mut cuts = [0.0; GRADES.len() + 1];
    for (cut, width) in cuts[1..].iter_mut().zip(GRADES) {
        *cut = (width / k).min(0.5);
    }
    let first = if amplitude <= WEAK_LAYER {
        GRADES.len() - 1
    } else {
        0
    };
    cuts[first] = 0.0;
    let layer = &cuts[first..];
    let sweep = |a: f64, b: f64| amplitude * (-k * a).exp() + rho * (b - a);
    for ab in layer.windows(2) {
        out.push(ab[0], ab[1], sweep(ab[0], ab[1]));
    }
    let inner = layer[layer.len() - 1];
    out.push(inner, 1.0 - inner, rho);
    for ab in layer.windows(2).rev() {
        out.push(1.0 - ab[1], 1.0 - ab[0], sweep(ab[0], ab[1]));
    }
    out
}

/// How far the slope would sweep over the whole span at its fastest, from nine samples.
fn fastest_sweep(profile: &Profile) -> f64 {
    let t = std::array::from_fn::<f64, 9, _>(|n| n as f64 / 8.0);
    let [u, v, g] = profile.form.at(&t, &[0.0; 9], &[0.0; 9]).value;
    let [alpha, beta] = profile.amplitude;
    let slope = |n: usize| profile.rho * g[n] + alpha * u[n] + beta * v[n];
    8.0 * (1..9)
        .map(|n| (slope(n) - slope(n - 1)).abs())
        .fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A Gauss rule of n points integrates tᵐ exactly up to m = 2n − 1.
    #[test]
    fn the_rule_is_exact_up_to_degree_47() {
        for m in 0..2 * POINTS as i32 {
            let sum: f64 = (0..POINTS).map(|n| WEIGHTS[n] * ABSCISSAS[n].powi(m)).sum();
            let exact = 1.0 / f64::from(m + 1);
            assert!((sum - exact).abs() < 4e-16, "degree {m}: {sum} for {exact}");
        }
    }
}
