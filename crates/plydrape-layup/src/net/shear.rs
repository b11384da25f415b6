//! Shear of a cell: how far its corners are from right angles.

use super::edge::EdgeRule;
use super::surface_point::SurfacePoint;
use std::f64::consts::FRAC_PI_2;

/// Shear of one cell, from its four corner angles; after Krogh et al. 2021.
///
/// With [`EdgeRule::Chord`] the angles are between bars, otherwise between tangents of the mold.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CellShear {
    /// Mean over the corners (rad), positive where u and v meet at less than 90°. What the mold's curvature
    /// adds to all four angles cancels.
    pub angle: f64,
    /// Mean over the corners of how far each is from 90° (rad), as KinDrape reports it.
    pub magnitude: f64,
}

impl CellShear {
    /// Shear of the cell with nodes [i, j], [i+1, j], [i+1, j+1] and [i, j+1].
    pub(super) fn new(ring: [&SurfacePoint; 4], rule: EdgeRule) -> Self {
        // the angle of the second and fourth corner is the supplement of that between u and v
        let signed: [f64; 4] = std::array::from_fn(|n| {
            let angle = rule.angle(ring[n], ring[(n + 1) % 4], ring[(n + 3) % 4]);
            let short = FRAC_PI_2 - angle;
            if n % 2 == 0 { short } else { -short }
        });
        CellShear {
            angle: signed.iter().sum::<f64>() / 4.0,
            magnitude: signed.iter().map(|s| s.abs()).sum::<f64>() / 4.0,
        }
    }
}
