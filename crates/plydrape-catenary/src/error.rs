//! What can be wrong with a strip.

/// Why a strip has no solution.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The ends of a strip are as far apart as it is long, or farther.
    #[error(
        "the strip is {length_mm:.6} mm long and its ends are {chord_mm:.6} mm apart: an inextensible strip hangs only with slack"
    )]
    StripTaut {
        /// Length (mm).
        length_mm: f64,
        /// Distance of the ends (mm).
        chord_mm: f64,
    },
    /// A slope is prescribed to a strip that does not resist bending, or a cantilever does not.
    #[error("a strip that does not resist bending cannot be held at a slope")]
    StripLimp,
    /// The continuation from the flexible catenary to the stiffness and slopes of a strip came to no end.
    #[error(
        "no hanging solution was found: from the flexible catenary at 0 to this strip's stiffness and slopes at 1, the search came to {reached:.4}"
    )]
    StripNotFound {
        /// Share of the way that was solved.
        reached: f64,
    },
    /// A quantity of a strip is not finite, or has the wrong sign.
    #[error("{what} is {value}; it must be {range}")]
    StripRange {
        /// What quantity.
        what: &'static str,
        /// Value (SI).
        value: f64,
        /// What it may be.
        range: &'static str,
    },
}
