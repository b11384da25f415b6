//! What of a mesh lies closest to a point.
//!
//! The side of the surface is told by the normal of what is closest: of a triangle, the sum of two at an
//! edge, the angle-weighted sum around a vertex (Bærentzen and Aanæs 2005). The normal that is
//! reported is another one: it is blended from the vertices, so that it turns smoothly.

use super::orient::NONE;
use super::triangle::{Closest, Weights};
use super::{Mesh, fan};
use crate::mold::vector::{cross, dot, norm, sub, unit};
use crate::mold::{Foot, Separation};

/// How far (share of the mesh) a point may lie off to the side of a border and still count as over it.
const ASIDE: f64 = 1e-9;
/// The same as a share of its distance.
const ASIDE_SLOPE: f64 = 1e-9;

/// Share by which the square of a bound on a distance is taken larger.
const WITHIN: f64 = 1e-6;

/// A point of the mesh: its triangle and its weights there.
#[derive(Debug, Clone, Copy)]
pub(super) struct Spot {
    pub triangle: usize,
    pub weights: Weights,
    pub point: [f64; 3],
}

impl Mesh {
    /// What lies closest to `p` (m).
    ///
    /// The distance is negative inside a closed mesh and below an open one.
    #[must_use]
    pub fn foot(&self, p: [f64; 3]) -> Foot {
        let spot = self.spot(p);
        let Separation { distance, beyond } = self.separation_from(&spot, p);
        Foot { point: spot.point, normal: self.normal_at(&spot), distance, beyond }
    }

    /// How far `p` (m) is away, as [`Mesh::foot`] says it; it is known to be no farther than `most` (m).
    #[must_use]
    pub fn separation(&self, p: [f64; 3], most: f64) -> Separation {
        // a margin for rounding; should the bound be wrong all the same, everything is searched
        let spot = self.spot_within(p, most * most * (1.0 + WITHIN));
        self.separation_from(&spot.unwrap_or_else(|| self.spot(p)), p)
    }

    fn separation_from(&self, spot: &Spot, p: [f64; 3]) -> Separation {
        let off = sub(p, spot.point);
        let distance = norm(off);
        let beyond = self.is_beyond(spot, off, distance);
        let inside = !beyond && dot(off, self.side_normal(spot)) < 0.0;
        Separation { distance: if inside { -distance } else { distance }, beyond }
    }

    /// The point of the mesh closest to `p` (m).
    pub(super) fn spot(&self, p: [f64; 3]) -> Spot {
        // no number, or too far away to tell
        let corner = || Spot { triangle: 0, weights: [1.0, 0.0, 0.0], point: self.corners(0)[0] };
        self.spot_within(p, f64::MAX).unwrap_or_else(corner)
    }

    /// The same, if the square of its distance is less than `most` (m²).
    fn spot_within(&self, p: [f64; 3], most: f64) -> Option<Spot> {
        let corners = |triangle| self.corners(triangle as usize);
        let (triangle, Closest { weights, point, .. }) = self.tree.closest(p, most, corners)?;
        Some(Spot { triangle: triangle as usize, weights, point })
    }

    /// Smooth unit normal.
    pub(super) fn normal_at(&self, spot: &Spot) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for (corner, weight) in self.triangles[spot.triangle].iter().zip(spot.weights) {
            let normal = self.vertex_normals[*corner as usize];
            sum = [0, 1, 2].map(|n| sum[n] + weight * normal[n]);
        }
        unit(sum).unwrap_or(self.triangle_normals[spot.triangle])
    }

    /// A vector that has the surface's outside on its side (not of unit length).
    fn side_normal(&self, spot: &Spot) -> [f64; 3] {
        let own = self.triangle_normals[spot.triangle];
        match spot.feature() {
            Feature::Inside => own,
            Feature::Edge(k) => match self.neighbours[spot.triangle][k] {
                NONE => own,
                other => {
                    let other = self.triangle_normals[other as usize];
                    [0, 1, 2].map(|n| own[n] + other[n])
                }
            },
            Feature::Corner(k) => self.vertex_normals[self.triangles[spot.triangle][k] as usize],
        }
    }

    /// Whether a point `off` the spot lies off to the side of a border there.
    fn is_beyond(&self, spot: &Spot, off: [f64; 3], distance: f64) -> bool {
        let outwards = |(t, k): (usize, usize)| {
            let corners = self.corners(t);
            let edge = sub(corners[(k + 1) % 3], corners[k]);
            let aside = cross(edge, self.triangle_normals[t]);
            let limit = ASIDE * self.size + ASIDE_SLOPE * distance;
            self.neighbours[t][k] == NONE && dot(off, aside) > limit * norm(aside)
        };
        match spot.feature() {
            Feature::Inside => false,
            Feature::Edge(k) => outwards((spot.triangle, k)),
            Feature::Corner(k) => {
                // at the border the fan begins with one border edge and ends with the other
                let vertex = self.triangles[spot.triangle][k] as usize;
                let (first, edge) = self.fans[vertex];
                if self.neighbours[first][edge] != NONE {
                    return false;
                }
                let mut last = (first, edge);
                while let Some(next) = fan::next(&self.triangles, &self.neighbours, last) {
                    last = next;
                }
                outwards((first, edge)) || outwards((last.0, (last.1 + 2) % 3))
            }
        }
    }
}

/// Where in a triangle a point is.
enum Feature {
    Inside,
    /// Between corner k and corner k + 1.
    Edge(usize),
    Corner(usize),
}

impl Spot {
    fn feature(&self) -> Feature {
        match self.weights.map(|w| w > 0.0) {
            [true, true, true] => Feature::Inside,
            [true, true, false] => Feature::Edge(0),
            [false, true, true] => Feature::Edge(1),
            [true, false, true] => Feature::Edge(2),
            [_, true, _] => Feature::Corner(1),
            [_, _, true] => Feature::Corner(2),
            _ => Feature::Corner(0),
        }
    }
}
