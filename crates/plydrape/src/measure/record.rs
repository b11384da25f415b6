//! What a result file keeps of the measures.

use super::{Found, Name};
use crate::layup::Layup;
use crate::state::Site;

/// A worst value and where it is.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Worst {
    /// The value, in the unit that the measure names.
    pub value: f64,
    /// Which part of the ply: a catenary, a cell or a gripper.
    #[cfg_attr(feature = "serde", serde(rename = "where"))]
    pub at: String,
    /// Place in space (m), where it has one.
    pub place: Option<[f64; 3]>,
}

impl Worst {
    /// With its site as a label.
    #[must_use]
    pub fn new(found: &Found, layup: &Layup) -> Worst {
        let at = match (found.site, found.place) {
            (Site::Bodies { .. }, Some(place)) => {
                let [x, y, z] = place.map(|c| c * 1e3);
                format!("{} near ({x:.1}, {y:.1}, {z:.1}) mm", found.site.label(layup))
            }
            _ => found.site.label(layup),
        };
        Worst { value: found.value, at, place: found.place }
    }
}

/// Values by measure, in the order of [`Name::ALL`]; a file has them by key.
#[derive(Debug, Clone, PartialEq)]
pub struct ByName<T>(Vec<(Name, T)>);

/// Worst values of one step; a measure without a meaning in it is missing.
pub type Measures = ByName<Worst>;

/// Worst values as plain numbers, null where a measure has no meaning.
pub type Numbers = ByName<Option<f64>>;

impl<T> Default for ByName<T> {
    fn default() -> Self {
        ByName(Vec::new())
    }
}

impl<T> ByName<T> {
    /// The value of a measure, if it has one.
    #[must_use]
    pub fn get(&self, name: Name) -> Option<&T> {
        self.0.iter().find(|(own, _)| *own == name).map(|(_, value)| value)
    }

    /// All of them in order.
    pub fn iter(&self) -> impl Iterator<Item = (Name, &T)> {
        self.0.iter().map(|(name, value)| (*name, value))
    }

    /// Sets a value, or none.
    pub fn set(&mut self, name: Name, value: Option<T>) {
        self.0.retain(|(own, _)| *own != name);
        if let Some(value) = value {
            let at = self.0.partition_point(|(own, _)| *own < name);
            self.0.insert(at, (name, value));
        }
    }
}

impl Measures {
    /// The number of a measure, in the unit that it names, if it has one.
    #[must_use]
    pub fn value(&self, name: Name) -> Option<f64> {
        self.get(name).map(|worst| worst.value)
    }
}

impl Numbers {
    /// The number of a measure, in the unit that it names, if it has one.
    #[must_use]
    pub fn value(&self, name: Name) -> Option<f64> {
        self.get(name).copied().flatten()
    }
}

impl<T> FromIterator<(Name, T)> for ByName<T> {
    fn from_iter<I: IntoIterator<Item = (Name, T)>>(values: I) -> Self {
        let mut values: Vec<(Name, T)> = values.into_iter().collect();
        values.sort_by_key(|(name, _)| *name);
        ByName(values)
    }
}
