//! One drape by one model: the motion is followed, every step is measured and recorded, and the end is judged.

use super::flight::{Flight, Lookout};
use super::forecast::Effort;
use super::recorder::Recorder;
use super::sensitivity::judge_sensitivity;
use super::{Status, Step, Summary, check_catenaries};
use crate::Error;
use crate::draping::spans::Equilibrium;
use crate::draping::{self, Draping, Follow};
use crate::layup::{Layup, Model};
use crate::measure::{Judge, Limits, Scope, Verdict};
use crate::scene::Scene;
use crate::sheet::{self, HandOver};
use crate::state::PlyState;
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
    pub drape: sheet::SheetDrape,
    /// The states that the scene keeps, the first and the last among them; empty if the caller took them as they came.
    pub states: Vec<sheet::ClothState>,
    /// The flight of the drape, if there is one to share.
    pub flight: Option<Flight>,
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
    /// The judgment of a drape that could not begin.
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

/// What watches a drape: it is asked whether to go on, and shown each step.
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
            let (drape, flight) = drape_sheet(&carried, &mut recorder, watch)?;
            let solving = drape.duration;
            let (summary, steps) = recorder.finish_sheet(&drape);
            (summary, steps, Some(DrapedSheet { drape, states: Vec::new(), flight }), solving)
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
    let flight = sheet.as_ref().and_then(|sheet| sheet.flight.as_ref());
    judge_sensitivity(&mut summary, &scene.layup, &scene.limits, flight, watch.stop);
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

/// Follows the sheet of a layup and records every step; gives its flight too, if there is one to share.
fn drape_sheet(
    layup: &Layup,
    recorder: &mut Recorder,
    watch: &mut DrapeWatch,
) -> Result<(sheet::SheetDrape, Option<Flight>), Error> {
    let mut hand_over = HandOver::default();
    let (mut ended, mut lookout) = (false, Lookout::new(layup));
    let DrapeWatch { stop, see } = watch;
    let tuning = sheet::SheetTuning::default();
    let drape = sheet::drape(layup, tuning, *stop, |sheet, state, last| {
        ended = last;
        let ply = &hand_over.state(layup, sheet, state, last);
        recorder.add(ply, None, last);
        if let Some(lookout) = &mut lookout {
            let judge = recorder.judge();
            lookout.see(&Seen { sheet, state, ply, judge, hand_over: &hand_over });
        }
        see(state.step, Some(state))
    })?;
    // a drape that ends before its motion is judged by the last state that it came to
    if !ended {
        recorder.add(&hand_over.state(layup, &drape.sheet, &drape.last, true), None, true);
    }
    Ok((drape, lookout.and_then(|lookout| lookout.flight)))
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
    judge_seen(layup, limits, most_equilibria, None, stop, &mut |_| ()).map(|(judged, _)| judged)
}

/// As [`judge`], from a flight of the sheet on if there is one, with the sheet as it ended if that draped; `see` is shown the ply of each step.
pub(super) fn judge_seen(
    layup: &Layup,
    limits: &Limits,
    most_equilibria: usize,
    flight: Option<&Flight>,
    stop: &dyn Fn() -> bool,
    see: &mut dyn FnMut(&PlyState),
) -> Result<(Judged, Option<sheet::SheetDrape>), Error> {
    if layup.settings.model == Model::Sheet {
        let go_on = &mut |seen: Seen| {
            see(seen.ply);
            ControlFlow::Continue(())
        };
        let (judged, drape) = judge_sheet(layup, limits, flight, stop, go_on)?;
        return Ok((judged, Some(drape)));
    }
    // what is judged is the motion that the tool makes, not the one that was asked for
    check_catenaries(layup, layup.settings.model)?;
    let (carried, _) = layup.carried();
    let layup = &*carried;
    let mut judge = Judge::new(layup, limits, false);
    // catenaries are a statics of each step: every one is judged as it is found
    let mut stopped = false;
    let follow = Follow { most_equilibria, full: false };
    let followed = draping::follow(layup, follow, |state, _, last| {
        judge.see(state, last);
        see(state);
        stopped = stop();
        if stopped { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    let judged = Judged {
        limits: judge.verdicts(),
        complete: followed.steps == layup.motion.positions.len(),
        missing: missing(followed.steps, layup),
        unsolved: followed.unsolved,
        interrupted: stopped,
        effort: None,
    };
    Ok((judged, None))
}

/// A step of a sheet as it is judged.
pub(super) struct Seen<'a> {
    /// The sheet.
    pub sheet: &'a sheet::Sheet,
    /// The ply in the step.
    pub state: &'a sheet::ClothState,
    /// That ply as measures see it.
    pub ply: &'a PlyState,
    /// The judge that has seen it.
    pub judge: &'a Judge<'a>,
    /// What has handed it over.
    pub hand_over: &'a HandOver,
}

/// Judges the sheet of a layup along its motion, from a flight on if there is one; `see` is called with each step, and may end the drape.
///
/// # Errors
/// As [`judge`].
pub(super) fn judge_sheet(
    layup: &Layup,
    limits: &Limits,
    flight: Option<&Flight>,
    stop: &dyn Fn() -> bool,
    see: &mut dyn FnMut(Seen) -> ControlFlow<()>,
) -> Result<(Judged, sheet::SheetDrape), Error> {
    let (carried, _) = layup.carried();
    let carried = &*carried;
    let (mut judge, mut hand_over) = match flight {
        Some(flight) => flight.go_on(carried, limits),
        None => (Judge::new(carried, limits, false), HandOver::default()),
    };
    let tuning = sheet::SheetTuning::default();
    let beginning = match flight {
        Some(flight) => sheet::Beginning::Air(&flight.air),
        None => sheet::Beginning::Flat,
    };
    let mut ended = false;
    let drape = sheet::drape_from(carried, tuning, beginning, stop, |sheet, state, last| {
        ended = last;
        let ply = &hand_over.state(carried, sheet, state, last);
        judge.see(ply, last);
        see(Seen { sheet, state, ply, judge: &judge, hand_over: &hand_over })
    })?;
    if drape.status == sheet::Status::NotInTheAir {
        return judge_sheet(layup, limits, None, stop, see);
    }
    // an interrupted sheet is judged by the last state that it reached
    if !ended {
        judge.see(&hand_over.state(carried, &drape.sheet, &drape.last, true), true);
    }
    let complete = drape.status == sheet::Status::Converged;
    let judged = Judged {
        limits: judge.verdicts(),
        complete: complete && drape.steps == carried.motion.positions.len(),
        missing: missing(drape.steps, carried),
        unsolved: usize::from(!complete),
        interrupted: drape.status == sheet::Status::Interrupted,
        effort: Some(Effort::new(&drape)),
    };
    Ok((judged, drape))
}

/// Share of the steps of a motion that is missing where this many are done.
fn missing(steps: usize, layup: &Layup) -> f64 {
    1.0 - steps as f64 / layup.motion.positions.len().max(1) as f64
}
