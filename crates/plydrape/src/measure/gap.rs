//! Gap: the largest distance of a station of a free span from the mold.

use super::{Description, Found, Measure, Most, Site, State, Unit};

/// Gap; see the head of this file.
pub struct Gap;

impl Measure for Gap {
    fn description(&self) -> Description {
        Description::new("gap", "gap_mm", "gap", Unit::MILLIMETRE)
    }

    fn evaluate(&self, state: &State) -> Option<Found> {
        let mold = state.scene.mold.as_ref()?;
        let mut most = Most::default();
        for (span, points) in state.snapshot.shape.spans.iter().zip(state.stations()) {
            for point in points {
                // a distance that is no number stays it
                let gap = mold.signed_distance(*point);
                let gap = if gap <= 0.0 { 0.0 } else { gap };
                most.meet(gap, Site::Catenary(span.catenary), *point);
            }
        }
        Some(most.in_units_of(1e-3).unwrap_or(Found::NONE))
    }
}
