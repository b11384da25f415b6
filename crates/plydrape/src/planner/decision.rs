//! The decision about a plan: its motion in time, and the drape along it by the model that decides, with the mesh of the
//! scene.

use super::evaluation;
use super::path::Strategy;
use super::search_state::SearchState;
use super::tuning::TUNING;
use crate::draping::spans::Point;
use crate::draping::{self, Judged};
use crate::measure::Verdict;
use crate::motion::{Attitudes, Bounds, MotionError, TimedMotion};
use crate::scene::{Model, Motion, ReleaseOrder, Scene};
use crate::sheet;
use crate::tool::{Carried, ToolRecord};
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};

/// The drape of the sheet along a planned motion.
#[derive(Debug, Clone)]
pub struct PlannedSheet {
    /// The drape.
    pub drape: sheet::Drape,
    /// The states that the scene wants to be kept.
    pub states: Vec<sheet::State>,
}

/// A plan on which was decided.
#[derive(Debug, Clone)]
pub struct Decision {
    /// The strategy behind it, of a plan of whole trajectories.
    pub strategy: Option<Strategy>,
    /// The positions that were planned (m), one list of all grippers a step; of a tool, those that it brings its grippers to.
    pub positions: Vec<Vec<Point>>,
    /// What the planned positions asked of the tool, if there is one.
    pub asked: Option<ToolRecord>,
    /// The motion in time.
    pub motion: TimedMotion,
    /// The drape of the sheet, where that decides.
    pub sheet: Option<PlannedSheet>,
    /// Its limits and failures.
    pub drape: Judged,
    /// [`evaluation::score`] of it.
    pub score: f64,
}

impl Decision {
    /// Drapes along planned positions (m).
    ///
    /// # Errors
    /// If they cannot become a motion.
    pub fn on(
        scene: &Scene,
        strategy: Option<Strategy>,
        positions: Vec<Vec<Point>>,
        state: &SearchState,
    ) -> Result<Self, MotionError> {
        let decision = Self::uncounted(scene, strategy, positions, state)?;
        state.record(&decision.drape, decision.score, true);
        Ok(decision)
    }

    /// The same, not counted among the decisions of a search.
    ///
    /// # Errors
    /// If the positions cannot become a motion.
    pub fn uncounted(
        scene: &Scene,
        strategy: Option<Strategy>,
        positions: Vec<Vec<Point>>,
        state: &SearchState,
    ) -> Result<Self, MotionError> {
        let (positions, asked) = match &scene.tool {
            Some(tool) => {
                let Carried { positions, record, .. } = tool.carry(&positions);
                (positions, Some(record))
            }
            None => (positions, None),
        };
        let motion = TimedMotion::new(&positions, &Bounds::from(&scene.limits))?;
        let (sheet, drape, score) = decided(scene, &motion, state);
        Ok(Decision { strategy, positions, asked, motion, sheet, drape, score })
    }

    /// The same places in another time.
    pub fn retimed(&mut self, scene: &Scene, motion: TimedMotion, state: &SearchState) {
        let before = std::mem::replace(&mut self.motion, motion);
        let dwells_on_the_way = scene
            .release
            .as_ref()
            .is_some_and(|release| release.order == ReleaseOrder::Landed && release.dwell > 0.0);
        if scene.settings.sheet.time == crate::scene::SheetTime::Real || dwells_on_the_way {
            (self.sheet, self.drape, self.score) = decided(scene, &self.motion, state);
            state.record(&self.drape, self.score, true);
        } else if let Some(sheet) = &mut self.sheet {
            let (end, now) = (before.duration(), self.motion.duration());
            for state in sheet.states.iter_mut().chain([&mut sheet.drape.last]) {
                let after = (state.time - end).max(0.0);
                state.time = self.motion.times()[state.step - 1] + after;
            }
            for event in &mut sheet.drape.summary.events {
                event.time = match event.time < end {
                    true => self.motion.same_place(&before, event.time),
                    // how long pads press after the motion is the scene's
                    false => now + (event.time - end),
                };
            }
        }
    }
}

/// The drape along a motion, its limits and failures, and its score. The drape with a step half-way between all steps counts
/// where it is the worse.
fn decided(
    scene: &Scene,
    motion: &TimedMotion,
    state: &SearchState,
) -> (Option<PlannedSheet>, Judged, f64) {
    // both at once, because most of a drape runs on one core; the second counts only where the first is accepted
    let refused = AtomicBool::new(false);
    let ((mut sheet, mut drape), between) = rayon::join(
        || {
            let (sheet, drape) = draped(scene, motion, state);
            refused.store(!drape.accepted, Ordering::Relaxed);
            (sheet, drape)
        },
        || {
            between_steps(scene, motion, &|| {
                refused.load(Ordering::Relaxed) || state.report().is_break()
            })
        },
    );
    let clearance = clearance(scene, motion);
    drape = evaluation::also(drape, clearance.clone());
    let mut score = evaluation::score(&drape);
    if drape.accepted
        && let Some(between) = between
    {
        if let Some(sheet) = &mut sheet {
            sheet.drape.summary.judge_between(&between);
        }
        let judged = evaluation::also(evaluation::judged(&between, between.steps), clearance);
        let worse = evaluation::score(&judged).max(score);
        if !judged.accepted || worse > score {
            (drape, score) = (judged, worse);
        }
    }
    if drape.accepted && scene.settings.model == Model::Sheet {
        let events = sheet.as_ref().map_or(&[][..], |sheet| &sheet.drape.summary.events);
        let scene = sheet::event::at_these_times(scene, events);
        let scene = evaluation::with_motion(&scene, motion.steps());
        drape = evaluation::with_errors(&scene, drape, |cell| {
            let stop = || state.report().is_break();
            let along = |_: &sheet::State| ControlFlow::Continue(());
            let drape = sheet::drape(&cell, sheet::Tuning::default(), &stop, along).ok()?;
            let ended = drape.summary.status != sheet::Status::Interrupted;
            ended.then(|| evaluation::judged(&drape.summary, motion.times().len()))
        });
        score = evaluation::score(&drape);
    }
    (sheet, drape, score)
}

/// The verdict on the nearest pair of bodies along the whole motion, with pads turned as the motion file will say; none of a scene
/// without bodies.
fn clearance(scene: &Scene, motion: &TimedMotion) -> Option<Verdict> {
    if scene.bodies.is_empty() {
        return None;
    }
    let followed = evaluation::with_motion(scene, motion.steps());
    let drape = draping::simulate(&followed, |_| ControlFlow::Continue(()));
    let attitudes = Attitudes::of(&drape.steps).ok()?;
    evaluation::clearance_of_motion(scene, motion, &attitudes)
}

/// The drape of the sheet along the motion with a step half-way between all its steps, because a good plan does not depend
/// on where the motion is sampled; none of catenaries, or if it was stopped.
fn between_steps(
    scene: &Scene,
    motion: &TimedMotion,
    stop: &(dyn Fn() -> bool + Sync),
) -> Option<sheet::Summary> {
    if scene.settings.model != Model::Sheet {
        return None;
    }
    let mut times = motion.times().to_vec();
    times.extend(motion.times().windows(2).map(|pair| 0.5 * (pair[0] + pair[1])));
    times.sort_by(f64::total_cmp);
    let positions: Vec<Vec<Point>> = times.iter().map(|t| motion.at(*t)).collect();
    let steps = times.len();
    let scene = evaluation::with_motion(scene, Motion { times, positions });
    let along = |_: &sheet::State| ControlFlow::Continue(());
    let drape = sheet::drape(&scene, sheet::Tuning::default(), stop, along).ok()?;
    (drape.summary.steps == steps).then_some(drape.summary)
}

fn draped(
    scene: &Scene,
    motion: &TimedMotion,
    state: &SearchState,
) -> (Option<PlannedSheet>, Judged) {
    let steps = motion.times().len();
    let scene = evaluation::with_motion(scene, motion.steps());
    let mut states = Vec::new();
    let keep = |state: &sheet::State| {
        if sheet::is_kept(state.step, steps, scene.settings.sheet.keep) {
            states.push(state.clone());
        }
        ControlFlow::Continue(())
    };
    let stop = || state.report().is_break();
    let drape = match scene.settings.model {
        Model::Sheet => sheet::drape(&scene, sheet::Tuning::default(), &stop, keep).ok(),
        Model::Catenaries => None,
    };
    match drape {
        Some(drape) => {
            let judged = evaluation::judged(&drape.summary, steps);
            (Some(PlannedSheet { drape, states }), judged)
        }
        None => {
            let most = TUNING.evaluation.most_equilibria * steps;
            (None, draping::judge(&scene, most, |_| state.report()))
        }
    }
}
