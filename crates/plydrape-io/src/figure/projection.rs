//! From space to the sheet: a parallel projection from above and to the right, z up.
//!
//! A parallel projection keeps equal lengths equal along each axis, so that the grid can be measured.

use super::canvas::Px;

/// A point in space (m).
pub(super) type Point = [f64; 3];

/// Elevation of the view above the horizontal (°).
const ELEVATION: f64 = 32.0;
/// Angle of the view from the shorter horizontal axis (°): the longer one runs across the sheet.
const TURN: f64 = 17.0;

/// Ratio of the sides from which on a box counts as wide.
const SQUARE: f64 = 0.8;

/// The view of one panel.
#[derive(Debug, Clone, Copy)]
pub(super) struct View {
    right: Point,
    up: Point,
    near: Point,
    /// Exaggeration of z.
    stretch: f64,
    /// Picture points per meter.
    scale: f64,
    /// Where the origin of space falls on the sheet.
    origin: Px,
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

impl View {
    /// The view of a box (m), z stretched, at one picture point per meter.
    pub(super) fn of(low: Point, high: Point, stretch: f64) -> Self {
        // what is all but square counts as wide, so that drapes of one scene are seen from one side
        let wide = high[0] - low[0] >= (high[1] - low[1]) * SQUARE;
        let azimuth = if wide { TURN - 90.0 } else { -TURN };
        let (sa, ca) = azimuth.to_radians().sin_cos();
        let (se, ce) = ELEVATION.to_radians().sin_cos();
        View {
            right: [-sa, ca, 0.0],
            up: [-ca * se, -sa * se, ce],
            near: [ca * ce, sa * ce, se],
            stretch,
            scale: 1.0,
            origin: [0.0, 0.0],
        }
    }

    /// The same view with its own scale and origin.
    pub(super) fn placed(self, scale: f64, origin: Px) -> Self {
        View { scale, origin, ..self }
    }

    /// Picture points per meter.
    pub(super) fn scale(&self) -> f64 {
        self.scale
    }

    /// The direction from space to the eye, where z is not stretched.
    pub(super) fn towards(&self) -> Point {
        self.near
    }

    /// Unit vectors to the right of the sheet, up on it and out of it.
    pub(super) fn axes(&self) -> [Point; 3] {
        [self.right, self.up, self.near]
    }

    fn stretched(&self, p: Point) -> Point {
        [p[0], p[1], p[2] * self.stretch]
    }

    /// Where a point falls on the sheet.
    pub(super) fn at(&self, p: Point) -> Px {
        let p = self.stretched(p);
        [
            self.origin[0] + self.scale * dot(p, self.right),
            self.origin[1] - self.scale * dot(p, self.up),
        ]
    }

    /// How near a point is to the eye (m); larger is nearer.
    pub(super) fn depth(&self, p: Point) -> f64 {
        dot(self.stretched(p), self.near)
    }

    /// The smallest rectangle on the sheet around a box in space: its upper left and lower right.
    pub(super) fn extent(&self, low: Point, high: Point) -> [Px; 2] {
        let mut extent = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
        for corner in 0..8 {
            let pick = |axis: usize| {
                if corner >> axis & 1 == 0 { low[axis] } else { high[axis] }
            };
            let at = self.at([pick(0), pick(1), pick(2)]);
            for axis in 0..2 {
                extent[0][axis] = extent[0][axis].min(at[axis]);
                extent[1][axis] = extent[1][axis].max(at[axis]);
            }
        }
        extent
    }
}

/// A vector turned by a unit quaternion (x, y, z, w).
pub(super) fn turned([qx, qy, qz, qw]: [f64; 4], v: Point) -> Point {
    let cross = |a: Point, b: Point| {
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    };
    let q = [qx, qy, qz];
    let t = cross(q, v).map(|c| 2.0 * c);
    let u = cross(q, t);
    [0, 1, 2].map(|c| v[c] + qw * t[c] + u[c])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A quarter turn about z takes x to y.
    #[test]
    fn a_quarter_turn_about_z_takes_x_to_y() {
        let half = std::f64::consts::FRAC_1_SQRT_2;
        let y = turned([0.0, 0.0, half, half], [1.0, 0.0, 0.0]);
        for (found, expected) in y.iter().zip([0.0, 1.0, 0.0]) {
            assert!((found - expected).abs() < 1e-15);
        }
    }

    /// Up in space is up on the sheet; the front corner of a box is nearer than the back one.
    #[test]
    fn up_is_up_and_front_is_near() {
        for high in [[0.3, 0.1, 0.1], [0.1, 0.3, 0.1]] {
            let view = View::of([0.0; 3], high, 1.0).placed(1000.0, [0.0, 0.0]);
            assert!(view.at([0.0, 0.0, 0.1])[1] < view.at([0.0; 3])[1]);
            assert!(view.depth([high[0], 0.0, 0.0]) > view.depth([0.0, high[1], 0.0]));
        }
    }
}
