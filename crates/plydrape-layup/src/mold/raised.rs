//! A mold with a height on it, along its normal: waves, or the plies that lie there.
//!
//! The surface is where F(p) = d(p) − w(c(p)) = 0, d the distance from the mold, c the closest point on it and w the height there. With
//! the slope ∇w along the mold the gradient of F is n − ∇w, n the normal of the mold, and its size 1/cos of the slope. So the
//! signed distance is F cos, which is right to the second order of the slope, and exact on the surface; the normal is
//! tilted accordingly. Where the height does not change, distance, closest point, normal and curvatures are those of the offset
//! surface, exactly. Where it does, terms in w times the mold's curvature are left out of the slope.

use super::tuning::TUNING;
use super::{ClosestPoint, Curvatures, Mold, Separation, Steepness};
use crate::geometry::vector::{along, cross, distance, dot, norm, sub, unit};

/// A height over a mold, along its normal.
pub trait Relief {
    /// The height at a point of the mold (m).
    fn at(&self, point: [f64; 3]) -> Raise;

    /// Height that no point exceeds (m).
    fn most(&self) -> f64;

    /// Slope that no point exceeds.
    fn steepest(&self) -> f64;
}

/// A height at one place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Raise {
    /// The height w (m).
    pub height: f64,
    /// Slope in space.
    pub gradient: [f64; 3],
    /// ∂²w/∂x², ∂²w/∂x∂y and ∂²w/∂y² (1/m).
    pub hessian: [f64; 3],
}

impl Raise {
    /// Whether the height is the same all around.
    fn is_level(&self) -> bool {
        self.gradient == [0.0; 3] && self.hessian == [0.0; 3]
    }
}

/// A mold with a height on it.
#[derive(Debug, Clone, PartialEq)]
pub struct Raised<R> {
    /// The mold without it.
    pub mold: Mold,
    /// The height.
    pub relief: R,
}

/// A point against a raised mold.
struct Level {
    /// F (m).
    value: f64,
    /// Cosine of the slope of the height along the mold.
    cos: f64,
    /// Unit normal.
    normal: [f64; 3],
}

impl<R: Relief> Raised<R> {
    /// F at a point whose closest point on the plain mold is `closest` and where the distance from it grows along `gradient`.
    fn level(&self, closest: &ClosestPoint, gradient: [f64; 3]) -> Level {
        self.level_of(&self.relief.at(closest.point), closest, gradient)
    }

    fn level_of(&self, raise: &Raise, closest: &ClosestPoint, gradient: [f64; 3]) -> Level {
        let slope = along(raise.gradient, -dot(raise.gradient, closest.normal), closest.normal);
        let steep = sub(gradient, slope);
        let cos = 1.0 / dot(slope, slope).sqrt().hypot(1.0);
        let normal = unit(steep).unwrap_or(closest.normal);
        Level { value: closest.distance - raise.height, cos, normal }
    }

    /// How far `p` (m) is away; beyond a boundary as far as from the plain mold.
    #[must_use]
    pub fn separation(&self, p: [f64; 3]) -> Separation {
        let closest = self.mold.closest_point(p);
        if closest.beyond {
            return Separation { distance: closest.distance, beyond: true };
        }
        let level = self.level(&closest, closest.normal);
        Separation { distance: level.value * level.cos, beyond: false }
    }

    /// What lies closest to `p` (m): along the normal, then by Newton's method onto the surface.
    #[must_use]
    pub fn closest_point(&self, p: [f64; 3]) -> ClosestPoint {
        let closest = self.mold.closest_point(p);
        if closest.beyond {
            return closest;
        }
        let raise = self.relief.at(closest.point);
        if raise.is_level() {
            let ClosestPoint { point, distance, .. } = closest;
            let outwards = self.mold.distance_gradient(p, &closest);
            let point = along(point, raise.height, outwards);
            return ClosestPoint { point, distance: distance - raise.height, ..closest };
        }
        let level = self.level_of(&raise, &closest, closest.normal);
        let (normal, distance) = (level.normal, level.value * level.cos);
        let mut point = along(p, -distance, normal);
        for _ in 0..TUNING.on_mold_steps {
            let there = self.mold.closest_point(point);
            let level = self.level(&there, there.normal);
            if there.beyond || level.value.abs() <= TUNING.on_mold * (norm(p) + distance.abs()) {
                break;
            }
            point = along(point, -level.value * level.cos, level.normal);
        }
        ClosestPoint { point, normal, distance, beyond: false }
    }

    /// Gradient of the signed distance at `p` (m), [`Mold::distance_gradient`].
    #[must_use]
    pub fn distance_gradient(&self, p: [f64; 3]) -> [f64; 3] {
        let closest = self.mold.closest_point(p);
        let gradient = self.mold.distance_gradient(p, &closest);
        if closest.beyond { gradient } else { self.level(&closest, gradient).normal }
    }

    /// Radius (m) of a ball around `p` (m) that holds nothing of the mold, [`Mold::clear`].
    ///
    /// Within a radius r the distance from the plain mold changes by r at most, and its closest point moves by no more than 2 r where the
    /// distance is known to be that of the closest point of all, so that F changes by r (1 + 2 s), s the largest slope.
    #[must_use]
    pub fn clear(&self, p: [f64; 3], apart: Separation, bound: Steepness) -> f64 {
        let clear = self.mold.clear(p, apart, bound);
        if clear >= apart.distance {
            clear.max(0.0) / (1.0 + 2.0 * self.relief.steepest())
        } else {
            (clear - self.relief.most()).max(0.0)
        }
    }

    /// Principal curvatures at a point of the mold (m).
    #[must_use]
    pub fn curvatures(&self, p: [f64; 3]) -> Curvatures {
        let closest = self.mold.closest_point(p);
        let plain = self.mold.curvatures(closest.point);
        let raise = self.relief.at(closest.point);
        let [xx, xy, yy] = raise.hessian;
        let [s, t] = plain.directions;
        // those of the offset surface
        let offset = plain.principal.map(|k| k / (1.0 + k * raise.height));
        if raise.is_level() {
            return Curvatures::new(offset, plain.directions);
        }
        // a mold that bends up curves towards its normal
        let bend = |a: [f64; 3], b: [f64; 3]| {
            -(xx * a[0] * b[0] + xy * (a[0] * b[1] + a[1] * b[0]) + yy * a[1] * b[1])
        };
        let form = [offset[0] + bend(s, s), bend(s, t), offset[1] + bend(t, t)];
        let normal = self.level_of(&raise, &closest, closest.normal).normal;
        let first = unit(along(s, -dot(s, normal), normal)).unwrap_or(s);
        let second = cross(normal, first);
        let sense = dot(second, t).signum();
        Curvatures::of_form(form, [first, second.map(|c| sense * c)])
    }

    /// The highest point at the place (x, y) (m): from that of the plain mold up or down by Newton's method.
    #[must_use]
    pub fn highest_point(&self, xy: [f64; 2]) -> Option<[f64; 3]> {
        let mut p = self.mold.highest_point(xy)?;
        let start = p;
        for _ in 0..TUNING.newton_steps {
            let closest = self.mold.closest_point(p);
            let level = self.level(&closest, closest.normal);
            if closest.beyond || level.normal[2] < TUNING.upright {
                break;
            }
            let step = level.value * level.cos / level.normal[2];
            p[2] -= step;
            if step.abs() <= TUNING.on_mold * (norm(p) + self.relief.most()) {
                break;
            }
        }
        // on a wall or at a boundary no height leads away from it
        let held = distance(p, start) <= self.relief.most() / TUNING.upright;
        Some(if held { p } else { start })
    }
}
