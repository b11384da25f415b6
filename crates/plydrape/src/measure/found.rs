//! A worst value and the part of the layup that has it.

use super::Sense;
use crate::geometry::Point;
use crate::state::Site;

/// A value of a measure, and where it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Found {
    /// The value, in the unit that the measure names.
    pub value: f64,
    /// Which part of the ply has it.
    pub site: Site,
    /// Place in space (m), where it has one.
    pub place: Option<Point>,
}

impl Found {
    /// The value zero, without a place.
    pub const NONE: Found = Found { value: 0.0, site: Site::Nowhere, place: None };
}

/// Collects the largest of several values, the first of those that are equal; one that is no number is the largest.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Most(Option<Found>);

impl Most {
    /// Another value.
    pub fn meet(&mut self, value: f64, site: Site, place: Point) {
        if self.0.is_none_or(|most| Sense::AtMost.is_worse(value, most.value)) {
            self.0 = Some(Found { value, site, place: Some(place) });
        }
    }

    /// The largest of them, `None` for none.
    #[must_use]
    pub fn found(self) -> Option<Found> {
        self.0
    }

    /// The largest of them, in a unit of size `unit` (SI).
    #[must_use]
    pub fn in_units_of(self, unit: f64) -> Option<Found> {
        self.0.map(|most| Found { value: most.value / unit, ..most })
    }
}
