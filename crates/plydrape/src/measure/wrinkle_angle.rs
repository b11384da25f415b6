//! Wrinkle angle: the steepest angle of the ruck that the slack of a segment makes on the mold ([`Ruck`]).

use super::{Found, Measure, Most, Site, State, Unit};
use crate::ply::Ruck;

/// Wrinkle angle; see the head of this file.
pub struct WrinkleAngle;

impl Measure for WrinkleAngle {
    fn name(&self) -> &'static str {
        "wrinkle_angle"
    }

    fn key(&self) -> &'static str {
        "wrinkle_angle_deg"
    }

    fn label(&self) -> &'static str {
        "wrinkle angle"
    }

    fn unit(&self) -> Unit {
        Unit::DEGREE
    }

    fn evaluate(&self, state: &State) -> Option<Found> {
        let (ply, gravity) = (&state.scene.ply, state.scene.settings.gravity);
        let mut most = Most::default();
        for m in state.edge_misfits() {
            let line = ply.line(ply.grid.catenary(m.catenary).kind);
            let ruck = Ruck::of(m.slack(), line.flexural_rigidity, line.mass * gravity);
            let value = ruck.map_or(0.0, |ruck| ruck.steepest().to_degrees());
            most.meet(value, Site::Catenary(m.catenary), m.place);
        }
        most.found()
    }
}
