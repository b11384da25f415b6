//! One term of an error budget: how far one number may be off.

/// How far a number may be off: a standard deviation or a bound, in the unit of the number; or a factor.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Term {
    /// Standard deviation of a normal law about zero.
    Deviation(f64),
    /// Largest size; every value between plus and minus the bound is as likely.
    Bound(f64),
    /// Largest factor f, of 1 or more: the true value is the nominal one times f^u, u being even from −1 to 1, so that half and double
    /// are as likely. Of values of the ply alone, which are never negative.
    Factor(f64),
}

impl Term {
    /// No error.
    pub const NONE: Term = Term::Bound(0.0);

    /// This law with all errors larger by a factor.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        match self {
            Term::Deviation(deviation) => Term::Deviation(factor * deviation),
            Term::Bound(bound) => Term::Bound(factor * bound),
            Term::Factor(most) => Term::Factor(most.powf(factor)),
        }
    }

    /// The standard deviation, the bound or the factor.
    #[must_use]
    pub fn value(self) -> f64 {
        match self {
            Term::Deviation(value) | Term::Bound(value) | Term::Factor(value) => value,
        }
    }

    /// The standard deviation: of a bound it is the bound over √3, of a factor that of its logarithm.
    #[must_use]
    pub fn deviation(self) -> f64 {
        match self {
            Term::Deviation(deviation) => deviation,
            Term::Bound(bound) => bound / 3.0_f64.sqrt(),
            Term::Factor(most) => most.ln() / 3.0_f64.sqrt(),
        }
    }

    /// An error that hardly one of twenty exceeds to either side, upwards with a `sign` of 1 and downwards with −1: two standard
    /// deviations, or the bound; of a factor the share of the nominal value that the true one then has more.
    #[must_use]
    pub fn extreme(self, sign: f64) -> f64 {
        match self {
            Term::Deviation(deviation) => 2.0 * sign * deviation,
            Term::Bound(bound) => sign * bound,
            Term::Factor(most) => most.powf(sign) - 1.0,
        }
    }

    /// Whether there is no error.
    #[must_use]
    pub fn is_zero(self) -> bool {
        match self {
            Term::Deviation(value) | Term::Bound(value) => value == 0.0,
            Term::Factor(most) => most == 1.0,
        }
    }
}

impl Default for Term {
    fn default() -> Self {
        Term::NONE
    }
}
