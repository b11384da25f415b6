//! A pose of a scene: a place and a turn about fixed axes.

use super::located::{Fixed, Located};
use super::quantity::{Measure, Quantity, Read};
use super::source::Document;
use super::usual::Heading;
use crate::Error;
use plydrape::mold::Pose;

/// A place and a turn about the fixed axes x, then y, then z; the origin unturned unless given.
pub(super) fn pose<M: Measure>(
    position: Option<&Located<Fixed<Quantity<M>, 3>>>,
    rotation: Option<&Located<Fixed<Quantity<Heading>, 3>>>,
    document: &Document,
) -> Result<Pose, Error> {
    let position = position.map_or(Ok([0.0; 3]), |position| position.read(document))?;
    let angles = rotation.map_or(Ok([0.0; 3]), |rotation| rotation.read(document))?;
    Ok(Pose::new(position, angles))
}
