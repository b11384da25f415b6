//! Tilt rate: how fast the ply's normal at a gripper turns.
//!
//! Orientations turn evenly between two steps, so over a step the rate is that of the written motion. A landing takes place at once in the
//! model, and a gripper turns with it: over ever shorter steps that would be ever faster. So the rate is taken over a hundredth of the motion at
//! least, which is about a step of a plan. Pads without joints turn with the frame alone, whose rate has a limit of its own.

use super::state::window;
use super::{Description, Found, Measure, Most, Scope, Site, State, Unit, Worth};
use crate::draping::attitude::normal;
use crate::mold::vector::{cross, dot, norm};
use crate::scene::Scene;

/// Tilt rate; see the head of this file.
pub struct TiltRate;

impl Measure for TiltRate {
    fn description(&self) -> Description {
        Description {
            scope: Scope::Time,
            worth: Worth::Kept,
            ..Description::new("tilt_rate", "tilt_rate_deg_s", "tilt rate", Unit::DEGREE_PER_SECOND)
        }
    }

    fn limit(&self, scene: &Scene) -> Option<f64> {
        scene.tilts().then(|| scene.limits.tilt_rate.to_degrees())
    }

    fn evaluate(&self, state: &State) -> Option<Found> {
        if !state.scene.tilts() {
            return None;
        }
        let (since, shortest) = (state.since(), window(state.scene));
        let mut most = Most::default();
        for (n, attitude) in state.attitudes().iter().enumerate() {
            let place = state.snapshot.positions[n];
            let turned = since.map_or(0.0, |(time, quaternions)| {
                let [a, b] = [quaternions[n], attitude.quaternion].map(normal);
                // exact for small angles, where the cosine alone is not
                norm(cross(a, b)).atan2(dot(a, b)) / time.max(shortest)
            });
            most.meet(turned.to_degrees(), Site::Gripper(n), place);
        }
        most.found()
    }
}
