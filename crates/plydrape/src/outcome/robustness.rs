//! How a finished drape is judged with errors: the sample of its scene, and what its motion
//! tolerates.
//!
//! The drape itself has been judged before. A sample that keeps too few of its cells refuses it; what it tolerates is said
//! for information. Both are drapes along the motion that was draped, by the model that decides.

use super::sample::Timeless;
use super::{Effort, Forecast, RateTolerance, Status, Summary, Tolerance, Watch};
use crate::errors::Errors;
use crate::layup::Stepping;
use crate::measure::{Scope, Verdict};
use crate::motion::Motion;
use crate::scene::Scene;

/// With which errors a finished drape is judged.
#[derive(Debug, Clone)]
pub struct Robustness {
    /// The scene, with the motion that was draped.
    scene: Scene,
    /// The errors of the sample; `None` where the scene has none.
    sample: Option<Errors>,
    /// Whether it is asked what the motion tolerates.
    tolerance: bool,
}

impl Robustness {
    /// The judgment of a drape along the motion of a scene: only the scene's own errors count.
    #[must_use]
    pub fn of_simulated(scene: &Scene) -> Self {
        let errors = scene.errors.filter(Errors::is_drawn);
        Robustness { scene: scene.clone(), sample: errors, tolerance: errors.is_some() }
    }

    /// The judgment of a drape along a planned motion, with steps cut as planners do. What it tolerates is found, but not where the scene asks
    /// for no samples.
    #[must_use]
    pub fn of_planned(scene: &Scene, motion: Motion) -> Self {
        let mut planned = scene.clone();
        planned.layup.motion = motion;
        planned.layup.settings.contact.stepping = Stepping::Cut;
        let asked = scene.errors.is_none_or(|errors| errors.samples > 0);
        let sample = scene.errors.filter(Errors::is_drawn);
        Robustness { scene: planned, sample, tolerance: asked }
    }

    /// The errors of the sample; `None` where the scene has none.
    #[must_use]
    pub fn sampled(&self) -> Option<&Errors> {
        self.sample.as_ref()
    }

    /// How long its drapes will take, by what the one without errors took.
    #[must_use]
    pub fn forecast(&self, drape: Effort) -> Forecast {
        Forecast::like(drape).along(&self.scene.layup)
    }

    /// Drapes the sample and judges by it too, unless that was done. Returns whether it was done to its end; if not, the drape is not
    /// accepted, because nobody knows whether enough of its cells are.
    pub fn judge_sample(&self, summary: &mut Summary, watch: &Watch) -> bool {
        let Some(errors) = self.sample.as_ref().filter(|_| summary.sample.is_none()) else {
            return true;
        };
        summary.judge_sample(errors.judge(&self.scene, watch))
    }

    /// The sample of a motion that may take another time; `None` if it was stopped, and of a scene without errors.
    pub(crate) fn timeless(&self, watch: &Watch) -> Option<Timeless> {
        self.sample.as_ref()?.judge_timeless(&self.scene, watch)
    }

    /// Finds what the motion tolerates: nothing if it is not accepted without errors; and how fast a ply with resin may be draped along it.
    /// Returns whether that was done to its end.
    pub fn judge_tolerance(&self, summary: &mut Summary, watch: &Watch) -> bool {
        if RateTolerance::applies_to(&self.scene.layup).is_some() {
            let timeless = |v: &&Verdict| v.name.measure().scope() != Scope::Time;
            let is_kept = summary.status == Status::Converged
                && summary.limits.iter().filter(timeless).all(|verdict| verdict.ok);
            summary.rate_tolerance = RateTolerance::new(&self.scene, is_kept, watch);
            if summary.rate_tolerance.is_none() {
                return false;
            }
        }
        if !self.tolerance {
            return true;
        }
        summary.tolerance = match summary.accepted_without_errors() {
            true => Tolerance::new(&self.scene, watch),
            false => Some(Tolerance::NOTHING),
        };
        summary.tolerance.is_some()
    }
}
