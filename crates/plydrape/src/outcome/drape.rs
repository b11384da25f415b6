//! One drape by one model: the motion is followed, every step is measured and recorded, and the end is judged.

use super::forecast::Effort;
use super::recorder::Recorder;
use super::sensitivity::judge_sensitivity;
use super::{Status, Step, Summary, check_catenaries};
use crate::Error;
use crate::draping::spans::Equilibrium;
use crate::draping::{self, Draping, Follow};
use crate::layup::{Layup, Model};
use crate::measure::{Judge, Limits, Name, Scope, Verdict};
use crate::scene::Scene;
use crate::sheet::{self, HandOver};
use std::ops::ControlFlow;
use std::time::Duration;

/// A finished drape by one model.
#[derive(Debug, Clone)]
pub struct Drape {
    /// The ply in every step, the start being the first.
    pub steps: Vec<Step>,
    /// How it came out.
    pub summary: Summary,
    /// The sheet at its end; `None` of catenaries.
    pub sheet: Option<DrapedSheet>,
    /// Time that the model took; no part of the result, which is the same on every machine.
    pub solving: Duration,
}

/// The sheet of a finished drape.
#[derive(Debug, Clone)]
pub struct DrapedSheet {
    /// The drape.
    pub drape: sheet::Drape,
    /// The states that the scene keeps, the first and the last among them; empty if the caller took them as they came.
    pub states: Vec<sheet::ClothState>,
}

/// How a drape came out for a search, which keeps the verdicts alone.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Judged {
    /// Every limit that applies, but those of a motion in time.
    pub limits: Vec<Verdict>,
    /// Whether every step was done, and the ply came to rest.
    pub complete: bool,
    /// Share of the steps that were not done: it was broken off.
    pub missing: f64,
    /// Steps that were not solved.
    pub unsolved: usize,
    /// Whether it was stopped before it had an end.
    pub interrupted: bool,
    /// What the sheet took; `None` of catenaries. It is not written.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub effort: Option<Effort>,
}

impl Judged {
    /// Of a drape that could not begin.
    #[must_use]
    pub(crate) fn nothing() -> Self {
        Judged {
            limits: Vec::new(),
            complete: false,
            missing: 1.0,
            unsolved: 1,
            interrupted: false,
            effort: None,
        }
    }

    /// Whether all steps were done and every limit holds.
    #[must_use]
    pub fn accepted(&self) -> bool {
        self.complete && self.limits.iter().all(|verdict| verdict.ok)
    }

    /// A recorded drape as a search sees it: without the limits of a motion in time, which gets its least time after the search.
    #[must_use]
    pub fn new(drape: &Drape) -> Self {
        let Drape { steps, summary, sheet, .. } = drape;
        let solved = |status| matches!(status, Status::Converged | Status::Torn);
        let unsolved = steps.iter().filter(|step| !step.is_solved()).count();
        let timeless = |verdict: &&Verdict| verdict.name.measure().scope() != Scope::Time;
        Judged {
            limits: summary.limits.iter().filter(timeless).cloned().collect(),
            complete: summary.status == Status::Converged,
            missing: 1.0 - summary.steps as f64 / summary.steps_planned.max(1) as f64,
            unsolved: unsolved + usize::from(!solved(summary.status)),
            interrupted: summary.interrupted(),
            effort: sheet.as_ref().map(|sheet| Effort::new(&sheet.drape)),
        }
    }
}

/// Who watches a drape: asked whether to go on, and shown what comes.
pub struct DrapeWatch<'a> {
    /// Asked before each time step whether to end.
    pub stop: &'a (dyn Fn() -> bool + Sync),
    /// Called with how many steps are done, with the state of the sheet if that drapes; it may end the drape.
    pub see: &'a mut dyn FnMut(usize, Option<&sheet::ClothState>) -> ControlFlow<()>,
}

/// Drapes along the motion of a scene, as its tool makes it, by one of the models, and judges that by every limit but those of a sample of
/// cells.
///
/// # Errors
/// The errors of [`super::check_model`] if the scene lacks what the model needs, and [`plydrape_layup::Error::ToolTips`] if the frame of its tool
/// tips over.
pub fn drape(scene: &Scene, model: Model, watch: &mut DrapeWatch) -> Result<Drape, Error> {
    let mut drape = drape_places(scene, model, watch)?;
    drape.summary.judge_motion(&scene.layup, &scene.limits);
    Ok(drape)
}

/// Drapes as [`drape()`], without the limits of the motion in time: a search judges those of the motion that it finds.
pub(crate) fn drape_places(
    scene: &Scene,
    model: Model,
    watch: &mut DrapeWatch,
) -> Result<Drape, Error> {
    check_catenaries(&scene.layup, model)?;
    scene.layup.check_carried()?;
    let (carried, tool) = scene.layup.carried();
    let mut recorder = Recorder::new(&carried, &scene.limits);
    let (mut summary, steps, sheet, solving) = match model {
        Model::Sheet => {
            let drape = drape_sheet(&carried, &scene.limits, &mut recorder, watch)?;
            let solving = drape.duration;
            let (summary, steps) = recorder.finish_sheet(&drape);
            (summary, steps, Some(DrapedSheet { drape, states: Vec::new() }), solving)
        }
        Model::Catenaries => {
            let mut draping = Draping::new(&carried);
            let (summary, steps, solving) = follow_catenaries(&mut draping, recorder, watch).0;
            (summary, steps, None, solving)
        }
    };
    if let Some(tool) = tool {
        summary.follow_tool(scene, tool);
    }
    judge_sensitivity(&mut summary, &scene.layup, &scene.limits, watch.stop);
    Ok(Drape { steps, summary, sheet, solving })
}

/// Drapes along the motion of a layup by catenaries as [`drape`], and gives the shape of the last step too, whose ply is left in `draping`.
pub(crate) fn drape_catenaries(
    layup: &Layup,
    limits: &Limits,
    draping: &mut Draping,
    watch: &mut DrapeWatch,
) -> (Drape, Option<Equilibrium>) {
    let recorder = Recorder::new(layup, limits);
    let ((summary, steps, solving), shape) = follow_catenaries(draping, recorder, watch);
    (Drape { steps, summary, sheet: None, solving }, shape)
}

/// Follows the catenaries and records every step.
fn follow_catenaries(
    draping: &mut Draping,
    mut recorder: Recorder,
    watch: &mut DrapeWatch,
) -> ((Summary, Vec<Step>, Duration), Option<Equilibrium>) {
    let follow = Follow { most_equilibria: usize::MAX, full: true };
    let (followed, shape) = draping.follow(follow, |state, record, last| {
        recorder.add(state, record, last);
        if (watch.stop)() {
            return ControlFlow::Break(());
        }
        (watch.see)(state.step, None)
    });
    let (summary, steps) = recorder.finish_catenaries(&followed);
    ((summary, steps, followed.solving), shape)
}

/// Follows the sheet of a layup and records every step.
fn drape_sheet(
    layup: &Layup,
    limits: &Limits,
    recorder: &mut Recorder,
    watch: &mut DrapeWatch,
) -> Result<sheet::Drape, Error> {
    let (mut hand_over, low) = (HandOver::default(), limits.get(Name::Height).unwrap_or(0.0));
    let mut ended = false;
    let DrapeWatch { stop, see } = watch;
    let tuning = sheet::SheetTuning::default();
    let drape = sheet::drape(layup, tuning, low, *stop, |sheet, state, last| {
        ended = last;
        recorder.add(&hand_over.state(layup, sheet, state, last), None, last);
        see(state.step, Some(state))
    })?;
    // a drape that ends before its motion is judged by the last state that it came to
    if !ended {
        recorder.replace_last(&hand_over.state(layup, &drape.sheet, &drape.last, true));
    }
    Ok(drape)
}

/// Drapes as [`drape`] along a motion without times, and keeps the verdicts alone; broken off after the step in which the catenaries have
/// taken more than `most_equilibria`.
///
/// # Errors
/// The errors of [`super::check_model`] if the layup lacks what the model of its settings needs.
pub fn judge(
    layup: &Layup,
    limits: &Limits,
    most_equilibria: usize,
    stop: &dyn Fn() -> bool,
) -> Result<Judged, Error> {
    judge_seen(layup, limits, most_equilibria, stop).map(|(judged, _)| judged)
}

/// As [`judge`], with the sheet as it ended if that draped.
pub(super) fn judge_seen(
    layup: &Layup,
    limits: &Limits,
    most_equilibria: usize,
    stop: &dyn Fn() -> bool,
) -> Result<(Judged, Option<sheet::Drape>), Error> {
    // what is judged is the motion that the tool makes, not the one that was asked for
    check_catenaries(layup, layup.settings.model)?;
    let (carried, _) = layup.carried();
    let layup = &*carried;
    let planned = layup.motion.positions.len();
    let missing = |steps: usize| 1.0 - steps as f64 / planned.max(1) as f64;
    let mut judge = Judge::new(layup, limits, false);
    match layup.settings.model {
        Model::Sheet => {
            // pads let go of a ply that lies: nodes up to the limit of the height do
            let (mut hand_over, low) =
                (HandOver::default(), limits.get(Name::Height).unwrap_or(0.0));
            let mut ended = false;
            let tuning = sheet::SheetTuning::default();
            let drape = sheet::drape(layup, tuning, low, stop, |sheet, state, last| {
                ended = last;
                judge.see(&hand_over.state(layup, sheet, state, last), last);
                ControlFlow::Continue(())
            })?;
            // an interrupted sheet is judged by the last state that it reached
            if !ended {
                judge.see(&hand_over.state(layup, &drape.sheet, &drape.last, true), true);
            }
            let complete = drape.status == sheet::Status::Converged;
            let judged = Judged {
                limits: judge.verdicts(),
                complete: complete && drape.steps == planned,
                missing: missing(drape.steps),
                unsolved: usize::from(!complete),
                interrupted: drape.status == sheet::Status::Interrupted,
                effort: Some(Effort::new(&drape)),
            };
            Ok((judged, Some(drape)))
        }
        Model::Catenaries => {
            // catenaries are a statics of each step: every one is judged as it is found
            let mut stopped = false;
            let follow = Follow { most_equilibria, full: false };
            let followed = draping::follow(layup, follow, |state, _, last| {
                judge.see(state, last);
                stopped = stop();
                if stopped { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            });
            let judged = Judged {
                limits: judge.verdicts(),
                complete: followed.steps == planned,
                missing: missing(followed.steps),
                unsolved: followed.unsolved,
                interrupted: stopped,
                effort: None,
            };
            Ok((judged, None))
        }
    }
}
