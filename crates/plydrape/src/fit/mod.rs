//! Laws of a ply from tests of specimens, with their uncertainty.
//!
//! `shear` turns forces of a bias-extension or picture-frame test into shear force per length, `bending` overhangs, hanging
//! strips and bending tests into rigidities and curves of the moment, `statistics` says how sure they are. Theory:
//! `docs/theory/fit.md`.

mod bending;
mod shear;
mod statistics;
#[cfg(test)]
mod tests;

pub use bending::{Hang, Overhang, fit_hang, fit_moments, rigidity_of_overhang};
pub use shear::{BiasExtension, PictureFrame, ShearFit, ShearTest};
pub use statistics::{Estimate, Sure};

/// Why a law cannot be had from a test.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FitError {
    /// Too few points.
    #[error("{what} has {found} points; {wanted} are wanted")]
    Few {
        /// What.
        what: String,
        /// How many it has.
        found: usize,
        /// How many it needs.
        wanted: usize,
    },
    /// A number that makes no sense.
    #[error("{what} is {value} {unit}; it must be {range}")]
    Range {
        /// What it is.
        what: &'static str,
        /// Its value (SI).
        value: f64,
        /// The unit of the value.
        unit: &'static str,
        /// What it may be.
        range: &'static str,
    },
    /// The points lie on no curve of the law.
    #[error("the points of {what} fit no heavy strip: {reason}")]
    NoFit {
        /// Which specimen.
        what: String,
        /// Why.
        reason: String,
    },
}

fn positive(what: &'static str, value: f64, unit: &'static str) -> Result<(), FitError> {
    if value > 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(FitError::Range { what, value, unit, range: "positive" })
}
