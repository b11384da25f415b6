//! A saddle: curved down along one axis and up along the other.

use super::height::Height;
use serde::{Deserialize, Serialize};

/// The surface z = x²/2r₀ − y²/2r₁.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Saddle {
    /// Radii of curvature at its middle, upwards along x and downwards along y (m).
    pub radii: [f64; 2],
}

impl Saddle {
    /// Its height at (x, y) (m).
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
