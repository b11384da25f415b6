//! Geometry that every stage of the method uses: vectors, matrices, rotations, placements, and the search for a minimum or a crossing
//! along a curve.

pub(crate) mod bracket;
pub(crate) mod matrix3;
mod pose;
pub(crate) mod rotation;
pub mod vector;

pub use pose::Pose;
pub use vector::distance;

/// A point in space (m).
pub type Point = [f64; 3];
