//! Local strain: the way of a segment of an edge beyond its fabric, as a share of the segment's own length.
//!
//! What is shorter than the contact tolerance has no length that the model knows: the tolerance takes its place.

use super::{Found, Measure, Most, Site, State, Unit};
use crate::scene::Scene;

/// Local strain; see the head of this file.
pub struct Strain;

impl Measure for Strain {
    fn name(&self) -> &'static str {
        "strain"
    }

    fn label(&self) -> &'static str {
        "local strain"
    }

    fn unit(&self) -> Unit {
        Unit::SHARE
    }

    fn limit(&self, scene: &Scene) -> Option<f64> {
        Some(scene.limits.strain)
    }

    fn evaluate(&self, state: &State) -> Option<Found> {
        let tolerance = match state.scene.mold {
            Some(_) => state.scene.settings.contact.tolerance,
            None => 0.0,
        };
        let mut most = Most::default();
        for m in state.edge_misfits() {
            let strain = m.overstretch() / m.length.max(tolerance);
            most.meet(strain, Site::Catenary(m.catenary), m.place);
        }
        most.found()
    }
}
