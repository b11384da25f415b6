//! When the pads let go of the ply.

use std::sync::Arc;

/// When the pads let go of the ply.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Release {
    /// Which of them, and after what.
    pub order: ReleaseOrder,
    /// How long a pad presses before it lets go (s).
    pub dwell: f64,
    /// When each pad lets go (s), as an earlier drape along the same motion has found it: a robot does so at that time, wherever
    /// the ply is. None to find that out.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub times: Option<Arc<[f64]>>,
}

impl Release {
    /// A release in an order, after a dwell (s), at times that a drape is to find.
    #[must_use]
    pub fn new(order: ReleaseOrder, dwell: f64) -> Self {
        Release { order, dwell, times: None }
    }
}

/// The order in which pads let go of the ply.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum ReleaseOrder {
    /// All at once, after the motion.
    End,
    /// Each when the ply around it lies, the others after the motion.
    Landed,
}
