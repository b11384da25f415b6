//! What the ply is made of: mass, flexural rigidity, shear curve and locking angle.

mod moment;
mod rate;
mod scatter;

pub use moment::MomentCurve;
pub use rate::{Relaxation, ShearRate};
pub use scatter::{Scatter, Spread};

/// A woven ply: what the sheet and the catenaries need to know of it.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Material {
    /// Name for reports.
    pub name: String,
    /// Where the numbers come from.
    pub source: String,
    /// Mass and bending, per line or per area.
    pub section: Section,
    /// Bending moment over curvature along warp and weft where it is no straight line; the rigidity of `section`, per area
    /// then, is its first slope, which is all that catenaries use.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "are_none"))]
    pub moment: [Option<MomentCurve>; 2],
    /// Picture-frame shear force per length τ(γ); `None` leaves shear forces unknown.
    pub shear_curve: Option<ShearCurve>,
    /// What resin adds to that force while the ply is sheared; `None` where nothing is known of it. Only a sheet that is draped in the
    /// time of its motion knows it.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub shear_rate: Option<ShearRate>,
    /// Tension over strain of the yarns; the sheet needs it, the catenaries do not.
    pub tension: Option<TensionLaw>,
    /// Shear angle at which the weave locks (rad), with the test that found it.
    pub locking_angle: Option<f64>,
    /// How much its properties scatter between specimens.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Scatter::is_unknown"))]
    pub scatter: Scatter,
}

impl Material {
    /// A woven ply by four numbers, warp and weft alike: mass per area (kg/m²), flexural rigidity per width D′ (N·m), tensile stiffness
    /// per width EA′ (N/m) and the slope of its shear force per length (N/m per rad). Nothing is known of its locking and its scatter.
    #[must_use]
    pub fn woven(name: &str, mass: f64, rigidity: f64, tension: f64, shear: f64) -> Self {
        Material {
            name: name.into(),
            source: String::new(),
            section: Section::Areal { mass, warp_rigidity: rigidity, weft_rigidity: rigidity },
            moment: [None, None],
            shear_curve: Some(ShearCurve::Polynomial { coefficients: vec![shear] }),
            shear_rate: None,
            tension: Some(TensionLaw::Linear { stiffness: tension }),
            locking_angle: None,
            scatter: Scatter::default(),
        }
    }

    /// The material with its shear force, and that of its resin, times a factor.
    #[must_use]
    pub fn with_shear(&self, factor: f64) -> Self {
        let times = |values: &[f64]| values.iter().map(|x| factor * x).collect();
        let curve = |curve: &ShearCurve| match curve {
            ShearCurve::Table { angle, force } => {
                ShearCurve::Table { angle: angle.clone(), force: times(force) }
            }
            ShearCurve::Polynomial { coefficients } => {
                ShearCurve::Polynomial { coefficients: times(coefficients) }
            }
        };
        let shear_curve = self.shear_curve.as_ref().map(curve);
        let stiffer = |rate: ShearRate| ShearRate { stiffness: factor * rate.stiffness, ..rate };
        let shear_rate = self.shear_rate.clone().map(stiffer);
        Material { shear_curve, shear_rate, ..self.clone() }
    }
}

#[cfg(feature = "serde")]
fn are_none(curves: &[Option<MomentCurve>; 2]) -> bool {
    curves.iter().all(Option::is_none)
}

/// Mass and flexural rigidity of the ply.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(tag = "kind", rename_all = "kebab-case"))]
pub enum Section {
    /// Mass and rigidity per length, equal for every catenary, as in the paper.
    Line {
        /// Mass per length m (kg/m).
        mass: f64,
        /// Flexural rigidity EI (N·m²).
        flexural_rigidity: f64,
    },
    /// Per area; each catenary stands for a strip of the ply one cell wide.
    Areal {
        /// Areal mass (kg/m²).
        mass: f64,
        /// Bending rigidity per width along the warp (N·m).
        warp_rigidity: f64,
        /// Bending rigidity per width along the weft (N·m).
        weft_rigidity: f64,
    },
}

/// Tension per width of the fabric T(ε), along warp and weft alike (N/m).
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(tag = "kind", rename_all = "kebab-case"))]
pub enum TensionLaw {
    /// T = EA′ ε, in compression too.
    Linear {
        /// Stiffness per width EA′ (N/m).
        stiffness: f64,
    },
    /// Measured points (ε ascending from 0, T in N/m from 0), joined by straight lines; the first slope holds in
    /// compression and the last one beyond the last point.
    Table {
        /// Strains ε.
        strain: Vec<f64>,
        /// Tensions per width (N/m).
        force: Vec<f64>,
    },
}

impl TensionLaw {
    /// Energy per area (J/m²), tension per width T (N/m) and its slope dT/dε (N/m) at a strain ε.
    #[must_use]
    pub fn tension(&self, strain: f64) -> [f64; 3] {
        match self {
            TensionLaw::Linear { stiffness } => {
                [0.5 * stiffness * strain * strain, stiffness * strain, *stiffness]
            }
            TensionLaw::Table { strain: strains, force } => straight_lines(strains, force, strain),
        }
    }
}

/// Integral, value and slope at a place of the straight lines through the points `(x, y)`, x ascending from 0; the first
/// and the last line go on beyond their points. Without a line all are 0.
fn straight_lines(x: &[f64], y: &[f64], place: f64) -> [f64; 3] {
    let mut integral = 0.0;
    for n in 1..x.len() {
        let slope = (y[n] - y[n - 1]) / (x[n] - x[n - 1]);
        if place <= x[n] || n + 1 == x.len() {
            let beyond = place - x[n - 1];
            integral += beyond * (y[n - 1] + 0.5 * slope * beyond);
            return [integral, y[n - 1] + slope * beyond, slope];
        }
        integral += 0.5 * (x[n] - x[n - 1]) * (y[n] + y[n - 1]);
    }
    [0.0; 3]
}

/// Mass per length and flexural rigidity of one catenary.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineSection {
    /// Mass per length m (kg/m).
    pub mass: f64,
    /// Flexural rigidity EI (N·m²).
    pub flexural_rigidity: f64,
}

/// Picture-frame shear force per length over the shear angle.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(tag = "kind", rename_all = "kebab-case"))]
pub enum ShearCurve {
    /// Measured points (γ in rad ascending from 0, τ in N/m), joined by a monotone cubic.
    Table {
        /// Shear angles γ (rad).
        angle: Vec<f64>,
        /// Shear force per length τ (N/m).
        force: Vec<f64>,
    },
    /// τ = Σ cᵢ γⁱ⁺¹ (N/m, γ in rad): no constant term, so that τ(0) = 0.
    Polynomial {
        /// Coefficients c₀, c₁, … of γ, γ², …
        coefficients: Vec<f64>,
    },
}

impl ShearCurve {
    /// Shear force per length τ (N/m) and its slope dτ/dγ (N/m per rad) at a shear angle γ (rad).
    ///
    /// A weave resists shear to either side alike, so both are taken at |γ|. A table is joined by
    /// the monotone cubic of Fritsch and Butland 1984, which never overshoots, and goes on straight
    /// with its last slope beyond its last point. A table without points has no force.
    #[must_use]
    pub fn force(&self, angle: f64) -> (f64, f64) {
        let gamma = angle.abs();
        match self {
            ShearCurve::Table { angle, force } => monotone_cubic(angle, force, gamma),
            ShearCurve::Polynomial { coefficients } => {
                // Horner's rule for Σ cᵢ γⁱ and its derivative, then times γ.
                let (sum, slope) = coefficients
                    .iter()
                    .rev()
                    .fold((0.0, 0.0), |(p, dp), c| (p * gamma + c, dp * gamma + p));
                (sum * gamma, slope * gamma + sum)
            }
        }
    }

    /// Energy per area ∫ τ dγ (J/m²) from no shear to a shear angle γ (rad) of either sign.
    #[must_use]
    pub fn energy(&self, angle: f64) -> f64 {
        let gamma = angle.abs();
        match self {
            ShearCurve::Polynomial { coefficients } => {
                let powers = coefficients.iter().enumerate().rev();
                gamma * gamma * powers.fold(0.0, |sum, (n, c)| sum * gamma + c / (n as f64 + 2.0))
            }
            ShearCurve::Table { angle, force } => {
                let points = angle.len().min(force.len());
                let (x, y) = (&angle[..points], &force[..points]);
                let mut energy = 0.0;
                for n in 1..points {
                    let (from, to) = (x[n - 1], x[n].min(gamma));
                    if to > from {
                        energy += (to - from) * simpson(x, y, from, to);
                    }
                }
                match x.last() {
                    Some(last) if gamma > *last && points > 1 => {
                        energy + (gamma - last) * simpson(x, y, *last, gamma)
                    }
                    _ => energy,
                }
            }
        }
    }
}

/// Mean of the monotone cubic through the points `(x, y)` between two places without a knot in between: Simpson's rule,
/// which is exact for a cubic.
fn simpson(x: &[f64], y: &[f64], from: f64, to: f64) -> f64 {
    let value = |place: f64| monotone_cubic(x, y, place).0;
    (value(from) + 4.0 * value(0.5 * (from + to)) + value(to)) / 6.0
}

/// Value and slope at a place of the monotone cubic through the points `(x, y)`, x ascending.
fn monotone_cubic(x: &[f64], y: &[f64], place: f64) -> (f64, f64) {
    let points = x.len().min(y.len());
    if points < 2 {
        return (y.first().copied().unwrap_or(0.0), 0.0);
    }
    let (x, y, last) = (&x[..points], &y[..points], points - 1);
    if place >= x[last] {
        let slope = knot_slope(x, y, last);
        return (y[last] + slope * (place - x[last]), slope);
    }

    // The interval that holds the place, and the cubic of Hermite there.
    let k = x.partition_point(|knot| *knot <= place).clamp(1, last) - 1;
    let (s0, s1) = (knot_slope(x, y, k), knot_slope(x, y, k + 1));
    let h = x[k + 1] - x[k];
    let secant = (y[k + 1] - y[k]) / h;
    let t = (place - x[k]) / h;
    let c = 3.0 * secant - 2.0 * s0 - s1;
    let d = s0 + s1 - 2.0 * secant;
    (y[k] + h * t * (s0 + t * (c + t * d)), s0 + t * (2.0 * c + 3.0 * t * d))
}

/// Slope of the monotone cubic at knot `k`: a weighted harmonic mean of the secants on both sides.
fn knot_slope(x: &[f64], y: &[f64], k: usize) -> f64 {
    let width = |i: usize| x[i + 1] - x[i];
    let secant = |i: usize| (y[i + 1] - y[i]) / width(i);
    let last = x.len() - 1;
    if last == 1 {
        return secant(0);
    }
    if k == 0 || k == last {
        // Three-point formula, kept to the sign and thrice the size of the secant beside it.
        let (near, far) = if k == 0 { (0, 1) } else { (last - 1, last - 2) };
        let (h0, h1, d0, d1) = (width(near), width(far), secant(near), secant(far));
        let slope = ((2.0 * h0 + h1) * d0 - h0 * d1) / (h0 + h1);
        return if slope * d0 <= 0.0 {
            0.0
        } else if d0 * d1 <= 0.0 && slope.abs() > 3.0 * d0.abs() {
            3.0 * d0
        } else {
            slope
        };
    }
    let (h0, h1, d0, d1) = (width(k - 1), width(k), secant(k - 1), secant(k));
    if d0 * d1 <= 0.0 {
        return 0.0;
    }
    let (w0, w1) = (2.0 * h1 + h0, h1 + 2.0 * h0);
    (w0 + w1) / (w0 / d0 + w1 / d1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Angle (rad) and force (N/m) from SciPy.
    const PCHIP: [(f64, f64); 6] = [
        (0.03, 4.218),
        (0.17, 10.0),
        (0.3, 11.580721062618595),
        (0.44, 28.977283643263753),
        (0.61, 77.88974896912859),
        (0.9, 300.00000000000006),
    ];

    fn table() -> ShearCurve {
        ShearCurve::Table {
            angle: vec![0.0, 0.1, 0.25, 0.5, 0.9],
            force: vec![0.0, 10.0, 10.0, 40.0, 300.0],
        }
    }

    /// Values of `scipy.interpolate.PchipInterpolator` on the same five points.
    #[test]
    fn a_table_is_joined_as_scipys_pchip_does() {
        for (gamma, tau) in PCHIP {
            let (found, _) = table().force(gamma);
            assert!((found - tau).abs() < 1e-12 * (1.0 + tau), "{gamma}: {found} {tau}");
        }
    }

    /// A straight line is its own interpolant, inside and beyond the table.
    #[test]
    fn a_straight_table_stays_straight() {
        let line = ShearCurve::Table { angle: vec![0.0, 0.2, 0.3], force: vec![0.0, 4.0, 6.0] };
        for gamma in [0.0, 0.13, 0.29, 0.3, 1.2] {
            let (tau, slope) = line.force(gamma);
            assert!((tau - 20.0 * gamma).abs() < 1e-12 && (slope - 20.0).abs() < 1e-12);
        }
    }

    /// By hand: 2γ + 3γ² at γ = 0.5 is 1.75, its slope 2 + 6γ is 5.
    #[test]
    fn a_polynomial_has_no_constant_term() {
        let curve = ShearCurve::Polynomial { coefficients: vec![2.0, 3.0] };
        assert_eq!(curve.force(0.5), (1.75, 5.0));
        assert_eq!(curve.force(-0.5), curve.force(0.5));
        assert_eq!(curve.force(0.0), (0.0, 2.0));
    }

    proptest! {
        /// The slope is the derivative, to the accuracy of central differences, and the curve of
        /// rising points never falls.
        #[test]
        fn the_slope_is_the_derivative_and_never_negative(gamma in 1e-4..1.4f64) {
            let h = 1e-6;
            for curve in [table(), ShearCurve::Polynomial { coefficients: vec![5.0, -1.0, 9.0] }] {
                let (_, slope) = curve.force(gamma);
                let central = (curve.force(gamma + h).0 - curve.force(gamma - h).0) / (2.0 * h);
                // The cubic's second derivative jumps at the knots, by up to 1e4 N/m here.
                prop_assert!((slope - central).abs() < 1e-2, "{gamma}: {slope} {central}");
                prop_assert!(slope >= 0.0);
            }
        }
    }
}
