//! The place on the mold that meets two conditions, by Newton's method.
//!
//! Trials always lie on the mold. Each condition has a gap and its gradient, a tangent of the mold at the
//! trial; a step δ in the tangent plane closes both gaps to second order, the bend of the lengths'
//! level lines (1/L) included. The point of the mold that is closest to the trial moved by δ is the next trial.

use super::edge::{EdgeRule, straightest};
use super::surface_point::{ExtendedSurface, SurfacePoint};
use super::tuning::TUNING;
use crate::geometry::vector::{along, cross, dot, norm, sub};

/// A condition on a place.
#[derive(Debug, Clone, Copy)]
pub(super) enum Condition<'a> {
    /// Fabric from a node to this point (m).
    Length(&'a SurfacePoint, f64),
    /// On the straightest line that leaves a node across this unit vector.
    Straight(&'a SurfacePoint, [f64; 3]),
    /// In the plane through a node across this unit vector.
    Plane(&'a SurfacePoint, [f64; 3]),
}

/// How a condition's gap is closed at a trial.
struct Slope {
    /// Gradient, a tangent of the mold.
    gradient: [f64; 3],
    /// Curvature of its level line (1/m).
    bend: f64,
}

impl Condition<'_> {
    /// What is missing at a trial (m).
    fn gap(self, x: &SurfacePoint, rule: EdgeRule) -> f64 {
        match self {
            Condition::Length(from, length) => length - rule.length(from, x),
            Condition::Straight(from, across) => {
                -EdgeRule::Along.length(from, x) * dot(straightest(from, x), across)
            }
            Condition::Plane(from, across) => -dot(sub(x.point, from.point), across),
        }
    }

    fn slope(self, x: &SurfacePoint, rule: EdgeRule) -> Slope {
        match self {
            Condition::Length(from, _) => {
                Slope { gradient: rule.gradient(from, x), bend: 1.0 / rule.length(from, x) }
            }
            Condition::Straight(from, across) => {
                // across the line where it arrives, to the side it was left on
                let left = cross(x.normal, straightest(x, from).map(|c| -c));
                let side = dot(cross(from.normal, straightest(from, x)), across).signum();
                Slope { gradient: left.map(|c| c * side), bend: 0.0 }
            }
            Condition::Plane(_, across) => {
                let gradient = along(across, -dot(across, x.normal), x.normal);
                Slope { gradient, bend: 0.0 }
            }
        }
    }
}

/// The place next to `guess` (m) that meets both conditions; otherwise the best trial.
pub(super) fn meet(
    surface: &ExtendedSurface,
    rule: EdgeRule,
    conditions: [Condition; 2],
    guess: [f64; 3],
    mesh: f64,
) -> Result<SurfacePoint, SurfacePoint> {
    let largest = guess.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    let tolerance = TUNING.gap * mesh + 4.0 * f64::EPSILON * largest;
    let gaps_at = |x: &SurfacePoint| conditions.map(|c| c.gap(x, rule));
    // Newton on the surface: two lengths, two unknowns in the tangent plane
    let mut best = surface.under(guess);
    let mut gaps = gaps_at(&best);
    let mut part = 1.0;
    let mut step = None;
    for _ in 0..TUNING.trials {
        let miss = size(gaps);
        if miss <= tolerance {
            return Ok(best);
        }
        if step.is_none() {
            step = newton(gaps, conditions.map(|c| c.slope(&best, rule)), mesh);
        }
        let Some(delta) = step else { break };
        let trial = surface.under(along(best.point, part, delta));
        let there = gaps_at(&trial);
        // a trial that is worse halves the step, one that is better doubles the next
        if size(there) < miss {
            (best, gaps, step) = (trial, there, None);
            part = f64::min(1.0, 2.0 * part);
            // the step hardly improves the place: the remaining gap is rounding
            if size(gaps) > 0.5 * miss && miss <= TUNING.largest_gap * mesh {
                break;
            }
        } else {
            part *= 0.5;
            if miss <= TUNING.largest_gap * mesh || part < TUNING.smallest_share {
                break;
            }
        }
    }
    if size(gaps) <= tolerance.max(TUNING.largest_gap * mesh) { Ok(best) } else { Err(best) }
}

fn size(gaps: [f64; 2]) -> f64 {
    gaps[0].abs().max(gaps[1].abs())
}

/// The step that closes both gaps, no longer than half a mesh width; `None` where their gradients are
/// parallel.
fn newton(gaps: [f64; 2], slopes: [Slope; 2], mesh: f64) -> Option<[f64; 3]> {
    let [p, q] = [slopes[0].gradient, slopes[1].gradient];
    let (pp, pq, qq) = (dot(p, p), dot(p, q), dot(q, q));
    let det = pp * qq - pq * pq;
    if det.is_nan() || det <= TUNING.parallel * pp * qq {
        return None;
    }
    let solve = |r: [f64; 2]| {
        let [a, b] = [(qq * r[0] - pq * r[1]) / det, (pp * r[1] - pq * r[0]) / det];
        [0, 1, 2].map(|n| a * p[n] + b * q[n])
    };
    let limited = |step: [f64; 3]| {
        let part = (TUNING.longest_step * mesh / norm(step)).min(1.0);
        step.map(|x| part * x)
    };
    let first = solve(gaps);
    if norm(first) > TUNING.longest_step * mesh {
        return Some(limited(first));
    }
    // what the level lines bend away over the first estimate
    let bent = [0, 1].map(|n| {
        let forward = dot(first, slopes[n].gradient);
        gaps[n] - 0.5 * slopes[n].bend * (dot(first, first) - forward * forward)
    });
    Some(limited(solve(bent)))
}
