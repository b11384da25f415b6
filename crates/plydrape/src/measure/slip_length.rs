//! Slide: how far the fabric has slid under a pad since the start, where the load along the ply has passed the slip force.

use super::{Description, Found, Measure, Most, Site, State, Unit};

/// Slide; see the head of this file.
pub struct SlipLength;

impl Measure for SlipLength {
    fn description(&self) -> Description {
        Description::new("slip_length", "slip_mm", "slide under a pad", Unit::MILLIMETRE)
    }

    fn evaluate(&self, state: &State) -> Option<Found> {
        state.scene.settings.pad.slip_force?;
        let mut most = Most::default();
        for (n, [x, y]) in state.snapshot.mounts.as_ref()?.slip.iter().enumerate() {
            most.meet(x.hypot(*y), Site::Gripper(n), state.snapshot.positions[n]);
        }
        let found = most.in_units_of(1e-3)?;
        Some(if found.value <= 0.0 { Found::NONE } else { found })
    }
}
