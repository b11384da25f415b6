//! The keys of the table `[sheet]`, and of what only the sheet knows of grippers and material.

use crate::scene::located::{Count, Located};
use crate::scene::quantity::Quantity;
use crate::scene::usual::{LipRigidity, Mesh, Mount, Pad, Strain, TensionForce};
use plydrape::layup::SheetSettings;
use schemars::JsonSchema;
use serde::Deserialize;

/// How the ply is divided and followed as a sheet.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
#[schemars(rename = "Sheet")]
pub(in crate::scene) struct SheetTable {
    /// Largest distance between neighboring lines of nodes (m), a tenth of the shorter side of a cell unless given.
    pub mesh: Option<Quantity<Mesh>>,
    /// Which time the motion takes.
    #[schemars(extend("default" = "quasi-static"))]
    pub time: Option<TimeKey>,
    /// Most states that are kept, the first and the last among them.
    #[schemars(extend("default" = SheetSettings::default().keep))]
    pub keep: Option<Located<Count>>,
}

/// The time in which a sheet follows the motion of its grippers.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
#[schemars(rename = "Time of the sheet")]
pub(in crate::scene) enum TimeKey {
    /// Stretched until the ply's kinetic energy is of no matter.
    QuasiStatic,
    /// That of the motion.
    Real,
}

/// How far the mount of a pad yields; a stiffness that is left out is rigid.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
#[schemars(rename = "Mount")]
pub(in crate::scene) struct MountTable {
    /// Stiffness along the ply (N/m).
    pub lateral: Option<Quantity<Mount>>,
    /// Stiffness across the ply (N/m).
    pub axial: Option<Quantity<Mount>>,
}

/// The soft lip of a vacuum cup, which the vacuum joins to the fabric: the fabric under it bends with it, and shears as if it were free.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
#[schemars(rename = "Lip")]
pub(in crate::scene) struct LipTable {
    /// Radius (m); that of the cell unless given. 0 is no lip.
    pub radius: Option<Quantity<Pad>>,
    /// Flexural rigidity per width (N·m), E t³/12(1 - ν²) of a disc of rubber t thick; that of the cell unless given.
    pub rigidity: Option<Quantity<LipRigidity>>,
}

/// Measured points of a tensile test, the same along warp and weft.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
#[schemars(rename = "Tension")]
pub(in crate::scene) struct TensionTable {
    /// Strains, ascending from 0.
    pub strain: Located<Vec<Quantity<Strain>>>,
    /// Tension per width at each strain, from 0 and never falling (N/m).
    pub force: Located<Vec<Quantity<TensionForce>>>,
}
