//! Slack: fabric of a free or lying segment of an edge beyond its way.

use super::{Found, Measure, Most, Site, State, Unit};

/// Slack; see the head of this file.
pub struct Slack;

impl Measure for Slack {
    fn name(&self) -> &'static str {
        "slack"
    }

    fn key(&self) -> &'static str {
        "slack_mm"
    }

    fn label(&self) -> &'static str {
        "slack"
    }

    fn unit(&self) -> Unit {
        Unit::MILLIMETRE
    }

    fn evaluate(&self, state: &State) -> Option<Found> {
        let mut most = Most::default();
        for m in state.edge_misfits() {
            most.meet(m.slack(), Site::Catenary(m.catenary), m.place);
        }
        most.in_units_of(1e-3)
    }
}
