//! Molds that are a height over a plane, z = f(x, y): closest points by Newton's method.

use super::formula::Formula;
use super::front_surface::FrontSurface;
use super::height::{Height, Steepness};
use super::height_grid::HeightGrid;
use super::saddle::Saddle;
use super::tuning::TUNING;
use super::{ClosestPoint, Curvatures, Separation};
use crate::geometry::Pose;
use crate::geometry::vector::{distance, dot, norm, sub, unit};

/// A height over the local xy plane.
#[derive(Debug, Clone, PartialEq)]
pub struct Graph {
    /// Position and rotation of the local frame.
    pub pose: Pose,
    /// What gives the height.
    pub surface: Surface,
    /// Range of local x and of local y (m); beyond it there is no mold. Everywhere unless given.
    pub domain: Option<[[f64; 2]; 2]>,
}

/// What gives the height of a [`Graph`].
#[derive(Debug, Clone, PartialEq)]
pub enum Surface {
    /// Curved down along one axis and up along the other.
    Saddle(Saddle),
    /// A formula.
    Formula {
        /// z = f(x, y).
        z: Formula,
    },
    /// Heights on a grid.
    HeightGrid(HeightGrid),
    /// Heights on a grid, raised ahead of a front.
    Front(FrontSurface),
}

impl Surface {
    /// The height at local (x, y) (m).
    #[must_use]
    pub fn at(&self, x: f64, y: f64) -> Height {
        match self {
            Surface::Saddle(saddle) => saddle.at(x, y),
            Surface::Formula { z } => z.at(x, y),
            Surface::HeightGrid(heights) => heights.at(x, y),
            Surface::Front(surface) => surface.at(x, y),
        }
    }
}

impl Graph {
    /// Bounds of its slope and bend; without a domain only where they hold everywhere.
    #[must_use]
    pub fn steepness(&self) -> Steepness {
        match (&self.surface, self.domain) {
            (Surface::Saddle(saddle), domain) => saddle.steepness(domain),
            (Surface::Formula { z }, Some(domain)) => z.steepness(domain),
            (Surface::HeightGrid(heights), Some(domain)) => heights.steepness(domain),
            _ => Steepness::UNKNOWN,
        }
    }

    /// Radius (m) of a ball around `p` (m) that holds nothing of the mold and lies above all of it, from how far
    /// `p` is away; zero if no such ball is known.
    ///
    /// The closest point that [`Graph::closest_point`] finds downhill may not be the closest of all. Where the Hessian of
    /// f is nowhere larger than b, it is: the lower half of a sphere of radius r ≤ 1/b that touches the graph from
    /// above is a height whose Hessian is nowhere smaller than 1/r, so their difference is convex, and smallest
    /// where they touch. From farther away only the slope s bounds the distance: a point at a height h above
    /// the graph is at least h/√(1 + s²) away from it.
    #[must_use]
    pub fn clear(&self, p: [f64; 3], apart: Separation, bound: Steepness) -> f64 {
        if apart.beyond || apart.distance <= 0.0 {
            return 0.0;
        }
        if apart.distance * bound.bend <= 1.0 {
            return apart.distance;
        }
        let [x, y, z] = self.pose.local(p);
        let outside = |n: usize, at: f64| {
            self.domain.is_some_and(|range| !(range[n][0]..=range[n][1]).contains(&at))
        };
        if outside(0, x) || outside(1, y) {
            return 0.0;
        }
        let clear = (z - self.surface.at(x, y).z) / bound.slope.hypot(1.0);
        // no number where nothing is known
        if clear > 0.0 { clear.min(apart.distance) } else { 0.0 }
    }

    /// What lies closest to `p` (m): the point that is found downhill from the one straight below.
    #[must_use]
    pub fn closest_point(&self, p: [f64; 3]) -> ClosestPoint {
        let p = self.pose.local(p);
        let inside = |xy: [f64; 2]| match self.domain {
            Some(range) => [0, 1].map(|n| xy[n].clamp(range[n][0], range[n][1])),
            None => xy,
        };
        let square = |xy: [f64; 2], z: f64| {
            (xy[0] - p[0]).powi(2) + (xy[1] - p[1]).powi(2) + (z - p[2]).powi(2)
        };
        let mut xy = inside([p[0], p[1]]);
        let mut height = self.surface.at(xy[0], xy[1]);
        let mut value = square(xy, height.z);
        for _ in 0..TUNING.newton_steps {
            let Some(step) = newton(xy, &height, p, self.domain) else { break };
            let size = step[0].hypot(step[1]);
            let scale = sizes(xy, p);
            // halved until it comes closer; a step too small to show in the distance is just taken
            let mut part = 1.0;
            let found = loop {
                let next = inside([xy[0] + part * step[0], xy[1] + part * step[1]]);
                let there = self.surface.at(next[0], next[1]);
                let closer = square(next, there.z);
                if closer < value || size < TUNING.unseen_step * scale {
                    break Some((next, there, closer));
                }
                part *= 0.5;
                if part < TUNING.smallest_share {
                    break None;
                }
            };
            let Some((next, there, closer)) = found else { break };
            (xy, height, value) = (next, there, closer);
            // quadratic convergence: what is left is below rounding
            if size < TUNING.newton_step * scale {
                break;
            }
        }
        let point = [xy[0], xy[1], height.z];
        let normal = upward(&height);
        let off = sub(p, point);
        let above = dot(off, normal);
        // at the boundary the way to the mold may lead sideways: there is no mold below
        let on_boundary = self
            .domain
            .is_some_and(|range| (0..2).any(|n| xy[n] <= range[n][0] || xy[n] >= range[n][1]));
        let far = distance(p, point);
        let aside = on_boundary && far - above.abs() > TUNING.aside_of_domain * far;
        // beside the mold and lower than its boundary, the closest point may be on the lower side of the graph: the mold is
        // below the graph, and there is none below a point of it that is not in the domain
        let past = |n: usize, range: [[f64; 2]; 2]| {
            (range[n][0] - p[n]).max(p[n] - range[n][1]) > TUNING.aside_of_domain * sizes(xy, p)
        };
        let beyond = aside || above < 0.0 && self.domain.is_some_and(|r| past(0, r) || past(1, r));
        ClosestPoint {
            point: self.pose.place(point),
            normal: self.pose.turn(normal),
            distance: if beyond { far } else { above },
            beyond,
        }
    }

    /// Where the vertical line through (x, y) (m) meets the mold, if it does.
    #[must_use]
    pub fn highest_point(&self, [x, y]: [f64; 2]) -> Option<[f64; 3]> {
        let [down, from] =
            [self.pose.turn_back([0.0, 0.0, 1.0]), self.pose.local([x, y, self.pose.position[2]])];
        let extent =
            self.domain.map_or(0.0, |range| range.as_flattened().iter().map(|c| c.abs()).sum());
        let mut t = -from[2] / down[2];
        for _ in 0..TUNING.newton_steps {
            let q = [0, 1, 2].map(|n| from[n] + t * down[n]);
            let height = self.surface.at(q[0], q[1]);
            let rate = down[2] - height.gradient[0] * down[0] - height.gradient[1] * down[1];
            let step = (height.z - q[2]) / rate;
            t += step;
            if step.abs() <= TUNING.rounding * (extent + norm(from) + t.abs()) {
                let q = [0, 1, 2].map(|n| from[n] + t * down[n]);
                let held = self.domain.is_none_or(|range| {
                    (0..2).all(|n| (range[n][0]..=range[n][1]).contains(&q[n]))
                });
                return held.then(|| self.pose.place(q));
            }
        }
        None
    }

    /// Principal curvatures at a point of the mold (m).
    #[must_use]
    pub fn curvatures(&self, p: [f64; 3]) -> Curvatures {
        let [x, y, _] = self.pose.local(p);
        let height = self.surface.at(x, y);
        let fx = height.gradient[0];
        let normal = upward(&height);
        // the second derivatives along two unit tangents at right angles
        let across = (1.0 + fx * fx).sqrt();
        let first = [1.0 / across, 0.0, fx / across];
        let second = crate::geometry::vector::cross(normal, first);
        let [xx, xy, yy] = height.hessian;
        let bend = |a: [f64; 3], b: [f64; 3]| {
            -normal[2] * (xx * a[0] * b[0] + xy * (a[0] * b[1] + a[1] * b[0]) + yy * a[1] * b[1])
        };
        let form = [bend(first, first), bend(first, second), bend(second, second)];
        let tangents = [first, second].map(|t| self.pose.turn(t));
        Curvatures::of_form(form, tangents)
    }
}

/// The size of the numbers that a closest point is computed from (m), which its rounding is relative to.
fn sizes(xy: [f64; 2], p: [f64; 3]) -> f64 {
    xy[0].abs() + xy[1].abs() + norm(p)
}

/// Unit normal of a height, upwards.
fn upward(height: &Height) -> [f64; 3] {
    let [fx, fy] = height.gradient;
    unit([-fx, -fy, 1.0]).unwrap_or([0.0, 0.0, 1.0])
}

/// The step towards the closest point; `None` where nothing comes closer. Directions in which the boundary
/// holds the point are left out.
fn newton(
    xy: [f64; 2],
    height: &Height,
    p: [f64; 3],
    domain: Option<[[f64; 2]; 2]>,
) -> Option<[f64; 2]> {
    let (dz, [fx, fy], [xx, xy2, yy]) = (height.z - p[2], height.gradient, height.hessian);
    let slope = [xy[0] - p[0] + dz * fx, xy[1] - p[1] + dz * fy];
    let free = [0, 1].map(|n| {
        domain.is_none_or(|range| {
            !(xy[n] <= range[n][0] && slope[n] > 0.0 || xy[n] >= range[n][1] && slope[n] < 0.0)
        })
    });
    let scale = TUNING.stationary * sizes(xy, p);
    if (0..2).all(|n| !free[n] || slope[n].abs() <= scale) {
        return None;
    }
    // the whole Hessian where it is positive, otherwise without the curvature
    let whole = [1.0 + fx * fx + dz * xx, fx * fy + dz * xy2, 1.0 + fy * fy + dz * yy];
    let flat = [1.0 + fx * fx, fx * fy, 1.0 + fy * fy];
    match free {
        [true, true] => {
            let determinant = |[a, b, c]: [f64; 3]| a * c - b * b;
            let [a, b, c] =
                if whole[0] > 0.0 && determinant(whole) > TUNING.positive * determinant(flat) {
                    whole
                } else {
                    flat
                };
            let d = determinant([a, b, c]);
            Some([-(c * slope[0] - b * slope[1]) / d, -(a * slope[1] - b * slope[0]) / d])
        }
        [true, false] => Some([-slope[0] / if whole[0] > 0.0 { whole[0] } else { flat[0] }, 0.0]),
        [false, true] => Some([0.0, -slope[1] / if whole[2] > 0.0 { whole[2] } else { flat[2] }]),
        [false, false] => None,
    }
}
