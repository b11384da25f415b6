//! Position and rotation of a body.

use super::rotation::{continued, normal, quaternion, x_axis};
use super::vector::{along, dot, sub};

/// A rigid placement: local coordinates are turned by `axes`, then moved to `position`.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Pose {
    /// Place of the local origin (m).
    pub position: [f64; 3],
    /// Unit vectors along which the local x, y and z axes come to lie.
    pub axes: [[f64; 3]; 3],
}

impl Pose {
    /// In the origin, not turned.
    pub const ORIGIN: Pose =
        Pose { position: [0.0; 3], axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] };

    /// A pose given in this one's coordinates, in space.
    #[must_use]
    pub fn compose(&self, local: &Pose) -> Pose {
        Pose { position: self.place(local.position), axes: local.axes.map(|axis| self.turn(axis)) }
    }

    /// The pose of space in this one's coordinates.
    #[must_use]
    pub fn inverse(&self) -> Pose {
        let axes = Pose::ORIGIN.axes.map(|axis| self.turn_back(axis));
        Pose { position: self.local([0.0; 3]), axes }
    }

    /// Turns about the fixed axes x, then y, then z by `rotation` (rad), then moves to `position` (m).
    #[must_use]
    pub fn new(position: [f64; 3], rotation: [f64; 3]) -> Self {
        let [(sx, cx), (sy, cy), (sz, cz)] = rotation.map(f64::sin_cos);
        let turn = |[x, y, z]: [f64; 3]| {
            let (y, z) = (cx * y - sx * z, sx * y + cx * z);
            let (x, z) = (cy * x + sy * z, cy * z - sy * x);
            [cz * x - sz * y, sz * x + cz * y, z]
        };
        Pose {
            position,
            axes: [turn([1.0, 0.0, 0.0]), turn([0.0, 1.0, 0.0]), turn([0.0, 0.0, 1.0])],
        }
    }

    /// At a place (m), turned by a unit quaternion (x, y, z, w).
    #[must_use]
    pub fn of_quaternion(position: [f64; 3], turn: [f64; 4]) -> Self {
        let [x, y, z, w] = turn;
        let y_axis = [2.0 * (x * y - z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + x * w)];
        Pose { position, axes: [x_axis(turn), y_axis, normal(turn)] }
    }

    /// At a place (m), not turned.
    #[must_use]
    pub fn upright(position: [f64; 3]) -> Self {
        Pose { position, ..Pose::ORIGIN }
    }

    /// Turn as a unit quaternion (x, y, z, w).
    #[must_use]
    pub fn quaternion(&self) -> [f64; 4] {
        quaternion(self.axes)
    }

    /// The turns of poses that follow each other as unit quaternions (x, y, z, w): the first with w ≥ 0, each other one with the sign
    /// that is nearer to the one before, so that who interpolates the four numbers gets no jump.
    #[must_use]
    pub fn quaternions<'a>(poses: impl IntoIterator<Item = &'a Pose>) -> Vec<[f64; 4]> {
        let mut before = [0.0, 0.0, 0.0, 1.0];
        let signed = |pose: &Pose| {
            before = continued(pose.quaternion(), Some(before));
            before
        };
        poses.into_iter().map(signed).collect()
    }

    /// A local point in space (m).
    #[must_use]
    pub fn place(&self, local: [f64; 3]) -> [f64; 3] {
        let turned = self.turn(local);
        along(self.position, 1.0, turned)
    }

    /// A local direction in space.
    #[must_use]
    pub fn turn(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        let [a, b, c] = self.axes;
        [0, 1, 2].map(|n| x * a[n] + y * b[n] + z * c[n])
    }

    /// The local coordinates of a point in space (m).
    #[must_use]
    pub fn local(&self, p: [f64; 3]) -> [f64; 3] {
        self.turn_back(sub(p, self.position))
    }

    /// A direction in space in local coordinates.
    #[must_use]
    pub fn turn_back(&self, d: [f64; 3]) -> [f64; 3] {
        self.axes.map(|axis| dot(axis, d))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A quarter turn about x and then about z turns y to z and x to y.
    #[test]
    fn turns_are_about_the_fixed_axes_in_the_order_x_y_z() {
        let quarter = std::f64::consts::FRAC_PI_2;
        let pose = Pose::new([1.0, 2.0, 3.0], [quarter, 0.0, quarter]);
        let near =
            |a: [f64; 3], b: [f64; 3]| assert!(crate::geometry::distance(a, b) < 1e-15, "{a:?}");
        near(pose.turn([0.0, 1.0, 0.0]), [0.0, 0.0, 1.0]);
        near(pose.turn([1.0, 0.0, 0.0]), [0.0, 1.0, 0.0]);
        let p = [0.3, -0.2, 0.7];
        let pose = Pose::new([1.0, 2.0, 3.0], [0.4, -1.1, 2.2]);
        assert!(crate::geometry::distance(pose.local(pose.place(p)), p) < 1e-15);
    }

    /// A pose after another places as both in turn, and after its inverse as none.
    #[test]
    fn poses_follow_each_other() {
        let [a, b] =
            [[0.4, -1.1, 2.2], [-2.0, 0.3, 0.1]].map(|turn| Pose::new([1.0, 2.0, 3.0], turn));
        let p = [0.3, -0.2, 0.7];
        let near =
            |x: [f64; 3], y: [f64; 3]| assert!(crate::geometry::distance(x, y) < 1e-14, "{x:?}");
        near(a.compose(&b).place(p), a.place(b.place(p)));
        near(a.inverse().place(a.place(p)), p);
        near(a.compose(&a.inverse()).turn(p), p);
    }
}
