//! The mold as the nodes of a sheet feel it: where it ends, its border is round.
//!
//! Yarns that hang over the border of a mold lie on its edge, and an edge between two nodes holds neither of them. A node
//! that came in from beside the mold would be far below it at once. So the border is rounded off with the width of the
//! mesh as its radius, and the mold goes down from there as a wall, see "The border of the mold" in `docs/theory/sheet.md`.
//! The finer the mesh, the sharper is the border.

use crate::geometry::vector::{along, dot, norm, sub};
use crate::mold::{ClosestPoint, Mold};

/// A mold with a round border.
#[derive(Debug, Clone, Copy)]
pub struct Rim<'a> {
    mold: &'a Mold,
    /// Radius of the border (m).
    radius: f64,
}

impl<'a> Rim<'a> {
    /// A mold whose border has a radius (m).
    pub fn new(mold: &'a Mold, radius: f64) -> Self {
        Rim { mold, radius }
    }

    /// What lies closest to a place `x` (m): the mold, or what is round beyond its border.
    pub fn closest_point(&self, x: [f64; 3]) -> ClosestPoint {
        let closest = self.mold.closest_point(x);
        if closest.beyond { self.round(x, &closest) } else { closest }
    }

    /// Gradient of the distance at a place (m) with its closest point.
    pub fn distance_gradient(&self, x: [f64; 3], closest: &ClosestPoint) -> [f64; 3] {
        if closest.beyond { closest.normal } else { self.mold.distance_gradient(x, closest) }
    }

    /// What lies closest to a place `x` (m) beside the mold, where this is the closest point of its border.
    fn round(&self, x: [f64; 3], border: &ClosestPoint) -> ClosestPoint {
        let off = sub(x, border.point);
        let above = dot(off, border.normal);
        let aside = along(off, -above, border.normal);
        // from the middle of the arc, which is a radius below the border; from the wall below it, level
        let up = (above + self.radius).max(0.0);
        let from_middle = along(aside, up, border.normal);
        let far = norm(from_middle);
        let normal = if far > 0.0 { from_middle.map(|c| c / far) } else { border.normal };
        let distance = far - self.radius;
        ClosestPoint { point: along(x, -distance, normal), normal, distance, beyond: true }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Pose;
    use crate::mold::{Cylinder, Face};

    const RADIUS: f64 = 0.01;

    /// A trough along x with its border at y = ±0.5 and z = 0, where it is upright.
    fn trough() -> Mold {
        let pose = Pose::upright([0.0; 3]);
        Mold::Cylinder(Cylinder { pose, radius: 0.5, face: Face::Inside })
    }

    /// Across the border the distance goes on as it was, at any depth that is less than the radius.
    #[test]
    fn a_node_that_comes_in_from_beside_the_mold_finds_no_jump() {
        let mold = trough();
        let rim = Rim::new(&mold, RADIUS);
        for depth in [-0.004, 0.0, 0.004, 0.009] {
            let [inside, beside] =
                [-1e-9, 1e-9].map(|z| rim.closest_point([0.1, 0.5 + depth, z]).distance);
            assert!((inside - beside).abs() < 1e-8, "{inside} and {beside} at {depth}");
            assert!((inside + depth).abs() < 1e-8, "{inside} at {depth}");
        }
    }

    /// The closest point is as far as the distance says, the normal is the gradient of the distance, and the arc has its
    /// radius about a middle that is below the border.
    #[test]
    fn the_border_is_an_arc_and_a_wall() {
        let mold = trough();
        let rim = Rim::new(&mold, RADIUS);
        for [along_normal, aside] in [[0.02, 0.01], [-0.003, 0.005], [-0.003, 0.02], [-0.03, 0.02]]
        {
            let x = [0.1, 0.5 - along_normal, aside];
            let closest = rim.closest_point(x);
            let up = along_normal + RADIUS;
            let from_middle = if up > 0.0 { up.hypot(aside) } else { aside };
            assert!((closest.distance - (from_middle - RADIUS)).abs() < 1e-12, "{closest:?}");
            let gradient = [0, 1, 2].map(|n| {
                let [more, less] = [1e-6, -1e-6].map(|step| {
                    let mut at = x;
                    at[n] += step;
                    rim.closest_point(at).distance
                });
                (more - less) / 2e-6
            });
            assert!(norm(sub(gradient, closest.normal)) < 1e-6, "{gradient:?} {closest:?}");
            assert!(rim.closest_point(closest.point).distance.abs() < 1e-12);
        }
    }
}
