//! The keys of the table `[release]`.

use crate::scene::quantity::Quantity;
use crate::scene::usual::Dwell;
use plydrape::layup::ReleaseOrder;
use schemars::JsonSchema;
use serde::Deserialize;

/// When the pads let go of the ply. Without this table they hold it to the end.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
#[schemars(rename = "Release")]
pub(in crate::scene) struct ReleaseTable {
    /// All after the motion, or each when the ply around it lies.
    #[schemars(extend("default" = "end"))]
    pub order: Option<OrderKey>,
    /// How long a pad presses before it lets go (s). With "landed" the ply around it lies for that long.
    #[schemars(extend("default" = 0))]
    pub dwell: Option<Quantity<Dwell>>,
}

/// The order in which pads let go of the ply.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
#[schemars(rename = "Order of release")]
pub(in crate::scene) enum OrderKey {
    /// All at once, after the motion.
    End,
    /// Each when the ply around it lies, the others after the motion.
    Landed,
}

impl From<OrderKey> for ReleaseOrder {
    fn from(order: OrderKey) -> Self {
        match order {
            OrderKey::End => ReleaseOrder::End,
            OrderKey::Landed => ReleaseOrder::Landed,
        }
    }
}
