//! Tilt rate: how fast the ply's normal at a gripper turns, from the step before to this one.
//!
//! Orientations turn evenly between two steps, so the rate is that of the written motion.

use super::{Found, Measure, Most, Scope, Site, State, Unit, Worth};
use crate::draping::attitude::normal;
use crate::mold::vector::{cross, dot, norm};
use crate::scene::Scene;

/// Tilt rate; see the head of this file.
pub struct TiltRate;

impl Measure for TiltRate {
    fn name(&self) -> &'static str {
        "tilt_rate"
    }

    fn key(&self) -> &'static str {
        "tilt_rate_deg_s"
    }

    fn label(&self) -> &'static str {
        "tilt rate"
    }

    fn unit(&self) -> Unit {
        Unit::DEGREE_PER_SECOND
    }

    fn scope(&self) -> Scope {
        Scope::Time
    }

    fn worth(&self) -> Worth {
        Worth::Kept
    }

    fn limit(&self, scene: &Scene) -> Option<f64> {
        Some(scene.limits.tilt_rate.to_degrees())
    }

    fn evaluate(&self, state: &State) -> Option<Found> {
        let mut most = Most::default();
        for (n, attitude) in state.attitudes().iter().enumerate() {
            let place = state.snapshot.positions[n];
            let turned = state.before.map_or(0.0, |before| {
                let [a, b] = [before.quaternions[n], attitude.quaternion].map(normal);
                // the sine is sharp where the cosine is flat
                let angle = norm(cross(a, b)).atan2(dot(a, b));
                angle / (state.snapshot.time - before.time)
            });
            most.meet(turned.to_degrees(), Site::Gripper(n), place);
        }
        most.found()
    }
}
