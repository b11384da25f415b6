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

/// Height added ahead of a front: an ellipse, or between it and the rectangle or the rhombus of its axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rise {
    /// Where the front starts from (m).
    pub center: [f64; 2],
    /// Direction of its longer axis (rad).
    pub angle: f64,
    /// Ratio of its axes: 1 is a circle.
    pub ratio: f64,
    /// How square it is: 0 is an ellipse, 1 near a rectangle whose sides are across its axes, and −1 a rhombus with round corners.
    pub squareness: f64,
    /// How far the front has come, in r (m).
    pub front: f64,
    /// Curvature at the front A (1/m).
    pub curvature: f64,
    /// Steepest slope σ.
    pub slope: f64,
    /// Radius over which the tip at r = 0 is rounded (m).
    pub tip: f64,
}

/// Distance r from where a front starts, in which it advances, with first and second derivatives to x and y.
struct Radius {
    r: f64,
    gradient: [f64; 2],
    hessian: [f64; 3],
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
    pub fn radius(&self, place: [f64; 2]) -> f64 {
        let [u, v] = self.along_axes(place);
        self.fourth_power(u, v, 0.0).max(0.0).sqrt().sqrt()
    }

    /// A place along the axes of the front (m), of which the longer one is measured in shares of the ratio.
    fn along_axes(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [dx, dy] = [x - self.center[0], y - self.center[1]];
        let (sin, cos) = self.angle.sin_cos();
        [(cos * dx + sin * dy) / self.ratio, cos * dy - sin * dx]
    }

    /// r⁴ = (u² + v² + tip²)² − 2 s u² v² with the squareness s.
    fn fourth_power(&self, u: f64, v: f64, tip: f64) -> f64 {
        let square = u * u + v * v + tip * tip;
        square * square - 2.0 * self.squareness * u * u * v * v
    }

    /// The distance r at a place, with its derivatives.
    fn radius_at(&self, place: [f64; 2]) -> Radius {
        let [u, v] = self.along_axes(place);
        let s = self.squareness;
        let r = self.fourth_power(u, v, self.tip).sqrt().sqrt();
        let square = u * u + v * v + self.tip * self.tip;
        // to u and v, from those of r⁴
        let cube = r * r * r;
        let first = [u * (square - s * v * v) / cube, v * (square - s * u * u) / cube];
        let second = [
            (square + 2.0 * u * u - s * v * v) / cube - 3.0 * first[0] * first[0] / r,
            2.0 * (1.0 - s) * u * v / cube - 3.0 * first[0] * first[1] / r,
            (square + 2.0 * v * v - s * u * u) / cube - 3.0 * first[1] * first[1] / r,
        ];
        // to x and y
        let (sin, cos) = self.angle.sin_cos();
        let [to_x, to_y] = [[cos / self.ratio, -sin], [sin / self.ratio, cos]];
        let along = |to: [f64; 2]| to[0] * first[0] + to[1] * first[1];
        let twice = |a: [f64; 2], b: [f64; 2]| {
            a[0] * (second[0] * b[0] + second[1] * b[1])
                + a[1] * (second[1] * b[0] + second[2] * b[1])
        };
        Radius {
            r,
            gradient: [along(to_x), along(to_y)],
            hessian: [twice(to_x, to_x), twice(to_x, to_y), twice(to_y, to_y)],
        }
    }

    /// The added height at (x, y) (m).
    fn at(&self, x: f64, y: f64) -> Height {
        let Radius { r, gradient, hessian } = self.radius_at([x, y]);
        let ahead = r - self.front;
        if ahead <= 0.0 {
            return Height::constant(0.0);
        }
        // the profile and its derivatives to r
        let (a, sigma) = (self.curvature, self.slope);
        let root = (1.0 + (a * ahead / sigma).powi(2)).sqrt();
        let (rate, bend) = (a * ahead / root, a / (root * root * root));
        let [gx, gy] = gradient;
        Height {
            z: sigma * sigma / a * (root - 1.0),
            gradient: gradient.map(|g| rate * g),
            hessian: [
                bend * gx * gx + rate * hessian[0],
                bend * gx * gy + rate * hessian[1],
                bend * gy * gy + rate * hessian[2],
            ],
        }
    }
}
