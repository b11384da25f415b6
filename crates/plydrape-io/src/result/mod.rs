//! The result file: the scene as it was understood, and every force, slope, contact and measure of every step.
//!
//! Lengths in meters, forces in newtons, angles in radians, unless the name says otherwise. All other outputs can be made
//! from it. What a [`ResultFile`] is in memory has the physics' own types; as a file it has columns, see [`document`].

mod check;
mod check_errors;
mod check_tool;
mod contact;
pub mod document;
pub mod mold;
pub mod read;
mod step;

use crate::sheet::{self, SheetDrape, SheetDrapeError, SheetKept};
use plydrape::clearance::Bodies;
use plydrape::draping::record::{PlanRecord, Step, Summary, Verdict};
use plydrape::draping::{Drape, curves};
use plydrape::errors::Errors;
use plydrape::mold::Mold;
use plydrape::motion::{Attitudes, MotionError, TimedMotion};
use plydrape::planner::{Planned, PlannedSheet};
use plydrape::ply::Ply;
use plydrape::scene::{Limits, Model, Release, Scene, Settings, Target};
use plydrape::sheet::Event;
use plydrape::tool::Tool;
use serde::{Deserialize, Serialize};
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

/// Name of the format, the first key of every result file.
pub const FORMAT: &str = "plydrape-result";
/// Version of the format; it grows when a key changes its meaning.
pub const VERSION: u32 = 8;

/// A whole result.
#[derive(Debug, Clone)]
pub struct ResultFile {
    /// Version of the program that made it.
    pub program: String,
    /// The scene, as it was understood.
    pub scene: SceneEcho,
    /// The plan that the drape follows, if it was planned.
    pub plan: Option<PlanRecord>,
    /// The outcome.
    pub summary: Summary,
    /// The states of the sheet, if it was draped.
    pub sheet_states: Option<SheetKept>,
    /// One entry a step, the start being step 1.
    pub steps: Vec<Step>,
}

/// The scene, as it was understood.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneEcho {
    /// Its title.
    pub title: String,
    /// The scene file; none of a scene that was made in a program.
    pub input: Option<Arc<str>>,
    /// The ply.
    pub ply: Ply,
    /// The mold, if any.
    #[serde(with = "mold")]
    pub mold: Option<Mold>,
    /// Where the ply should end, if it is to be draped.
    pub target: Option<Target>,
    /// Rules of the model.
    pub settings: Settings,
    /// Limits of an accepted drape.
    pub limits: Limits,
    /// What moves with grippers and robot, and what stands in the cell.
    #[serde(default, skip_serializing_if = "Bodies::is_nothing")]
    pub bodies: Bodies,
    /// How far a real cell may be from the scene, if it says so.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub errors: Option<Errors>,
    /// What carries the grippers, if they do not move by themselves.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tool: Option<Tool>,
    /// When the pads let go of the ply; none where they hold it to the end.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub release: Option<Release>,
}

impl SceneEcho {
    /// What a result keeps of a scene and of the text of its file.
    #[must_use]
    pub fn new(scene: &Scene, input: Option<Arc<str>>) -> Self {
        SceneEcho {
            title: scene.title.clone(),
            input,
            ply: scene.ply.clone(),
            mold: scene.mold.clone(),
            target: scene.target.clone(),
            settings: scene.settings,
            limits: scene.limits,
            bodies: scene.bodies.clone(),
            errors: scene.errors,
            tool: scene.tool.clone(),
            release: scene.release.clone(),
        }
    }
}

impl SceneEcho {
    /// Final gripper positions of the ideal drape (m), if the ply is to be draped.
    #[must_use]
    pub fn target_grippers(&self) -> Option<&[[f64; 3]]> {
        self.target.as_ref().map(|target| target.grippers.as_slice())
    }
}

impl ResultFile {
    /// The result of a drape of a scene, which was read from a file with the text `input`.
    #[must_use]
    pub fn new(scene: &Scene, input: Option<Arc<str>>, drape: Drape) -> Self {
        ResultFile {
            program: crate::PROGRAM.into(),
            scene: SceneEcho::new(scene, input),
            plan: None,
            summary: drape.summary,
            sheet_states: None,
            steps: drape.steps,
        }
    }

    /// Drapes the sheet of the scene too, if its model says so, and lets it decide; not after an interrupted drape by the
    /// catenaries. `scene` is that of the result, with the motion that was draped; arguments as [`sheet::drape`]. Returns the
    /// time that the drape of the sheet took.
    ///
    /// # Errors
    /// As [`sheet::drape`].
    pub fn drape_sheet(
        &mut self,
        scene: &Scene,
        dir: &Path,
        stop: &dyn Fn() -> bool,
        progress: impl FnMut(usize),
    ) -> Result<Option<Duration>, SheetDrapeError> {
        if scene.settings.model != Model::Sheet || self.summary.catenaries_interrupted() {
            return Ok(None);
        }
        Ok(Some(self.decided_by(sheet::drape(scene, dir, stop, progress)?)))
    }

    /// Lets the drape of the sheet that decided on the plan of this result decide on it; arguments as [`sheet::keep`].
    /// Returns the time that the drape took. The result is as after [`Self::drape_sheet`] along the planned motion.
    ///
    /// # Errors
    /// As [`sheet::keep`].
    pub fn keep_sheet(
        &mut self,
        planned: PlannedSheet,
        dir: &Path,
    ) -> Result<Duration, SheetDrapeError> {
        Ok(self.decided_by(sheet::keep(planned, dir)?))
    }

    fn decided_by(&mut self, draped: SheetDrape) -> Duration {
        self.summary.decide_by(draped.summary);
        self.sheet_states = Some(draped.states);
        draped.duration
    }

    /// The result of a plan of a scene. Where the sheet decides, [`Self::keep_sheet`] adds it.
    #[must_use]
    pub fn planned(scene: &Scene, input: Option<Arc<str>>, planned: &Planned) -> Self {
        let plan = Some(planned.record.clone());
        ResultFile { plan, ..ResultFile::new(scene, input, planned.drape.clone()) }
    }

    /// The limits of the model that decides.
    #[must_use]
    pub fn deciding_limits(&self) -> &[Verdict] {
        self.summary.sheet.as_ref().map_or(&self.summary.limits, |sheet| &sheet.limits)
    }

    /// When pads grip, press and let go, in the order of time; nothing where they hold the ply from first to last.
    #[must_use]
    pub fn events(&self) -> &[Event] {
        self.summary.sheet.as_ref().map_or(&[], |sheet| &sheet.events)
    }

    /// The curves of a step (m): for each catenary, one for each of its spans, see [`plydrape::draping::curves`].
    #[must_use]
    pub fn curves(&self, step: &Step) -> Vec<Vec<Vec<[f64; 3]>>> {
        let SceneEcho { ply, settings, mold, .. } = &self.scene;
        curves(ply, settings, mold.as_ref(), step)
    }

    /// The motion of a planned drape at any time, and the orientations along it; none of a simulated one.
    ///
    /// # Errors
    /// [`MotionError`] if plan and steps are none that a planner has written.
    pub fn motion(&self) -> Result<Option<(TimedMotion, Attitudes)>, MotionError> {
        let Some(plan) = &self.plan else { return Ok(None) };
        Ok(Some((plan.motion()?, self.attitudes()?)))
    }

    /// Orientations of the grippers between the steps.
    ///
    /// # Errors
    /// [`MotionError`] if there are no steps.
    pub fn attitudes(&self) -> Result<Attitudes, MotionError> {
        Attitudes::of(&self.steps)
    }
}
