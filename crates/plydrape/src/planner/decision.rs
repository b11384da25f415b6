//! The decision about a plan: its motion in time, and the drape along it by the model that decides, with the mesh of the
//! scene.

use super::cycle::Cycle;
use super::evaluation::{self, ENDS};
use super::infeasible_limits::infeasible_limits;
use super::journal::Known;
use super::path::Strategy;
use super::quickest::quickest;
use super::record::LimitedBy;
use super::search_state::{Proof, SearchState};
use super::tuning::TUNING;
use crate::Error;
use crate::errors::Errors;
use crate::geometry::Point;
use crate::layup::{Layup, Model, Release, SheetTime};
use crate::measure::{Course, MotionPeaks, Name, Scope, Verdict, WholeMotion};
use crate::motion::{Attitudes, Motion, TimedMotion};
use crate::outcome::forecast::{self, CONSTANTS};
use crate::outcome::{
    self, Drape, Effort, Flight, Forecast, Judged, RateTolerance, Robustness, SampleVerdict,
    Timeless, Watch,
};
use crate::scene::Scene;
use crate::sheet;
use crate::tool::{Carried, ToolRecord};
use std::sync::atomic::{AtomicBool, Ordering};

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
    /// What the grippers do before it and after it, if the ply is picked up; known once the motion has its least time, and then the drape
    /// is in the time of the cycle.
    pub cycle: Option<Cycle>,
    /// What follows from the motion by the model that decides.
    pub decided: Decided,
    /// What limits the time of the motion, once that is its least one and all is judged that belongs to it.
    pub limited_by: Option<Vec<LimitedBy>>,
    /// How many times slower than that the motion is, because the resin of the ply takes its time; 1 if it does not.
    pub slowed: f64,
    /// Whether it was draped once more in that time.
    redraped: bool,
}

/// The drape along a motion by the model that decides, and how a search judges it.
#[derive(Debug, Clone)]
pub struct Decided {
    /// The drape.
    pub drape: Drape,
    /// How the grippers are turned in it.
    pub attitudes: Attitudes,
    /// Limits and failures of the drape, with those of a step half-way between all steps, and of a few cells with errors.
    pub judged: Judged,
    /// [`evaluation::score`] of that.
    pub score: f64,
    /// The cell with errors that breaks a limit, if one of those does that prove a plan.
    pub refused_by: Option<usize>,
}

impl Decision {
    /// Drapes along planned positions (m), and says before how long that will take; `ranked` is what the drape took that ranked them. A plan that
    /// keeps its limits is given its least time, and judged with all that belongs to it.
    ///
    /// # Errors
    /// If they cannot become a motion, or the model that decides cannot drape.
    pub fn on(
        scene: &Scene,
        strategy: Option<Strategy>,
        positions: Vec<Vec<Point>>,
        ranked: Option<Effort>,
        state: &SearchState,
    ) -> Result<Self, Error> {
        let asked = positions.clone();
        let undecided = Undecided::new(scene, strategy, positions)?;
        state.set_forecast(forecast(scene, &undecided.motion, ranked, state));
        let decision = undecided.decide(scene, state).and_then(|mut decision| {
            decision.slow_down(scene, state, true)?;
            if decision.decided.judged.accepted() {
                decision.finish(scene, Vec::new(), state, true)?;
            }
            Ok(decision)
        });
        if let Ok(Decision { decided, .. }) = &decision {
            state.record(&decided.judged, decided.score, true, Some((strategy, &asked)));
        }
        state.set_forecast(None);
        decision
    }

    /// Drapes once more along planned positions (m) on which was decided before, and takes what is known of that. Nothing is counted.
    ///
    /// # Errors
    /// As [`Decision::on`].
    pub fn again(
        scene: &Scene,
        strategy: Option<Strategy>,
        positions: Vec<Vec<Point>>,
        known: &Known,
        state: &SearchState,
    ) -> Result<Self, Error> {
        let mut decision = Self::uncounted(scene, strategy, positions, state)?;
        if known.finished {
            decision.finish(scene, Vec::new(), state, false)?;
        }
        Ok(decision)
    }

    /// What a journal keeps of it.
    pub fn known(&self) -> Known {
        let Decided { judged, score, refused_by, .. } = &self.decided;
        let (score, refused_by) = (*score, *refused_by);
        let (finished, drapes) = (self.limited_by.is_some(), 1 + usize::from(self.redraped));
        Known { judged: judged.clone(), score, refused_by, finished, drapes }
    }

    /// Gives the motion the least time under all limits, and judges it as a whole, with limits of its planner; does nothing twice. Drapes that
    /// this takes are counted among the decisions of the search, or not.
    ///
    /// # Errors
    /// As [`Decision::on`].
    pub fn finish(
        &mut self,
        scene: &Scene,
        own_limits: Vec<Verdict>,
        state: &SearchState,
        counted: bool,
    ) -> Result<(), Error> {
        if self.limited_by.is_some() {
            self.decided.drape.summary.judge_also(own_limits);
            return Ok(());
        }
        let mut limited_by = Vec::new();
        if self.slowed == 1.0 {
            self.slow_down(scene, state, counted)?;
        }
        // half a drape has no least time, and who broke it off waits; a motion that resin slows is as quick as it may be
        if !self.decided.drape.summary.interrupted() && self.slowed == 1.0 {
            let found = quickest(scene, &self.motion, &self.decided.drape, None);
            if found.motion != self.motion {
                self.retime(scene, found.motion, state, counted)?;
                self.slow_down(scene, state, counted)?;
            }
            limited_by = found.limited_by;
        }
        self.judge_whole(scene, own_limits)?;
        self.limited_by = Some(limited_by);
        Ok(())
    }

    /// Judges the motion as a whole, with all that grippers do before it and after it, and with limits of its planner.
    fn judge_whole(&mut self, scene: &Scene, own_limits: Vec<Verdict>) -> Result<(), Error> {
        self.cycle = Cycle::around(scene, &self.motion)?;
        let whole = self.whole_motion()?;
        if let Some(cycle) = &self.cycle {
            cycle.delay(scene, &mut self.decided.drape, &whole);
            self.decided.attitudes = outcome::attitudes(&self.decided.drape.steps)?;
        }
        let Decision { asked, decided, .. } = self;
        let motion = &whole;
        let summary = &mut decided.drape.summary;
        if let (Some(asked), Some(made)) = (&asked, summary.tool.take()) {
            summary.follow_tool(scene, made.with_residual_of(asked));
        }
        let rate = motion.fitting_rate(scene.plan.rate);
        let tool = scene.layup.tool.as_ref();
        let peaks = tool.and_then(|tool| tool.peaks(motion, rate).ok());
        let whole = WholeMotion {
            layup: &scene.layup,
            limits: &scene.limits,
            motion: Course::Smooth(motion),
            attitudes: Some(&decided.attitudes),
            peaks: MotionPeaks::new(motion, summary.last_free(motion.times().len()), &scene.limits),
            tool: peaks.as_ref(),
            rate,
        };
        if let Some(tool) = &mut summary.tool {
            tool.arm = peaks.and_then(|peaks| peaks.arm_record);
        }
        // those of a motion in another time do not count
        summary.limits.retain(|verdict| verdict.name.measure().scope() != Scope::Motion);
        summary.judge_also(infeasible_limits(scene));
        summary.judge_also(own_limits);
        summary.judge_also(whole.verdicts());
        // what the drape alone did not know refuses the plan
        let known = |name: Name| decided.judged.limits.iter().any(|v| v.name == name && !v.ok);
        let broken = summary.limits.iter().filter(|v| !v.ok && !known(v.name));
        let broken: Vec<Verdict> = broken.cloned().collect();
        if !broken.is_empty() {
            decided.judged.limits.retain(|v| broken.iter().all(|other| other.name != v.name));
            decided.judged.limits.extend(broken);
            decided.score = evaluation::score(&decided.judged);
        }
        Ok(())
    }

    /// Judges a finished plan by the sample of its scene, unless that was done; `None` if somebody ended that, and of a scene without
    /// errors. The motion takes more time where grippers turn too fast in cells that keep all other limits.
    ///
    /// # Errors
    /// As [`Decision::on`].
    pub fn sample(
        &mut self,
        scene: &Scene,
        state: &SearchState,
    ) -> Result<Option<&SampleVerdict>, Error> {
        let robustness = Robustness::of_planned(scene, self.whole_motion()?.steps());
        let Drape { summary, sheet, .. } = &self.decided.drape;
        if let (None, false, Some(errors)) =
            (&summary.sample, summary.interrupted(), robustness.sampled())
        {
            let samples = errors.samples;
            let effort = sheet.as_ref().map(|sheet| Effort::new(&sheet.drape));
            let before = state.begin("draping cells with errors");
            state.set_sample(effort.map(|effort| robustness.forecast(effort)), samples);
            let stop = || state.report().is_break();
            let done = |done: usize, of: usize| state.set_step(done, of);
            let watch = Watch { stop: &stop, done: &done };
            match state.while_finishing(|| robustness.timeless(&watch)) {
                Some(sample) => self.judge_in_time(scene, sample, state, &watch)?,
                None => {
                    self.decided.drape.summary.judge_sample(None);
                }
            }
            state.set_forecast(None);
            state.begin(before);
        }
        Ok(self.decided.drape.summary.sample.as_ref())
    }

    /// Judges a finished plan by a sample without the tilt rates of its cells, in a time in which those that keep all other limits keep that one
    /// too.
    fn judge_in_time(
        &mut self,
        scene: &Scene,
        sample: Timeless,
        state: &SearchState,
        watch: &Watch,
    ) -> Result<(), Error> {
        if !sample.ok() {
            self.decided.drape.summary.judge_sample(Some(sample.verdict()));
            return Ok(());
        }
        let in_its_time = |decision: &Self| -> Result<Layup, Error> {
            Ok(evaluation::along_motion(&scene.layup, decision.whole_motion()?.steps()))
        };
        let mut fastest = sample.fastest(&in_its_time(self)?, &scene.limits);
        // the least time in which no step is too short; a rate over more than a step, or between samples, may still ask for a little more
        let mut turns = Some(sample.turns());
        while fastest > 1.0 && fastest.is_finite() {
            if let Some(cycle) = self.cycle.take() {
                cycle.undelay(scene, &mut self.decided.drape, &self.motion);
            }
            let slower = TUNING.sampled_margin * fastest;
            let motion = match turns.take() {
                Some(turns) if self.slowed == 1.0 => {
                    let cells = Some((&turns, slower));
                    let found = quickest(scene, &self.motion, &self.decided.drape, cells);
                    self.limited_by = Some(found.limited_by);
                    found.motion
                }
                _ => self.motion.slowed(slower),
            };
            self.retime(scene, motion, state, true)?;
            self.judge_whole(scene, Vec::new())?;
            fastest = sample.fastest(&in_its_time(self)?, &scene.limits);
        }
        let layup = in_its_time(self)?;
        let summary = &mut self.decided.drape.summary;
        if summary.interrupted() {
            return Ok(());
        }
        if Self::depends_on_time(scene) && turns.is_none() {
            // the ply was draped anew, and so are its cells
            summary.judge_rest(&scene.layup, &scene.limits);
            let along = Robustness::of_planned(scene, layup.motion);
            state.while_finishing(|| along.judge_sample(summary, watch));
        } else {
            summary.judge_sample(Some(sample.in_time(&layup, &scene.limits)));
        }
        Ok(())
    }

    /// Whether the shapes of the ply depend on the time of the motion.
    fn depends_on_time(scene: &Scene) -> bool {
        let dwells = scene.layup.release.as_ref().is_some_and(Release::dwells_on_the_way);
        scene.layup.settings.sheet.time == SheetTime::Real || dwells
    }

    /// The motion with all that grippers do before it and after it.
    ///
    /// # Errors
    /// As [`Cycle::whole`].
    pub fn whole_motion(&self) -> Result<TimedMotion, Error> {
        Ok(match &self.cycle {
            Some(cycle) => cycle.whole(&self.motion)?,
            None => self.motion.clone(),
        })
    }

    /// Drapes along planned positions (m) without counting that among the decisions of a search.
    ///
    /// # Errors
    /// As [`Decision::on`].
    pub fn uncounted(
        scene: &Scene,
        strategy: Option<Strategy>,
        positions: Vec<Vec<Point>>,
        state: &SearchState,
    ) -> Result<Self, Error> {
        Undecided::new(scene, strategy, positions)?.decide(scene, state)
    }

    /// Slows a motion that is not accepted until the resin of the ply follows it, by a power of 2; leaves it as it is where that does not
    /// help, or time does not matter.
    fn slow_down(
        &mut self,
        scene: &Scene,
        state: &SearchState,
        counted: bool,
    ) -> Result<(), Error> {
        if self.decided.judged.accepted() || RateTolerance::applies_to(&scene.layup).is_none() {
            return Ok(());
        }
        let stop = || state.report().is_break();
        let watch = Watch { stop: &stop, done: &|_, _| {} };
        let layup = evaluation::along_motion(&scene.layup, self.motion.steps());
        let along = Scene { layup, ..scene.clone() };
        let found = RateTolerance::new(&along, false, &watch).and_then(|found| found.speed);
        let Some(speed) = found else { return Ok(()) };
        let before = self.clone();
        // cells with errors may need more time than the ply alone
        for slower in [1.0 / speed, 2.0 / speed] {
            self.retime(scene, before.motion.slowed(slower), state, counted)?;
            if self.decided.judged.accepted() {
                self.slowed = slower;
                return Ok(());
            }
        }
        *self = before;
        Ok(())
    }

    /// Takes another time for the same places.
    fn retime(
        &mut self,
        scene: &Scene,
        motion: TimedMotion,
        state: &SearchState,
        counted: bool,
    ) -> Result<(), Error> {
        let before = std::mem::replace(&mut self.motion, motion);
        if Self::depends_on_time(scene) {
            // strategies that are compared decide at once: one forecast would not be that of all
            if state.is_finishing() {
                let before = self.decided.drape.sheet.as_ref();
                let before = before.map(|sheet| Effort::new(&sheet.drape));
                state.set_forecast(forecast(scene, &self.motion, before, state));
            }
            let decided = decide(scene, &self.motion, state);
            state.set_forecast(None);
            self.decided = decided?;
            self.redraped = true;
            if counted {
                state.record(&self.decided.judged, self.decided.score, true, None);
            }
            return Ok(());
        }
        // the shapes of the ply do not depend on time: only how fast everything goes does
        let times = self.motion.times();
        let (end, now) = (before.duration(), self.motion.duration());
        let followed = evaluation::along_motion(&scene.layup, self.motion.steps());
        // how long pads press after the motion is the scene's
        let after = |time: f64| (time - end).max(0.0);
        let step_time = |step: usize, time: f64| times[step - 1] + after(time);
        let event_time = |time: f64| match time < end {
            true => self.motion.same_place(&before, time),
            false => now + after(time),
        };
        self.decided.drape.retime(&followed, &scene.limits, step_time, event_time);
        self.decided.attitudes = outcome::attitudes(&self.decided.drape.steps)?;
        Ok(())
    }
}

/// A plan before it is decided on: a [`Decision`] without what was decided.
struct Undecided {
    strategy: Option<Strategy>,
    positions: Vec<Vec<Point>>,
    asked: Option<ToolRecord>,
    motion: TimedMotion,
}

impl Undecided {
    /// The motion in time along planned positions (m).
    fn new(
        scene: &Scene,
        strategy: Option<Strategy>,
        positions: Vec<Vec<Point>>,
    ) -> Result<Self, Error> {
        // the ply is lifted first
        let mut positions = positions;
        if let Some(pick_up) = &scene.layup.pick_up {
            let lift = scene.layup.motion.positions.iter().take(pick_up.lift_steps).cloned();
            positions.splice(0..0, lift);
        }
        let (positions, asked) = match &scene.layup.tool {
            Some(tool) => {
                let Carried { positions, record, .. } = tool.carry(&positions);
                (positions, Some(record))
            }
            None => (positions, None),
        };
        let motion = TimedMotion::new(&positions, &scene.limits.motion_bounds())?;
        Ok(Undecided { strategy, positions, asked, motion })
    }

    fn decide(self, scene: &Scene, state: &SearchState) -> Result<Decision, Error> {
        let decided = decide(scene, &self.motion, state)?;
        let Undecided { strategy, positions, asked, motion } = self;
        let (cycle, limited_by, slowed, redraped) = (None, None, 1.0, false);
        Ok(Decision {
            strategy,
            positions,
            asked,
            motion,
            cycle,
            decided,
            limited_by,
            slowed,
            redraped,
        })
    }
}

/// How long [`decide`] will take; `None` of catenaries, which take no time to speak of.
fn forecast(
    scene: &Scene,
    motion: &TimedMotion,
    ranked: Option<Effort>,
    state: &SearchState,
) -> Option<Forecast> {
    let Layup { ply, settings, .. } = &scene.layup;
    if settings.model != Model::Sheet {
        return None;
    }
    let nodes = sheet::Fabric::new(ply, settings).ok()?.places.len();
    let mut solves = match ranked {
        Some(ranked) => forecast::solves(nodes, ranked),
        None => CONSTANTS.solves * motion.times().len() as f64,
    };
    if settings.sheet.time == SheetTime::Real {
        let swing = (sheet::pitch(ply) / settings.gravity).sqrt();
        let step = sheet::SheetTuning::default().real_step * swing;
        solves = solves.max(CONSTANTS.real_solves * motion.duration() / step);
    }
    let errors = scene.errors.filter(Errors::is_drawn);
    let changed = outcome::minute_changes(&scene.layup).samples;
    let cells = changed + errors.map_or(0, |_| state.proof().cells);
    let forecast = Forecast::new(nodes, solves, state.pace()).along(&scene.layup);
    Some(Forecast { cells, ..forecast })
}

/// The drape along a motion, its limits and failures, and its score. The drape with a step half-way between all steps counts
/// where it is the worse.
fn decide(scene: &Scene, motion: &TimedMotion, state: &SearchState) -> Result<Decided, Error> {
    let followed = evaluation::along_motion(&scene.layup, motion.steps());
    // both at once, because most of a drape runs on one core; the second counts only where the first is accepted
    let refused = AtomicBool::new(false);
    let (drape, between) = rayon::join(
        || {
            let drape = draped(scene, &followed, state);
            let drape = drape.map(|drape| (Judged::new(&drape), drape));
            let accepted = drape.as_ref().is_ok_and(|(judged, _)| judged.accepted());
            refused.store(!accepted, Ordering::Relaxed);
            drape
        },
        || {
            between_steps(scene, motion, &|| {
                refused.load(Ordering::Relaxed) || state.report().is_break()
            })
        },
    );
    let (_, mut drape) = drape?;
    let attitudes = outcome::attitudes(&drape.steps)?;
    let clearance = evaluation::clearance_of_motion(scene, motion, &attitudes);
    drape.summary.judge_also(clearance.clone());
    let mut judged = Judged::new(&drape);
    let mut score = evaluation::score(&judged);
    if let (true, Some(between)) = (judged.accepted(), between?) {
        drape.summary.judge_between(&between);
        let between = evaluation::also(between, clearance);
        let worse = evaluation::score(&between).max(score);
        if !between.accepted() || worse > score {
            (judged, score) = (between, worse);
        }
    }
    let mut refused_by = None;
    if judged.accepted() {
        // those that refused another plan first; a ply at the ends of its scatter is none of so few
        let Proof { cells: proving, spare } = state.proof();
        let proving = ENDS.len()..ENDS.len() + proving;
        let mut cells = state.cells();
        cells.retain(|cell| proving.contains(cell));
        let others: Vec<usize> = proving.filter(|n| !cells.contains(n)).collect();
        cells.extend(others);
        let stop = || state.report().is_break();
        let flight = drape.sheet.as_ref().and_then(|sheet| sheet.flight.as_ref());
        let drapes =
            evaluation::with_errors(&followed, scene.errors, judged, &cells, spare, |cell| {
                let judged = Flight::judge(flight, &cell, &scene.limits, &stop);
                // the errors may have left nothing that could be draped
                let judged = judged.unwrap_or_else(|_| Judged::nothing());
                (!judged.interrupted).then_some(judged)
            });
        (judged, refused_by) = (drapes.worst, drapes.refused_by);
        score = evaluation::score(&judged);
    }
    Ok(Decided { drape, attitudes, judged, score, refused_by })
}

/// The drape of the sheet along the motion with a step half-way between all its steps, because a good plan does not depend
/// on where the motion is sampled; `None` of catenaries, or if it was stopped.
fn between_steps(
    scene: &Scene,
    motion: &TimedMotion,
    stop: &(dyn Fn() -> bool + Sync),
) -> Result<Option<Judged>, Error> {
    if scene.layup.settings.model != Model::Sheet {
        return Ok(None);
    }
    let mut times = motion.times().to_vec();
    times.extend(motion.times().windows(2).map(|pair| 0.5 * (pair[0] + pair[1])));
    times.sort_by(f64::total_cmp);
    let positions: Vec<Vec<Point>> = times.iter().map(|t| motion.at(*t)).collect();
    let layup = evaluation::along_motion(&scene.layup, Motion { times, positions });
    let judged = outcome::judge(&layup, &scene.limits, usize::MAX, stop)?;
    Ok((!judged.interrupted && judged.missing == 0.0).then_some(judged))
}

/// The drape of a layup by the model that decides, with the states of the sheet that the scene keeps.
fn draped(scene: &Scene, layup: &Layup, state: &SearchState) -> Result<Drape, Error> {
    let scene = Scene { layup: layup.clone(), errors: None, ..scene.clone() };
    let steps = layup.motion.times.len();
    let mut go_on = |done: usize| {
        state.set_step(done, steps);
        state.report()
    };
    let stop = || state.report().is_break();
    outcome::keeping_states(&scene, scene.layup.settings.model, &stop, &mut go_on)
}
