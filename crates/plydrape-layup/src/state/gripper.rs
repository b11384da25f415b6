//! A gripper after one step: where it is, how its pad is turned, and what the ply does to it.

use crate::geometry::Point;
use crate::geometry::rotation::normal;
use crate::geometry::vector::{along, dot, norm};

/// A gripper after one step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GripperState {
    /// Where it holds the fabric (m).
    pub position: Point,
    /// Where the robot holds it (m); its position if its mount is rigid.
    pub commanded: Point,
    /// Orientation of the pad (x, y, z, w): z along the normal of the ply, x along u. Signs continue from step to step.
    pub quaternion: [f64; 4],
    /// Angle between the normal of the ply and the stem, which is upright unless a tool turns it (rad).
    pub tilt: f64,
    /// Force of the ply on the gripper (N).
    pub force: [f64; 3],
    /// How far the fabric has slid under the pad since the start (m).
    pub slide: f64,
    /// Whether the pad holds the ply; it does until it is released.
    pub holds: bool,
}

impl GripperState {
    /// Unit normal of the ply at the pad.
    #[must_use]
    pub fn normal(&self) -> Point {
        normal(self.quaternion)
    }

    /// What the gripper holds against gravity (N); negative where the ply pushes it up.
    #[must_use]
    pub fn load(&self) -> f64 {
        -self.force[2]
    }

    /// Horizontal force of the ply (N).
    #[must_use]
    pub fn pull(&self) -> f64 {
        self.force[0].hypot(self.force[1])
    }

    /// Force that draws the ply off the pad (N), not negative: what presses the pad on the mold holds the ply.
    #[must_use]
    pub fn load_across(&self) -> f64 {
        (-dot(self.force, self.normal())).max(0.0)
    }

    /// Force that draws the ply along the pad (N).
    #[must_use]
    pub fn load_along(&self) -> f64 {
        let normal = self.normal();
        norm(along(self.force, -dot(self.force, normal), normal))
    }
}
