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
        let now: Vec<[f64; 4]> = state.attitudes().iter().map(|one| one.quaternion).collect();
        fastest(&state.snapshot.positions, &now, state.since(), window(state.scene))
    }
}

/// The gripper that has turned fastest (°/s) since an earlier step, so long ago (s) and turned so then, over a time that counts as
/// `shortest` (s) at least.
pub(crate) fn fastest(
    positions: &[[f64; 3]],
    now: &[[f64; 4]],
    since: Option<(f64, &[[f64; 4]])>,
    shortest: f64,
) -> Option<Found> {
    let mut most = Most::default();
    for (n, place) in positions.iter().enumerate() {
        let turned = since.map_or(0.0, |(time, quaternions)| {
            let [a, b] = [quaternions[n], now[n]].map(normal);
            // exact for small angles, where the cosine alone is not
            norm(cross(a, b)).atan2(dot(a, b)) / time.max(shortest)
        });
        most.meet(turned.to_degrees(), Site::Gripper(n), *place);
    }
    most.found()
}
