//! Wrinkle height: how high the ruck stands that the slack of a segment makes on the mold (`ply/ruck.rs`).
//!
//! Its limit is one of slack as a height. A ply without rigidity crumples and has no height, so scenes refuse such a limit there.

use super::{Description, Found, Measure, Most, Scope, Site, State, Unit};
use crate::ply::Ruck;
use crate::scene::Scene;

/// Wrinkle height; see the head of this file.
pub struct Wrinkle;

impl Measure for Wrinkle {
    fn description(&self) -> Description {
        Description {
            scope: Scope::End,
            ..Description::new("wrinkle", "wrinkle_mm", "wrinkle height", Unit::MILLIMETRE)
        }
    }

    fn limit(&self, scene: &Scene) -> Option<f64> {
        let limit = scene.limits.wrinkle.map(|height| height * 1e3);
        limit.filter(|_| scene.mold.is_some() && scene.target.is_some())
    }

    fn evaluate(&self, state: &State) -> Option<Found> {
        highest(state, |ruck| ruck.height()).in_units_of(1e-3)
    }
}

/// The largest of a property of the rucks that the slack of the edges makes; zero without slack.
pub fn highest(state: &State, property: impl Fn(&Ruck) -> f64) -> Most {
    let (ply, gravity) = (&state.scene.ply, state.scene.settings.gravity);
    let lines = ply.lines();
    let mut most = Most::default();
    for m in state.edge_misfits() {
        let line = ply.line(lines.catenary(m.catenary).kind);
        let ruck = Ruck::of(m.slack(), line.flexural_rigidity, line.mass * gravity);
        most.meet(ruck.as_ref().map_or(0.0, &property), Site::Catenary(m.catenary), m.place);
    }
    most
}
