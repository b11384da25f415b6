//! Slack of diagonals: fabric of a segment of a diagonal beyond its way, as the paper prints it of its example.
//!
//! A diagonal is no fiber and this is no wrinkle: what counts is the shear that its cell landed with
//! (`landing_shear.rs`).

use super::{Description, Found, Measure, Most, Site, State, Unit};

/// Slack of diagonals; see the head of this file.
pub struct DiagonalSlack;

impl Measure for DiagonalSlack {
    fn description(&self) -> Description {
        Description::new(
            "diagonal_slack",
            "diagonal_slack_mm",
            "slack of diagonals",
            Unit::MILLIMETRE,
        )
    }

    fn evaluate(&self, state: &State) -> Option<Found> {
        let mut most = Most::default();
        for m in state.misfits().iter().filter(|m| m.catenary >= state.edges()) {
            most.meet(m.slack(), Site::Catenary(m.catenary), m.place);
        }
        most.in_units_of(1e-3)
    }
}
