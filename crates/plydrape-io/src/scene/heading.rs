//! Headings, coordinates and poses.

use super::located::{Fixed, Located};
use super::quantity::{Angle, Length, Quantity};
use super::source::Document;
use super::usual::{self, Usual};
use crate::Error;
use plydrape::mold::Pose;
use std::f64::consts::TAU;

/// A heading of at most one turn to either side (rad).
pub(super) fn heading(angle: &Quantity<Angle>, document: &Document) -> Result<f64, Error> {
    let value = angle.si(document, &usual::ANGLE.within([0.0, TAU]))?;
    if value.abs() <= TAU * (1.0 + 1e-9) {
        return Ok(value);
    }
    Err(document.error(
        angle.span.clone(),
        format!("{} is more than a whole turn", document.quoted(&angle.span)),
        "plain numbers are radians; write degrees as \"90 deg\"",
    ))
}

/// A place and a turn about the fixed axes x, then y, then z; the origin unturned unless given.
pub(super) fn pose(
    position: Option<&Located<Fixed<Quantity<Length>, 3>>>,
    rotation: Option<&Located<Fixed<Quantity<Angle>, 3>>>,
    document: &Document,
    usual: &Usual,
) -> Result<Pose, Error> {
    let position = match position {
        Some(position) => coordinates(&position.value, document, usual)?,
        None => [0.0; 3],
    };
    let mut angles = [0.0; 3];
    if let Some(written) = rotation {
        for (angle, quantity) in angles.iter_mut().zip(&written.value.0) {
            *angle = heading(quantity, document)?;
        }
    }
    Ok(Pose::new(position, angles))
}

/// Coordinates or distances from the origin (m).
pub(super) fn coordinates<const N: usize>(
    values: &Fixed<Quantity<Length>, N>,
    document: &Document,
    usual: &Usual,
) -> Result<[f64; N], Error> {
    let mut numbers = [0.0; N];
    for (number, value) in numbers.iter_mut().zip(&values.0) {
        *number = value.coordinate(document, usual)?;
    }
    Ok(numbers)
}
