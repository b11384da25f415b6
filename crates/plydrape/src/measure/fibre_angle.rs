//! Fibre angle: the angle between a landed edge, from end to end, and the same fabric in the ideal drape.

use super::{Found, Measure, Most, Scope, Site, State, Unit};
use crate::scene::Scene;

/// Fibre angle; see the head of this file.
pub struct FibreAngle;

impl Measure for FibreAngle {
    fn name(&self) -> &'static str {
        "fibre_angle"
    }

    fn key(&self) -> &'static str {
        "fibre_angle_deg"
    }

    fn label(&self) -> &'static str {
        "fibre angle"
    }

    fn unit(&self) -> Unit {
        Unit::DEGREE
    }

    fn scope(&self) -> Scope {
        Scope::End
    }

    fn limit(&self, scene: &Scene) -> Option<f64> {
        scene.target.as_ref().map(|_| scene.limits.fibre_angle.to_degrees())
    }

    fn evaluate(&self, state: &State) -> Option<Found> {
        let mut most = Most::default();
        for (n, landing) in state.landings().iter().enumerate() {
            if let Some((angle, place)) = landing.as_ref().and_then(|landing| landing.fibre_angle) {
                most.meet(angle.to_degrees(), Site::Catenary(n), place);
            }
        }
        most.found()
    }
}
