//! A saddle: curved down along one axis and up along the other.

use super::height::{Height, Steepness};

/// The surface z = x²/2r₀ − y²/2r₁.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Saddle {
    /// Radii of curvature at its middle, upwards along x and downwards along y (m).
    pub radii: [f64; 2],
}

impl Saddle {
    /// Bounds of its slope over ranges of x and y (m), and of its bend, which is the same everywhere.
    #[must_use]
    pub fn steepness(&self, range: Option<[[f64; 2]; 2]>) -> Steepness {
        let [a, b] = self.radii.map(f64::abs);
        let reach =
            range.map_or([f64::INFINITY; 2], |range| range.map(|r| r[0].abs().max(r[1].abs())));
        Steepness { slope: (reach[0] / a).hypot(reach[1] / b), bend: (1.0 / a).max(1.0 / b) }
    }

    /// Height at (x, y) (m).
    #[must_use]
    pub fn at(&self, x: f64, y: f64) -> Height {
        let [a, b] = self.radii;
        Height {
            z: x * x / (2.0 * a) - y * y / (2.0 * b),
            gradient: [x / a, -y / b],
            hessian: [1.0 / a, 0.0, -1.0 / b],
        }
    }
}
