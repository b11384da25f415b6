//! Local strain: the path of a segment of an edge beyond its fabric, as a share of the segment's own length.
//!
//! The contact tolerance ε lets a point of the ply be ε off its place, and so changes a path of length s by up to ε²/2s. In a segment of ten
//! tolerances that alone is 0.5 % of strain: for a shorter segment, ten tolerances take the place of its length.

use super::{Description, Found, Measure, Most, Site, State, TUNING, Unit};
use crate::scene::Scene;

/// Local strain; see the head of this file.
pub struct Strain;

impl Measure for Strain {
    fn description(&self) -> Description {
        Description::new("strain", "strain", "local strain", Unit::SHARE)
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
            let strain = m.overstretch() / m.length.max(TUNING.gauge_length * tolerance);
            most.meet(strain, Site::Catenary(m.catenary), m.place);
        }
        most.found()
    }
}
