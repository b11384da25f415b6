//! Shear that takes time: what resin between the yarns adds to the shear force.
//!
//! A Maxwell element acts in parallel to the shear curve, τ = τ∞(γ) + q with q̇ = G₁ γ̇ − q/θ. A shear that is much slower than the
//! relaxation time θ is resisted by G₁ θ γ̇, as by a viscous liquid; one that is much faster by G₁ γ, as by a spring; and where the
//! ply is at rest, q falls as e^(−t/θ). Resin flows the sooner the warmer it is, so θ depends on the temperature by the law of Arrhenius,
//! while G₁ does not (time–temperature superposition).

/// What resin adds to the shear force per length of a ply.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct ShearRate {
    /// Stiffness G₁ against a shear that is much faster than the relaxation (N/m per rad).
    pub stiffness: f64,
    /// How long the resin takes to relax.
    pub relaxation: Relaxation,
    /// Temperature of the ply (K).
    pub temperature: f64,
}

impl ShearRate {
    /// The relaxation time θ at the temperature of the ply (s).
    #[must_use]
    pub fn time(&self) -> f64 {
        self.relaxation.time_at(self.temperature)
    }

    /// The law with all relaxation times longer by a factor. But for inertia, a ply with that law drapes along a motion as a ply
    /// with this one does along a motion that is as many times as fast.
    #[must_use]
    pub fn slower(&self, factor: f64) -> Self {
        let mut slower = self.clone();
        slower.relaxation.time.iter_mut().for_each(|time| *time *= factor);
        slower
    }
}

/// Share of a relaxation time that is rounding.
const ROUNDING: f64 = 1e-12;

/// Relaxation times over temperatures. Between two of them, and beyond the last ones, ln θ is a straight line over 1/T, the law of
/// Arrhenius; a single one is that of every temperature.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Relaxation {
    /// Temperatures, ascending (K).
    pub temperature: Vec<f64>,
    /// Relaxation times θ, falling (s).
    pub time: Vec<f64>,
}

impl Relaxation {
    /// The relaxation time (s) at a temperature (K).
    #[must_use]
    pub fn time_at(&self, temperature: f64) -> f64 {
        let Self { temperature: known, time } = self;
        let last = known.len().min(time.len()).saturating_sub(1);
        if last == 0 {
            return time.first().copied().unwrap_or(0.0);
        }
        let k = known[..=last].partition_point(|t| *t <= temperature).clamp(1, last) - 1;
        let [cold, warm] = [k, k + 1].map(|n| (1.0 / known[n], time[n].ln()));
        let share = (1.0 / temperature - cold.0) / (warm.0 - cold.0);
        (cold.1 + share * (warm.1 - cold.1)).exp()
    }

    /// The temperature (K) at which the relaxation takes so long (s); `None` where no temperature between those that are known does.
    #[must_use]
    pub fn temperature_of(&self, seconds: f64) -> Option<f64> {
        let pairs = self.temperature.windows(2).zip(self.time.windows(2));
        let [longer, shorter] = [1.0 + ROUNDING, 1.0 - ROUNDING].map(|share| share * seconds);
        let mut within = pairs.filter(|(_, time)| time[1] <= longer && shorter <= time[0]);
        let (temperature, time) = within.next()?;
        let share = (time[0] / seconds).ln() / (time[0] / time[1]).ln();
        let [cold, warm] = [temperature[0], temperature[1]].map(f64::recip);
        Some((cold + share * (warm - cold)).recip())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Resin 8552: 8.8 kPa·s at 25 °C, 0.35 kPa·s at 60 °C.
    fn resin() -> Relaxation {
        Relaxation { temperature: vec![298.15, 333.15], time: vec![8.8, 0.35] }
    }

    /// The activation energy R ln(8.8 / 0.35) / (1/298.15 − 1/333.15) is 76 kJ/mol, and with it the law says what it does between.
    #[test]
    fn relaxation_follows_the_law_of_arrhenius() {
        let (gas, cold, warm) = (8.314_462_6, 298.15_f64, 333.15_f64);
        let energy = gas * (8.8_f64 / 0.35).ln() / (cold.recip() - warm.recip());
        assert!((energy - 76.1e3).abs() < 0.1e3, "{energy}");
        for temperature in [290.0, 298.15, 310.0, 333.15, 340.0] {
            let time = 8.8 * (energy / gas * (f64::recip(temperature) - cold.recip())).exp();
            assert!((resin().time_at(temperature) / time - 1.0).abs() < 1e-12, "{temperature}");
        }
    }

    #[test]
    fn the_temperature_of_a_relaxation_time_is_its_inverse() {
        for temperature in [298.15, 305.0, 320.0, 333.15] {
            let found = resin().temperature_of(resin().time_at(temperature)).expect("known");
            assert!((found - temperature).abs() < 1e-9, "{temperature} {found}");
        }
        assert_eq!(resin().temperature_of(9.0), None);
        assert_eq!(resin().temperature_of(0.3), None);
    }

    #[test]
    fn a_single_relaxation_time_is_that_of_every_temperature() {
        let single = Relaxation { temperature: vec![298.15], time: vec![2.0] };
        assert_eq!([250.0, 298.15, 400.0].map(|t| single.time_at(t)), [2.0; 3]);
    }
}
