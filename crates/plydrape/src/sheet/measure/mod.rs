//! What is measured of a sheet, each value with its place in the fabric, in space and its step.
//!
//! The extremes of strain, shear, force, depth and tilt are those of all steps (`extremes`); height (`height`), fiber
//! directions (`direction`) and positions (`position`) are those of the end.

mod direction;
mod extremes;
mod height;
mod limits;
mod position;
mod summary;

pub use extremes::Extremes;
#[cfg(test)]
pub(super) use extremes::{TILT_REACH, tilt};
pub use height::{Raised, raised};
pub(super) use summary::Effort;
pub use summary::Summary;

/// A largest value and where it is.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Place {
    /// The value (SI).
    pub value: f64,
    /// Fabric coordinates (m).
    pub uv: [f64; 2],
    /// Place in space (m).
    pub at: [f64; 3],
    /// The step.
    pub step: usize,
}

/// Collects the largest of several values, the first of those that are equal; one that is no number is the largest.
#[derive(Debug, Clone, Copy, Default)]
struct Most(Option<Place>);

impl Most {
    fn meet(&mut self, value: f64, uv: [f64; 2], at: [f64; 3], step: usize) {
        let larger = |most: Place| !most.value.is_nan() && (value.is_nan() || value > most.value);
        if self.0.is_none_or(larger) {
            self.0 = Some(Place { value, uv, at, step });
        }
    }
}

/// The middle of some points.
fn middle<const N: usize, const D: usize>(points: [[f64; D]; N]) -> [f64; D] {
    let mut sum = [0.0; D];
    for point in points {
        for n in 0..D {
            sum[n] += point[n] / N as f64;
        }
    }
    sum
}
