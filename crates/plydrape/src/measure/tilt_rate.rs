//! Tilt rate: how fast the ply's normal at a gripper turns.
//!
//! Orientations turn evenly between two steps, so over a step the rate is that of the written motion. What lands, lands at once in the
//! model, and a gripper turns with it: over ever shorter steps that would be ever faster. So the rate is taken over a hundredth of the motion at
//! least, which is about a step of a plan.

use super::{Found, Measure, Most, Scope, Site, State, Unit, Worth};
use super::state::window;
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
        let (since, shortest) = (state.since(), window(state.scene));
        let mut most = Most::default();
        for (n, attitude) in state.attitudes().iter().enumerate() {
            let place = state.snapshot.positions[n];
            let turned = since.map_or(0.0, |(time, quaternions)| {
                let [a, b] = [quaternions[n], attitude.quaternion].map(normal);
                // the sine is sharp where the cosine is flat
                norm(cross(a, b)).atan2(dot(a, b)) / time.max(shortest)
            });
            most.meet(turned.to_degrees(), Site::Gripper(n), place);
        }
        most.found()
    }
}
