//! Headings and coordinates.

use super::error::{Document, SceneError};
use super::located::Fixed;
use super::quantity::{Angle, Length, Quantity};

/// A heading of at most one turn to either side (rad).
pub(super) fn heading(angle: &Quantity<Angle>, document: &Document) -> Result<f64, SceneError> {
    let value = angle.si(document)?;
    if value.abs() <= std::f64::consts::TAU * (1.0 + 1e-9) {
        return Ok(value);
    }
    Err(document.error(
        angle.span.clone(),
        format!("{} is more than a whole turn", document.quoted(&angle.span)),
        "plain numbers are radians; write degrees as \"90 deg\"",
    ))
}

/// Coordinates or distances from the origin (m).
pub(super) fn coordinates<const N: usize>(
    values: &Fixed<Quantity<Length>, N>,
    document: &Document,
) -> Result<[f64; N], SceneError> {
    let mut numbers = [0.0; N];
    for (number, value) in numbers.iter_mut().zip(&values.0) {
        *number = value.coordinate(document)?;
    }
    Ok(numbers)
}
