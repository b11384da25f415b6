//! How an array is turned on its way: the rotation that fits it best to another array (Kabsch 1976), and all rotations
//! in between.

use crate::geometry::Point;
use crate::geometry::vector::{along, cross, dot, norm, sub, unit};
use crate::ply::{Ply, directions};
pub use crate::sheet::matrix3::times as turned;
use crate::sheet::matrix3::{Matrix3, product, transposed};

/// A rotation as the rows of its matrix.
pub type Rotation = Matrix3;

/// Rounds of Newton's method for the best rotation; from the right heading it takes five to ten.
const ROUNDS: usize = 50;
/// Share of the array's moments of inertia that keeps a line of grippers, which may turn about itself, from doing so.
const LINE: f64 = 1e-6;

/// The rotations from one array to another: the heading changes the shorter way, the normal on a great circle, but never
/// away from the vertical.
#[derive(Debug, Clone, Copy)]
pub struct Turn {
    /// Unit normals of the array at both ends of the way.
    normals: [Point; 2],
    /// Change of heading, −π to π (rad).
    heading: f64,
}

impl Turn {
    /// The turn of an array from some places to others (m).
    pub fn new(ply: &Ply, from: &[Point], to: &[Point]) -> Self {
        let whole = best_rotation(from, to);
        let normal = normal(ply, from);
        let mut normals = [normal, turned(&whole, normal)];
        // what is left of it between the two upright positions is a rotation about z
        let upright = turned(&whole, turned(&inclined(normals[0]), [1.0, 0.0, 0.0]));
        let [x, y, _] = turned(&transposed(&inclined(normals[1])), upright);
        // the ply hangs slack while it is carried, and an inclined array adds to the tilt of its grippers
        if normals[1][2] < normals[0][2] {
            normals[1] = normals[0];
        }
        Turn { normals, heading: y.atan2(x) }
    }

    /// The rotation after a share of the way.
    pub fn at(&self, share: f64) -> Rotation {
        let [from, to] = self.normals;
        let (sin, cos) = (share * self.heading).sin_cos();
        let heading = [[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]];
        let upright = product(&heading, &transposed(&inclined(from)));
        product(&inclined(great_circle(from, to, share)), &upright)
    }

    /// Angle of the whole turn (rad), of heading and normal together.
    pub fn angle(&self) -> f64 {
        let [from, to] = self.normals;
        self.heading.abs() + norm(cross(from, to)).atan2(dot(from, to))
    }
}

/// The mean of some places (m).
pub fn center(places: &[Point]) -> Point {
    let sum = places.iter().fold([0.0; 3], |sum, p| along(sum, 1.0, *p));
    sum.map(|c| c / places.len() as f64)
}

/// The rotation R that makes Σ |R (a − ā) − (b − b̄)|² smallest.
///
/// Newton's method for the trace of Rᵀ B with B = Σ (b − b̄)(a − ā)ᵀ, from the rotation about z that is best.
fn best_rotation(from: &[Point], to: &[Point]) -> Rotation {
    let (here, there) = (center(from), center(to));
    let mut moments = [[0.0; 3]; 3];
    for (a, b) in from.iter().zip(to) {
        let (a, b) = (sub(*a, here), sub(*b, there));
        for n in 0..3 {
            moments[n] = along(moments[n], b[n], a);
        }
    }
    let heading = (moments[1][0] - moments[0][1]).atan2(moments[0][0] + moments[1][1]);
    let mut rotation = rotation_about([0.0, 0.0, heading]);
    for _ in 0..ROUNDS {
        let m = product(&moments, &transposed(&rotation));
        let torque = [m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]];
        let trace = m[0][0] + m[1][1] + m[2][2];
        let stiffness = |r: usize, c: usize| {
            let own = if r == c { trace + LINE * trace.abs() } else { 0.0 };
            own - 0.5 * (m[r][c] + m[c][r])
        };
        let rows = [0, 1, 2].map(|r| [0, 1, 2].map(|c| stiffness(r, c)));
        let Some(step) = solve(&rows, torque) else { break };
        let size = norm(step);
        rotation = product(&rotation_about(step.map(|c| c / size.max(1.0))), &rotation);
        if size < 1e-14 {
            break;
        }
    }
    rotation
}

/// Normal of an array, upwards; of a line of grippers the steepest one.
fn normal(ply: &Ply, places: &[Point]) -> Point {
    let upwards = [0.0, 0.0, 1.0];
    let [u, v] = directions(ply, places);
    let normal = unit(cross(u, v)).unwrap_or(upwards);
    if normal[2] < 0.0 { normal.map(|c| -c) } else { normal }
}

/// The unit vector a share of the way from one to another on their great circle.
fn great_circle(from: Point, to: Point, share: f64) -> Point {
    let axis = cross(from, to);
    let (sin, cos) = (norm(axis), dot(from, to));
    let Some(axis) = unit(axis) else { return from };
    turned(&rotation_about(axis.map(|c| share * sin.atan2(cos) * c)), from)
}

/// The least rotation that takes the z axis to a unit normal, which does not point straight down.
fn inclined([x, y, z]: Point) -> Rotation {
    let f = 1.0 / (1.0 + z).max(f64::EPSILON);
    [[1.0 - f * x * x, -f * x * y, x], [-f * x * y, 1.0 - f * y * y, y], [-x, -y, z]]
}

/// The rotation by the length of a vector (rad) about it, after Rodrigues.
fn rotation_about(vector: Point) -> Rotation {
    let angle = norm(vector);
    let (sin, cos) = angle.sin_cos();
    let axis = if angle > 0.0 { vector.map(|c| c / angle) } else { [0.0; 3] };
    let column = |n: usize| {
        let mut e = [0.0; 3];
        e[n] = 1.0;
        let side = cross(axis, e);
        [0, 1, 2].map(|k| cos * e[k] + sin * side[k] + (1.0 - cos) * axis[n] * axis[k])
    };
    transposed(&[column(0), column(1), column(2)])
}

/// The solution of three equations by Cramer's rule; `None` if they are singular.
fn solve(rows: &Rotation, right: Point) -> Option<Point> {
    let [a, b, c] = *rows;
    let determinant = dot(a, cross(b, c));
    let [p, q, r] = [cross(b, c), cross(c, a), cross(a, b)];
    let solution =
        [0, 1, 2].map(|n| (right[0] * p[n] + right[1] * q[n] + right[2] * r[n]) / determinant);
    solution.iter().all(|x| x.is_finite()).then_some(solution)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::planner::sample::cloth;
    use crate::ply::Grid;
    use std::f64::consts::{PI, TAU};

    const GRID: Grid = Grid { nu: 4, nv: 3 };

    fn array(grid: Grid) -> Vec<Point> {
        let place = |n: usize| {
            let [i, j] = grid.id(n).map(|k| k as f64);
            [0.1 * i + 0.3, 0.12 * j - 0.2, 0.02 * (i * j).sin()]
        };
        (0..grid.grippers()).map(place).collect()
    }

    fn all(rotation: &Rotation, places: &[Point]) -> Vec<Point> {
        places.iter().map(|p| along([2.0, 0.3, -0.1], 1.0, turned(rotation, *p))).collect()
    }

    /// An array that is turned about any axis by up to two thirds of a half turn, and moved, is found as it was turned.
    #[test]
    fn the_rotation_of_a_turned_array_is_found() {
        let places = array(GRID);
        for vector in [[0.0, 0.0, 2.0], [0.3, -0.2, -1.9], [0.9, 0.4, 0.1], [0.0, -1.2, 0.0]] {
            let rotation = rotation_about(vector);
            let found = best_rotation(&places, &all(&rotation, &places));
            let off = (0..9).map(|n| (found[n / 3][n % 3] - rotation[n / 3][n % 3]).abs());
            assert!(off.fold(0.0, f64::max) < 1e-12, "{vector:?}: {found:?} {rotation:?}");
        }
    }

    /// The turn begins as no rotation, ends as the best one if that is upright, and is a rotation everywhere between.
    #[test]
    fn a_turn_goes_from_one_array_to_the_other() {
        let there = array(GRID);
        let places = all(&rotation_about([0.3, -0.2, 1.1]), &there);
        let turn = Turn::new(&cloth(GRID), &places, &there);
        for (share, expected) in [(0.0, &places), (1.0, &there)] {
            let (from, to) = (center(&places), center(expected));
            for (p, q) in places.iter().zip(expected) {
                let off = norm(sub(turned(&turn.at(share), sub(*p, from)), sub(*q, to)));
                assert!(off < 1e-12, "{share}: {off} m");
            }
        }
        for k in 0..=10 {
            let rotation = turn.at(f64::from(k) / 10.0);
            let square = product(&rotation, &transposed(&rotation));
            let off =
                (0..9).map(|n| (square[n / 3][n % 3] - f64::from(u8::from(n % 4 == 0))).abs());
            assert!(off.fold(0.0, f64::max) < 1e-12, "{square:?}");
        }
    }

    /// An array that shall end inclined is carried as upright as it was.
    #[test]
    fn no_array_is_inclined_on_its_way() {
        let places = array(GRID);
        let there = all(&rotation_about([0.3, -0.2, 1.1]), &places);
        let turn = Turn::new(&cloth(GRID), &places, &there);
        for k in 0..=10 {
            let up = turned(&turn.at(f64::from(k) / 10.0), turn.normals[0]);
            assert!((up[2] - turn.normals[0][2]).abs() < 1e-12, "{k}: {up:?}");
        }
    }

    /// A heading of 300° more is one of 60° less, from any start.
    #[test]
    fn the_heading_takes_the_shorter_way() {
        let places = array(GRID);
        for (from, by) in [(0.0, 5.0), (2.0, -4.0), (-3.0, 3.5), (1.0, 1.0)] {
            let start = all(&rotation_about([0.0, 0.0, from]), &places);
            let end = all(&rotation_about([0.0, 0.0, from + by]), &places);
            let turn = Turn::new(&cloth(GRID), &start, &end);
            let shorter = (by + PI).rem_euclid(TAU) - PI;
            assert!((turn.heading - shorter).abs() < 1e-12, "{by}: {}", turn.heading);
        }
    }

    /// A strip of grippers that climbs is made level, and keeps its normal as steep as it can: it does not turn about its own
    /// line.
    #[test]
    fn a_strip_does_not_turn_about_itself() {
        for grid in [Grid { nu: 5, nv: 1 }, Grid { nu: 1, nv: 5 }] {
            let level: Vec<Point> = (0..5).map(|k| [0.1 * f64::from(k), 0.0, 0.0]).collect();
            let climbing = all(&rotation_about([0.0, -0.3, 0.7]), &level);
            let turn = Turn::new(&cloth(grid), &climbing, &level);
            let [x, y, z] = unit(sub(climbing[4], climbing[0])).expect("a line");
            assert!((turn.heading + y.atan2(x)).abs() < 1e-9, "{turn:?}");
            // a normal of a line that climbs by an angle is no steeper than this angle allows
            let [before, after] = [0.0, 1.0].map(|t| turned(&turn.at(t), turn.normals[0]));
            assert!((before[2] - z.asin().cos()).abs() < 1e-9, "{turn:?} {before:?}");
            assert!((after[2] - 1.0).abs() < 1e-9, "{turn:?} {after:?}");
        }
    }
}
