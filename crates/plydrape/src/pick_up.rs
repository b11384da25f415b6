//! Where the ply lies when it is picked up, as a camera sees it: a shift and a turn from where it was planned.
//!
//! A turn φ about an upright axis through c, and a shift d, bring a point p to `p + d + (R(φ) − 1)(p − c)`. With
//! `R − 1 = (−2 sin²(φ/2), −sin φ; sin φ, −2 sin²(φ/2))` it is exactly p where both are zero. The ply's shape, its forces and its
//! weight are the same before and after.
//!
//! From points, the motion is the one with the least squares of what is left: the middles of both sets come to lie on each other,
//! and `tan φ = Σ (p × q) / Σ (p · q)` over the points as seen from their middles (Umeyama 1991, in the plane).

use crate::Error;
use crate::ply::FARTHEST;

/// A place in plan (m).
type Place = [f64; 2];

/// How far the ply lies from where it was planned: turned about an upright axis, then shifted.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Offset {
    /// Shift along x and y (m).
    pub shift: [f64; 2],
    /// Turn about the upright axis (rad), from x to y.
    pub yaw: f64,
    /// Where the axis is (m); `None` for the middle of the grippers at the start.
    pub about: Option<[f64; 2]>,
}

impl Offset {
    /// The offset with the least squares, from pairs of where points were planned and where they were seen (m), and what it leaves:
    /// the largest distance of a point from where it puts it (m).
    ///
    /// # Errors
    /// [`Error::OffsetTooFew`] for fewer than two points, [`Error::OffsetTooClose`] if all are within `tolerance` (m) of their middle,
    /// [`Error::OffsetDistorted`] if one is left farther than that.
    pub fn of_points(pairs: &[(Place, Place)], tolerance: f64) -> Result<(Self, f64), Error> {
        if pairs.len() < 2 {
            return Err(Error::OffsetTooFew { found: pairs.len() });
        }
        let count = pairs.len() as f64;
        let middle = |place: &dyn Fn(&(Place, Place)) -> Place| {
            [0, 1].map(|c| pairs.iter().map(|pair| place(pair)[c]).sum::<f64>() / count)
        };
        let (planned, seen) = (middle(&|pair| pair.0), middle(&|pair| pair.1));
        let from = |p: Place, middle: Place| [p[0] - middle[0], p[1] - middle[1]];
        let reach = pairs.iter().map(|(p, _)| length(from(*p, planned))).fold(0.0, f64::max);
        if reach <= tolerance || !reach.is_finite() {
            return Err(Error::OffsetTooClose { reach, tolerance });
        }
        let (mut sine, mut cosine) = (0.0, 0.0);
        for (p, q) in pairs {
            let ([a, b], [c, d]) = (from(*p, planned), from(*q, seen));
            sine += a * d - b * c;
            cosine += a * c + b * d;
        }
        let offset =
            Offset { shift: from(seen, planned), yaw: sine.atan2(cosine), about: Some(planned) };
        let moved = Moved::new(planned, offset.shift, offset.yaw);
        let left = pairs.iter().map(|(p, q)| {
            let [x, y, _] = moved.place([p[0], p[1], 0.0]);
            let left = length([x - q[0], y - q[1]]);
            // what is no number fits nowhere
            if left.is_finite() { left } else { f64::INFINITY }
        });
        let (point, residual) = left
            .enumerate()
            .fold((0, 0.0), |most: (usize, f64), next| if next.1 > most.1 { next } else { most });
        if residual <= tolerance {
            Ok((offset, residual))
        } else {
            Err(Error::OffsetDistorted { point, residual, tolerance })
        }
    }

    /// Whether all of it is a number up to 10⁶ m and half a turn.
    #[must_use]
    pub fn is_near(&self) -> bool {
        let about = self.about.unwrap_or_default();
        let near = self.shift.iter().chain(&about).all(|c| c.abs() <= FARTHEST);
        near && self.yaw.abs() <= std::f64::consts::PI
    }

    /// This offset about the axis through a point (m): the shift is then that of this point.
    #[must_use]
    pub fn about(&self, point: Place) -> Offset {
        let given = Moved::new(self.about.unwrap_or(point), self.shift, self.yaw);
        let [x, y, _] = given.displacement([point[0], point[1], 0.0]);
        Offset { shift: [x, y], yaw: self.yaw, about: Some(point) }
    }
}

fn length([x, y]: Place) -> f64 {
    x.hypot(y)
}

/// A turn about an upright axis, then a shift.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Moved {
    axis: Place,
    shift: Place,
    /// sin φ.
    sine: f64,
    /// 1 − cos φ.
    versine: f64,
    /// Sine and cosine of φ/2.
    half: [f64; 2],
}

impl Moved {
    /// A turn (rad) about an axis (m), then a shift (m).
    #[must_use]
    pub fn new(axis: Place, shift: Place, yaw: f64) -> Self {
        let (sine, cosine) = (0.5 * yaw).sin_cos();
        Moved { axis, shift, sine: yaw.sin(), versine: 2.0 * sine * sine, half: [sine, cosine] }
    }

    /// Whether it moves nothing.
    #[must_use]
    pub fn is_nothing(&self) -> bool {
        self.shift == [0.0; 2] && self.sine == 0.0 && self.versine == 0.0
    }

    /// How far it moves a point (m).
    #[must_use]
    pub fn displacement(&self, [x, y, _]: [f64; 3]) -> [f64; 3] {
        let [x, y] = [x - self.axis[0], y - self.axis[1]];
        let [dx, dy] = self.shift;
        [dx - self.versine * x - self.sine * y, dy + self.sine * x - self.versine * y, 0.0]
    }

    /// Where it brings a point (m).
    #[must_use]
    pub fn place(&self, p: [f64; 3]) -> [f64; 3] {
        let displacement = self.displacement(p);
        [0, 1, 2].map(|c| p[c] + displacement[c])
    }

    /// What it makes of a vector.
    #[must_use]
    pub fn turn(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        [x - self.versine * x - self.sine * y, y + self.sine * x - self.versine * y, z]
    }

    /// What it makes of an orientation (x, y, z, w).
    #[must_use]
    pub fn orientation(&self, [x, y, z, w]: [f64; 4]) -> [f64; 4] {
        let [s, c] = self.half;
        [c * x - s * y, c * y + s * x, c * z + s * w, c * w - s * z]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mold::Pose;
    use proptest::prelude::*;

    const CORNERS: [Place; 4] = [[0.1, 0.2], [0.7, 0.25], [0.65, 0.9], [0.05, 0.8]];

    proptest! {
        /// Points that were moved by a known turn and shift give both again, to rounding, and leave nothing; about another point the
        /// same offset moves every point alike.
        #[test]
        fn moved_points_give_their_motion_again(
            yaw in -3.1..3.1_f64, x in -0.5..0.5_f64, y in -0.5..0.5_f64, count in 2..5_usize,
        ) {
            let moved = Moved::new([0.3, -0.4], [x, y], yaw);
            let seen = |p: Place| { let [x, y, _] = moved.place([p[0], p[1], 0.0]); [x, y] };
            let pairs: Vec<_> = CORNERS[..count].iter().map(|p| (*p, seen(*p))).collect();
            let (found, residual) = Offset::of_points(&pairs, 1e-3).unwrap();
            prop_assert!((found.yaw - yaw).abs() < 1e-12 && residual < 1e-12, "{found:?}");
            let same = found.about([0.3, -0.4]);
            prop_assert!((same.shift[0] - x).abs() < 1e-12 && (same.shift[1] - y).abs() < 1e-12);
        }

        /// Equal errors of all seen points along both axes are a shift alone, and noise changes the yaw by no more than the noise over the reach.
        #[test]
        fn noise_of_points_is_averaged(noise in prop::collection::vec(-1e-4..1e-4_f64, 8)) {
            let pairs: Vec<_> = CORNERS
                .iter()
                .enumerate()
                .map(|(n, p)| (*p, [p[0] + noise[2 * n], p[1] + noise[2 * n + 1]]))
                .collect();
            let (found, residual) = Offset::of_points(&pairs, 1e-3).unwrap();
            // every point is farther than 0.4 m from the middle
            prop_assert!(found.yaw.abs() < 1.5e-4 / 0.4, "{found:?}");
            prop_assert!(residual < 3e-4);
        }
    }

    /// Two of four points that were swapped fit no rigid motion; one point and points in one place tell no turn.
    #[test]
    fn swapped_points_are_refused() {
        let mut pairs: Vec<_> = CORNERS.iter().map(|p| (*p, *p)).collect();
        (pairs[1].1, pairs[2].1) = (pairs[2].1, pairs[1].1);
        let refused = Offset::of_points(&pairs, 2e-3);
        assert!(matches!(refused, Err(Error::OffsetDistorted { .. })), "{refused:?}");
        assert!(matches!(
            Offset::of_points(&pairs[..1], 2e-3),
            Err(Error::OffsetTooFew { found: 1 })
        ));
        let same = [([0.1, 0.2], [0.3, 0.4]); 3];
        assert!(matches!(Offset::of_points(&same, 2e-3), Err(Error::OffsetTooClose { .. })));
        let none = [([0.1, 0.2], [f64::NAN, 0.4]), ([0.5, 0.2], [0.3, 0.4])];
        assert!(Offset::of_points(&none, 2e-3).is_err());
    }

    /// The turn of points, of vectors and of orientations is one turn, that of a pose; none at all changes no bit.
    #[test]
    fn points_vectors_and_orientations_turn_alike() {
        let moved = Moved::new([0.0; 2], [0.0; 2], 0.7);
        let pose = Pose::new([0.0; 3], [0.0, 0.0, 0.7]);
        let near = |a: [f64; 3], b: [f64; 3]| (0..3).all(|c| (a[c] - b[c]).abs() < 1e-15);
        let v = [0.3, -0.2, 0.5];
        assert!(near(moved.place(v), pose.place(v)) && near(moved.turn(v), pose.turn(v)));
        let tilted = Pose::new([0.0; 3], [0.3, -0.5, 1.1]);
        let turned = Pose::of_quaternion([0.0; 3], moved.orientation(tilted.quaternion()));
        assert!(near(turned.turn(v), pose.turn(tilted.turn(v))));

        let nothing = Moved::new([0.4, 0.1], [0.0; 2], 0.0);
        let q = [0.1, 0.2, 0.3, 0.9];
        assert!(nothing.is_nothing() && nothing.place(v) == v && nothing.turn(v) == v);
        assert!(nothing.orientation(q) == q && !moved.is_nothing());
    }
}
