//! Wrinkle height: how high the ruck stands that the slack of a segment makes on the mold (`ply/ruck.rs`).

use super::{Description, Found, Measure, Most, Site, State, Unit};
use crate::ply::Ruck;

/// Wrinkle height; see the head of this file.
pub struct Wrinkle;

impl Measure for Wrinkle {
    fn description(&self) -> Description {
        Description::new("wrinkle", "wrinkle_mm", "wrinkle height", Unit::MILLIMETRE)
    }

    fn evaluate(&self, state: &State) -> Option<Found> {
        highest(state, |ruck| ruck.height()).in_units_of(1e-3)
    }
}

/// The largest of a property of the rucks that the slack of the edges makes; zero without slack.
pub fn highest(state: &State, property: impl Fn(&Ruck) -> f64) -> Most {
    let (ply, gravity) = (&state.scene.ply, state.scene.settings.gravity);
    let mut most = Most::default();
    for m in state.edge_misfits() {
        let line = ply.line(ply.grid.catenary(m.catenary).kind);
        let ruck = Ruck::of(m.slack(), line.flexural_rigidity, line.mass * gravity);
        most.meet(ruck.as_ref().map_or(0.0, &property), Site::Catenary(m.catenary), m.place);
    }
    most
}
