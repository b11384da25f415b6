//! The closest point of one triangle.

use crate::geometry::vector::{along, cross, dot, sub};

/// A point of a triangle by the weights of its corners; a weight of zero is exact, so that the weights
/// tell corners, edges and the inside apart.
pub(crate) type Weights = [f64; 3];

/// A vector across a triangle of three points, as long as twice its area.
pub(super) fn double_area([p, q, r]: [[f64; 3]; 3]) -> [f64; 3] {
    cross(sub(q, p), sub(r, p))
}

/// A point of a triangle that is closest to another.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Closest {
    pub weights: Weights,
    /// The point (m).
    pub point: [f64; 3],
    /// Square of the distance (m²).
    pub square: f64,
}

/// The point of a triangle closest to `p` (m).
///
/// Projected to the plane of the triangle, `p` is inside or beyond an edge. The weights of that
/// projection are ratios of signed areas; where one is negative, the closest point is on the edge across
/// from it, or on another edge that meets it.
#[inline]
pub(crate) fn closest([a, b, c]: [[f64; 3]; 3], p: [f64; 3]) -> Closest {
    let (ab, ac, ap) = (sub(b, a), sub(c, a), sub(p, a));
    let (bb, bc, cc) = (dot(ab, ab), dot(ab, ac), dot(ac, ac));
    let (pb, pc) = (dot(ap, ab), dot(ap, ac));
    // weights of b and c in the plane, times the square of twice the area
    let across = cross(ab, ac);
    let area = dot(across, across);
    let v = dot(cross(ap, ac), across);
    let w = dot(cross(ab, ap), across);
    if v > 0.0 && w > 0.0 && v + w < area {
        let (v, w) = (v / area, w / area);
        let weights = [1.0 - v - w, v, w];
        let point = along(along(a, v, ab), w, ac);
        let off = sub(p, point);
        return Closest { weights, point, square: dot(off, off) };
    }
    // outside: the nearest of the edges that p lies beyond
    let mut best = Closest { weights: [1.0, 0.0, 0.0], point: a, square: f64::INFINITY };
    let mut edge = |s: [f64; 3], t: [f64; 3], along_edge: f64, square: f64, i: usize, j: usize| {
        let share = (along_edge / square).clamp(0.0, 1.0);
        let point = if share == 1.0 { t } else { along(s, share, sub(t, s)) };
        let off = sub(p, point);
        let distance = dot(off, off);
        if distance < best.square {
            let mut weights = [0.0; 3];
            weights[i] = 1.0 - share;
            weights[j] = share;
            best = Closest { weights, point, square: distance };
        }
    };
    if w <= 0.0 {
        edge(a, b, pb, bb, 0, 1);
    }
    if v <= 0.0 {
        edge(a, c, pc, cc, 0, 2);
    }
    if v + w >= area {
        // (p − b)·(c − b) and |c − b|²
        edge(b, c, (pc - pb) - (bc - bb), bb + cc - 2.0 * bc, 1, 2);
    }
    best
}
