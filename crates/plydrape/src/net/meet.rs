//! The place on the mold that meets two conditions, by Newton's method.
//!
//! Trials always lie on the mold. Each condition has a gap and its gradient, a tangent of the mold at the
//! trial; a step δ in the tangent plane closes both gaps to second order, the bend of the lengths'
//! level lines (1/L) included, and the foot of the trial moved by δ is the next trial.

use super::edge::{EdgeRule, straightest};
use super::spot::{Ground, Spot};
use crate::mold::vector::{along, distance, dot, sub};

/// What is asked of a place.
#[derive(Debug, Clone, Copy)]
pub(super) enum Condition<'a> {
    /// So much fabric away from a node (m).
    Length(&'a Spot, f64),
    /// On the straightest line that leaves a node across this unit vector.
    Straight(&'a Spot, [f64; 3]),
    /// In the plane through a node across this unit vector.
    Plane(&'a Spot, [f64; 3]),
}

/// One condition at a trial.
struct Gap {
    /// What is missing (m).
    gap: f64,
    /// How it is closed: a tangent at the trial.
    gradient: [f64; 3],
    /// Curvature of its level line (1/m).
    bend: f64,
}

/// Largest miss of a condition where Newton's method can do no more, as a share of the mesh width.
const ACCEPTED: f64 = 1e-10;
/// Trials before a place is given up.
const TRIALS: usize = 60;

impl Condition<'_> {
    fn at(self, x: &Spot, rule: EdgeRule) -> Gap {
        match self {
            Condition::Length(from, length) => {
                let there = rule.length(from, x);
                Gap { gap: length - there, gradient: rule.gradient(from, x), bend: 1.0 / there }
            }
            Condition::Straight(from, across) => {
                let there = EdgeRule::Along.length(from, x);
                let aside = there * dot(straightest(from, x), across);
                // across the line, where it arrives
                let arriving = straightest(x, from).map(|c| -c);
                let gradient = crate::mold::vector::cross(x.normal, arriving);
                let side =
                    dot(crate::mold::vector::cross(from.normal, straightest(from, x)), across);
                Gap { gap: -aside, gradient: gradient.map(|c| c * side.signum()), bend: 0.0 }
            }
            Condition::Plane(from, across) => {
                let gradient = along(across, -dot(across, x.normal), x.normal);
                Gap { gap: -dot(sub(x.point, from.point), across), gradient, bend: 0.0 }
            }
        }
    }
}

/// The place next to `guess` (m) that meets both conditions; otherwise the best trial.
pub(super) fn meet(
    ground: &Ground,
    rule: EdgeRule,
    conditions: [Condition; 2],
    guess: [f64; 3],
    mesh: f64,
) -> Result<Spot, Spot> {
    let largest = guess.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    let tolerance = 1e-13 * mesh + 4.0 * f64::EPSILON * largest;
    let mut best = ground.under(guess);
    let mut gaps = conditions.map(|c| c.at(&best, rule));
    let mut miss = size(&gaps);
    let mut part = 1.0;
    let mut step = newton(&gaps, mesh);
    for _ in 0..TRIALS {
        if miss <= tolerance {
            return Ok(best);
        }
        let Some(delta) = step else { break };
        let trial = ground.under(along(best.point, part, delta));
        let there = conditions.map(|c| c.at(&trial, rule));
        let missed = size(&there);
        if missed < miss {
            // a step that hardly helps any more: rounding, or the kink of a facet
            let done = missed > 0.5 * miss && missed <= ACCEPTED * mesh;
            (best, gaps, miss) = (trial, there, missed);
            if done {
                break;
            }
            part = f64::min(1.0, 2.0 * part);
            step = newton(&gaps, mesh);
        } else {
            if miss <= ACCEPTED * mesh || part < 1e-4 {
                break;
            }
            part *= 0.5;
        }
    }
    if miss <= tolerance.max(ACCEPTED * mesh) { Ok(best) } else { Err(best) }
}

fn size(gaps: &[Gap; 2]) -> f64 {
    gaps[0].gap.abs().max(gaps[1].gap.abs())
}

/// The step that closes both gaps, no longer than half a mesh width; none where their gradients are
/// parallel.
fn newton(gaps: &[Gap; 2], mesh: f64) -> Option<[f64; 3]> {
    let [p, q] = [gaps[0].gradient, gaps[1].gradient];
    let (pp, pq, qq) = (dot(p, p), dot(p, q), dot(q, q));
    let det = pp * qq - pq * pq;
    if det <= 1e-10 * pp * qq {
        return None;
    }
    let solve = |r: [f64; 2]| {
        let [a, b] = [(qq * r[0] - pq * r[1]) / det, (pp * r[1] - pq * r[0]) / det];
        [0, 1, 2].map(|n| a * p[n] + b * q[n])
    };
    let limited = |d: [f64; 3]| {
        let length = dot(d, d).sqrt();
        if length > 0.5 * mesh { d.map(|x| x * 0.5 * mesh / length) } else { d }
    };
    let first = solve([gaps[0].gap, gaps[1].gap]);
    if distance(first, [0.0; 3]) > 0.5 * mesh {
        return Some(limited(first));
    }
    // what the level lines bend away over the first estimate
    let bent = [0, 1].map(|n| {
        let Gap { gap, gradient, bend } = gaps[n];
        let forward = dot(first, gradient);
        gap - 0.5 * bend * (dot(first, first) - forward * forward)
    });
    Some(limited(solve(bent)))
}
