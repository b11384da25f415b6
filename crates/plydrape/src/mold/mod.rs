//! The surface that the ply is laid on.
//!
//! What contact asks of a mold: how far a point is from it, its closest point and normal, and where a
//! length of fabric ends that is laid along it in a vertical plane. Distances in metres, positive
//! outside; normals are unit vectors out of the mold.

mod plane;

pub use plane::Plane;

use serde::Serialize;

/// A mold.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Mold {
    /// Flat, of any position and tilt.
    Plane(Plane),
}

impl Mold {
    /// Distance of `p` (m) from the mold (m), negative inside it.
    #[must_use]
    pub fn signed_distance(&self, p: [f64; 3]) -> f64 {
        match self {
            Mold::Plane(plane) => plane.signed_distance(p),
        }
    }

    /// The point of the mold closest to `p` (m).
    #[must_use]
    pub fn closest_point(&self, p: [f64; 3]) -> [f64; 3] {
        match self {
            Mold::Plane(plane) => plane.closest_point(p),
        }
    }

    /// Unit normal of the mold at its point `p` (m).
    #[must_use]
    pub fn normal(&self, _p: [f64; 3]) -> [f64; 3] {
        match self {
            Mold::Plane(plane) => plane.normal,
        }
    }

    /// Where fabric of arc length `length` (m) ends that is laid along the mold from its point `from`
    /// (m) in the vertical plane of the horizontal unit vector `heading`.
    #[must_use]
    pub fn lay(&self, from: [f64; 3], heading: [f64; 2], length: f64) -> [f64; 3] {
        match self {
            Mold::Plane(plane) => {
                let slope = plane.slope(heading);
                let run = length / slope.hypot(1.0);
                [from[0] + run * heading[0], from[1] + run * heading[1], from[2] + run * slope]
            }
        }
    }

    /// Length of the path along the mold between two of its points (m).
    #[must_use]
    pub fn path(&self, a: [f64; 3], b: [f64; 3]) -> f64 {
        match self {
            Mold::Plane(_) => distance(a, b),
        }
    }

    /// A distance (m) that no point of a curve of `length` (m) between `a` and `b` falls short of.
    #[must_use]
    pub fn clearance(&self, a: [f64; 3], b: [f64; 3], length: f64) -> f64 {
        let chord = distance(a, b);
        let sag = 0.5 * (length * length - chord * chord).max(0.0).sqrt();
        match self {
            Mold::Plane(plane) => plane.signed_distance(a).min(plane.signed_distance(b)) - sag,
        }
    }
}

/// Distance of two points (m).
pub(crate) fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|n| (a[n] - b[n]).powi(2)).sum::<f64>().sqrt()
}
