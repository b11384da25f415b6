//! The keys of the tables `[[bodies]]` and `[[obstacles]]`.

use crate::scene::located::{Fixed, Located};
use crate::scene::quantity::Quantity;
use crate::scene::usual::{Body, Coordinate, Cylinder, Heading, Place};
use plydrape::bodies::Mount;
use schemars::JsonSchema;
use serde::Deserialize;

/// A body that moves with grippers or robot: one of `cylinder`, `box` and `mesh`.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
#[schemars(rename = "Body")]
pub(in crate::scene) struct BodyTable {
    /// Name for reports.
    pub name: Located<String>,
    /// What it moves with: the "pad" of each gripper, which tilts with the ply; the "stem" of each gripper, which does not; or the
    /// robot's "flange".
    pub on: Located<MountKey>,
    /// A cylinder about the z axis: on a pad the ply's normal, on a stem upwards.
    pub cylinder: Option<Located<CylinderTable>>,
    /// A box with sides along the axes.
    #[serde(rename = "box")]
    pub cuboid: Option<Located<BoxTable>>,
    /// A file .stl, .obj or .inp, relative to the scene.
    pub mesh: Option<Located<String>>,
    /// The unit in which the mesh file is written, as in "mm".
    pub unit: Option<Located<String>>,
}

/// Something that stands in the cell, as a table, a flange or a fixture: one of `cylinder`, `box` and `mesh`.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
#[schemars(rename = "Obstacle")]
pub(in crate::scene) struct ObstacleTable {
    /// Name for reports.
    pub name: Located<String>,
    /// A cylinder about its z axis.
    pub cylinder: Option<Located<CylinderTable>>,
    /// A box with sides along its axes.
    #[serde(rename = "box")]
    pub cuboid: Option<Located<BoxTable>>,
    /// A file .stl, .obj or .inp, relative to the scene.
    pub mesh: Option<Located<String>>,
    /// The unit in which the mesh file is written, as in "mm".
    pub unit: Option<Located<String>>,
    /// Place of its own origin (m), that of the scene unless given.
    pub position: Option<Located<Fixed<Quantity<Coordinate>, 3>>>,
    /// How it is turned: about the fixed axes x, then y, then z (rad).
    pub rotation: Option<Located<Fixed<Quantity<Heading>, 3>>>,
}

/// What a body moves with.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
#[schemars(rename = "Mount of a body")]
pub(in crate::scene) enum MountKey {
    /// The pad of each gripper, which tilts with the ply.
    Pad,
    /// The stem of each gripper, which does not.
    Stem,
    /// The robot's flange.
    Flange,
}

impl From<MountKey> for Mount {
    fn from(key: MountKey) -> Self {
        match key {
            MountKey::Pad => Mount::Pad,
            MountKey::Stem => Mount::Stem,
            MountKey::Flange => Mount::Flange,
        }
    }
}

/// A cylinder about the z axis.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
#[schemars(rename = "Cylindrical body")]
pub(in crate::scene) struct CylinderTable {
    /// Radius (m).
    pub radius: Quantity<Cylinder>,
    /// Where along z it begins (m), 0 unless given.
    pub from: Option<Quantity<Place>>,
    /// Where it ends (m), above `from`.
    pub to: Quantity<Place>,
}

/// A box with sides along the axes.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
#[schemars(rename = "Box")]
pub(in crate::scene) struct BoxTable {
    /// Lengths of its sides along x, y and z (m).
    pub size: Fixed<Quantity<Body>, 3>,
    /// Middle (m), the origin unless given.
    pub at: Option<Fixed<Quantity<Place>, 3>>,
}
