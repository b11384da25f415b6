//! A gripper of the sheet: the fabric point that it holds, its pad, its mount, and where it is.

use super::matrix3::{IDENTITY, Matrix3, orthonormal, product, rotation, times};
use crate::draping::attitude::quaternion;

/// A gripper.
#[derive(Debug, Clone, PartialEq)]
pub struct Gripper {
    /// Fabric coordinates of its middle (m).
    pub place: [f64; 2],
    /// Radius of its pad (m); zero holds one point.
    pub radius: f64,
    /// Stiffness of its mount along x, y and z (N/m); none if rigid.
    pub mount: Option<[f64; 3]>,
    /// Largest tilt of its pad (rad).
    pub max_tilt: f64,
}

/// A gripper's pad in space.
#[derive(Debug, Clone, PartialEq)]
pub struct Pad {
    /// Its middle (m).
    pub position: [f64; 3],
    /// Where the robot holds the mount (m); the same if it is rigid.
    pub target: [f64; 3],
    /// Its turn: the rows of u, v and normal are the columns of this matrix.
    pub turn: Matrix3,
}

impl Pad {
    /// At a place, not turned.
    pub fn new(position: [f64; 3]) -> Self {
        Pad { position, target: position, turn: IDENTITY }
    }

    /// The arm of a fabric point `off` (m) from the pad's middle.
    pub fn arm(&self, off: [f64; 2]) -> [f64; 3] {
        times(&self.turn, [off[0], off[1], 0.0])
    }

    /// Turns it by |w| (rad) about w.
    pub fn rotate(&mut self, w: [f64; 3]) {
        self.turn = orthonormal(&product(&rotation(w), &self.turn));
    }

    /// Its unit normal.
    pub fn normal(&self) -> [f64; 3] {
        times(&self.turn, [0.0, 0.0, 1.0])
    }

    /// Its turn as a unit quaternion (x, y, z, w).
    #[must_use]
    pub fn quaternion(&self) -> [f64; 4] {
        quaternion([0, 1, 2].map(|axis| self.turn.map(|row| row[axis])))
    }

    /// Angle between its normal and the vertical (rad).
    pub fn tilt(&self) -> f64 {
        self.normal()[2].clamp(-1.0, 1.0).acos()
    }
}
