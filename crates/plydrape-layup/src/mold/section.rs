//! Section curves: the line along which a vertical plane cuts a smooth mold, traced by its arc length.
//!
//! The unit tangent T of the curve is across both the plane's normal m and the mold's normal n,
//! T = m × n / |m × n|. The curve p' = T(p) is followed by the Runge–Kutta method of fourth order, in
//! steps over which neither T nor n turns by more than about a hundredth of a radian, nor would n along the
//! mold's strongest bend; after each step the point is put back on the mold within the plane. The error of an arc is then some 1e-11 of its length.

use super::tuning::TUNING;
use super::{ClosestPoint, Mold, SurfaceCurve};
use crate::geometry::vector::{along, cross, distance, dot, norm, unit};

/// How far a curve is followed.
#[derive(Debug, Clone, Copy)]
pub(super) enum Until {
    /// Over an arc length (m).
    Length(f64),
    /// Over a horizontal distance (m).
    Run(f64),
}

/// How a curve runs somewhere.
#[derive(Clone, Copy)]
struct CurveFrame {
    /// Unit tangent T.
    tangent: [f64; 3],
    /// Unit normal of the mold.
    normal: [f64; 3],
}

impl CurveFrame {
    /// How far tangent or normal turn from here to there, the larger of both (rad).
    fn turn(&self, there: &CurveFrame) -> f64 {
        angle(self.tangent, there.tangent).max(angle(self.normal, there.normal))
    }
}

/// Where a step along a curve leads.
struct Step {
    /// End, on the mold (m).
    end: [f64; 3],
    /// How the curve runs there.
    course: CurveFrame,
    /// How it runs half-way.
    half_way: CurveFrame,
}

/// Angle between two unit vectors (rad).
fn angle(a: [f64; 3], b: [f64; 3]) -> f64 {
    // the chord is sharp where the cosine is flat
    2.0 * (0.5 * distance(a, b)).min(1.0).asin()
}

/// The plane of a section: vertical, along a horizontal unit vector.
struct Section<'a> {
    mold: &'a Mold,
    heading: [f64; 2],
    across: [f64; 3],
}

/// Follows the section of a mold from a point of it (m) along the horizontal unit vector `heading`.
///
/// The curve ends early at an open boundary, and where the mold stands upright across the plane.
pub(super) fn trace(mold: &Mold, from: [f64; 3], heading: [f64; 2], until: Until) -> SurfaceCurve {
    let section = Section { mold, heading, across: [-heading[1], heading[0], 0.0] };
    let mut curve = SurfaceCurve { points: vec![from], arc: vec![0.0] };
    let total = match until {
        Until::Length(length) | Until::Run(length) => length,
    };
    let Some(mut course) = section.course(&mold.closest_point(from)) else {
        return curve;
    };
    let (mut p, mut arc, mut step) = (from, 0.0, total);
    // a length that is no finite number has no curve
    if !total.is_finite() {
        return curve;
    }
    for _ in 0..TUNING.curve_trials {
        if curve.points.len() >= TUNING.curve_points {
            break;
        }
        let left = match until {
            Until::Length(length) => length - arc,
            Until::Run(run) => {
                (run - section.run(from, p))
                    / section.run([0.0; 3], course.tangent).max(TUNING.upright)
            }
        };
        if left <= TUNING.rounding * total {
            break;
        }
        // where the curve itself hardly turns the mold may still bend across it
        let bend = mold.curvatures(p).principal.map(f64::abs).into_iter().fold(0.0, f64::max);
        step = step.min(left).min(TUNING.largest_turn / bend);
        let Some(Step { end: mut next, course: mut there, half_way }) =
            section.step(p, course, step)
        else {
            step *= 0.5;
            if step < TUNING.shortest_step * total { break } else { continue }
        };
        // by way of the middle: an S turns too
        let turn = course.turn(&half_way) + half_way.turn(&there);
        if turn > TUNING.largest_turn && step > TUNING.kink_step * total {
            step *= 0.5;
            continue;
        }
        // the last step over a run is as long as it takes
        if let Until::Run(run) = until
            && section.run(from, next) >= run * (1.0 - TUNING.shortest_step)
        {
            for _ in 0..TUNING.run_steps {
                let miss = run - section.run(from, next);
                if miss.abs() <= TUNING.rounding * run {
                    break;
                }
                step += miss / section.run([0.0; 3], there.tangent).max(TUNING.upright);
                let Some(found) = section.step(p, course, step) else { return curve };
                (next, there) = (found.end, found.course);
            }
            curve.push(next, arc + step);
            break;
        }
        arc = if matches!(until, Until::Length(_)) && step >= left { total } else { arc + step };
        curve.push(next, arc);
        (p, course) = (next, there);
        step *= (TUNING.turn / turn).clamp(0.5, 2.0);
    }
    curve
}

impl Section<'_> {
    /// Horizontal distance from `a` to `b` along the plane (m).
    fn run(&self, a: [f64; 3], b: [f64; 3]) -> f64 {
        (b[0] - a[0]) * self.heading[0] + (b[1] - a[1]) * self.heading[1]
    }

    fn course(&self, closest: &ClosestPoint) -> Option<CurveFrame> {
        // horizontal normals along `across`: the mold touches the plane
        let tangent = unit(cross(self.across, closest.normal)).filter(|_| !closest.beyond)?;
        Some(CurveFrame { tangent, normal: closest.normal })
    }

    /// One step along the curve.
    fn step(&self, p: [f64; 3], course: CurveFrame, length: f64) -> Option<Step> {
        let course_at = |p| self.course(&self.mold.closest_point(p));
        let k1 = course.tangent;
        let k2 = course_at(along(p, 0.5 * length, k1))?.tangent;
        let half_way = course_at(along(p, 0.5 * length, k2))?;
        let k3 = half_way.tangent;
        let k4 = course_at(along(p, length, k3))?.tangent;
        let mean = [0, 1, 2].map(|n| (k1[n] + 2.0 * (k2[n] + k3[n]) + k4[n]) / 6.0);
        let mut next = along(p, length, mean);
        let on_mold = TUNING.on_mold * (length + norm(p));
        // back onto the mold, within the plane
        for _ in 0..TUNING.on_mold_steps {
            let closest = self.mold.closest_point(next);
            if closest.beyond {
                return None;
            }
            let sideways = dot(closest.normal, self.across);
            let within = along(closest.normal, -sideways, self.across);
            if closest.distance.abs() <= on_mold {
                return Some(Step { end: next, course: self.course(&closest)?, half_way });
            }
            next = along(next, -closest.distance / dot(within, within), within);
        }
        let closest = self.mold.closest_point(next);
        Some(Step { end: next, course: self.course(&closest)?, half_way })
    }
}
