//! Fiber angle: the angle between a landed edge, from end to end, and the same fabric in the ideal drape.

use super::{Description, Found, Measure, Most, Scope, Site, State, Unit};
use crate::scene::Scene;

/// Fiber angle; see the head of this file.
pub struct FibreAngle;

impl Measure for FibreAngle {
    fn description(&self) -> Description {
        Description {
            scope: Scope::End,
            ..Description::new("fibre_angle", "fibre_angle_deg", "fiber angle", Unit::DEGREE)
        }
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
