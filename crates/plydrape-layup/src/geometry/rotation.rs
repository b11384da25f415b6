//! Rotations as unit quaternions (x, y, z, w): of given axes, of a surface with a direction on it, and continued in sign.

use super::Point;
use super::vector::{cross, dot, unit};

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

/// The x axis of an orientation (x, y, z, w).
pub fn x_axis([x, y, z, w]: [f64; 4]) -> Point {
    [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + z * w), 2.0 * (x * z - y * w)]
}

/// The z axis of an orientation (x, y, z, w): of a pad the unit normal of the ply.
#[must_use]
pub fn normal([x, y, z, w]: [f64; 4]) -> Point {
    [2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y)]
}

/// The orientation (x, y, z, w) with its z axis along a unit normal and its x axis as near to `along` as that allows.
#[must_use]
pub fn oriented(normal: Point, along: Point) -> [f64; 4] {
    let aside = dot(along, normal);
    let x = unit([0, 1, 2].map(|n| along[n] - aside * normal[n])).unwrap_or([1.0, 0.0, 0.0]);
    quaternion([x, cross(normal, x), normal])
}

/// The orientation (x, y, z, w) of a surface with two tangents: z along the normal that points upwards, x along the first tangent.
#[must_use]
pub fn of_tangents(along_u: Point, along_v: Point) -> [f64; 4] {
    let up = [0.0, 0.0, 1.0];
    let normal =
        unit(cross(along_u, along_v)).map_or(up, |n| if n[2] < 0.0 { n.map(|x| -x) } else { n });
    oriented(normal, unit(along_u).unwrap_or([1.0, 0.0, 0.0]))
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
