//! What of a mesh lies closest to a point.
//!
//! The side of the surface follows from the normal of what is closest: of a triangle, the sum of two at an
//! edge, the angle-weighted sum around a vertex (Bærentzen and Aanæs 2005). The normal that is
//! reported is another one: it is blended from the vertices, so that it turns smoothly.

use super::orient::NONE;
use super::triangle::{Closest, Weights};
use super::{Mesh, one_ring};
use crate::geometry::vector::{cross, dot, norm, sub, unit};
use crate::mold::tuning::TUNING;
use crate::mold::{ClosestPoint, Separation};

/// A point of the mesh: its triangle and its weights there.
#[derive(Debug, Clone, Copy)]
pub(super) struct SurfacePoint {
    pub triangle: usize,
    pub weights: Weights,
    pub point: [f64; 3],
}

impl Mesh {
    /// What lies closest to `p` (m).
    ///
    /// The distance is negative inside a closed mesh and below an open one.
    #[must_use]
    pub fn closest_point(&self, p: [f64; 3]) -> ClosestPoint {
        let place = self.surface_point(p);
        let Separation { distance, beyond } = self.separation_from(&place, p);
        ClosestPoint { point: place.point, normal: self.normal_at(&place), distance, beyond }
    }

    /// How far `p` (m) is away, as [`Mesh::closest_point`] says it; it is known to be no farther than `most` (m).
    #[must_use]
    pub fn separation(&self, p: [f64; 3], most: f64) -> Separation {
        // a margin for rounding; should the bound be wrong all the same, everything is searched
        let place = self.surface_point_within(p, most * most * (1.0 + TUNING.bound_margin));
        self.separation_from(&place.unwrap_or_else(|| self.surface_point(p)), p)
    }

    fn separation_from(&self, place: &SurfacePoint, p: [f64; 3]) -> Separation {
        let off = sub(p, place.point);
        let distance = norm(off);
        let beyond = self.is_beyond(place, off, distance);
        let inside = !beyond && dot(off, self.side_normal(place)) < 0.0;
        Separation { distance: if inside { -distance } else { distance }, beyond }
    }

    /// The point of the mesh closest to `p` (m).
    pub(super) fn surface_point(&self, p: [f64; 3]) -> SurfacePoint {
        // no number, or too far away to tell
        let corner =
            || SurfacePoint { triangle: 0, weights: [1.0, 0.0, 0.0], point: self.corners(0)[0] };
        self.surface_point_within(p, f64::MAX).unwrap_or_else(corner)
    }

    /// The closest point, if the square of its distance is less than `most` (m²).
    fn surface_point_within(&self, p: [f64; 3], most: f64) -> Option<SurfacePoint> {
        let corners = |triangle| self.corners(triangle as usize);
        let (triangle, Closest { weights, point, .. }) = self.tree.closest(p, most, corners)?;
        Some(SurfacePoint { triangle: triangle as usize, weights, point })
    }

    /// Smooth unit normal.
    pub(super) fn normal_at(&self, place: &SurfacePoint) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for (corner, weight) in self.triangles[place.triangle].iter().zip(place.weights) {
            let normal = self.vertex_normals[*corner as usize];
            sum = [0, 1, 2].map(|n| sum[n] + weight * normal[n]);
        }
        unit(sum).unwrap_or(self.triangle_normals[place.triangle])
    }

    /// A vector that has the surface's outside on its side (not of unit length).
    fn side_normal(&self, place: &SurfacePoint) -> [f64; 3] {
        let own = self.triangle_normals[place.triangle];
        match place.feature() {
            Feature::Inside => own,
            Feature::Edge(k) => match self.neighbors[place.triangle][k] {
                NONE => own,
                other => {
                    let other = self.triangle_normals[other as usize];
                    [0, 1, 2].map(|n| own[n] + other[n])
                }
            },
            Feature::Corner(k) => self.vertex_normals[self.triangles[place.triangle][k] as usize],
        }
    }

    /// Whether a point `off` a point of the mesh lies off to the side of a boundary there.
    fn is_beyond(&self, place: &SurfacePoint, off: [f64; 3], distance: f64) -> bool {
        let outwards = |(t, k): (usize, usize)| {
            let corners = self.corners(t);
            let edge = sub(corners[(k + 1) % 3], corners[k]);
            let aside = cross(edge, self.triangle_normals[t]);
            let limit = TUNING.aside * (self.size + distance);
            self.neighbors[t][k] == NONE && dot(off, aside) > limit * norm(aside)
        };
        match place.feature() {
            Feature::Inside => false,
            Feature::Edge(k) => outwards((place.triangle, k)),
            Feature::Corner(k) => {
                // at the boundary the one-ring begins with one boundary edge and ends with the other
                let vertex = self.triangles[place.triangle][k] as usize;
                let (first, edge) = self.first_corners[vertex];
                if self.neighbors[first][edge] != NONE {
                    return false;
                }
                let mut last = (first, edge);
                while let Some(next) = one_ring::next(&self.triangles, &self.neighbors, last) {
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

impl SurfacePoint {
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
