//! A ply that was picked up off its place.
//!
//! Fabric is the same everywhere: an array that holds it δ aside holds the same ply, which drapes as it would have and lies δ off in the end.
//! Turned by an angle ψ, the yarns run at ψ to the lines of cups, and a line of length L over cells that are sheared by γ has another length by
//! γψL: 0.04 mm of 100 mm at 6° and the 0.2° of a usual cell. That is neglected, as the way that the edges of the ply have moved is.

use super::Ply;

/// The error of where the grippers hold the ply.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct PickUpError {
    /// Shift of the array over the fabric along u and v (m).
    pub offset: [f64; 2],
    /// Turn of the array on the fabric about its middle, from u to v (rad).
    pub yaw: f64,
}

impl PickUpError {
    /// Whether the ply is held where it should be.
    #[must_use]
    pub fn is_none(&self) -> bool {
        *self == PickUpError::default()
    }
}

impl Ply {
    /// How far off along u and v (m) the fabric is that is where a ply without an error of its pick-up has the point `uv` (m).
    #[must_use]
    pub fn held_off(&self, uv: [f64; 2]) -> [f64; 2] {
        let PickUpError { offset, yaw } = self.pick_up_error;
        if self.pick_up_error.is_none() {
            return [0.0; 2];
        }
        let [low, high] = self.held_bounds();
        let off = [0, 1].map(|n| uv[n] - 0.5 * (low[n] + high[n]));
        [offset[0] - yaw * off[1], offset[1] + yaw * off[0]]
    }
}
