//! The search for a strategy: a few families first, then evolution of the best (CMA-ES, Hansen 2016). Every
//! candidate is evaluated by its complete drape. Candidates are independent and run on all cores; which one is the
//! best does not depend on the number of cores.

use super::formation::MoldHeights;
use super::refine::correction;
use super::strategy::Strategy;
use super::tabulation::tabulated;
use super::trajectory::trajectory;
use super::tuning::TUNING;
use crate::draping::Judged;
use crate::draping::spans::Point;
use crate::mold::vector::along;
use crate::planner::checkpoint::Checkpoint;
use crate::planner::evaluation;
use crate::planner::search_state::SearchState;
use crate::scene::Scene;
use cmaes::{CMAESOptions, DVector};
use rayon::prelude::*;
use std::cmp::Ordering;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// A strategy and the drape that it leads to.
#[derive(Debug, Clone)]
pub struct Candidate {
    /// Its strategy.
    pub strategy: Strategy,
    /// The positions that it plans (m), one list of all grippers a step.
    pub positions: Vec<Vec<Point>>,
    /// Limits and failures of its complete drape.
    pub drape: Judged,
    /// [`evaluation::score`] of it.
    pub score: f64,
}

impl Candidate {
    fn of(
        scene: &Scene,
        heights: &MoldHeights,
        strategy: Strategy,
        state: &SearchState,
    ) -> Option<Candidate> {
        Some(Candidate::along(scene, strategy, trajectory(scene, heights, strategy)?, state))
    }

    fn along(
        scene: &Scene,
        strategy: Strategy,
        positions: Vec<Vec<Point>>,
        state: &SearchState,
    ) -> Candidate {
        let drape = evaluation::drape(scene, &positions, state);
        let mut score = evaluation::score(&drape);
        if score < TUNING.search.promising {
            let finer = evaluation::drape_finer(scene, &positions, state);
            score = score.max(evaluation::score(&finer));
        }
        state.record(&drape, score);
        Candidate { strategy, positions, drape, score }
    }
}

/// The best plan that is found: families first, or the result of an earlier search, then evolution. None without
/// a mold or a target.
#[must_use]
pub fn search(
    scene: &Scene,
    checkpoint: Option<&Checkpoint>,
    state: &SearchState,
) -> Option<Candidate> {
    let heights = MoldHeights::new(scene)?;
    let scene = &*tabulated(scene);
    let most = scene.plan.evaluations.max(1);
    let try_one = |strategy: Strategy| Candidate::of(scene, &heights, strategy, state);
    state.begin("first candidates");
    let tried: Vec<Candidate> = match checkpoint.and_then(|checkpoint| checkpoint.path(scene)) {
        Some((strategy, Some(positions))) => {
            vec![Candidate::along(scene, strategy, positions, state)]
        }
        Some((strategy, None)) => vec![try_one(strategy)?],
        None => {
            let mut first = Strategy::families(scene);
            first.truncate(most);
            first.into_par_iter().filter_map(try_one).collect()
        }
    };
    let mut left = most.saturating_sub(tried.len());
    let mut best = tried.into_iter().reduce(better)?;

    best = refine(scene, best, &mut left, state);
    state.begin("evolution");
    // evolution about the best; a search that continues an earlier one takes other samples
    let mean = best.strategy.to_unit().to_vec();
    let before = checkpoint.map_or(0, |checkpoint| checkpoint.evaluations as u64);
    let seed = scene.plan.seed.wrapping_add(before);
    let found: Mutex<Option<Candidate>> = Mutex::new(None);
    let objective = |unit: &DVector<f64>| -> f64 {
        if state.is_stopped() {
            return f64::MAX;
        }
        let Some(candidate) = try_one(Strategy::of_unit(unit.as_slice())) else { return f64::MAX };
        let score = candidate.score;
        let mut found = lock(&found);
        *found = Some(match found.take() {
            Some(before) => better(before, candidate),
            None => candidate,
        });
        score
    };
    let options = CMAESOptions::new(mean, TUNING.search.step)
        .population_size(TUNING.search.generation)
        .seed(seed);
    let Ok(mut evolution) = options.build(objective) else { return Some(best) };
    let mut idle = 0;
    while best.score > TUNING.search.good
        && idle < TUNING.search.patience
        && left >= TUNING.search.generation + TUNING.search.refinements * TUNING.search.parts.len()
        && !state.is_stopped()
    {
        let ended = evolution.next_parallel().is_some();
        left -= TUNING.search.generation;
        let before = best.score;
        if let Some(candidate) = lock(&found).take() {
            best = better(best, candidate);
        }
        // an accepted plan is not improved for long
        idle = if best.score < TUNING.search.gain * before || !is_accepted(&best) {
            0
        } else {
            idle + 1
        };
        if ended {
            break;
        }
    }
    best = refine(scene, best, &mut left, state);
    Some(best)
}

/// Rounds of refinement, as long as they help and are needed.
fn refine(scene: &Scene, mut best: Candidate, left: &mut usize, state: &SearchState) -> Candidate {
    state.begin("refinement");
    for _ in 0..TUNING.search.refinements {
        if best.score <= TUNING.search.good
            || *left < TUNING.search.parts.len()
            || state.is_stopped()
        {
            break;
        }
        *left -= TUNING.search.parts.len();
        match refined(scene, &best, state) {
            Some(refined) if refined.score < best.score => best = refined,
            _ => break,
        }
    }
    best
}

/// The best along parts of the correction that gradients propose.
fn refined(scene: &Scene, best: &Candidate, state: &SearchState) -> Option<Candidate> {
    let correction = correction(scene, &best.positions)?;
    let corrected = |part: &f64| {
        let moved = |(p, c): (&Point, &Point)| along(*p, *part, *c);
        let step = |(p, c): (&Vec<Point>, &Vec<Point>)| p.iter().zip(c).map(moved).collect();
        let positions = best.positions.iter().zip(&correction).map(step).collect();
        Candidate::along(scene, best.strategy, positions, state)
    };
    let tried: Vec<Candidate> = TUNING.search.parts.par_iter().map(corrected).collect();
    tried.into_iter().reduce(better)
}

fn is_accepted(candidate: &Candidate) -> bool {
    candidate.drape.accepted
}

/// The one with the lower score; where they are equal, the one whose numbers come first.
fn better(a: Candidate, b: Candidate) -> Candidate {
    let key = |c: &Candidate| (c.score, c.strategy.to_unit());
    let order = key(&a).partial_cmp(&key(&b)).unwrap_or(Ordering::Equal);
    if order == Ordering::Greater { b } else { a }
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
