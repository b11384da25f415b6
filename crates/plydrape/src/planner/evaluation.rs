//! How good a plan is: the complete drape along it, and how far its worst measure is from its limit.

use crate::draping::{self, Judged};
use crate::measure::{Verdict, Worth};
use crate::planner::search_state::SearchState;
use crate::planner::tuning::{Evaluation, TUNING};
use crate::scene::{Motion, Scene, Stepping};

/// A scene as plans are evaluated in it: with steps cut where the ply would penetrate the mold.
#[must_use]
pub fn with_steps_cut(scene: &Scene) -> Scene {
    let mut scene = scene.clone();
    scene.settings.contact.stepping = Stepping::Cut;
    scene
}

/// The same with another motion.
#[must_use]
pub fn with_motion(scene: &Scene, motion: Motion) -> Scene {
    Scene { motion, ..with_steps_cut(scene) }
}

/// The complete drape along planned positions of grippers (m), rounded as the motion will round them; broken off
/// where it needs too many equilibria or the search is stopped.
#[must_use]
pub fn drape(scene: &Scene, planned: &[Vec<[f64; 3]>], state: &SearchState) -> Judged {
    follow(scene, rounded(planned), state)
}

/// The same with twice the steps on the same path, because a good plan does not depend on the number of steps.
#[must_use]
pub fn drape_finer(scene: &Scene, planned: &[Vec<[f64; 3]>], state: &SearchState) -> Judged {
    let mut positions = Vec::with_capacity(2 * planned.len());
    for (k, here) in rounded(planned).into_iter().enumerate() {
        if k > 0 {
            positions.push(halfway(planned, k - 1));
        }
        positions.push(here);
    }
    follow(scene, positions, state)
}

/// The drape along positions (m), one second a step.
fn follow(scene: &Scene, positions: Vec<Vec<[f64; 3]>>, state: &SearchState) -> Judged {
    let most = TUNING.evaluation.most_equilibria * positions.len();
    let times = (0..positions.len()).map(|n| n as f64).collect();
    draping::judge(&with_motion(scene, Motion { times, positions }), most, |_| state.report())
}

/// Where the spline of [`rounded`] passes halfway between two steps; straight between the first two and the last
/// two.
fn halfway(planned: &[Vec<[f64; 3]>], k: usize) -> Vec<[f64; 3]> {
    let weights = if k == 0 || k + 2 == planned.len() {
        [0.0, 0.5, 0.5, 0.0]
    } else {
        [1.0 / 48.0, 23.0 / 48.0, 23.0 / 48.0, 1.0 / 48.0]
    };
    let at = |n: usize| &planned[(k + n).saturating_sub(1).min(planned.len() - 1)];
    let place = |g: usize| [0, 1, 2].map(|c| (0..4).map(|n| weights[n] * at(n)[g][c]).sum::<f64>());
    (0..planned[k].len()).map(place).collect()
}

/// Where a cubic B-spline passes the planned positions, which are its control points, if its knots are evenly
/// spaced: nearly what [`crate::motion::TimedMotion`] makes of them, without its search for the spacing.
#[must_use]
pub fn rounded(planned: &[Vec<[f64; 3]>]) -> Vec<Vec<[f64; 3]>> {
    let mut out = planned.to_vec();
    for (k, around) in planned.windows(3).enumerate() {
        for (n, place) in out[k + 1].iter_mut().enumerate() {
            let [before, here, after] = [around[0][n], around[1][n], around[2][n]];
            *place = [0, 1, 2].map(|c| (before[c] + 4.0 * here[c] + after[c]) / 6.0);
        }
    }
    out
}

/// What a limit adds to the score. A limit that only has to be kept counts from a share of it on; of the errors of the
/// ply, less is always better.
fn weight(verdict: &Verdict) -> f64 {
    let (ratio, counted) = (verdict.ratio(), TUNING.evaluation.counted_share);
    match verdict.name.measure().worth() {
        Worth::Kept if ratio <= 1.0 => ((ratio - counted) / (1.0 - counted)).max(0.0),
        _ => ratio,
    }
}

/// The worst ratio, and a little of the mean; smaller is better, and above 1 plus the weight of the mean nothing is accepted.
#[must_use]
pub fn score(drape: &Judged) -> f64 {
    let ratios: Vec<f64> = drape.limits.iter().map(weight).collect();
    let worst = ratios.iter().copied().fold(0.0, f64::max);
    let Evaluation { mean_weight, largest_ratio, missing_weight, .. } = TUNING.evaluation;
    let mean =
        ratios.iter().map(|r| r.min(largest_ratio)).sum::<f64>() / ratios.len().max(1) as f64;
    // a drape that was broken off is worse than any other, the more so the earlier it was broken off
    let missing = drape.missing;
    worst
        + mean_weight * mean
        + drape.unsolved as f64
        + if missing > 0.0 { missing_weight * (1.0 + missing) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::{Name, Worst};

    /// A search prefers a plan that misses a limit to one with a step that is no solution, and any whole one to one broken off.
    #[test]
    fn an_unsolved_step_costs_a_search_more_than_a_limit() {
        let at = |value: f64| {
            let worst = Worst { value, at: String::new(), place: None };
            Verdict::of(Name::SlackRatio, worst, 5e-4, Some(1))
        };
        let evaluated = |value: f64, unsolved: usize, missing: f64| {
            score(&Judged { limits: vec![at(value)], accepted: false, missing, unsolved })
        };
        let sound = evaluated(4e-4, 0, 0.0);
        assert!(sound < 1.0);
        assert!((evaluated(4e-4, 2, 0.0) - sound - 2.0).abs() < 1e-12);
        assert!(evaluated(4e-4, 0, 0.1) > evaluated(1e-1, 30, 0.0));
    }
}
