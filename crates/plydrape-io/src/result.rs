//! The result file: the scene as it was understood, and every force, slope, shape, contact and measure of every
//! step.
//!
//! Lengths in metres, forces in newtons, angles in radians, unless the name says otherwise. All other
//! outputs can be made from it.

use crate::mold_record;
use plydrape::draping::Drape;
use plydrape::draping::record::{PlanRecord, Step, Summary};
use plydrape::material::Material;
use plydrape::mold::Mold;
use plydrape::motion::{Attitudes, MotionError, TimedMotion};
use plydrape::net::Net;
use plydrape::planner::Planned;
use plydrape::ply::{Direction, Grid};
use plydrape::scene::{Limits, Scene, Settings};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::sync::Arc;

/// Name of the format, the first key of every result file.
pub const FORMAT: &str = "plydrape-result";
/// Version of the format; it grows when a key changes its meaning.
pub const VERSION: u32 = 5;

/// A whole result file.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ResultFile {
    /// [`FORMAT`].
    pub format: Cow<'static, str>,
    /// [`VERSION`].
    pub version: u32,
    /// Check sum of the whole file with nothing here; empty until it is written.
    pub checksum: String,
    /// Version of the program that wrote it.
    pub program: String,
    /// The scene, as it was understood.
    pub scene: SceneEcho,
    /// The plan that the drape follows, if it was planned.
    pub plan: Option<PlanRecord>,
    /// One entry a step, the start being step 1.
    pub steps: Vec<Step>,
    /// The outcome.
    pub summary: Summary,
}

/// The scene, as it was understood.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneEcho {
    /// Its title.
    pub title: String,
    /// The scene file; none of a scene that was made in a program.
    pub input: Option<Arc<str>>,
    /// Grippers along u and v.
    pub grid: Grid,
    /// Fabric length of a cell along u and v (m).
    pub cell: [f64; 2],
    /// The ply's material.
    pub material: Material,
    /// The grid direction of the warp.
    pub warp: Direction,
    /// The mold, if any.
    #[serde(with = "mold_record")]
    pub mold: Option<Mold>,
    /// Final gripper positions of the ideal drape (m), if the ply is to be draped.
    pub target_grippers: Option<Vec<[f64; 3]>>,
    /// The ideal drape, a net, where it is known.
    pub ideal_drape: Option<Arc<Net>>,
    /// Rules of the model.
    pub settings: Settings,
    /// Limits of an accepted drape.
    pub limits: Limits,
}

impl SceneEcho {
    /// What a result keeps of a scene and of the text of its file.
    #[must_use]
    pub fn new(scene: &Scene, input: Option<Arc<str>>) -> Self {
        let target = scene.target.as_ref();
        SceneEcho {
            title: scene.title.clone(),
            input,
            grid: scene.ply.grid,
            cell: scene.ply.cell,
            material: scene.ply.material.clone(),
            warp: scene.ply.warp,
            mold: scene.mold.clone(),
            target_grippers: target.map(|target| target.grippers.clone()),
            ideal_drape: target.and_then(|target| target.drape.clone()),
            settings: scene.settings,
            limits: scene.limits,
        }
    }
}

impl ResultFile {
    /// The result of a drape of a scene, which was read from a file with the text `input`.
    #[must_use]
    pub fn new(scene: &Scene, input: Option<Arc<str>>, drape: Drape) -> Self {
        ResultFile {
            format: FORMAT.into(),
            version: VERSION,
            checksum: String::new(),
            program: crate::PROGRAM.into(),
            scene: SceneEcho::new(scene, input),
            plan: None,
            steps: drape.steps,
            summary: drape.summary,
        }
    }

    /// The result of a plan of a scene.
    #[must_use]
    pub fn planned(scene: &Scene, input: Option<Arc<str>>, planned: &Planned) -> Self {
        let plan = Some(planned.record.clone());
        ResultFile { plan, ..ResultFile::new(scene, input, planned.drape.clone()) }
    }

    /// The motion of a planned drape at any time, and the orientations along it; none of a simulated one.
    ///
    /// # Errors
    /// [`MotionError`] if plan and steps are none that a planner has written.
    pub fn motion(&self) -> Result<Option<(TimedMotion, Attitudes)>, MotionError> {
        let Some(plan) = &self.plan else { return Ok(None) };
        Ok(Some((plan.motion(&self.scene.limits)?, self.attitudes()?)))
    }

    /// Orientations of the grippers between the steps.
    ///
    /// # Errors
    /// [`MotionError`] if there are no steps.
    pub fn attitudes(&self) -> Result<Attitudes, MotionError> {
        Attitudes::of(&self.steps)
    }
}
