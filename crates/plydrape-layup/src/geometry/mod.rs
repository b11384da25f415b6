//! Geometry that every stage of the method uses: vectors, rotations, placements, and closed lines in a plane.

mod pose;
pub mod ring;
pub mod rotation;
pub mod vector;

pub use pose::Pose;
pub use vector::distance;

/// A point in space (m).
pub type Point = [f64; 3];
