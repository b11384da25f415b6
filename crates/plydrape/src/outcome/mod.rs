//! The outcome of a scene: the drape by the model that decides, and the verdict that follows from it.
//!
//! [`simulate`] follows the motion of a scene by the model that the scene chooses. That model alone is asked: its states are measured, its
//! limits are judged, and its orientations are those of the motion files. The other one drapes only where the scene asks for it
//! ([`Scene::also`]); it is drawn beside and never judges.
//!
//! 1. `drape`: one drape by one model; `recorder`, `step`: what is kept of it;
//! 2. `summary`: how it came out; [`Summary::accepted`] is a function of the verdicts;
//! 3. `sensitivity`: whether it depends on what is too small to know;
//! 4. `flight`: the ply in the air, which drapes of one motion share; `forecast`: how long drapes of the sheet will take;
//! 5. `sample`, `robustness`: the verdict over cells with the errors of the scene;
//! 6. `tolerance`, `rate_tolerance`: how far grippers and ply may be off, and how fast a ply with resin may be draped.

mod check;
mod drape;
mod flight;
#[cfg(test)]
mod flight_tests;
pub mod forecast;
#[cfg(test)]
mod forecast_tests;
mod rate_tolerance;
mod recorder;
mod retime;
mod robustness;
mod sample;
#[cfg(test)]
mod sample_tests;
mod sensitivity;
mod step;
mod summary;
#[cfg(test)]
mod summary_tests;
mod tolerance;
#[cfg(test)]
mod tolerance_tests;
mod turning;

pub(crate) use check::check_catenaries;
pub use check::check_model;
pub use drape::{Drape, DrapeWatch, DrapedSheet, Judged, drape, judge};
pub(crate) use drape::{drape_catenaries, drape_places};
pub use flight::Flight;
pub use forecast::{Effort, Forecast, Pace};
pub use rate_tolerance::RateTolerance;
pub use robustness::Robustness;
pub(crate) use sample::Timeless;
pub use sample::{CellVerdict, Highest, SampleVerdict, Watch};
pub use sensitivity::minute_changes;
pub use step::{Gripper, Step, attitudes};
#[cfg(feature = "serde")]
pub use summary::Unjudged;
pub use summary::{CatenaryReport, Status, Summary};
pub use tolerance::Tolerance;
pub(crate) use turning::Turns;

use crate::Error;
use crate::layup::Model;
use crate::scene::Scene;
use crate::sheet;
use std::ops::ControlFlow;

/// The outcome of a scene.
#[derive(Debug, Clone)]
pub struct Outcome {
    /// The drape by the model that decides.
    pub drape: Drape,
    /// The drape by the other model, if the scene asks for it; it judges nothing.
    pub also: Option<Drape>,
}

impl Outcome {
    /// Whether the drape by the model that decides was done to its end and keeps every limit.
    #[must_use]
    pub fn accepted(&self) -> bool {
        self.drape.summary.accepted()
    }
}

/// Drapes the ply of a scene along its motion, as its tool makes it, by the model that decides, and by a sample of cells if the scene has
/// errors.
///
/// `progress` is called after each step with the number of steps done; when it breaks, the drape ends there, complete for the steps done
/// and not accepted.
///
/// # Errors
/// The errors of [`check_model`] if the scene lacks what the model needs.
pub fn simulate(
    scene: &Scene,
    mut progress: impl FnMut(usize) -> ControlFlow<()>,
) -> Result<Outcome, Error> {
    let model = scene.layup.settings.model;
    let mut drape = keeping_states(scene, model, &|| false, &mut progress)?;
    drape.summary.judge_motion(&scene.layup, &scene.limits);
    let also = also(scene, &drape.summary, &mut progress)?;
    let watch = Watch { stop: &|| false, done: &|_, _| {} };
    if !drape.summary.interrupted() {
        Robustness::of_simulated(scene).judge_sample(&mut drape.summary, &watch);
    }
    Ok(Outcome { drape, also })
}

/// The drape of a scene by the model that does not decide, if the scene asks for it and the one that decides was not broken off.
///
/// # Errors
/// The errors of [`check_model`] if the scene lacks what that model needs.
pub fn also(
    scene: &Scene,
    decided: &Summary,
    progress: &mut dyn FnMut(usize) -> ControlFlow<()>,
) -> Result<Option<Drape>, Error> {
    if !scene.also || decided.interrupted() {
        return Ok(None);
    }
    let drape = keeping_states(scene, scene.layup.settings.model.other(), &|| false, progress)?;
    Ok(Some(Drape { summary: drape.summary.unjudged(), ..drape }))
}

/// A drape by a model without the limits of the motion in time, with the states of the sheet that the scene keeps.
pub(crate) fn keeping_states(
    scene: &Scene,
    model: Model,
    stop: &(dyn Fn() -> bool + Sync),
    progress: &mut dyn FnMut(usize) -> ControlFlow<()>,
) -> Result<Drape, Error> {
    let (steps, keep) = (scene.layup.motion.positions.len(), scene.layup.settings.sheet.keep);
    let mut states: Vec<sheet::ClothState> = Vec::new();
    let mut see = |step: usize, state: Option<&sheet::ClothState>| {
        if let Some(state) = state.filter(|state| sheet::is_kept(state.step, steps, keep)) {
            states.push(state.clone());
        }
        progress(step)
    };
    let mut drape = drape_places(scene, model, &mut DrapeWatch { stop, see: &mut see })?;
    if let Some(sheet) = &mut drape.sheet {
        sheet.states = states;
    }
    Ok(drape)
}
