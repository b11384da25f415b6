//! A flat mold of any position and tilt.

use serde::Serialize;

/// The plane through `point` with unit normal `normal`, whose z component is positive.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Plane {
    /// A point of the mold (m).
    pub point: [f64; 3],
    /// Unit normal, out of the mold towards the ply.
    pub normal: [f64; 3],
}
