//! Gauss–Legendre panels over a span, fine where its slope bends.
//!
//! The arc length integrand √(1+z'²) is analytic; what slows convergence is a boundary layer e^(−kt) and
//! a slope that sweeps past ±1 (the branch points are at z' = ±i). Panels are cut so that neither
//! happens within one. How the slope behaves is all that is known here of a span: see [`Sweep`].

use super::tuning::{GRADES, TUNING};

/// A Gauss–Legendre rule on [0, 1], its points ascending and symmetric.
pub struct Rule<const P: usize> {
    /// Abscissas.
    pub t: [f64; P],
    /// Weights, adding up to 1.
    pub weight: [f64; P],
}

/// The weights of a rule from those of its first half.
const fn mirrored<const H: usize, const P: usize>(half: [f64; H]) -> [f64; P] {
    let mut all = [0.0; P];
    let mut n = 0;
    while n < H {
        (all[n], all[P - 1 - n]) = (half[n], half[n]);
        n += 1;
    }
    all
}

/// The rule of most spans.
pub static SHORT: Rule<24> = Rule {
    t: [
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
    ],
    weight: mirrored([
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
    ]),
};

/// The rule of spans with thin boundary layers.
pub static LONG: Rule<32> = Rule {
    t: [
        0.0013680690752592183,
        0.007194244227365833,
        0.017618872206246784,
        0.03254696203113015,
        0.05183942211697394,
        0.07531619313371501,
        0.1027581020160288,
        0.13390894062985517,
        0.1684778665348924,
        0.20614212137961885,
        0.2465500455338853,
        0.2893243619346823,
        0.33406569885893617,
        0.38035631887393145,
        0.42776401920860174,
        0.4758461671561308,
        0.5241538328438692,
        0.5722359807913983,
        0.6196436811260685,
        0.6659343011410638,
        0.7106756380653176,
        0.7534499544661147,
        0.7938578786203812,
        0.8315221334651076,
        0.8660910593701449,
        0.8972418979839712,
        0.9246838068662849,
        0.9481605778830261,
        0.9674530379688698,
        0.9823811277937532,
        0.9928057557726342,
        0.9986319309247408,
    ],
    weight: mirrored([
        0.003509305004735048,
        0.008137197365452835,
        0.01269603265463103,
        0.017136931456510716,
        0.02141794901111334,
        0.025499029631188087,
        0.029342046739267772,
        0.032911111388180925,
        0.03617289705442425,
        0.039096947893535156,
        0.041655962113473374,
        0.043826046502201906,
        0.045586939347881945,
        0.04692219954040228,
        0.04781936003963743,
        0.0482700442573639,
    ]),
};

/// How the slope of a span behaves over its run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Sweep {
    /// It sweeps evenly: the range over which it would sweep if it did all along what it does at its fastest.
    Even(f64),
    /// A part that grows evenly by `load`, and boundary layers e^(−kt) and e^(−k(1−t)).
    Layered {
        /// k = ℓ√(H/EI).
        k: f64,
        /// Sweep of the even part.
        load: f64,
        /// Larger amplitude of the two layers.
        amplitude: f64,
    },
}

/// Most stretches that a span is cut into.
const STRETCHES: usize = 2 * GRADES + 1;

/// A stretch [start, end] of a span, cut into equal panels.
#[derive(Debug, Clone, Copy, Default)]
struct Stretch {
    start: f64,
    end: f64,
    panels: usize,
    short: bool,
}

/// A panel from t = `start` to `start + width`.
#[derive(Debug, Clone, Copy)]
pub struct Interval {
    /// First t.
    pub start: f64,
    /// Width in t.
    pub width: f64,
    /// Whether the short rule does.
    pub short: bool,
}

/// The stretches of a span, few enough to live on the stack.
#[derive(Debug, Clone, Copy, Default)]
pub struct Stretches {
    list: [Stretch; STRETCHES],
    count: usize,
}

impl Stretches {
    /// Where the arc length of a span is sampled whose slope behaves like this.
    pub fn new(slope: Sweep) -> Stretches {
        let mut out = Stretches::default();
        let (k, load, amplitude) = match slope {
            Sweep::Even(sweep) => {
                out.push(0.0, 1.0, sweep);
                return out;
            }
            Sweep::Layered { k, load, amplitude } => (k, load, amplitude),
        };
        let sharpness = k * (0.6 + amplitude);
        if sharpness <= TUNING.single_panel {
            out.push(0.0, 1.0, load + amplitude);
            let even = load + amplitude <= TUNING.short_sweep;
            out.list[0].short = sharpness <= TUNING.short_panel && even;
            return out;
        }
        // a layer from each end, graded if it is strong, and what is between
        let mut cuts = [0.0; GRADES + 1];
        for (cut, width) in cuts[1..].iter_mut().zip(TUNING.layer_grades) {
            *cut = (width / k).min(0.5);
        }
        let first = if amplitude <= TUNING.weak_layer { GRADES - 1 } else { 0 };
        cuts[first] = 0.0;
        let layer = &cuts[first..];
        let sweep = |a: f64, b: f64| amplitude * (-k * a).exp() + load * (b - a);
        for ab in layer.windows(2) {
            out.push(ab[0], ab[1], sweep(ab[0], ab[1]));
        }
        let inner = layer[layer.len() - 1];
        out.push(inner, 1.0 - inner, load);
        for ab in layer.windows(2).rev() {
            out.push(1.0 - ab[1], 1.0 - ab[0], sweep(ab[0], ab[1]));
        }
        out
    }

    fn push(&mut self, start: f64, end: f64, sweep: f64) {
        if end <= start {
            return;
        }
        let panels = (sweep / TUNING.sweep).ceil().clamp(1.0, TUNING.panels) as usize;
        self.list[self.count] = Stretch { start, end, panels, short: false };
        self.count += 1;
    }

    /// Hands over the panels up to t = `end`, ascending.
    #[inline(always)]
    pub fn for_each_panel(&self, end: f64, mut take: impl FnMut(Interval)) {
        for stretch in &self.list[..self.count] {
            let width = (stretch.end - stretch.start) / stretch.panels as f64;
            for panel in 0..stretch.panels {
                let start = stretch.start + panel as f64 * width;
                let width = width.min(end - start);
                if width <= 0.0 {
                    return;
                }
                take(Interval { start, width, short: stretch.short });
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check<const P: usize>(rule: &Rule<P>) {
        for m in 0..2 * P as i32 {
            let sum: f64 = (0..P).map(|n| rule.weight[n] * rule.t[n].powi(m)).sum();
            let exact = 1.0 / f64::from(m + 1);
            assert!((sum - exact).abs() < 4e-16, "degree {m}: {sum} for {exact}");
        }
    }

    /// A Gauss rule of n points integrates tᵐ exactly up to m = 2n − 1.
    #[test]
    fn the_rules_are_exact_up_to_degree_47_and_63() {
        check(&SHORT);
        check(&LONG);
    }
}
