//! A point of the mold, or of its extension beyond the boundary.

use crate::geometry::vector::{along, dot, sub};
use crate::mold::Mold;
use std::cell::Cell;

/// A place of the net with the mold's normal there.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct SurfacePoint {
    /// Place (m).
    pub point: [f64; 3],
    /// Unit normal, towards the ply.
    pub normal: [f64; 3],
    /// Distance beyond the mold's boundary (m); 0 on the mold.
    pub beyond: f64,
}

/// A mold that is extended beyond its open boundary along its tangent planes.
///
/// So a ply that leaves the mold at one place comes back to it at another where it would on flat surface, and
/// a gripper outside still has a place.
pub(super) struct ExtendedSurface<'a> {
    mold: &'a Mold,
    /// Number of closest points computed so far.
    closest_points: Cell<usize>,
}

impl<'a> ExtendedSurface<'a> {
    pub fn new(mold: &'a Mold) -> Self {
        ExtendedSurface { mold, closest_points: Cell::new(0) }
    }

    /// What lies closest to `p` (m).
    pub fn under(&self, p: [f64; 3]) -> SurfacePoint {
        self.closest_points.set(self.closest_points.get() + 1);
        let closest = self.mold.closest_point(p);
        if !closest.beyond {
            return SurfacePoint { point: closest.point, normal: closest.normal, beyond: 0.0 };
        }
        let height = dot(sub(p, closest.point), closest.normal);
        let point = along(p, -height, closest.normal);
        let aside = sub(point, closest.point);
        // never 0: a place beyond the boundary is no place of the mold
        let beyond = dot(aside, aside).sqrt().max(f64::MIN_POSITIVE);
        SurfacePoint { point, normal: closest.normal, beyond }
    }

    /// Number of closest points computed.
    pub fn closest_points(&self) -> usize {
        self.closest_points.get()
    }
}
