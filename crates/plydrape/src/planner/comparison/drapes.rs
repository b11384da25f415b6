//! The drape of a scene by each strategy of a comparison.

use super::{ComparedDrape, NotDraped};
use crate::draping::record::Summary;
use crate::draping::spans::Point;
use crate::draping::{Drape, Judged, simulate};
use crate::measure::Verdict;
use crate::mold::vector::between;
use crate::motion::{Bounds, TimedMotion};
use crate::planner::decision::{Decision, PlannedSheet};
use crate::planner::evaluation::{self, Mesh};
use crate::planner::path::tuning::TUNING;
use crate::planner::path::{Fronts, Strategy};
use crate::planner::plan::{self, Followed};
use crate::planner::search_state::SearchState;
use crate::planner::stepwise::stepwise;
use crate::scene::{Model, Motion, Scene, SheetTime};
use crate::sheet;
use rayon::prelude::*;
use std::ops::ControlFlow;

/// The drape along the straight paths of the scene, as `simulate` drapes them.
pub fn straight(scene: &Scene, state: &SearchState) -> Result<ComparedDrape, NotDraped> {
    let scene = Scene { motion: straight_motion(scene), ..scene.clone() };
    let time = match (scene.settings.model, scene.settings.sheet.time) {
        (Model::Sheet, SheetTime::Real) => scene.motion.times.last().copied().unwrap_or(0.0),
        _ => TimedMotion::new(&scene.motion.positions, &Bounds::from(&scene.limits))?.duration(),
    };
    let drape = simulate(&scene, |_| state.report());
    let stop = || state.report().is_break();
    let along = |_: &sheet::State| ControlFlow::Continue(());
    let sheet = match scene.settings.model {
        // a scene without a sheet is refused before
        Model::Sheet => sheet::drape(&scene, sheet::Tuning::default(), &stop, along).ok(),
        Model::Catenaries => None,
    };
    let steps = scene.motion.positions.len();
    let judged = |drape: sheet::Drape| {
        let judged = evaluation::judged(&drape.summary, steps);
        (drape, judged)
    };
    Ok(decided(drape, sheet.map(judged), time))
}

/// From the start of the scene straight to its target, in the steps and times of its motion.
fn straight_motion(scene: &Scene) -> Motion {
    let (Some(start), Some(target)) = (scene.motion.positions.first(), &scene.target) else {
        return scene.motion.clone();
    };
    let times = match scene.motion.times.len() {
        // a ply that is held has one step
        0 | 1 => (0..scene.plan.steps.max(2)).map(|k| k as f64).collect(),
        _ => scene.motion.times.clone(),
    };
    let last = (times.len() - 1) as f64;
    let at = |k: usize| -> Vec<Point> {
        let pairs = start.iter().zip(&target.grippers);
        pairs.map(|(a, b)| between(*a, *b, k as f64 / last)).collect()
    };
    Motion { positions: (0..times.len()).map(at).collect(), times }
}

/// The best drape along the motions of several fronts. They are ranked as a search ranks its candidates, and of the best few
/// each is draped with the mesh of the scene until one is accepted.
pub fn best_front(
    scene: &Scene,
    fronts: &Fronts,
    strategies: &[Strategy],
    state: &SearchState,
) -> Result<ComparedDrape, NotDraped> {
    let ranked = |strategy: &Strategy| {
        let positions = fronts.positions(*strategy)?;
        let score = match strategies {
            [_] => 0.0,
            _ => fronts
                .rank(&positions, Mesh::Coarse, state)
                .map_or_else(|score| score, |drape| evaluation::score(&drape)),
        };
        Some((score, *strategy, positions))
    };
    let mut ranked: Vec<_> = strategies.par_iter().filter_map(ranked).collect();
    ranked.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut best: Result<ComparedDrape, NotDraped> = Err(NotDraped::Interrupted);
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
pub fn by_steps(scene: &Scene, state: &SearchState) -> Result<ComparedDrape, NotDraped> {
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
) -> Result<ComparedDrape, NotDraped> {
    if state.is_stopped() {
        return Err(NotDraped::Interrupted);
    }
    let mut decision = Decision::uncounted(scene, strategy, positions, state)?;
    let Followed { drape, .. } = plan::follow(scene, &mut decision, own_limits, state);
    let Decision { motion, sheet, drape: judged, .. } = decision;
    let sheet = sheet.map(|sheet| (sheet.drape, judged));
    Ok(decided(drape, sheet, motion.duration()))
}

/// A drape of which the sheet decides, if there is one, as it is judged.
fn decided(mut drape: Drape, sheet: Option<(sheet::Drape, Judged)>, time: f64) -> ComparedDrape {
    let summary = &mut drape.summary;
    let (sheet, judged) = match sheet {
        Some((drape, judged)) => {
            summary.decide_by(drape.summary.clone());
            (Some(PlannedSheet { drape, states: Vec::new() }), judged)
        }
        None => {
            let Summary { limits, accepted, .. } = summary.clone();
            let missing = 1.0 - summary.steps as f64 / summary.steps_planned.max(1) as f64;
            (None, Judged { limits, accepted, missing, unsolved: 0 })
        }
    };
    ComparedDrape { drape, sheet, judged, time }
}
