//! The keys of the table `[pick_up]`.

use crate::scene::located::Located;
use crate::scene::pick_up;
use crate::scene::quantity::{Quantity, written};
use crate::scene::usual::{Clear, Grip, Place, Timeout};
use schemars::JsonSchema;
use serde::Deserialize;

/// How the ply is picked up from a table, under the place where [grippers] hang it. Without this table a motion begins with a ply in the air.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
#[schemars(rename = "Pick-up")]
pub(in crate::scene) struct PickUpTable {
    /// Height z of the table or the stack on which the ply lies (m); the top of the obstacle `table` unless given.
    pub height: Option<Quantity<Place>>,
    /// Name of the obstacle on which the ply lies. Pads stand on it, so bodies on pads are not judged against it.
    pub table: Option<Located<String>>,
    /// How far above the ply the pads come from, and go to when they have let go of it (m).
    #[schemars(extend("default" = written(pick_up::CLEARANCE, "mm")))]
    pub clearance: Option<Quantity<Clear>>,
    /// How long the pads stand on the ply with the vacuum on before they lift it (s).
    #[schemars(extend("default" = written(pick_up::GRIP, "s")))]
    pub grip: Option<Quantity<Grip>>,
    /// How long programs wait at most for an input of each pad that says that its vacuum is there, before they stop and hold (s). Unless given
    /// they do not look.
    pub vacuum_timeout: Option<Quantity<Timeout>>,
    /// How far the pads go back along the normals of the mold when they have let go (m).
    #[schemars(extend("default" = written(pick_up::RETREAT, "mm")))]
    pub retreat: Option<Quantity<Clear>>,
}
