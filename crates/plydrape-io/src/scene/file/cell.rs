//! The keys of the table `[cell]`, and of the file of a cell.

use super::{ErrorsTable, GrippersTable, ReleaseTable};
use crate::scene::located::Located;
use schemars::JsonSchema;
use serde::Deserialize;

/// What the scene leaves out of `[grippers]`, `[release]` and `[errors]`; without this table mounts are rigid, pads hold to the end, and nothing is off.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
#[schemars(rename = "Cell")]
pub(in crate::scene) struct CellTable {
    /// "usual": cups with bellows on a robot; "ideal": rigid and without errors; or a .toml file relative to the scene. It gives `lip`,
    /// `stiffness`, `slip_force`, `holding_force` and `max_tilt` of [grippers], [release] and each term of [errors]; keys of
    /// the scene override it. `plydrape limits` lists the figures with their sources.
    #[schemars(extend("examples" = ["usual", "ideal"]))]
    pub preset: Located<String>,
}

/// A file of a cell.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
pub(in crate::scene) struct CellFile {
    /// Where its numbers come from.
    pub source: Option<Located<String>>,
    /// How grippers hold the ply.
    pub grippers: Option<Located<GrippersTable>>,
    /// When the pads let go of a ply on a mold.
    pub release: Option<ReleaseTable>,
    /// How far the cell may be from a scene.
    pub errors: Option<ErrorsTable>,
}
