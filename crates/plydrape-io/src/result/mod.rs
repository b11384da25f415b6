//! The result file: the scene as it was understood, and what the model that decides says of every step.
//!
//! Lengths in meters, forces in newtons, angles in radians, unless the name says otherwise. All other outputs can be made
//! from it. What a [`ResultFile`] is in memory has the physics' own types; as a file it has columns, see [`document`].

mod check;
mod check_errors;
mod check_limits;
mod check_tool;
mod contact;
pub mod document;
pub mod mold;
pub mod read;
mod refusal;
pub mod sheet;
mod step;

use crate::Error;
use crate::result::sheet::{KeptDrape, SheetKept};
use plydrape::LayupError;
use plydrape::bodies::Bodies;
use plydrape::draping::curves;
use plydrape::draping::record::CatenaryState;
use plydrape::errors::Errors;
use plydrape::layup::{Layup, Model, PickUp, Release, Settings, Target};
use plydrape::measure::Limits;
use plydrape::mold::Mold;
use plydrape::motion::{Attitudes, Motion, TimedMotion};
use plydrape::outcome::{Outcome, Step, Summary, attitudes};
use plydrape::planner::{PlanRecord, Planned};
use plydrape::ply::Ply;
use plydrape::scene::{BookPly, Scene};
use plydrape::sheet::Event;
use plydrape::tool::Tool;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

/// A whole result: what the model that decides says of a scene, and what the other one says beside if it was asked.
///
/// Whether it is accepted is [`Summary::accepted`] of its `summary`, and nothing else.
#[derive(Debug, Clone)]
pub struct ResultFile {
    /// Version of the program that made it.
    pub program: String,
    /// The scene, as it was understood.
    pub scene: SceneEcho,
    /// The plan that the drape follows, if it was planned.
    pub plan: Option<PlanRecord>,
    /// The outcome by the model that decides.
    pub summary: Summary,
    /// The states of the sheet, whether that decides or is the other model; `None` if no sheet was draped.
    pub sheet_states: Option<SheetKept>,
    /// The ply by the model that decides, one entry a step, the start being step 1.
    pub steps: Vec<Step>,
    /// The drape by the other model, if it was asked for; it is shown and judges nothing.
    pub also: Option<Also>,
    /// The files from which it was read, or from which the plan was that it corrects; none for one that was draped.
    pub files: Vec<PathBuf>,
    /// The motion of a plan with the orientations along it: those that were judged, or made once of plan and steps.
    pub(crate) motion: OnceLock<Arc<Turned>>,
}

/// A drape by the model that does not decide.
#[derive(Debug, Clone)]
pub struct Also {
    /// The outcome by that model, which judges nothing.
    pub summary: Summary,
    /// The ply by that model, one entry a step.
    pub steps: Vec<Step>,
}

/// A planned motion and how the grippers are turned along it, by the model that decides.
#[derive(Debug, Clone, PartialEq)]
pub struct Turned {
    /// Where the grippers are at any time.
    pub motion: TimedMotion,
    /// How they are turned.
    pub attitudes: Attitudes,
}

/// The scene, as it was understood.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneEcho {
    /// Title.
    pub title: String,
    /// Which ply of a plybook it is; `None` of a scene by itself.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub book_ply: Option<BookPly>,
    /// The scene file; `None` for a scene that was made in a program.
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
    /// When the pads let go of the ply; `None` where they hold it to the end.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub release: Option<Release>,
    /// How the ply is picked up from a table; none of a motion that begins with a ply in the air.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pick_up: Option<PickUp>,
}

impl SceneEcho {
    /// What a result keeps of a scene and of the text of its file.
    #[must_use]
    pub fn new(scene: &Scene, input: Option<Arc<str>>) -> Self {
        let layup = &scene.layup;
        SceneEcho {
            title: scene.title.clone(),
            book_ply: scene.book_ply.clone(),
            input,
            ply: layup.ply.clone(),
            mold: layup.mold.clone(),
            target: layup.target.clone(),
            settings: layup.settings,
            limits: scene.limits.clone(),
            bodies: layup.bodies.clone(),
            errors: scene.errors,
            tool: layup.tool.clone(),
            release: layup.release.clone(),
            pick_up: layup.pick_up,
        }
    }

    /// Final gripper positions of the ideal drape (m), if the ply is to be draped.
    #[must_use]
    pub fn target_grippers(&self) -> Option<&[[f64; 3]]> {
        self.target.as_ref().map(|target| target.grippers.as_slice())
    }
}

impl ResultFile {
    /// The result of a drape of a scene by the model that decides; the scene was read from a file with the text `input`.
    #[must_use]
    pub fn new(scene: &Scene, input: Option<Arc<str>>, drape: KeptDrape) -> Self {
        ResultFile {
            program: crate::PROGRAM.into(),
            scene: SceneEcho::new(scene, input),
            plan: None,
            summary: drape.summary,
            sheet_states: drape.states,
            steps: drape.steps,
            also: None,
            files: Vec::new(),
            motion: OnceLock::new(),
        }
    }

    /// The result of the outcome of a scene; states of a sheet go into a hidden folder within `dir`.
    ///
    /// # Errors
    /// [`Error`] if the disk refuses.
    pub fn of_outcome(
        scene: &Scene,
        input: Option<Arc<str>>,
        outcome: Outcome,
        dir: &Path,
    ) -> Result<Self, Error> {
        let Outcome { drape, also } = outcome;
        let mut result = ResultFile::new(scene, input, sheet::keep(drape, dir)?);
        if let Some(also) = also {
            result.show_also(sheet::keep(also, dir)?);
        }
        Ok(result)
    }

    /// The result of a plan of a scene; states of a sheet go into a hidden folder within `dir`.
    ///
    /// # Errors
    /// [`Error`] if the disk refuses.
    pub fn planned(
        scene: &Scene,
        input: Option<Arc<str>>,
        planned: Planned,
        dir: &Path,
    ) -> Result<Self, Error> {
        let Planned { outcome, record, motion, attitudes, .. } = planned;
        let result = ResultFile::of_outcome(scene, input, outcome, dir)?;
        Ok(result.with_plan(record, motion, attitudes))
    }

    /// This result as that of a plan, with the motion that was judged.
    #[must_use]
    pub(crate) fn with_plan(
        self,
        record: PlanRecord,
        motion: TimedMotion,
        attitudes: Attitudes,
    ) -> Self {
        let turned = OnceLock::from(Arc::new(Turned { motion, attitudes }));
        ResultFile { plan: Some(record), motion: turned, ..self }
    }

    /// Shows the drape by the model that does not decide beside.
    pub fn show_also(&mut self, drape: KeptDrape) {
        let KeptDrape { summary, steps, states, .. } = drape;
        if states.is_some() {
            self.sheet_states = states;
        }
        self.also = Some(Also { summary: summary.unjudged(), steps });
    }

    /// The tool, whose arm begins in the configuration in which the motion was judged.
    pub(crate) fn judged_tool(&self) -> Option<Cow<'_, Tool>> {
        let tool = self.scene.tool.as_ref()?;
        Some(match self.summary.tool.as_ref().and_then(|record| record.arm) {
            Some(record) => Cow::Owned(tool.beginning_as(&record)),
            None => Cow::Borrowed(tool),
        })
    }

    /// What was draped, along the steps of the result.
    #[must_use]
    pub fn layup(&self) -> Layup {
        let SceneEcho { ply, mold, target, settings, bodies, tool, release, pick_up, .. } =
            &self.scene;
        let places = |step: &Step| step.grippers.iter().map(|gripper| gripper.commanded).collect();
        let motion = Motion {
            times: self.steps.iter().map(|step| step.time).collect(),
            positions: self.steps.iter().map(places).collect(),
        };
        Layup {
            ply: ply.clone(),
            mold: mold.clone(),
            motion,
            target: target.clone(),
            settings: *settings,
            bodies: bodies.clone(),
            tool: tool.clone(),
            release: release.clone(),
            pick_up: *pick_up,
        }
    }

    /// The outcome with the motion judged by the steps of the result once more: what it says of its own motion is not believed.
    #[must_use]
    pub fn judged_again(&self) -> Summary {
        let mut summary = self.summary.clone();
        summary.judge_motion(&self.layup(), &self.scene.limits);
        summary
    }

    /// The model that decides.
    #[must_use]
    pub fn model(&self) -> Model {
        self.summary.model
    }

    /// The verdict in words: accepted, in which world, and what the model that decides does not see of the scene; or not accepted.
    #[must_use]
    pub fn verdict(&self) -> String {
        match self.summary.accepted() {
            true => format!("accepted{}", self.world()),
            false => "not accepted".into(),
        }
    }

    /// What follows the word accepted: the world of the verdict, whether a plan begins with a ply in the air, and what the model that decides does not see of the scene.
    #[must_use]
    pub fn world(&self) -> String {
        let unseen = self.unseen().map(|unseen| format!("; {unseen}")).unwrap_or_default();
        let begins = if self.begins_in_the_air() { "; the ply begins in the air" } else { "" };
        format!("{}{begins}{unseen}", self.summary.world.words())
    }

    /// Whether this is a plan that does not say how the ply comes to its grippers: its scene has no pick-up.
    #[must_use]
    pub fn begins_in_the_air(&self) -> bool {
        self.plan.is_some() && self.scene.pick_up.is_none()
    }

    /// What the scene has and the model that decides does not see between and beyond its lines, in a sentence without its end; `None` of a sheet, and where there is
    /// nothing of that.
    #[must_use]
    pub fn unseen(&self) -> Option<String> {
        if self.model() == Model::Sheet {
            return None;
        }
        let scene = &self.scene;
        let beyond = scene.settings.sheet.overhang > 0.0 || scene.ply.cut.is_some();
        let holes = match &scene.mold {
            Some(Mold::Mesh(mesh)) => mesh.boundaries().iter().filter(|b| b.hole).count(),
            _ => 0,
        };
        let holes = match holes {
            0 => None,
            1 => Some("the hole of the mold".to_owned()),
            count => Some(format!("the {count} holes of the mold")),
        };
        let beyond = beyond.then(|| "fabric beyond the outer grippers".to_owned());
        let parts: Vec<String> = beyond.into_iter().chain(holes).collect();
        (!parts.is_empty()).then(|| format!("the catenaries do not see {}", parts.join(" and ")))
    }

    /// When pads grip, press and let go, in the order of time, by the model that decides; nothing where they hold the ply from first to
    /// last.
    #[must_use]
    pub fn events(&self) -> &[Event] {
        &self.summary.events
    }

    /// The outcome by a model, if that was draped.
    #[must_use]
    pub fn summary_of(&self, model: Model) -> Option<&Summary> {
        let also = self.also.as_ref().map(|also| &also.summary);
        [Some(&self.summary), also].into_iter().flatten().find(|summary| summary.model == model)
    }

    /// The steps by a model, if that was draped.
    #[must_use]
    pub fn steps_of(&self, model: Model) -> Option<&[Step]> {
        match &self.also {
            _ if self.summary.model == model => Some(&self.steps),
            Some(also) if also.summary.model == model => Some(&also.steps),
            _ => None,
        }
    }

    /// The curves of the catenaries of a step (m): for each of them one for each of its spans, see [`plydrape::draping::curves`]; none of
    /// a step of the sheet.
    #[must_use]
    pub fn curves(&self, step: &Step) -> Vec<Vec<Vec<[f64; 3]>>> {
        let Some(catenaries) = &step.catenaries else { return Vec::new() };
        let SceneEcho { ply, settings, mold, .. } = &self.scene;
        let positions: Vec<[f64; 3]> = step.grippers.iter().map(|g| g.position).collect();
        curves(ply, settings, mold.as_ref(), &positions, &catenaries.catenaries)
    }

    /// The motion of a planned drape at any time, and the orientations along it, which are those that were judged; `None` of a simulated
    /// one. Of a result that was read they are made once.
    ///
    /// # Errors
    /// The errors of [`TimedMotion::recorded`] and [`Attitudes::new`] if plan and steps are none that a planner has written.
    pub fn motion(&self) -> Result<Option<&Turned>, LayupError> {
        let Some(plan) = &self.plan else { return Ok(None) };
        if let Some(turned) = self.motion.get() {
            return Ok(Some(turned));
        }
        let turned = Turned { motion: plan.motion()?, attitudes: attitudes(&self.steps)? };
        Ok(Some(self.motion.get_or_init(|| Arc::new(turned))))
    }
}

/// The catenaries of a step, edges along u, edges along v, then diagonals; none for a step of the sheet.
#[must_use]
pub(crate) fn catenaries(step: &Step) -> &[CatenaryState] {
    step.catenaries.as_ref().map_or(&[], |step| &step.catenaries)
}
