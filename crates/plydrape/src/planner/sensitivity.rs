//! A drape by catenaries as it is recorded, with the derivatives of its end: [`plydrape_catenary::sensitivity`].

pub use plydrape_catenary::sensitivity::*;

use crate::draping::Draping;
use crate::outcome::{Drape, DrapeWatch, drape_catenaries};
use crate::scene::Scene;
use std::ops::ControlFlow;

/// A drape by catenaries with the derivatives of its last step.
#[derive(Debug, Clone)]
pub struct DifferentiatedDrape {
    /// The drape.
    pub drape: Drape,
    /// Last step.
    pub last_step: LastStep,
}

/// Drapes the ply of a scene along its motion by catenaries and differentiates its last step; `None` of a motion without
/// steps. `progress` is as that of [`crate::simulate`].
pub fn outcome(
    scene: &Scene,
    mut progress: impl FnMut(usize) -> ControlFlow<()>,
) -> Option<DifferentiatedDrape> {
    let layup = &scene.layup;
    let mut draping = Draping::new(layup);
    let mut see = |step: usize, _: Option<&crate::sheet::ClothState>| progress(step);
    let mut watch = DrapeWatch { stop: &|| false, see: &mut see };
    let (mut drape, shape) = drape_catenaries(layup, &scene.limits, &mut draping, &mut watch);
    drape.summary.judge_motion(layup, &scene.limits);
    let last_step = LastStep::new(layup, &mut draping, &shape?);
    Some(DifferentiatedDrape { drape, last_step })
}
