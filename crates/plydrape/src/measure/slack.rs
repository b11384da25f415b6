//! Slack: fabric of a free or lying segment of an edge beyond its way.

use super::{Description, Found, Measure, Most, Site, State, Unit};

/// Slack; see the head of this file.
pub struct Slack;

impl Measure for Slack {
    fn description(&self) -> Description {
        Description::new("slack", "slack_mm", "slack", Unit::MILLIMETRE)
    }

    fn evaluate(&self, state: &State) -> Option<Found> {
        let mut most = Most::default();
        for m in state.edge_misfits() {
            most.meet(m.slack(), Site::Catenary(m.catenary), m.place);
        }
        most.in_units_of(1e-3)
    }
}
