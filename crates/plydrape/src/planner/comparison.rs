//! Drapes of one scene by every named strategy, side by side: which of them lay the ply down, and why the others do not.
//!
//! Each strategy is draped with the mesh of the scene and judged by its limits: the straight one as `simulate` drapes it, the
//! others as a search decides on a plan. Rolled and from a point are the fronts that a search tries first, the best of each kind; evolution
//! of them is left to the search.

mod drapes;

use super::evaluation;
use super::path::{Fronts, LowStart, Strategy};
use super::search_state::{SearchState, Watcher};
use crate::Error;
use crate::measure::Verdict;
use crate::outcome::{Drape, Judged, check_model};
use crate::scene::Scene;
use drapes::{best_front, by_steps, straight};
use rayon::prelude::*;
use std::cmp::Ordering;
use std::fmt::{self, Display, Formatter};

/// The ways to lay a ply that have a name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum StrategyName {
    /// Every gripper straight from its start to its target.
    Straight,
    /// The array is formed over its place, nearly flat, and let down so that all cells land nearly together.
    AllAtOnce,
    /// A line lands first and the ply is rolled on to both sides of it, as steeply as the tilt of the grippers allows.
    Rolled,
    /// A point lands first, and a ring or an ellipse spreads from it, about as steeply as the tilt of the grippers allows.
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

/// One strategy of a comparison.
#[derive(Debug, Clone)]
pub struct Compared {
    /// The strategy.
    pub name: StrategyName,
    /// The drape along its motion.
    pub drape: Result<ComparedDrape, Error>,
}

/// The drape by one strategy.
#[derive(Debug, Clone)]
pub struct ComparedDrape {
    /// The drape by the model that decides, with its last state if that is the sheet.
    pub drape: Drape,
    /// How a search judges it. A planned motion is draped as a search decides on it: with a step half-way between all
    /// steps, too, and the worse drape counts.
    judged: Judged,
    /// The shortest time of the motion (s) within the limits of the grippers; in real time, the time in which it was draped.
    pub time: f64,
}

impl ComparedDrape {
    /// Whether it keeps all limits.
    #[must_use]
    pub fn is_accepted(&self) -> bool {
        self.judged.accepted() && self.drape.summary.accepted()
    }

    /// Every limit once: of several verdicts on one limit the worst.
    #[must_use]
    pub fn limits(&self) -> Vec<&Verdict> {
        let mut limits: Vec<&Verdict> = Vec::new();
        for verdict in self.drape.summary.limits.iter().chain(&self.judged.limits) {
            match limits.iter_mut().find(|limit| limit.name == verdict.name) {
                Some(limit) if verdict.ratio() > limit.ratio() => *limit = verdict,
                Some(_) => {}
                None => limits.push(verdict),
            }
        }
        limits
    }

    /// The limits that it breaks, the one exceeded furthest first.
    #[must_use]
    pub fn broken(&self) -> Vec<&Verdict> {
        let mut broken: Vec<&Verdict> = self.limits().into_iter().filter(|v| !v.ok).collect();
        broken.sort_by(|a, b| b.ratio().total_cmp(&a.ratio()));
        broken
    }

    /// The better drape first: an accepted one before others, then the one that stays farther from its limits.
    fn order(&self, other: &Self) -> Ordering {
        let accepted = other.is_accepted().cmp(&self.is_accepted());
        accepted.then_with(|| self.score().total_cmp(&other.score()))
    }

    /// [`evaluation::score`] with the limits of the motion.
    fn score(&self) -> f64 {
        evaluation::score(&self.with_motion())
    }

    /// The judgment with the limits of the motion.
    fn with_motion(&self) -> Judged {
        let limits = self.limits().into_iter().cloned().collect();
        Judged { limits, ..self.judged }
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
        drapes.min_by(|(_, a), (_, b)| a.order(b))
    }
}

/// Drapes a scene by every named strategy. `watcher` receives the progress, a candidate being a strategy; when it breaks, the
/// strategies that are not complete end with [`Error::ComparisonInterrupted`]. The same scene gives the same comparison on any number of threads.
///
/// # Errors
/// [`Error::NoMold`] or [`Error::NoTarget`], or those of [`check_model`] for the model that decides.
pub fn compare(scene: &Scene, watcher: Watcher) -> Result<Comparison, Error> {
    if scene.layup.mold.is_none() {
        return Err(Error::NoMold);
    }
    check_model(&scene.layup, scene.layup.settings.model)?;
    let raised = LowStart::find(scene).map(|low| low.raised(scene));
    let scene = raised.as_ref().unwrap_or(scene);
    // rolled and from a point are families of strategies, of which each is represented by its best
    let fronts = Fronts::new(scene).ok_or(Error::NoTarget)?;
    let state = SearchState::new(StrategyName::ALL.len(), watcher);
    state.begin("draping the strategies");
    let (lines, points): (Vec<Strategy>, Vec<Strategy>) =
        Strategy::families(scene, |shape| fronts.steepest(shape))
            .into_iter()
            .partition(Strategy::is_line);
    let drape_of = |name: &StrategyName| {
        let drape = match name {
            StrategyName::Straight => straight(scene, &state),
            StrategyName::AllAtOnce => best_front(scene, &fronts, &[Strategy::flat()], &state),
            StrategyName::Rolled => best_front(scene, &fronts, &lines, &state),
            StrategyName::FromAPoint => best_front(scene, &fronts, &points, &state),
            StrategyName::Stepwise => by_steps(scene, &state),
        };
        let drape = drape.and_then(|drape| match state.is_stopped() {
            true => Err(Error::ComparisonInterrupted),
            false => Ok(drape),
        });
        // progress shows the best plan so far
        if let Ok(drape) = &drape {
            state.record(&drape.with_motion(), drape.score(), true, None);
            state.set_steps(state.decisions());
        }
        Compared { name: *name, drape }
    };
    let strategies = StrategyName::ALL.par_iter().map(drape_of).collect();
    Ok(Comparison { strategies, interrupted: state.is_interrupted() })
}
