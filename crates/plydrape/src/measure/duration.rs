//! Duration: how long the motion has taken.

use super::{Found, Measure, Scope, Site, State, Unit, Worth};
use crate::scene::Scene;

/// Duration; see the head of this file.
pub struct Duration;

impl Measure for Duration {
    fn name(&self) -> &'static str {
        "duration"
    }

    fn key(&self) -> &'static str {
        "duration_s"
    }

    fn label(&self) -> &'static str {
        "duration"
    }

    fn unit(&self) -> Unit {
        Unit::SECOND
    }

    fn scope(&self) -> Scope {
        Scope::Time
    }

    fn worth(&self) -> Worth {
        Worth::Kept
    }

    fn limit(&self, scene: &Scene) -> Option<f64> {
        scene.limits.duration
    }

    fn evaluate(&self, state: &State) -> Option<Found> {
        Some(Found { value: state.snapshot.time, site: Site::AllGrippers, place: None })
    }
}
