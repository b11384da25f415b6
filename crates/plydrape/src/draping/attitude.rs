//! How a gripper is tilted: its ball joint follows the ply, and a pad without a joint the frame that carries it.

use super::spans::Point;
use super::tuning::TUNING;
use crate::equilibrium::{Solver, heading};
use crate::mold::vector::{cross, dot, unit};
use crate::ply::{Grid, Neighbours, Ply, tangents};

/// Slopes of the ply at a gripper and the orientation that follows from them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Attitude {
    /// Slope along u and along v; none where the ply has no edge in that direction.
    pub slope: [Option<f64>; 2],
    /// Angle between the ply's normal and the stem of the gripper, which is upright unless a tool turns it (rad), or the normal of its
    /// pad where that has no joint.
    pub tilt: f64,
    /// Orientation of the pad (x, y, z, w): z axis along the ply's normal, x axis along u; that of the frame where it has no joint.
    pub quaternion: [f64; 4],
}

impl Attitude {
    /// The same gripper at a height over a mold (m): as it comes down it turns to the mold's normal, which it has where it stands.
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
        let normal = unit(mixed).unwrap_or(own);
        Attitude { slope: self.slope, ..oriented(normal, x_axis(self.quaternion), before) }
    }
}

/// The attitude of a gripper; the quaternion's sign continues `before`. `neighbours` are those of the ply; they count where
/// no catenaries hang.
pub fn attitude(
    solver: &Solver,
    ply: &Ply,
    neighbours: &[Neighbours],
    positions: &[Point],
    gripper: usize,
    before: Option<[f64; 4]>,
) -> Attitude {
    let lines = solver.lines();
    let slope = [0, 1].map(|d| solver.gripper_slope(positions, gripper, d));
    if ply.grid == Grid::NONE && slope.contains(&None) {
        // no fibre line runs through it along u or along v: there its neighbours say how it is tilted
        let mut along = tangents(ply, neighbours, positions, gripper);
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

/// How each gripper is turned (x, y, z, w) by the lines to its neighbors, whatever the ply between them does.
#[must_use]
pub fn by_neighbours(ply: &Ply, neighbours: &[Neighbours], positions: &[Point]) -> Vec<[f64; 4]> {
    let one = |n: usize| {
        let [u, v] = tangents(ply, neighbours, positions, n);
        across(u, v, [None; 2], None).quaternion
    };
    (0..positions.len()).map(one).collect()
}

/// An orientation (x, y, z, w) turned so that its z axis is along a unit normal, its x axis as near to what it was as that allows.
#[must_use]
pub fn on_normal(turned: [f64; 4], normal: Point) -> [f64; 4] {
    oriented(normal, x_axis(turned), None).quaternion
}

/// The attitude of a gripper at which u and v run along two tangents.
fn across(
    along_u: Point,
    along_v: Point,
    slope: [Option<f64>; 2],
    before: Option<[f64; 4]>,
) -> Attitude {
    let up = [0.0, 0.0, 1.0];
    let normal =
        unit(cross(along_u, along_v)).map_or(up, |n| if n[2] < 0.0 { n.map(|x| -x) } else { n });
    let x = unit(along_u).unwrap_or([1.0, 0.0, 0.0]);
    Attitude { slope, ..oriented(normal, x, before) }
}

/// With its z axis along a unit normal and its x axis as near to `along` as that allows.
fn oriented(normal: Point, along: Point, before: Option<[f64; 4]>) -> Attitude {
    let aside = dot(along, normal);
    let x = unit([0, 1, 2].map(|n| along[n] - aside * normal[n])).unwrap_or([1.0, 0.0, 0.0]);
    let quaternion = continued(quaternion([x, cross(normal, x), normal]), before);
    Attitude { slope: [None; 2], tilt: normal[2].clamp(-1.0, 1.0).acos(), quaternion }
}

/// An orientation (x, y, z, w) with the sign that continues the one before.
#[must_use]
pub fn continued(quaternion: [f64; 4], before: Option<[f64; 4]>) -> [f64; 4] {
    let cosine = |before: [f64; 4]| quaternion.iter().zip(before).map(|(a, b)| a * b).sum::<f64>();
    if before.is_some_and(|before| cosine(before) < 0.0) {
        return quaternion.map(|c| -c);
    }
    quaternion
}

/// The x axis of an orientation (x, y, z, w).
fn x_axis([x, y, z, w]: [f64; 4]) -> Point {
    [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + z * w), 2.0 * (x * z - y * w)]
}

/// Unit normal of the ply at a gripper: the z axis of its orientation (x, y, z, w).
#[must_use]
pub fn normal([x, y, z, w]: [f64; 4]) -> Point {
    [2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y)]
}

/// Unit quaternion (x, y, z, w) of the rotation whose columns are the given axes.
pub fn quaternion([x, y, z]: [Point; 3]) -> [f64; 4] {
    let trace = x[0] + y[1] + z[2];
    let q = if trace > 0.0 {
        [y[2] - z[1], z[0] - x[2], x[1] - y[0], 1.0 + trace]
    } else if x[0] >= y[1] && x[0] >= z[2] {
        [1.0 + x[0] - y[1] - z[2], y[0] + x[1], z[0] + x[2], y[2] - z[1]]
    } else if y[1] >= z[2] {
        [y[0] + x[1], 1.0 + y[1] - x[0] - z[2], z[1] + y[2], z[0] - x[2]]
    } else {
        [z[0] + x[2], z[1] + y[2], 1.0 + z[2] - x[0] - y[1], x[1] - y[0]]
    };
    let length = q.iter().map(|c| c * c).sum::<f64>().sqrt();
    q.map(|c| c / length)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A quaternion turns the unit vectors into the axes it was made of, from any of its four branches.
    #[test]
    fn a_quaternion_turns_the_unit_vectors_into_the_axes() {
        let (s, c) = 0.6_f64.sin_cos();
        let flip = |a: Point| [a[0], -a[1], -a[2]];
        let axes = [[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]];
        let cases = [
            axes,
            [axes[1], axes[2], axes[0]],
            axes.map(flip),
            [[-c, -s, 0.0], [s, -c, 0.0], [0.0, 0.0, 1.0]],
            [[-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]],
        ];
        for axes in cases {
            let [x, y, z, w] = quaternion(axes);
            let turned = [
                [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + z * w), 2.0 * (x * z - y * w)],
                [2.0 * (x * y - z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + x * w)],
                [2.0 * (x * z + y * w), 2.0 * (y * z - x * w), 1.0 - 2.0 * (x * x + y * y)],
            ];
            for (a, b) in turned.iter().flatten().zip(axes.iter().flatten()) {
                assert!((a - b).abs() < 1e-15, "{axes:?} {turned:?}");
            }
        }
    }
}
