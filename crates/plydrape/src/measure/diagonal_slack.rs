//! Slack of diagonals: fabric of a segment of a diagonal beyond its way, as the paper prints it of its example.
//!
//! A diagonal is no fiber and this is no wrinkle: what counts is the shear that its cell landed with
//! (`landing_shear.rs`).

use super::{Description, Found, Measure, Most, Observation, Unit};

/// Slack of diagonals; see the head of this file.
pub struct DiagonalSlack;

impl Measure for DiagonalSlack {
    fn description(&self) -> Description {
        Description::of_catenaries(
            "diagonal_slack",
            "diagonal_slack_mm",
            "slack of diagonals",
            Unit::MILLIMETER,
        )
    }

    fn evaluate(&self, seen: &Observation) -> Option<Found> {
        let mut most = Most::default();
        for (_, line) in seen.catenaries().filter(|(_, line)| !line.is_fiber) {
            most.meet(line.slack(), line.site, line.place);
        }
        most.in_units_of(1e-3)
    }
}
