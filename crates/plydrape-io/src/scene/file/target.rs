//! The keys of the table `[target]`.

use crate::scene::choice::{HeadingChoice, Positions, SeedChoice};
use crate::scene::located::{Fixed, Located};
use crate::scene::quantity::Quantity;
use crate::scene::usual::{Mesh, Place, ShearAngle};
use schemars::JsonSchema;
use serde::Deserialize;

/// Where the ply shall end: laid on the mold as a net of yarns that do not stretch, or `positions`.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
#[schemars(rename = "Target")]
pub(in crate::scene) struct TargetTable {
    /// Place x, y (m) of the fabric point that is laid first, the `seed`; it is put on the mold.
    pub origin: Option<Located<Fixed<Quantity<Place>, 2>>>,
    /// Heading there (rad), from x towards y, of u, or of the warp where `warp` is an angle; or "best", the one with which the ply
    /// shears least.
    pub direction: Option<Located<HeadingChoice>>,
    /// Shear angle there (rad): v is at 90° minus this angle from u.
    pub shear: Option<Quantity<ShearAngle>>,
    /// The fabric point [u, v] (m) that is laid first, gripper g0_0 unless given, of a ply that is cut a point of its drawing and
    /// its middle unless given; or "middle", of a ply that is cut that of the box around its drawing. With "best" the middle of the ply lies at `origin`, and the yarns that are laid first
    /// are those with which the ply shears least.
    pub seed: Option<Located<SeedChoice>>,
    /// Mesh width of the net (m), a whole part of both cells. Unless given, cells are divided to a tenth of their shorter side or
    /// less, on a plane not at all.
    pub mesh: Option<Quantity<Mesh>>,
    /// How the first two yarns run.
    #[schemars(extend("default" = "geodesic"))]
    pub generators: Option<Located<GeneratorsKey>>,
    /// How the fabric between neighboring nodes of the net is measured.
    #[schemars(extend("default" = "along"))]
    pub edges: Option<Located<EdgesKey>>,
    /// The target boundary, for `plydrape net`: a CSV file (x, y, z) of points on the mold in turn around the ply.
    pub trim: Option<Located<String>>,
    /// Every position: a table of rows along v of [x, y, z] along u, or a CSV file (i, j, x, y, z).
    pub positions: Option<Located<Positions>>,
}

/// How the two yarns through the seed run, from which all others follow.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
#[schemars(rename = "Generators")]
pub(in crate::scene) enum GeneratorsKey {
    /// Straight on over the mold.
    Geodesic,
    /// So that each cell beside them keeps the shear of the seed.
    LeastShear,
}

/// How the fabric between neighboring nodes of the net is measured.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
#[schemars(rename = "Edges")]
pub(in crate::scene) enum EdgesKey {
    /// Along the mold.
    Along,
    /// Straight from node to node.
    Chord,
}
