//! Laws of a ply from tests of specimens, with their uncertainty.
//!
//! `shear` turns forces of a bias-extension or picture-frame test into shear force per length, `bending` overhangs, hanging
//! strips and bending tests into rigidities and curves of the moment, `rate` strips that are pulled at several speeds into what
//! resin adds. `record` finds the part of a machine's record that is the test, and `statistics` says how sure the laws are. Theory:
//! `docs/theory/fit.md`.

mod bending;
mod rate;
mod record;
mod shear;
mod statistics;
#[cfg(test)]
mod tests;

pub use crate::error::PointFault;
pub use bending::{Hang, MomentFit, Overhang, fit_hang, fit_moments, rigidity_of_overhang};
pub use rate::{RateFit, TimedSpecimen, fit_rate};
pub use record::Remark;
pub use shear::{BiasExtension, PictureFrame, ShearFit, ShearSpecimen, ShearTest, fit_shear};
pub use statistics::{Estimate, Sure};

use crate::Error;

fn positive(what: &'static str, value: f64, unit: &'static str) -> Result<(), Error> {
    if value > 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(Error::FitRange { what, value, unit, range: "positive" })
}
