//! The surface that the ply is laid on.

mod plane;

pub use plane::Plane;

use serde::Serialize;

/// A mold.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Mold {
    /// Flat, of any position and tilt.
    Plane(Plane),
}
