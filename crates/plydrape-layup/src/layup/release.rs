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
    /// When the pad of each gripper lets go (s) by the program of a robot, in a cell whose motion has errors; `None` if that follows
    /// from the motion.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub times: Option<Arc<[f64]>>,
}

impl Release {
    /// A release in an order, after a dwell (s).
    #[must_use]
    pub fn new(order: ReleaseOrder, dwell: f64) -> Self {
        Release { order, dwell, times: None }
    }

    /// Whether pads dwell while others still move, so that what they do depends on the time of the motion.
    #[must_use]
    pub fn dwells_on_the_way(&self) -> bool {
        self.order == ReleaseOrder::HollowsFirst && self.dwell > 0.0
    }
}

/// The order in which pads let go of the ply.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum ReleaseOrder {
    /// All at once, after the motion.
    End,
    /// Over a hollow of the mold each when its gripper has come to its last place, all others after the motion.
    HollowsFirst,
}
