//! Whether gripper positions are such that the model has a solution, and times such that a motion has them.
//!
//! Scene files, tables and programs are held to the same: coordinates are finite and up to [`FARTHEST`], neighbors stand a
//! horizontal distance apart, because a span straight up has no horizontal force, and times ascend.

use super::{Catenary, Ply};
use crate::Error;

/// Largest coordinate of a gripper (m): far beyond any robot, and far from where squares of distances overflow.
pub const FARTHEST: f64 = 1e6;
/// Least horizontal distance of neighbors as a share of the fabric between them: a span has no solution straight up.
pub const STEEPEST: f64 = 0.01;

/// Whether every coordinate (m) is a number up to [`FARTHEST`]; NaN and infinity are not.
#[must_use]
pub fn is_near(position: &[f64; 3]) -> bool {
    position.iter().all(|x| x.abs() <= FARTHEST)
}

impl Ply {
    /// Refuses gripper positions (m, in the order of [`super::Ply::index`]) for which the model has no solution.
    ///
    /// # Errors
    /// [`Error::GripperCount`] without one position for each gripper; [`Error::GripperFar`] or [`Error::GripperSteep`] for the first
    /// gripper, or pair of neighbors, that cannot be where it is.
    pub fn check_places(&self, positions: &[[f64; 3]]) -> Result<(), Error> {
        let (found, expected) = (positions.len(), self.grippers());
        if found != expected {
            return Err(Error::GripperCount { step: None, found, expected });
        }
        if let Some(far) = positions.iter().position(|position| !is_near(position)) {
            let (gripper, position) = (self.id(far), positions[far]);
            return Err(Error::GripperFar { step: None, gripper, position, most: FARTHEST });
        }
        let lines = self.lines();
        (0..lines.catenaries()).try_for_each(|index| {
            let Catenary { from: a, to: b, .. } = lines.catenary(index);
            let [from, to] = lines.ends(index).map(|gripper| positions[gripper]);
            let (run, length) = (
                (to[0] - from[0]).hypot(to[1] - from[1]),
                lines.flat_length(index, self.length_factor),
            );
            if run >= STEEPEST * length {
                return Ok(());
            }
            Err(Error::GripperSteep { step: None, a, b, run, length })
        })
    }
}
