//! What is found for one ply: the result of its plan, as it is judged.

use super::arguments::Arguments;
use crate::failure::Failure;
use crate::outcome::{code, is_unsolved};
use crate::search::Ended;
use crate::watch::Interrupt;
use crate::{errors, model};
use plydrape::outcome::Robustness;
use plydrape::planner::{self, Checkpoint, LimitedBy, Planned, Watcher};
use plydrape_io::ResultFile;
use plydrape_io::scene::SceneFile;
use serde::Serialize;
use std::path::Path;
use std::process::ExitCode;
use std::time::Duration;

/// The motion in a few numbers; largest values of any gripper.
#[derive(Serialize)]
pub(super) struct Motion {
    pub(super) duration_s: f64,
    pub(super) max_speed: f64,
    pub(super) max_acceleration: f64,
    pub(super) max_jerk: f64,
    limited_by: Vec<LimitedBy>,
}

impl Motion {
    fn new(planned: &Planned) -> Self {
        let peaks = planned.motion.peaks();
        Motion {
            duration_s: planned.motion.duration(),
            max_speed: peaks.speed.value,
            max_acceleration: peaks.acceleration.value,
            max_jerk: peaks.jerk.value,
            limited_by: planned.record.limited_by.clone(),
        }
    }
}

/// A plan and its result, judged by the model that decides and with errors.
pub(super) struct Found {
    /// What is written.
    pub(super) result: ResultFile,
    /// From where another search goes on.
    pub(super) checkpoint: Checkpoint,
    /// The motion in a few numbers.
    pub(super) motion: Motion,
    /// Drapes that decided on a plan.
    pub(super) decisions: usize,
    /// How long the model took that decides.
    pub(super) solving: Duration,
    /// Whether what follows the search was broken off.
    pub(super) broken_off: bool,
}

impl Found {
    /// Whether a signal ended the search, or what follows it.
    pub(super) fn is_interrupted(&self, ended: Option<Ended>, interrupt: &Interrupt) -> bool {
        ended == Some(Ended::Interrupted) || self.broken_off && interrupt.is_signaled()
    }

    /// Whether it is accepted, and nothing is missing.
    pub(super) fn is_done(&self) -> bool {
        self.result.summary.accepted() && !self.broken_off
    }

    /// The exit code: a plan that is accepted is what was looked for, whatever ended the search.
    pub(super) fn code(&self, interrupted: bool) -> ExitCode {
        let accepted = self.result.summary.accepted();
        code(interrupted && !self.is_done(), is_unsolved(&self.result), accepted)
    }
}

impl Arguments {
    /// Plans, and judges by the sample of the scene unless the options say otherwise.
    pub(super) fn planned(
        &self,
        scene: &SceneFile,
        earlier: Option<&Checkpoint>,
        watcher: Watcher,
    ) -> Result<Planned, plydrape::Error> {
        match self.without_errors {
            true => planner::plan_without_errors(scene, earlier, watcher),
            false => planner::plan(scene, earlier, watcher),
        }
    }

    /// What becomes of a planned motion: its result, with the sheet's states in a stage, with the other model beside if that is asked for, and
    /// with what it tolerates unless the options say otherwise.
    pub(super) fn judged(
        &self,
        scene: &SceneFile,
        planned: Planned,
        stage: &Path,
        interrupt: &Interrupt,
        quiet: bool,
    ) -> Result<Found, Failure> {
        let (motion, checkpoint) = (Motion::new(&planned), planned.checkpoint.clone());
        let (decisions, solving) = (planned.decisions, planned.outcome.drape.solving);
        let along = planner::along(scene, &planned.motion);
        let steps = planned.motion.steps();
        let mut result = ResultFile::planned(scene, scene.input.clone(), planned, stage)?;
        let mut broken_off = model::show_also(&mut result, &along, stage, interrupt, quiet)?;
        if !self.without_errors {
            let robustness = Robustness::of_planned(scene, steps);
            broken_off |= !errors::judge(&mut result, &robustness, solving, interrupt, quiet);
        }
        broken_off |= result.summary.interrupted();
        Ok(Found { result, checkpoint, motion, decisions, solving, broken_off })
    }
}
