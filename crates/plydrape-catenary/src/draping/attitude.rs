//! How a gripper is tilted: its ball joint follows the ply, and a pad without a joint the frame that carries it.

use super::tuning::TUNING;
use crate::equilibrium::{Solver, heading};
use crate::geometry::Point;
use crate::geometry::rotation::{continued, normal, of_tangents, oriented, x_axis};
use crate::geometry::vector::unit;
use crate::ply::{Grid, Neighbors, Ply, tangents};

/// Slopes of the ply at a gripper and the orientation that follows from them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Attitude {
    /// Slope along u and along v; `None` where the ply has no edge in that direction.
    pub slope: [Option<f64>; 2],
    /// Angle between the ply's normal and the stem of the gripper, which is upright unless a tool turns it (rad), or the normal of its
    /// pad where that has no joint.
    pub tilt: f64,
    /// Orientation of the pad (x, y, z, w): z axis along the ply's normal, x axis along u; that of the frame where it has no joint.
    pub quaternion: [f64; 4],
}

impl Attitude {
    /// The attitude of this gripper at a height over a mold (m): as it comes down it turns to the mold's normal, which it has where it stands.
    #[must_use]
    pub fn landing(
        self,
        height: f64,
        mold: Point,
        tolerance: f64,
        before: Option<[f64; 4]>,
    ) -> Self {
        let [low, high] = TUNING.landing_heights.map(|heights| heights * tolerance);
        let t = ((high - height) / (high - low)).clamp(0.0, 1.0);
        let share = t * t * (3.0 - 2.0 * t);
        if share == 0.0 {
            return self;
        }
        let own = normal(self.quaternion);
        let mixed = [0, 1, 2].map(|n| (1.0 - share) * own[n] + share * mold[n]);
        let mixed = unit(mixed).unwrap_or(own);
        let quaternion = continued(oriented(mixed, x_axis(self.quaternion)), before);
        Attitude { slope: self.slope, tilt: mixed[2].clamp(-1.0, 1.0).acos(), quaternion }
    }
}

/// The attitude of a gripper; the quaternion's sign continues `before`. `neighbors` are those of the ply; they count where
/// no catenaries hang.
pub fn attitude(
    solver: &Solver,
    ply: &Ply,
    neighbors: &[Neighbors],
    positions: &[Point],
    gripper: usize,
    before: Option<[f64; 4]>,
) -> Attitude {
    let lines = solver.lines();
    let slope = [0, 1].map(|d| solver.gripper_slope(positions, gripper, d));
    if ply.grid == Grid::NONE && slope.contains(&None) {
        // no fiber line runs through it along u or along v: there its neighbors say how it is tilted
        let mut along = tangents(ply, neighbors, positions, gripper);
        for d in 0..2 {
            if let (Some([x, y]), Some(slope)) = (heading(lines, positions, gripper, d), slope[d]) {
                along[d] = [x, y, slope];
            }
        }
        return across(along[0], along[1], slope, before);
    }
    let u = heading(lines, positions, gripper, 0).unwrap_or([1.0, 0.0]);
    // a strip has no v: across it the gripper is level
    let v = heading(lines, positions, gripper, 1).unwrap_or([-u[1], u[0]]);
    let tangent = |h: [f64; 2], s: Option<f64>| [h[0], h[1], s.unwrap_or(0.0)];
    across(tangent(u, slope[0]), tangent(v, slope[1]), slope, before)
}

/// The attitude of a gripper at which u and v run along two tangents.
fn across(
    along_u: Point,
    along_v: Point,
    slope: [Option<f64>; 2],
    before: Option<[f64; 4]>,
) -> Attitude {
    let quaternion = continued(of_tangents(along_u, along_v), before);
    Attitude { slope, tilt: upright_angle(quaternion), quaternion }
}

/// Angle between the z axis of an orientation (x, y, z, w) and the vertical (rad).
fn upright_angle(quaternion: [f64; 4]) -> f64 {
    normal(quaternion)[2].clamp(-1.0, 1.0).acos()
}
