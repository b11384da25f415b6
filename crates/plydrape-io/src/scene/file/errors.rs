//! The keys of the table `[errors]`.

use crate::scene::located::{CountOrNone, Located, Seed};
use crate::scene::quantity::{Measure, Quantity, Ratio, written};
use crate::scene::usual::{AngleError, CellError, CellShare, Waves};
use plydrape::errors::Errors;
use schemars::JsonSchema;
use serde::Deserialize;

/// How far a real cell may be from this scene. Every term is a table of one key: `deviation` is the standard deviation of a
/// normal law, `bound` the largest size, every value below it being as likely. A term that is left out is that of the cell, or zero.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
#[schemars(rename = "Errors")]
pub(in crate::scene) struct ErrorsTable {
    /// Seed of the draws. The same seed draws the same cells.
    #[schemars(extend("default" = Errors::default().seed))]
    pub seed: Option<Located<Seed>>,
    /// Cells that are drawn at most. With 0 nothing is judged with errors.
    #[schemars(extend("default" = Errors::default().samples))]
    pub samples: Option<Located<CountOrNone>>,
    /// Share of the cells that must keep the limits.
    #[schemars(extend("default" = written(Errors::default().share, "%")))]
    pub share: Option<Quantity<CellShare>>,
    /// Of the tool frame, common to all grippers.
    #[serde(default)]
    pub frame: FrameErrorsTable,
    /// Of each gripper by itself.
    #[serde(default)]
    pub gripper: GripperErrorsTable,
    /// Of where the grippers hold the ply.
    #[serde(default)]
    pub pick_up: PickUpErrorsTable,
    /// Of the ply, shares of its nominal values or factors.
    #[serde(default)]
    pub material: MaterialErrorsTable,
    /// Of the mold.
    pub mold: Option<Located<MoldErrorsTable>>,
}

/// Errors of the tool frame, common to all grippers.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
#[schemars(rename = "Errors of the tool frame")]
pub(in crate::scene) struct FrameErrorsTable {
    /// Shift along each of x, y and z (m).
    pub position: Option<Term<CellError>>,
    /// Turn about each of x, y and z through the middle of the array (rad).
    pub angle: Option<Term<AngleError>>,
}

/// Errors of each gripper by itself.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
#[schemars(rename = "Errors of a gripper")]
pub(in crate::scene) struct GripperErrorsTable {
    /// Constant shift along each of x, y and z (m).
    pub position: Option<Term<CellError>>,
    /// Shift along each axis as a share of the way gone along it since the start.
    pub stroke: Option<Term<Ratio>>,
}

/// Errors of where the grippers hold the ply.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
#[schemars(rename = "Errors of the pick-up")]
pub(in crate::scene) struct PickUpErrorsTable {
    /// Shift of the array over the fabric along u and along v (m).
    pub offset: Option<Term<CellError>>,
    /// Turn of the array on the fabric about its middle (rad).
    pub yaw: Option<Term<AngleError>>,
}

/// Errors of the ply, each a share of the nominal value or a factor.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
#[schemars(rename = "Errors of the material")]
pub(in crate::scene) struct MaterialErrorsTable {
    /// Of the mass per area, or per length.
    pub areal_mass: Option<Located<ShareTable>>,
    /// Of the bending rigidities, warp and weft alike.
    pub bending: Option<Located<ShareTable>>,
    /// Of the shear force at every shear angle.
    pub shear: Option<Located<ShareTable>>,
    /// Of the length of fabric between the grippers.
    pub length: Option<Term<Ratio>>,
}

/// Errors of the mold.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
#[schemars(rename = "Errors of the mold")]
pub(in crate::scene) struct MoldErrorsTable {
    /// Shift along each of x, y and z (m).
    pub offset: Option<Term<CellError>>,
    /// Turn about x and about y through the middle of the target (rad).
    pub tilt: Option<Term<AngleError>>,
    /// Height of smooth random waves on its surface (m): the root of its mean square, or what no point exceeds.
    pub waviness: Option<Term<CellError>>,
    /// Length of these waves (m); needed where there is waviness.
    pub wavelength: Option<Quantity<Waves>>,
}

/// One term, with its place.
pub(in crate::scene) type Term<M> = Located<TermTable<M>>;

/// How far a number may be off: one of both keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    bound = "M: Measure",
    expecting = "a table of one key, `deviation` or `bound`"
)]
#[schemars(inline, bound = "M: Measure", extend("minProperties" = 1, "maxProperties" = 1))]
pub(in crate::scene) struct TermTable<M: Measure> {
    /// Standard deviation of a normal law.
    pub deviation: Option<Quantity<M>>,
    /// Largest size; every value below it is as likely.
    pub bound: Option<Quantity<M>>,
}

/// How far a value of the ply may be off: one of three keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of one key, `deviation`, `bound` or `factor`")]
#[schemars(inline, extend("minProperties" = 1, "maxProperties" = 1))]
pub(in crate::scene) struct ShareTable {
    /// Standard deviation of a normal law, as a share.
    pub deviation: Option<Quantity<Ratio>>,
    /// Largest size, as a share; every value below it is as likely.
    pub bound: Option<Quantity<Ratio>>,
    /// Largest factor f from 1 to 10: the value is the nominal one times f^u, u being even from -1 to 1.
    pub factor: Option<Quantity<Ratio>>,
}
