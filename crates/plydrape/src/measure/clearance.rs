//! Clearance: the smallest distance of the bodies of grippers and robot from mold, obstacles and each other, on the way to a step.
//!
//! Between two steps grippers go straight, and turn along the shortest way. Depths count as negative distances.

use super::{Description, Found, Measure, Sense, Site, State, Subject, Unit, Worth};
use crate::clearance::{self, Nearest};
use crate::scene::Scene;

/// Clearance; see the head of this file.
pub struct Clearance;

impl Measure for Clearance {
    fn description(&self) -> Description {
        Description {
            sense: Sense::AtLeast,
            worth: Worth::Kept,
            subject: Subject::Motion,
            ..Description::new("clearance", "clearance_mm", "clearance", Unit::MILLIMETRE)
        }
    }

    fn is_signed(&self) -> bool {
        true
    }

    fn limit(&self, scene: &Scene) -> Option<f64> {
        (!scene.bodies.is_empty()).then_some(scene.limits.clearance * 1e3)
    }

    fn evaluate(&self, state: &State) -> Option<Found> {
        let scene = state.scene;
        if scene.bodies.is_empty() {
            return None;
        }
        let now = state.poses();
        let Some(before) = state.before else {
            return Some(found(&clearance::at(scene, &now)?, state.snapshot.time));
        };
        let nearest = clearance::between_steps(scene, &before.poses(state.scene), &now)?;
        let time = before.time + nearest.time * (state.snapshot.time - before.time);
        Some(found(&nearest, time))
    }
}

/// What a nearest pair is as a value (mm), at a time (s).
pub(crate) fn found(nearest: &Nearest, time: f64) -> Found {
    let site = Site::Bodies { part: nearest.part, near: nearest.near, time };
    Found { value: nearest.distance * 1e3, site, place: Some(nearest.place) }
}
