//! Drapes of one scene by every named strategy, side by side: which of them lay the ply down, and why the others do not.
//!
//! Nothing is searched. Each strategy is one motion, draped with the mesh of the scene and judged by its limits: the straight
//! one as `simulate` drapes it, the others as a finished plan.

use super::decision::{Decision, PlannedSheet};
use super::evaluation;
use super::path::{Fronts, Strategy};
use super::plan::{self, Followed, PlanError};
use super::search_state::{SearchState, Watcher};
use super::stepwise::stepwise;
use crate::draping::spans::Point;
use crate::draping::{Drape, Judged, simulate};
use crate::measure::{Subject, Verdict};
use crate::mold::vector::between;
use crate::motion::{Bounds, MotionError, TimedMotion};
use crate::scene::{Model, Motion, Scene, SheetTime};
use crate::sheet;
use rayon::prelude::*;
use std::fmt::{self, Display, Formatter};
use std::ops::ControlFlow;

/// The ways to lay a ply that have a name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum StrategyName {
    /// Every gripper straight from its start to its target.
    Straight,
    /// The array is formed over its place, nearly flat, and let down so that all cells land nearly together.
    AllAtOnce,
    /// A line lands first and the ply is rolled on to both sides of it, as steep as the tilt of the grippers allows.
    Rolled,
    /// The middle of the ply lands first, and a ring spreads from it, as steep as the tilt of the grippers allows.
    FromAPoint,
    /// Step by step, by the stepwise planner.
    Stepwise,
}

impl StrategyName {
    /// Every strategy, in the order in which they are shown.
    pub const ALL: [StrategyName; 5] = [
        StrategyName::Straight,
        StrategyName::AllAtOnce,
        StrategyName::Rolled,
        StrategyName::FromAPoint,
        StrategyName::Stepwise,
    ];
}

impl Display for StrategyName {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        f.pad(match self {
            StrategyName::Straight => "straight",
            StrategyName::AllAtOnce => "all at once",
            StrategyName::Rolled => "rolled",
            StrategyName::FromAPoint => "from a point",
            StrategyName::Stepwise => "stepwise",
        })
    }
}

/// Why there is no drape by a strategy.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NotDraped {
    /// Its positions cannot become a motion.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// The comparison was ended before its drape was complete.
    #[error("interrupted before its drape was complete")]
    Interrupted,
}

/// One strategy of a comparison.
#[derive(Debug, Clone)]
pub struct Compared {
    /// The strategy.
    pub name: StrategyName,
    /// The drape along its motion.
    pub drape: Result<ComparedDrape, NotDraped>,
}

/// The drape by one strategy.
#[derive(Debug, Clone)]
pub struct ComparedDrape {
    /// The drape by catenaries, with the verdict of the model that decides.
    pub drape: Drape,
    /// The drape by the sheet with its last state, where the sheet decides.
    pub sheet: Option<PlannedSheet>,
    /// The shortest time of the motion (s) within the limits of the grippers; in real time, the time in which it was draped.
    pub time: f64,
}

impl ComparedDrape {
    /// Whether it keeps all limits.
    #[must_use]
    pub fn is_accepted(&self) -> bool {
        self.drape.summary.accepted
    }

    /// The limits that decide: those of the deciding model first, then those of the motion.
    #[must_use]
    pub fn limits(&self) -> Vec<&Verdict> {
        let all = self.drape.summary.limits.iter();
        match &self.drape.summary.sheet {
            None => all.collect(),
            Some(sheet) => {
                let of_motion = |v: &&Verdict| v.name.measure().subject() == Subject::Motion;
                sheet.limits.iter().chain(all.filter(of_motion)).collect()
            }
        }
    }

    /// The limits that it breaks, the one exceeded furthest first.
    #[must_use]
    pub fn broken(&self) -> Vec<&Verdict> {
        let mut broken: Vec<&Verdict> = self.limits().into_iter().filter(|v| !v.ok).collect();
        broken.sort_by(|a, b| b.ratio().total_cmp(&a.ratio()));
        broken
    }

    fn judged(&self) -> Judged {
        let summary = &self.drape.summary;
        let steps = summary.sheet.as_ref().map_or(summary.steps, |sheet| sheet.steps);
        let converged = summary.sheet.as_ref().is_none_or(|sheet| sheet.converged);
        Judged {
            limits: self.limits().into_iter().cloned().collect(),
            accepted: summary.accepted,
            missing: 1.0 - steps as f64 / summary.steps_planned.max(1) as f64,
            unsolved: usize::from(!converged),
        }
    }
}

/// The strategies of a scene side by side.
#[derive(Debug, Clone)]
pub struct Comparison {
    /// Each of [`StrategyName::ALL`], in that order.
    pub strategies: Vec<Compared>,
    /// Whether the watcher ended it.
    pub interrupted: bool,
}

impl Comparison {
    /// The best strategy: an accepted one before others, then the one that stays farthest from its limits.
    #[must_use]
    pub fn best(&self) -> Option<(StrategyName, &ComparedDrape)> {
        let drapes = self.strategies.iter().filter_map(|c| Some((c.name, c.drape.as_ref().ok()?)));
        let key = |drape: &ComparedDrape| evaluation::score(&drape.judged());
        drapes.min_by(|(_, a), (_, b)| {
            let order = b.is_accepted().cmp(&a.is_accepted());
            order.then(key(a).total_cmp(&key(b)))
        })
    }
}

/// Drapes a scene by every named strategy. `watcher` receives the progress, a candidate being a strategy; when it breaks, the
/// strategies that are not complete are left out. The same scene gives the same comparison on any number of threads.
///
/// # Errors
/// [`PlanError`] if the scene has no mold or target.
pub fn compare(scene: &Scene, watcher: Watcher) -> Result<Comparison, PlanError> {
    if scene.mold.is_none() {
        return Err(PlanError::NoMold);
    }
    let fronts = Fronts::new(scene).ok_or(PlanError::NoTarget)?;
    let state = SearchState::new(StrategyName::ALL.len(), watcher);
    state.begin("draping the strategies");
    let one = |name: &StrategyName| {
        let drape = match name {
            StrategyName::Straight => straight(scene, &state),
            StrategyName::AllAtOnce => by_front(scene, &fronts, Strategy::flat(), &state),
            StrategyName::Rolled => {
                by_front(scene, &fronts, steepest(&fronts, Strategy::line(scene)), &state)
            }
            StrategyName::FromAPoint => {
                by_front(scene, &fronts, steepest(&fronts, Strategy::ring()), &state)
            }
            StrategyName::Stepwise => by_steps(scene, &state),
        };
        let drape = drape.and_then(|drape| match state.is_stopped() {
            true => Err(NotDraped::Interrupted),
            false => Ok(drape),
        });
        if let Ok(drape) = &drape {
            let judged = drape.judged();
            state.record(&judged, evaluation::score(&judged), true);
            state.set_steps(state.decisions());
        }
        Compared { name: *name, drape }
    };
    let strategies = StrategyName::ALL.par_iter().map(one).collect();
    Ok(Comparison { strategies, interrupted: state.is_interrupted() })
}

/// A front of this shape as steep as the tilt of the grippers allows.
fn steepest(fronts: &Fronts, shape: Strategy) -> Strategy {
    Strategy { slope: fronts.steepest(shape), ..shape }
}

/// The drape along the straight paths of the scene, as `simulate` drapes them.
fn straight(scene: &Scene, state: &SearchState) -> Result<ComparedDrape, NotDraped> {
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
    Ok(decided(drape, sheet, time))
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

/// The drape along the motion of a front.
fn by_front(
    scene: &Scene,
    fronts: &Fronts,
    strategy: Strategy,
    state: &SearchState,
) -> Result<ComparedDrape, NotDraped> {
    let positions = fronts.positions(strategy).unwrap_or_default();
    planned(scene, Some(strategy), positions, Vec::new(), state)
}

/// The drape along the motion of the stepwise planner.
fn by_steps(scene: &Scene, state: &SearchState) -> Result<ComparedDrape, NotDraped> {
    let plan = stepwise(scene, &mut |_| state.report());
    let limits = plan::unreached(scene, &plan);
    planned(scene, None, plan.positions, limits, state)
}

/// The drape along planned positions (m), finished and judged as a plan is; `own_limits` are those of its planner.
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
    let mut decision = Decision::along(scene, strategy, positions, state)?;
    let Followed { drape, .. } = plan::follow(scene, &mut decision, own_limits, state);
    let Decision { motion, sheet, .. } = decision;
    Ok(decided(drape, sheet.map(|sheet| sheet.drape), motion.duration()))
}

/// A drape of which the sheet decides, if there is one.
fn decided(mut drape: Drape, sheet: Option<sheet::Drape>, time: f64) -> ComparedDrape {
    if let Some(sheet) = &sheet {
        drape.summary.decide_by(sheet.summary.clone());
    }
    let sheet = sheet.map(|drape| PlannedSheet { drape, states: Vec::new() });
    ComparedDrape { drape, sheet, time }
}
