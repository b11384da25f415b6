//! A mold with waves on it: what is left of its waviness when it is said to be made to size.
//!
//! The waves are a height w along the normal of the mold, a sum of a few sine waves over the plan with directions and phases
//! of their own. The surface is where F(p) = d(p) − w(c(p)) = 0, d the distance from the mold and c the closest point on it. With
//! the slope ∇w along the mold the gradient of F is n − ∇w, n the normal of the mold, and its size 1/cos of the slope. So the
//! signed distance is F cos, which is right to the second order of the slope, and exact on the surface; the normal is
//! tilted accordingly. Waves are long against their height and against a mold's bends: terms in w times the mold's curvature are left out.

use super::tuning::TUNING;
use super::vector::{along, cross, distance, dot, norm, sub, unit};
use super::{ClosestPoint, Curvatures, Mold, Separation, Steepness};
use std::f64::consts::TAU;

/// Number of sine waves: of fewer one sees the directions, more of them change nothing but the time.
const COUNT: usize = 6;

/// A sum of sine waves over the plan, of one length and height.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Waves {
    /// Height of each wave above its middle (m).
    pub amplitude: f64,
    /// Length of each wave (m).
    pub wavelength: f64,
    /// Direction in plan in which each wave runs, from x to y (rad).
    pub headings: [f64; COUNT],
    /// Phase of each wave at the origin (rad).
    pub phases: [f64; COUNT],
}

/// The waves at one place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wave {
    /// Their height w (m).
    pub height: f64,
    /// Its slope in space.
    pub gradient: [f64; 3],
    /// ∂²w/∂x², ∂²w/∂x∂y and ∂²w/∂y² (1/m).
    pub hessian: [f64; 3],
}

/// A mold with waves on it.
#[derive(Debug, Clone, PartialEq)]
pub struct Wavy {
    /// The mold without them.
    pub mold: Mold,
    /// The waves.
    pub waves: Waves,
}

impl Waves {
    /// Amplitude (m) of each wave for a standard deviation of the height (m): the squares of waves add up, each ½.
    #[must_use]
    pub fn amplitude_of_deviation(deviation: f64) -> f64 {
        deviation / (0.5 * COUNT as f64).sqrt()
    }

    /// Amplitude (m) of each wave for a height that no point exceeds (m).
    #[must_use]
    pub fn amplitude_of_bound(bound: f64) -> f64 {
        bound / COUNT as f64
    }

    /// Height that no point exceeds (m).
    #[must_use]
    pub fn most(&self) -> f64 {
        COUNT as f64 * self.amplitude.abs()
    }

    /// Slope that no point exceeds.
    #[must_use]
    pub fn steepest(&self) -> f64 {
        self.most() * TAU / self.wavelength
    }

    /// The waves at a place (m).
    #[must_use]
    pub fn at(&self, [x, y, _]: [f64; 3]) -> Wave {
        let number = TAU / self.wavelength;
        let mut wave = Wave { height: 0.0, gradient: [0.0; 3], hessian: [0.0; 3] };
        for (heading, phase) in self.headings.into_iter().zip(self.phases) {
            let (b, a) = heading.sin_cos();
            let (sin, cos) = (number * (a * x + b * y) + phase).sin_cos();
            wave.height += self.amplitude * sin;
            let slope = self.amplitude * number * cos;
            wave.gradient[0] += slope * a;
            wave.gradient[1] += slope * b;
            let bend = -self.amplitude * number * number * sin;
            for (sum, square) in wave.hessian.iter_mut().zip([a * a, a * b, b * b]) {
                *sum += bend * square;
            }
        }
        wave
    }
}

/// A point against a wavy mold.
struct Level {
    /// F (m).
    value: f64,
    /// Cosine of the slope of the waves along the mold.
    cos: f64,
    /// Unit normal.
    normal: [f64; 3],
}

impl Wavy {
    /// F at a point whose closest point on the plain mold is `closest` and where the distance from it grows along `gradient`.
    fn level(&self, closest: &ClosestPoint, gradient: [f64; 3]) -> Level {
        let wave = self.waves.at(closest.point);
        let slope = along(wave.gradient, -dot(wave.gradient, closest.normal), closest.normal);
        let steep = sub(gradient, slope);
        let cos = 1.0 / dot(slope, slope).sqrt().hypot(1.0);
        let normal = unit(steep).unwrap_or(closest.normal);
        Level { value: closest.distance - wave.height, cos, normal }
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
        let level = self.level(&closest, closest.normal);
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
            clear.max(0.0) / (1.0 + 2.0 * self.waves.steepest())
        } else {
            (clear - self.waves.most()).max(0.0)
        }
    }

    /// Principal curvatures at a point of the mold (m).
    #[must_use]
    pub fn curvatures(&self, p: [f64; 3]) -> Curvatures {
        let closest = self.mold.closest_point(p);
        let plain = self.mold.curvatures(closest.point);
        let wave = self.waves.at(closest.point);
        let [xx, xy, yy] = wave.hessian;
        let [s, t] = plain.directions;
        // a mold that bends up curves towards its normal
        let bend = |a: [f64; 3], b: [f64; 3]| {
            -(xx * a[0] * b[0] + xy * (a[0] * b[1] + a[1] * b[0]) + yy * a[1] * b[1])
        };
        let form =
            [plain.principal[0] + bend(s, s), bend(s, t), plain.principal[1] + bend(t, t)];
        let normal = self.level(&closest, closest.normal).normal;
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
            if step.abs() <= TUNING.on_mold * (norm(p) + self.waves.most()) {
                break;
            }
        }
        // a wall or a boundary has no wave that leads away from it
        let held = distance(p, start) <= self.waves.most() / TUNING.upright;
        Some(if held { p } else { start })
    }
}
