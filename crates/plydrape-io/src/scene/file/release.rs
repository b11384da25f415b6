//! The keys of the table `[release]`.

use crate::scene::quantity::Quantity;
use crate::scene::usual::Dwell;
use plydrape::layup::ReleaseOrder;
use schemars::JsonSchema;
use serde::Deserialize;

/// When the pads let go of the ply. Without this table they do so as the cell does; without a cell they hold it to the end.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
#[schemars(rename = "Release")]
pub(in crate::scene) struct ReleaseTable {
    /// All after the motion, or those over a hollow of the mold each when its gripper has come to its last place; that of the cell or "end" unless given.
    pub order: Option<OrderKey>,
    /// How long a pad presses before it lets go (s); that of the cell or 0 unless given.
    pub dwell: Option<Quantity<Dwell>>,
}

/// The order in which pads let go of the ply.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
#[schemars(rename = "Order of release")]
pub(in crate::scene) enum OrderKey {
    /// All at once, after the motion.
    End,
    /// Over a hollow of the mold each when its gripper has come to its last place, all others after the motion.
    HollowsFirst,
}

impl From<OrderKey> for ReleaseOrder {
    fn from(order: OrderKey) -> Self {
        match order {
            OrderKey::End => ReleaseOrder::End,
            OrderKey::HollowsFirst => ReleaseOrder::HollowsFirst,
        }
    }
}
