//! The drape of a scene by each strategy of a comparison.

use super::ComparedDrape;
use crate::Error;
use crate::geometry::Point;
use crate::geometry::vector::between;
use crate::layup::{Model, SheetTime};
use crate::measure::Verdict;
use crate::motion::Motion;
use crate::motion::TimedMotion;
use crate::outcome::{self, DrapeWatch, Judged};
use crate::planner::decision::{Decided, Decision};
use crate::planner::evaluation::{Bias, Mesh};
use crate::planner::path::tuning::TUNING;
use crate::planner::path::{Fronts, Strategy};
use crate::planner::plan;
use crate::planner::search_state::SearchState;
use crate::planner::stepwise::stepwise;
use crate::scene::Scene;
use rayon::prelude::*;
use std::ops::ControlFlow;

/// The drape along the straight paths of the scene, as `simulate` drapes them.
pub fn straight(scene: &Scene, state: &SearchState) -> Result<ComparedDrape, Error> {
    let mut scene = Scene { errors: None, ..scene.clone() };
    scene.layup.motion = straight_motion(&scene);
    let layup = &scene.layup;
    let time = match (layup.settings.model, layup.settings.sheet.time) {
        (Model::Sheet, SheetTime::Real) => layup.motion.times.last().copied().unwrap_or(0.0),
        _ => TimedMotion::new(&layup.motion.positions, &scene.limits.motion_bounds())?.duration(),
    };
    let stop = || state.report().is_break();
    let mut see = |_: usize, _: Option<&crate::sheet::ClothState>| ControlFlow::Continue(());
    let mut watch = DrapeWatch { stop: &stop, see: &mut see };
    let drape = outcome::drape_places(&scene, layup.settings.model, &mut watch)?;
    let judged = Judged::new(&drape);
    Ok(ComparedDrape { drape, judged, time })
}

/// From the start of the scene straight to its target, in the steps and times of its motion.
fn straight_motion(scene: &Scene) -> Motion {
    let start = scene.layup.start();
    let Some(target) = scene.layup.target.as_ref().filter(|_| !start.is_empty()) else {
        return scene.layup.motion.clone();
    };
    let times = match scene.layup.motion.times.len() {
        // a ply that is held has one step
        0 | 1 => (0..scene.plan.steps.max(2)).map(|k| k as f64).collect(),
        _ => scene.layup.motion.times.clone(),
    };
    let last = (times.len() - 1) as f64;
    let straight_step = |k: usize| -> Vec<Point> {
        let pairs = start.iter().zip(&target.grippers);
        pairs.map(|(a, b)| between(*a, *b, k as f64 / last)).collect()
    };
    Motion { positions: (0..times.len()).map(straight_step).collect(), times }
}

/// The best drape along the motions of several fronts. They are ranked as a search ranks its candidates, and of the best few
/// each is draped with the mesh of the scene until one is accepted.
pub fn best_front(
    scene: &Scene,
    fronts: &Fronts,
    strategies: &[Strategy],
    state: &SearchState,
) -> Result<ComparedDrape, Error> {
    // ranking costs a coarse drape, which a single strategy does not need
    let ranked = |strategy: &Strategy| {
        let positions = fronts.positions(*strategy)?;
        let score = match strategies {
            [_] => 0.0,
            _ => match fronts.rank(&positions, Mesh::Coarse, &Bias::default(), state) {
                Ok((score, _)) => score,
                Err(fault) => return Some(Err(fault)),
            },
        };
        Some(Ok((score, *strategy, positions)))
    };
    let ranked: Result<Vec<_>, Error> = strategies.par_iter().filter_map(ranked).collect();
    let mut ranked = ranked?;
    ranked.sort_by(|a, b| a.0.total_cmp(&b.0));
    // only the best few get the mesh of the scene, because ranks of a coarse sheet are not exact
    let mut best: Result<ComparedDrape, Error> = Err(Error::ComparisonInterrupted);
    for (_, strategy, positions) in ranked.into_iter().take(TUNING.search.batch) {
        let drape = planned(scene, Some(strategy), positions, Vec::new(), state);
        let better = match (&best, &drape) {
            (Err(_), _) => true,
            (Ok(_), Err(_)) => false,
            (Ok(best), Ok(drape)) => drape.order(best).is_lt(),
        };
        if better {
            best = drape;
        }
        if state.is_stopped() || best.as_ref().is_ok_and(ComparedDrape::is_accepted) {
            break;
        }
    }
    best
}

/// The drape along the motion of the stepwise planner.
pub fn by_steps(scene: &Scene, state: &SearchState) -> Result<ComparedDrape, Error> {
    let plan = stepwise(scene, &mut |_| state.report());
    let limits = plan::unreached(scene, &plan);
    planned(scene, None, plan.positions, limits, state)
}

/// The drape along planned positions (m), judged as a search decides on a plan; `own_limits` are those of its planner.
fn planned(
    scene: &Scene,
    strategy: Option<Strategy>,
    positions: Vec<Vec<Point>>,
    own_limits: Vec<Verdict>,
    state: &SearchState,
) -> Result<ComparedDrape, Error> {
    if state.is_stopped() {
        return Err(Error::ComparisonInterrupted);
    }
    let mut decision = Decision::uncounted(scene, strategy, positions, state)?;
    decision.finish(scene, own_limits, state, true)?;
    decision.decided.drape.summary.judge_rest(&scene.layup, &scene.limits);
    let Decision { motion, decided, .. } = decision;
    let Decided { mut drape, judged, .. } = decided;
    if let Some(sheet) = &mut drape.sheet {
        sheet.states.clear();
    }
    Ok(ComparedDrape { drape, judged, time: motion.duration() })
}
