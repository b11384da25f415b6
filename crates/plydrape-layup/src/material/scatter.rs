//! How much measured properties of a ply scatter.

/// Standard deviation of each property between specimens, as a share of its value; `None` where nobody says.
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
    /// Of the shear force.
    pub shear_curve: Option<f64>,
}

impl Scatter {
    /// Whether nothing is known.
    #[must_use]
    pub fn is_unknown(&self) -> bool {
        *self == Scatter::default()
    }
}
