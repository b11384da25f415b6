//! Overstretch: the way of a free or lying segment of an edge beyond its fabric, as a share of the whole edge.

use super::{Description, Found, Measure, Most, Site, State, Unit};
use crate::scene::Scene;

/// Overstretch; see the head of this file.
pub struct Overstretch;

impl Measure for Overstretch {
    fn description(&self) -> Description {
        Description::new("overstretch", "overstretch", "overstretch", Unit::SHARE)
    }

    fn limit(&self, scene: &Scene) -> Option<f64> {
        Some(scene.limits.overstretch)
    }

    fn evaluate(&self, state: &State) -> Option<Found> {
        let mut most = Most::default();
        for m in state.edge_misfits() {
            most.meet(m.overstretch() / m.whole, Site::Catenary(m.catenary), m.place);
        }
        most.found()
    }
}
