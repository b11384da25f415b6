//! Bridging: the gap between ply and mold between two touches of one edge, of which the model follows one.
//!
//! A diagonal is no fiber: one that landed in another shear than its cell ends with is too short or too long for its place, and spans hollows that
//! the fabric lies in. Its gaps stand in its record.

use super::{Description, Found, Measure, Most, Scope, Site, State, Unit};
use crate::scene::Scene;

/// Bridging; see the head of this file.
pub struct Bridging;

impl Measure for Bridging {
    fn description(&self) -> Description {
        Description {
            scope: Scope::End,
            ..Description::new("bridging", "bridging_mm", "bridging", Unit::MILLIMETRE)
        }
    }

    fn limit(&self, scene: &Scene) -> Option<f64> {
        (scene.mold.is_some() && scene.target.is_some()).then_some(scene.limits.bridging * 1e3)
    }

    fn evaluate(&self, state: &State) -> Option<Found> {
        state.scene.mold.as_ref()?;
        let mut most = Most::default();
        for (n, bridge) in state.snapshot.bridges.iter().enumerate().take(state.edges()) {
            if let Some(bridge) = bridge {
                most.meet(bridge.gap, Site::Catenary(n), bridge.place);
            }
        }
        Some(most.in_units_of(1e-3).unwrap_or(Found::NONE))
    }
}
