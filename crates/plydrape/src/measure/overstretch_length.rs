//! Overstretch as a length: the way of a segment of an edge beyond its fabric.

use super::{Description, Found, Measure, Most, Site, State, Unit};

/// Overstretch as a length; see the head of this file.
pub struct OverstretchLength;

impl Measure for OverstretchLength {
    fn description(&self) -> Description {
        Description::new(
            "overstretch_length",
            "overstretch_mm",
            "overstretch length",
            Unit::MILLIMETRE,
        )
    }

    fn evaluate(&self, state: &State) -> Option<Found> {
        let mut most = Most::default();
        for m in state.edge_misfits() {
            most.meet(m.overstretch(), Site::Catenary(m.catenary), m.place);
        }
        most.in_units_of(1e-3)
    }
}
