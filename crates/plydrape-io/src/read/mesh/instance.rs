//! Where an Abaqus instance puts its part: moved, then turned about an axis.

use plydrape::geometry::vector::{along, cross, direction, dot, sub};

/// A translation and, after it, a rotation about the axis from `a` to `b`.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Placing {
    translation: [f64; 3],
    axis: Option<([f64; 3], [f64; 3])>,
    angle_deg: f64,
}

impl Placing {
    /// What the data lines of an instance should be.
    pub const EXPECTED: [&str; 3] = [
        "a translation: `x, y, z`",
        "a rotation: two points of its axis and an angle, `ax, ay, az, bx, by, bz, degrees`",
        "`*End Instance`",
    ];

    /// Takes in the data line with this index; false if it is not as [`Self::EXPECTED`].
    pub fn line(&mut self, index: usize, values: &[f64]) -> bool {
        match (index, values) {
            (0, &[x, y, z]) => self.translation = [x, y, z],
            (1, &[ax, ay, az, bx, by, bz, angle]) => {
                let (a, b) = ([ax, ay, az], [bx, by, bz]);
                let Some(axis) = direction(sub(b, a)) else { return false };
                self.axis = Some((a, axis));
                self.angle_deg = angle;
            }
            _ => return false,
        }
        true
    }
}

/// A point of the part, placed.
pub(super) fn turned(point: [f64; 3], placing: &Placing) -> [f64; 3] {
    let moved = along(point, 1.0, placing.translation);
    let Some((a, axis)) = placing.axis else { return moved };
    // Rodrigues' rotation of the arm
    let arm = sub(moved, a);
    let (sin, cos) = placing.angle_deg.to_radians().sin_cos();
    let across = cross(axis, arm);
    let lengthwise = (1.0 - cos) * dot(axis, arm);
    [0, 1, 2].map(|n| a[n] + cos * arm[n] + sin * across[n] + lengthwise * axis[n])
}
