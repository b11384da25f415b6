//! Bending moment over curvature, for a ply whose rigidity falls as it bends.
//!
//! Yarns slide on each other when a fabric bends, so the moment M(κ) rises less and less: the secant rigidity of measured
//! plies falls to a sixth of its first value and less (Broberg et al. 2023, Composites Part B 274:111268). The law is
//! elastic, odd about zero and without hysteresis, after eq. (19d) of `docs/theory/sheet.md`.

use super::straight_lines;

/// Bending moment per width over the curvature, M(−κ) = −M(κ).
///
/// Measured points, joined by straight lines; beyond the last point its last slope goes on.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MomentCurve {
    /// Curvatures κ, ascending from 0 (1/m).
    pub curvature: Vec<f64>,
    /// Moments per width M, ascending from 0 (N, that is N·m per m).
    pub moment: Vec<f64>,
}

impl MomentCurve {
    /// Whether this is a law: two points or more, as many moments as curvatures, both ascending from 0.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        let ascends = |x: &[f64]| {
            x.first() == Some(&0.0)
                && x.iter().all(|x| x.is_finite())
                && x.windows(2).all(|pair| pair[1] > pair[0])
        };
        self.curvature.len() == self.moment.len()
            && self.curvature.len() >= 2
            && ascends(&self.curvature)
            && ascends(&self.moment)
    }

    /// Rigidity at rest (N·m): the first slope.
    #[must_use]
    pub fn rigidity(&self) -> f64 {
        self.bend(0.0)[2]
    }

    /// The smallest of its slopes (N·m).
    #[must_use]
    pub fn least_slope(&self) -> f64 {
        let slope = |n: usize| {
            (self.moment[n] - self.moment[n - 1]) / (self.curvature[n] - self.curvature[n - 1])
        };
        (1..self.curvature.len()).map(slope).fold(f64::INFINITY, f64::min)
    }

    /// Energy per area ∫ M dκ (N/m), moment per width M (N) and its slope dM/dκ (N·m) at a curvature κ (1/m) of either
    /// sign.
    #[must_use]
    pub fn bend(&self, curvature: f64) -> [f64; 3] {
        let [energy, moment, slope] =
            straight_lines(&self.curvature, &self.moment, curvature.abs());
        [energy, if curvature < 0.0 { -moment } else { moment }, slope]
    }

    /// The law of a strip that is wider by a factor, or of a ply that resists more by it.
    #[must_use]
    pub fn times(&self, factor: f64) -> MomentCurve {
        let moment = self.moment.iter().map(|moment| factor * moment).collect();
        MomentCurve { curvature: self.curvature.clone(), moment }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve() -> MomentCurve {
        MomentCurve { curvature: vec![0.0, 10.0, 30.0], moment: vec![0.0, 0.02, 0.04] }
    }

    /// By hand: at κ = 20 1/m the moment is 0.03 N and the area below the lines 0.1 + 0.25 N/m.
    #[test]
    fn moment_and_energy_are_those_of_straight_lines() {
        let [energy, moment, slope] = curve().bend(20.0);
        assert!((energy - 0.35).abs() < 1e-14 && (moment - 0.03).abs() < 1e-15);
        assert!((slope - 1e-3).abs() < 1e-15);
        let [energy, moment, _] = curve().bend(50.0);
        assert!((energy - (0.1 + 0.6 + 1.0)).abs() < 1e-14 && (moment - 0.06).abs() < 1e-15);
        assert!((curve().rigidity() - 2e-3).abs() < 1e-15);
        assert!((curve().least_slope() - 1e-3).abs() < 1e-15);
    }

    /// A ply resists bending to either side alike.
    #[test]
    fn the_moment_is_odd_and_its_energy_even() {
        for kappa in [0.0, 3.0, 10.0, 17.0, 80.0] {
            let ([e, m, d], [f, n, g]) = (curve().bend(kappa), curve().bend(-kappa));
            assert_eq!([e, m, d], [f, -n, g]);
        }
    }

    #[test]
    fn what_does_not_rise_from_zero_is_no_law() {
        assert!(curve().is_sound());
        let with = |curvature: &[f64], moment: &[f64]| MomentCurve {
            curvature: curvature.to_vec(),
            moment: moment.to_vec(),
        };
        for bad in [
            with(&[0.0], &[0.0]),
            with(&[0.0, 1.0], &[0.0, 0.0]),
            with(&[0.0, 1.0], &[0.1, 0.2]),
            with(&[0.0, 2.0, 1.0], &[0.0, 1.0, 2.0]),
            with(&[0.0, 2.0], &[0.0, f64::NAN]),
            with(&[0.0, 2.0], &[0.0, 1.0, 2.0]),
        ] {
            assert!(!bad.is_sound(), "{bad:?}");
        }
    }
}
