//! How much measured properties of a ply scatter.

/// Scatter of each property between specimens; `None` where nobody says. Mass, bending and tension have a standard deviation, as a
/// share of the value.
///
/// Nothing in a drape depends on it: results repeat it, and who draws errors of a cell takes it from here.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Scatter {
    /// Of the mass.
    pub mass: Option<f64>,
    /// Of the bending along the warp, or of the flexural rigidity of a line.
    pub warp_rigidity: Option<f64>,
    /// Of the bending along the weft.
    pub weft_rigidity: Option<f64>,
    /// Of the tension.
    pub tension: Option<f64>,
    /// Of the shear force, which is often known within a factor only.
    pub shear_curve: Option<Spread>,
}

/// How far a value may be off, to both sides.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(untagged))]
pub enum Spread {
    /// Standard deviation as a share of the value.
    Share(f64),
    /// From 1/f to f times the value, every logarithm in between as likely.
    Factor {
        /// The factor f, 1 or more.
        factor: f64,
    },
}

impl Scatter {
    /// Whether nothing is known.
    #[must_use]
    pub fn is_unknown(&self) -> bool {
        *self == Scatter::default()
    }
}
