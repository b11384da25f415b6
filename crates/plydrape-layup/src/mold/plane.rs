//! A flat mold of any position and tilt.

use super::ClosestPoint;

/// The plane through `point` with unit normal `normal`, whose z component is positive.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Plane {
    /// A point of the mold (m).
    pub point: [f64; 3],
    /// Unit normal, out of the mold towards the ply.
    pub normal: [f64; 3],
}

impl Plane {
    /// Distance of `p` (m) from the mold (m), negative below it.
    #[must_use]
    pub fn signed_distance(&self, p: [f64; 3]) -> f64 {
        (0..3).map(|n| self.normal[n] * (p[n] - self.point[n])).sum()
    }

    /// What lies closest to `p` (m).
    #[must_use]
    pub fn closest_point(&self, p: [f64; 3]) -> ClosestPoint {
        let distance = self.signed_distance(p);
        let point = [0, 1, 2].map(|n| p[n] - distance * self.normal[n]);
        ClosestPoint { point, normal: self.normal, distance, beyond: false }
    }

    /// Slope of the mold along the horizontal unit vector `heading`.
    #[must_use]
    pub fn slope(&self, heading: [f64; 2]) -> f64 {
        -(self.normal[0] * heading[0] + self.normal[1] * heading[1]) / self.normal[2]
    }
}
