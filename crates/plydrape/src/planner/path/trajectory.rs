//! From a strategy to the positions of every step: transport, and the front that passes over the mold.

use super::formation::{Formation, MoldHeights};
use super::preload::commanded;
use super::strategy::Strategy;
use super::transport::transport;
use super::tuning::TUNING;
use crate::geometry::Point;
use crate::geometry::vector;
use crate::motion::farthest;
use crate::scene::Scene;

/// Positions (m) of `scene.plan.steps` steps: the first is the scene's start, the last the target, beyond which
/// grippers on mounts are commanded. `None` without a mold or a target.
#[must_use]
pub fn trajectory(
    scene: &Scene,
    heights: &MoldHeights,
    strategy: Strategy,
) -> Option<Vec<Vec<Point>>> {
    let steps = scene.plan.steps.max(2);
    let Some(limit) = scene.plan.move_limit else {
        return positions(scene, heights, strategy, steps);
    };
    let planned = positions(scene, heights, strategy, steps)?;
    if planned.windows(2).all(|pair| farthest(&pair[0], &pair[1]) <= limit) {
        return Some(planned);
    }
    Some(evened(&positions(scene, heights, strategy, TUNING.front.finer * steps)?, steps))
}

fn positions(
    scene: &Scene,
    heights: &MoldHeights,
    strategy: Strategy,
    steps: usize,
) -> Option<Vec<Vec<Point>>> {
    let formation = Formation::new(scene, heights, strategy)?;
    let target = &scene.layup.target.as_ref()?.grippers;
    let mut out = transport(scene, &formation.grippers(0.0), steps)?;
    let roll = steps.saturating_sub(out.len() + 1).max(1);

    let reach = formation.reach() * (1.0 + TUNING.front.beyond);
    out.extend((0..roll).map(|k| formation.grippers(reach * k as f64 / roll as f64)));
    out.push(target.clone());
    commanded(scene, &strategy, &mut out);
    Some(out)
}

/// Positions a share `t` of the way from one to the other.
fn between(from: &[Point], to: &[Point], t: f64) -> Vec<Point> {
    from.iter().zip(to).map(|(a, b)| vector::between(*a, *b, t)).collect()
}

/// A path in steps whose longest moves are equal.
fn evened(fine: &[Vec<Point>], steps: usize) -> Vec<Vec<Point>> {
    let mut lengths = vec![0.0];
    for pair in fine.windows(2) {
        lengths.push(lengths[lengths.len() - 1] + farthest(&pair[0], &pair[1]));
    }
    let last = fine.len() - 1;
    (0..steps)
        .map(|k| {
            let at = lengths[last] * k as f64 / (steps - 1) as f64;
            let n = lengths.partition_point(|x| *x < at).clamp(1, last);
            let length = lengths[n] - lengths[n - 1];
            let t =
                if length > 0.0 { ((at - lengths[n - 1]) / length).clamp(0.0, 1.0) } else { 1.0 };
            if k + 1 == steps { fine[last].clone() } else { between(&fine[n - 1], &fine[n], t) }
        })
        .collect()
}
