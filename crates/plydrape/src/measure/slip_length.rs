//! Slide: how far the fabric has slid under a pad since the start, where the load along the ply has passed the slip force. The sheet alone
//! follows it: grippers of catenaries hold the fabric where they are.

use super::{Description, Found, Measure, Observation, Unit};
use crate::layup::Model;

/// Slide; see the head of this file.
pub struct SlipLength;

impl Measure for SlipLength {
    fn description(&self) -> Description {
        Description::of_sheet("slip_length", "slip_mm", "slide under a pad", Unit::MILLIMETRE)
    }

    fn evaluate(&self, seen: &Observation) -> Option<Found> {
        seen.layup.settings.pad.slip_force.filter(|_| seen.state.model == Model::Sheet)?;
        let found = seen.most_of_grippers(|gripper| gripper.slide).in_units_of(1e-3)?;
        Some(if found.value <= 0.0 { Found::NONE } else { found })
    }
}
