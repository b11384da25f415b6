//! Slide: how far the fabric has slid under a pad since the start, where the load along the ply has passed the slip force.

use super::{Description, Found, Measure, Observation, Unit};

/// Slide; see the head of this file.
pub struct SlipLength;

impl Measure for SlipLength {
    fn description(&self) -> Description {
        Description::new("slip_length", "slip_mm", "slide under a pad", Unit::MILLIMETRE)
    }

    fn evaluate(&self, seen: &Observation) -> Option<Found> {
        seen.layup.settings.pad.slip_force?;
        let found = seen.most_of_grippers(|gripper| gripper.slide).in_units_of(1e-3)?;
        Some(if found.value <= 0.0 { Found::NONE } else { found })
    }
}
