//! Wrinkle height: how high the ruck stands that the slack of a segment makes on the mold ([`Ruck`]).

use super::{Found, Measure, Most, Site, State, Unit};
use crate::ply::Ruck;

/// Wrinkle height; see the head of this file.
pub struct Wrinkle;

impl Measure for Wrinkle {
    fn name(&self) -> &'static str {
        "wrinkle"
    }

    fn key(&self) -> &'static str {
        "wrinkle_mm"
    }

    fn label(&self) -> &'static str {
        "wrinkle height"
    }

    fn unit(&self) -> Unit {
        Unit::MILLIMETRE
    }

    fn evaluate(&self, state: &State) -> Option<Found> {
        let (ply, gravity) = (&state.scene.ply, state.scene.settings.gravity);
        let mut most = Most::default();
        for m in state.edge_misfits() {
            let line = ply.line(ply.grid.catenary(m.catenary).kind);
            let ruck = Ruck::of(m.slack(), line.flexural_rigidity, line.mass * gravity);
            let value = ruck.map_or(0.0, |ruck| ruck.height());
            most.meet(value, Site::Catenary(m.catenary), m.place);
        }
        most.in_units_of(1e-3)
    }
}
