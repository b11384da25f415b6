//! The search for a strategy: a few families first, then evolution of the best (CMA-ES, Hansen 2016), every
//! candidate judged by its complete drape. Candidates are independent and run on all cores; which one wins
//! does not depend on how many there are.

use super::formation::Ground;
use super::quick::quick;
use super::refine::correction;
use super::strategy::Strategy;
use super::trajectory::trajectory;
use crate::draping::Judged;
use crate::draping::spans::Point;
use crate::mold::vector::along;
use crate::planner::board::Board;
use crate::planner::judge;
use crate::planner::memory::Memory;
use crate::scene::Scene;
use cmaes::{CMAESOptions, DVector};
use rayon::prelude::*;
use std::cmp::Ordering;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Score below which a plan keeps every limit with so much to spare that the search ends.
const GOOD: f64 = 0.6;
/// Score below which a plan is worth a second look: whether it is as good with twice the steps.
const PROMISING: f64 = 1.3;
/// First step of the evolution, in shares of each range.
const STEP: f64 = 0.08;
/// Candidates of a generation, and of the first look: whole pairs, for two cores.
const GENERATION: usize = 8;

/// Generations without a gain after which an accepted plan is good enough, and the ratio of scores that is a
/// gain.
const PATIENCE: usize = 3;
const GAIN: f64 = 0.98;
/// Rounds of refinement.
const ROUNDS: usize = 3;
/// Parts of a correction that are tried.
const PARTS: [f64; 2] = [1.0, 0.4];

/// A strategy and the drape that it leads to.
#[derive(Debug, Clone)]
pub struct Candidate {
    /// What was tried.
    pub strategy: Strategy,
    /// The positions that it plans (m), one list of all grippers a step.
    pub positions: Vec<Vec<Point>>,
    /// How its complete drape came out.
    pub judged: Judged,
    /// [`judge::score`] of it.
    pub score: f64,
}

impl Candidate {
    fn of(scene: &Scene, ground: &Ground, strategy: Strategy, board: &Board) -> Option<Candidate> {
        Some(Candidate::along(scene, strategy, trajectory(scene, ground, strategy)?, board))
    }

    fn along(
        scene: &Scene,
        strategy: Strategy,
        positions: Vec<Vec<Point>>,
        board: &Board,
    ) -> Candidate {
        let judged = judge::drape(scene, &positions, board);
        let mut score = judge::score(&judged);
        if score < PROMISING {
            let finer = judge::drape_finer(scene, &positions, board);
            score = score.max(judge::score(&finer));
        }
        board.add(&judged, score);
        Candidate { strategy, positions, judged, score }
    }
}

/// The best plan that is found: families first, or what an earlier search has left, then evolution. None without
/// a mold or a target.
#[must_use]
pub fn search(scene: &Scene, memory: Option<&Memory>, board: &Board) -> Option<Candidate> {
    let ground = Ground::new(scene)?;
    let scene = &*quick(scene);
    let most = scene.plan.evaluations.max(1);
    let try_one = |strategy: Strategy| Candidate::of(scene, &ground, strategy, board);
    board.enter("a first look");
    let tried: Vec<Candidate> = match memory.and_then(|memory| memory.path(scene)) {
        Some((strategy, Some(positions))) => {
            vec![Candidate::along(scene, strategy, positions, board)]
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

    best = refine(scene, best, &mut left, board);
    board.enter("evolution");
    // evolution about the best; what it has tried before it goes on from, with other samples
    let mean = best.strategy.to_unit().to_vec();
    let before = memory.map_or(0, |memory| memory.evaluations as u64);
    let seed = scene.plan.seed.wrapping_add(before);
    let found: Mutex<Option<Candidate>> = Mutex::new(None);
    let objective = |unit: &DVector<f64>| -> f64 {
        if board.is_stopped() {
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
    let options = CMAESOptions::new(mean, STEP).population_size(GENERATION).seed(seed);
    let Ok(mut evolution) = options.build(objective) else { return Some(best) };
    let mut idle = 0;
    while best.score > GOOD
        && idle < PATIENCE
        && left >= GENERATION + ROUNDS * PARTS.len()
        && !board.is_stopped()
    {
        let ended = evolution.next_parallel().is_some();
        left -= GENERATION;
        let before = best.score;
        if let Some(candidate) = lock(&found).take() {
            best = better(best, candidate);
        }
        // what is accepted needs not be searched for long
        idle = if best.score < GAIN * before || !is_accepted(&best) { 0 } else { idle + 1 };
        if ended {
            break;
        }
    }
    best = refine(scene, best, &mut left, board);
    Some(best)
}

/// Rounds of refinement, as long as they help and are needed.
fn refine(scene: &Scene, mut best: Candidate, left: &mut usize, board: &Board) -> Candidate {
    board.enter("refinement");
    for _ in 0..ROUNDS {
        if best.score <= GOOD || *left < PARTS.len() || board.is_stopped() {
            break;
        }
        *left -= PARTS.len();
        match refined(scene, &best, board) {
            Some(refined) if refined.score < best.score => best = refined,
            _ => break,
        }
    }
    best
}

/// The best along parts of the correction that gradients propose.
fn refined(scene: &Scene, best: &Candidate, board: &Board) -> Option<Candidate> {
    let correction = correction(scene, &best.positions)?;
    let corrected = |part: &f64| {
        let moved = |(p, c): (&Point, &Point)| along(*p, *part, *c);
        let step = |(p, c): (&Vec<Point>, &Vec<Point>)| p.iter().zip(c).map(moved).collect();
        let positions = best.positions.iter().zip(&correction).map(step).collect();
        Candidate::along(scene, best.strategy, positions, board)
    };
    let tried: Vec<Candidate> = PARTS.par_iter().map(corrected).collect();
    tried.into_iter().reduce(better)
}

fn is_accepted(candidate: &Candidate) -> bool {
    candidate.judged.accepted
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
