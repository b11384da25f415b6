//! A gripper of the sheet: the fabric point that it holds, its pad, its mount, and where it is.

use super::lip::Under;
use crate::geometry::rotation::quaternion;
use crate::geometry::vector::{along, angle_between, cross, dot, norm, sub};
use crate::sheet::matrix3::{
    IDENTITY, Matrix3, orthonormal, outer, plus, product, rotation, times,
};

/// A gripper.
#[derive(Debug, Clone, PartialEq)]
pub struct Gripper {
    /// Fabric coordinates of its middle (m).
    pub place: [f64; 2],
    /// Radius of its pad (m); zero holds one point.
    pub radius: f64,
    /// Stiffness of its mount along x, y and z (N/m); `None` if rigid.
    pub mount: Option<[f64; 3]>,
    /// Largest load along the ply that its pad holds (N); beyond it the fabric slides. `None` if it never does.
    pub slip_force: Option<f64>,
    /// Largest tilt of its pad (rad).
    pub max_tilt: f64,
    /// The fabric under its lip, on which it acts as long as it holds the ply; nothing if it has none.
    pub lip: Under,
}

/// What a mount does to the fabric that it holds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hold {
    /// Energy of the spring (J); of fabric that slides, with the work against the slip force.
    pub energy: f64,
    /// Force of the ply on the mount (N).
    pub force: [f64; 3],
    /// Derivative to the place of the fabric (N/m); of fabric that slides, symmetric positive part.
    pub stiffness: Matrix3,
    /// By how much the fabric slides more than before (m).
    pub slides: [f64; 3],
}

impl Gripper {
    /// What its mount does where the fabric that it holds is at a place (m); `None` for a rigid one.
    ///
    /// The mount is a spring. What it pulls along the pad is at most the slip force: beyond it the fabric slides under the
    /// pad, by as much as leaves the slip force in the spring.
    pub fn hold(&self, pad: &Pad, at: [f64; 3]) -> Option<Hold> {
        let k = self.mount?;
        let spring = |off: [f64; 3]| [0, 1, 2].map(|n| k[n] * off[n]);
        let off = sub(sub(at, pad.target), pad.slip);
        let force = spring(off);
        let energy = (0..3).map(|n| 0.5 * k[n] * off[n] * off[n]).sum();
        let stiffness = [[k[0], 0.0, 0.0], [0.0, k[1], 0.0], [0.0, 0.0, k[2]]];
        let normal = pad.normal();
        let load = along(force, -dot(force, normal), normal);
        let size = norm(load);
        let Some(most) = self.slip_force.filter(|most| size > *most) else {
            return Some(Hold { energy, force, stiffness, slides: [0.0; 3] });
        };
        let way = load.map(|c| c / size);
        let aside = cross(normal, way);
        let [along_way, along_aside] = [way, aside].map(|unit| dot(spring(unit), unit));
        // along the way the force stays, aside it only turns
        let stiffness = plus(&stiffness, -along_way, &outer(way, way));
        let stiffness = plus(&stiffness, -along_aside * (1.0 - most / size), &outer(aside, aside));
        let beyond = size - most;
        Some(Hold {
            energy: energy - 0.5 * beyond * beyond / along_way,
            force: along(force, -beyond, way),
            stiffness,
            slides: way.map(|c| c * beyond / along_way),
        })
    }
}

/// A gripper's pad in space.
#[derive(Debug, Clone, PartialEq)]
pub struct Pad {
    /// Middle (m).
    pub position: [f64; 3],
    /// Where the robot holds the mount (m); the same if it is rigid.
    pub target: [f64; 3],
    /// How far the fabric has slid under it (m).
    pub slip: [f64; 3],
    /// Direction of the stem that its joint tilts from (unit vector): upright unless a tool turns it.
    pub stem: [f64; 3],
    /// Turn: the rows of u, v and normal are the columns of this matrix.
    pub turn: Matrix3,
}

impl Pad {
    /// At a place, not turned.
    pub fn new(position: [f64; 3]) -> Self {
        let (slip, stem) = ([0.0; 3], [0.0, 0.0, 1.0]);
        Pad { position, target: position, slip, stem, turn: IDENTITY }
    }

    /// The arm of a fabric point `off` (m) from the pad's middle.
    pub fn arm(&self, off: [f64; 2]) -> [f64; 3] {
        times(&self.turn, [off[0], off[1], 0.0])
    }

    /// Turns it by |w| (rad) about w.
    pub fn rotate(&mut self, w: [f64; 3]) {
        self.turn = orthonormal(&product(&rotation(w), &self.turn));
    }

    /// Unit normal.
    pub fn normal(&self) -> [f64; 3] {
        times(&self.turn, [0.0, 0.0, 1.0])
    }

    /// Turn as a unit quaternion (x, y, z, w).
    #[must_use]
    pub fn quaternion(&self) -> [f64; 4] {
        quaternion([0, 1, 2].map(|axis| self.turn.map(|row| row[axis])))
    }

    /// Angle between its normal and its stem (rad).
    pub fn tilt(&self) -> f64 {
        angle_between(self.normal(), self.stem)
    }
}
