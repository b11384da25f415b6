//! The surface of a ply that is in contact with the mold inside a front and curves away from the mold outside it.
//!
//! S = f + σ²/A (√(1 + (A e/σ)²) − 1), e = max(0, r − r_f): a curvature A right at the front, and a slope
//! of no more than σ far ahead of it.

use super::height::Height;
use super::height_grid::HeightGrid;
use std::sync::Arc;

/// A height grid raised ahead of a front.
#[derive(Debug, Clone, PartialEq)]
pub struct FrontSurface {
    /// The surface that is raised.
    pub mold: Arc<HeightGrid>,
    /// By how much.
    pub rise: Rise,
}

/// Height added ahead of an elliptic front.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rise {
    /// Where the front starts from (m).
    pub center: [f64; 2],
    /// The metric of the front (1): r² = q₀ x² + 2 q₁ x y + q₂ y² about the center.
    pub metric: [f64; 3],
    /// How far the front has come, in r (m).
    pub front: f64,
    /// Curvature at the front A (1/m).
    pub curvature: f64,
    /// Steepest slope σ.
    pub slope: f64,
    /// Radius over which the tip at r = 0 is rounded (m).
    pub tip: f64,
}

impl FrontSurface {
    /// The height at (x, y) (m).
    #[must_use]
    pub fn at(&self, x: f64, y: f64) -> Height {
        self.mold.at(x, y).plus(1.0, &self.rise.at(x, y))
    }

    /// By how much it is raised at (x, y) (m).
    #[must_use]
    pub fn rise_at(&self, x: f64, y: f64) -> f64 {
        self.rise.at(x, y).z
    }
}

impl Rise {
    /// Distance r of a place from where the front starts (m).
    #[must_use]
    pub fn radius(&self, [x, y]: [f64; 2]) -> f64 {
        let [dx, dy] = [x - self.center[0], y - self.center[1]];
        let [q0, q1, q2] = self.metric;
        (q0 * dx * dx + 2.0 * q1 * dx * dy + q2 * dy * dy).max(0.0).sqrt()
    }

    /// The added height at (x, y) (m).
    fn at(&self, x: f64, y: f64) -> Height {
        let [dx, dy] = [x - self.center[0], y - self.center[1]];
        let [q0, q1, q2] = self.metric;
        let half = [q0 * dx + q1 * dy, q1 * dx + q2 * dy];
        let r = (half[0] * dx + half[1] * dy + self.tip * self.tip).sqrt();
        let ahead = r - self.front;
        if ahead <= 0.0 {
            return Height::constant(0.0);
        }
        // the profile and its derivatives to r
        let (a, sigma) = (self.curvature, self.slope);
        let root = (1.0 + (a * ahead / sigma).powi(2)).sqrt();
        let (rate, bend) = (a * ahead / root, a / (root * root * root));
        let gradient = half.map(|h| h / r);
        let [gx, gy] = gradient;
        Height {
            z: sigma * sigma / a * (root - 1.0),
            gradient: gradient.map(|g| rate * g),
            hessian: [
                bend * gx * gx + rate * (q0 - gx * gx) / r,
                bend * gx * gy + rate * (q1 - gx * gy) / r,
                bend * gy * gy + rate * (q2 - gy * gy) / r,
            ],
        }
    }
}
