//! Rectangles of grippers laid out on a plane.

use plydrape::geometry::vector::{along, cross};
use plydrape::mold::Plane;
use plydrape::ply::{Grid, Ply};

/// A rectangle in a plane, spread along u and v from a corner.
pub(super) struct Rectangle {
    /// Corner (m).
    origin: [f64; 3],
    /// Unit vector along u.
    along_u: [f64; 3],
    /// Unit vector along v, to the left of u.
    along_v: [f64; 3],
}

impl Rectangle {
    /// The corner above or below `origin` (x, y in m), u along the heading `direction` (rad) as seen from
    /// above.
    pub fn on(plane: &Plane, [x, y]: [f64; 2], direction: f64) -> Self {
        let (sin, cos) = direction.sin_cos();
        let climb = plane.slope([cos, sin]);
        let length = climb.hypot(1.0);
        let along_u = [cos / length, sin / length, climb / length];
        let [nx, ny, nz] = plane.normal;
        let [px, py, pz] = plane.point;
        let z = pz - (nx * (x - px) + ny * (y - py)) / nz;
        Rectangle { origin: [x, y, z], along_u, along_v: cross(plane.normal, along_u) }
    }

    /// Places (m) of all grippers of a ply, neighbors in its array closer to each other than in the fabric by these shares
    /// along u and v, from the first gripper at the corner.
    pub fn grippers(&self, ply: &Ply, spacing: [f64; 2]) -> Vec<[f64; 3]> {
        let place = |index: usize| match ply.grid {
            Grid::NONE => self.point(ply, spacing, ply.place(index)),
            grid => {
                let [i, j] = grid.id(index);
                self.place([i as f64 * spacing[0], j as f64 * spacing[1]])
            }
        };
        (0..ply.grippers()).map(place).collect()
    }

    /// Place (m) of a fabric point (m) among these grippers.
    pub fn point(&self, ply: &Ply, spacing: [f64; 2], [u, v]: [f64; 2]) -> [f64; 3] {
        let (sin, cos) = ply.cut.as_ref().map_or(0.0, |cut| cut.turn).sin_cos();
        // along the rows and columns of the array, and back
        let share = [0, 1].map(|n| spacing[n] / ply.cell[n]);
        let (row, column) = (cos * u + sin * v, cos * v - sin * u);
        let (row, column) = (share[0] * row, share[1] * column);
        self.place([cos * row - sin * column, sin * row + cos * column])
    }

    /// Place (m) so far from the corner along u and v (m).
    fn place(&self, [u, v]: [f64; 2]) -> [f64; 3] {
        along(along(self.origin, u, self.along_u), v, self.along_v)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use plydrape::geometry::vector::{dot, sub};
    use proptest::prelude::*;

    proptest! {
        /// On any plane the sides keep their length, stand at right angles, lie in the plane, and u keeps its
        /// heading in plan.
        #[test]
        fn a_rectangle_lies_in_its_plane(
            tilt in 0.0..1.5f64, climb in -3.0..3.0f64, direction in -6.0..6.0f64,
        ) {
            let normal = [-tilt.sin() * climb.cos(), -tilt.sin() * climb.sin(), tilt.cos()];
            let plane = Plane { point: [0.1, -0.2, 0.3], normal };
            let rectangle = Rectangle::on(&plane, [0.4, 0.5], direction);
            let (u, v) = (rectangle.along_u, rectangle.along_v);
            prop_assert!((dot(u, u) - 1.0).abs() < 1e-13 && (dot(v, v) - 1.0).abs() < 1e-13);
            prop_assert!(dot(u, v).abs() < 1e-13 && dot(u, normal).abs() < 1e-13);
            prop_assert!((u[0] * direction.sin() - u[1] * direction.cos()).abs() < 1e-13);
            prop_assert!(u[0] * direction.cos() + u[1] * direction.sin() > 0.0);
            prop_assert!(dot(sub(rectangle.origin, plane.point), normal).abs() < 1e-13);
        }
    }
}
