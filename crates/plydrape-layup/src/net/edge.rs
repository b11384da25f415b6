//! One mesh width of fabric between two nodes: its length and its directions on the mold.
//!
//! Between nodes a and b with unit normals n_a and n_b, c is the chord b − a, Δn = n_b − n_a and φ the
//! angle between the normals. On a plane, a cylinder and a sphere the straightest line from a to b is
//! developed into the plane by stretching the part of c along Δn from a chord to its arc,
//! k = (φ/2)/sin(φ/2):
//!
//! v = c + (k − 1)(c·Δn) Δn/|Δn|², so L² = |v|² = c² + (c·Δn)² (k² − 1)/|Δn|².
//!
//! v is a tangent half-way; turned from the mean normal to n_a or n_b by the shortest turn it is the line's
//! tangent there, times L. All of it is exact on those three molds, in every direction, and L is right to
//! the fourth order of the mesh width on others: c·Δn is its normal curvature times c², to second order.

use super::surface_point::SurfacePoint;
use crate::geometry::vector::{along, cross, direction, dot, norm, sub, unit};

/// How the fabric between two neighboring nodes is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum EdgeRule {
    /// Along the mold.
    #[default]
    Along,
    /// As straight bars, after Mack and Taylor 1956 and Krogh et al. 2021.
    Chord,
}

impl EdgeRule {
    /// Length of the fabric between two nodes (m).
    pub(super) fn length(self, a: &SurfacePoint, b: &SurfacePoint) -> f64 {
        let c = sub(b.point, a.point);
        match self {
            EdgeRule::Chord => norm(c),
            EdgeRule::Along => {
                let turn = sub(b.normal, a.normal);
                let bend = dot(c, turn);
                (dot(c, c) + bend * bend * stretch(dot(turn, turn))).sqrt()
            }
        }
    }

    /// Direction at `a` in which the fabric leaves for `b`: along the bar, or a unit tangent of the mold.
    pub(super) fn leaving(self, a: &SurfacePoint, b: &SurfacePoint) -> [f64; 3] {
        match self {
            EdgeRule::Chord => direction(sub(b.point, a.point)).unwrap_or([0.0; 3]),
            EdgeRule::Along => straightest(a, b),
        }
    }

    /// Change of [`EdgeRule::length`] with the place of `b`, a tangent at `b`.
    ///
    /// Along the mold it is the line's unit tangent: a length changes with its end alone.
    pub(super) fn gradient(self, a: &SurfacePoint, b: &SurfacePoint) -> [f64; 3] {
        match self {
            EdgeRule::Chord => {
                let bar = self.leaving(a, b);
                along(bar, -dot(bar, b.normal), b.normal)
            }
            EdgeRule::Along => straightest(b, a).map(|x| -x),
        }
    }

    /// Angle at `a` between the fabric towards `b` and towards `c` (rad), from 0 to π.
    pub(super) fn angle(self, a: &SurfacePoint, b: &SurfacePoint, c: &SurfacePoint) -> f64 {
        let [p, q] = [self.leaving(a, b), self.leaving(a, c)];
        norm(cross(p, q)).atan2(dot(p, q))
    }
}

/// Unit tangent at `a` of the straightest line to `b`.
pub(super) fn straightest(a: &SurfacePoint, b: &SurfacePoint) -> [f64; 3] {
    let c = sub(b.point, a.point);
    let turn = sub(b.normal, a.normal);
    let s = dot(turn, turn);
    // (k − 1)/|Δn|² from (k² − 1)/|Δn|²
    let f = stretch(s);
    let excess = f / (1.0 + (1.0 + s * f).sqrt());
    let developed = along(c, dot(c, turn) * excess, turn);
    let sum = [0, 1, 2].map(|n| a.normal[n] + b.normal[n]);
    let mean = unit(sum).unwrap_or(a.normal);
    let half_way = along(developed, -dot(developed, mean), mean);
    let there = turned(half_way, mean, a.normal);
    unit(there).unwrap_or([0.0; 3])
}

/// A vector across the unit vector `from`, turned by the shortest turn of `from` into `to`.
pub(super) fn turned(v: [f64; 3], from: [f64; 3], to: [f64; 3]) -> [f64; 3] {
    let share = dot(v, to) / (1.0 + dot(from, to)).max(1e-12);
    [0, 1, 2].map(|n| v[n] - share * (from[n] + to[n]))
}

/// (k² − 1)/s for s = |Δn|² = 4 sin²(φ/2) and k = (φ/2)/sin(φ/2).
///
/// The series is Σ 2 sⁿ⁻²/(n² C(2n, n)) from n = 2 on, that of the square of the arcsine.
fn stretch(s: f64) -> f64 {
    const SERIES: [f64; 8] = [
        1.0 / 12.0,
        1.0 / 90.0,
        1.0 / 560.0,
        1.0 / 3150.0,
        1.0 / 16_632.0,
        1.0 / 84_084.0,
        1.0 / 411_840.0,
        1.0 / 1_969_110.0,
    ];
    if s < 0.05 {
        return SERIES.iter().rev().fold(0.0, |sum, term| sum * s + term);
    }
    let sine = (0.5 * s.sqrt()).min(1.0);
    ((sine.asin() / sine).powi(2) - 1.0) / s
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn series_and_closed_form_of_the_stretch_agree_where_they_meet() {
        let s: f64 = 0.05;
        let sine = 0.5 * s.sqrt();
        let closed = ((sine.asin() / sine).powi(2) - 1.0) / s;
        // the closed form loses digits to the difference from 1
        assert!((stretch(s * (1.0 - 1e-15)) - closed).abs() < 1e-13);
    }

    /// A helix of 1.1 rad on a cylinder of radius 0.7 about x, over 0.4 along it.
    #[test]
    fn length_and_tangents_of_a_helix_are_exact() {
        let (radius, turn, rise) = (0.7_f64, 1.1_f64, 0.4);
        let point = |angle: f64, x: f64| SurfacePoint {
            point: [x, radius * angle.sin(), radius * angle.cos()],
            normal: [0.0, angle.sin(), angle.cos()],
            beyond: 0.0,
        };
        let (a, b) = (point(0.3, 0.0), point(0.3 + turn, rise));
        let length = rise.hypot(radius * turn);
        assert!((EdgeRule::Along.length(&a, &b) - length).abs() < 1e-15);
        let tangent = |angle: f64| {
            [rise, radius * turn * angle.cos(), -radius * turn * angle.sin()].map(|x| x / length)
        };
        let near = |p: [f64; 3], q: [f64; 3]| assert!(norm(sub(p, q)) < 1e-15, "{p:?} {q:?}");
        near(EdgeRule::Along.leaving(&a, &b), tangent(0.3));
        near(EdgeRule::Along.gradient(&a, &b), tangent(0.3 + turn));
    }
}
