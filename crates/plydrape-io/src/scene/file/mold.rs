//! The keys of the table `[mold]`.

use crate::scene::located::{Fixed, Located};
use crate::scene::quantity::{Quantity, Ratio};
use crate::scene::usual::{Coordinate, Heading, Radius, Slope, Spanned};
use schemars::JsonSchema;
use serde::Deserialize;

/// The surface that the ply is laid on. Its kind says which of the keys it takes.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
#[schemars(rename = "Mold")]
pub(in crate::scene) struct MoldTable {
    /// Shape of the mold.
    pub kind: Located<MoldKind>,
    /// Of a plane: a point of it (m); the origin unless given.
    pub point: Option<Located<Fixed<Quantity<Coordinate>, 3>>>,
    /// Of a plane: direction out of the mold towards the ply, of any length, upwards; or give `tilt`.
    pub normal: Option<Located<Fixed<Quantity<Ratio>, 3>>>,
    /// Of a plane: angle between it and the horizontal (rad).
    pub tilt: Option<Quantity<Slope>>,
    /// Of a plane: heading in which it climbs (rad), from x towards y.
    pub tilt_direction: Option<Quantity<Heading>>,
    /// Place of the mold's own origin (m), that of the scene unless given. Not of a plane.
    pub position: Option<Located<Fixed<Quantity<Coordinate>, 3>>>,
    /// How the mold is turned: about the fixed axes x, then y, then z (rad). Not of a plane.
    pub rotation: Option<Located<Fixed<Quantity<Heading>, 3>>>,
    /// Radius of a cylinder, whose axis is its x axis, or of a sphere (m).
    pub radius: Option<Quantity<Radius>>,
    /// Of a torus: radius of the ring that its tube follows, in its xy plane (m).
    pub ring_radius: Option<Quantity<Radius>>,
    /// Of a torus: radius of the tube (m), smaller than that of the ring.
    pub tube_radius: Option<Quantity<Radius>>,
    /// Of a cylinder, sphere or torus: the side on which the ply lies.
    #[schemars(extend("default" = "outside"))]
    pub side: Option<Located<SideKey>>,
    /// Of a saddle: radii of curvature at its middle, upwards along x and downwards along y (m).
    pub radii: Option<Located<Fixed<Quantity<Radius>, 2>>>,
    /// Of a formula: the height over x and y, all in meters, as in "0.1*x^2 - y^2".
    pub z: Option<Located<String>>,
    /// Of a saddle or a formula: from where to where it reaches along its x axis (m); goes with `y`.
    pub x: Option<Located<Fixed<Quantity<Coordinate>, 2>>>,
    /// Of a saddle or a formula: from where to where it reaches along its y axis (m); goes with `x`.
    pub y: Option<Located<Fixed<Quantity<Coordinate>, 2>>>,
    /// Of a height grid: a CSV file with the columns x, y, z. Of a mesh: a file .stl, .obj or .inp. Relative
    /// to the scene.
    pub file: Option<Located<String>>,
    /// Of a mesh: the unit in which its file is written, as in "mm"; mesh files do not say it themselves.
    pub unit: Option<Located<String>>,
    /// Of a mesh: width up to which the ply spans pits and holes, which are then taken as filled (m), a tenth of a cell unless
    /// given; 0 for none.
    pub spanned: Option<Quantity<Spanned>>,
}

/// Shape of the mold.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(in crate::scene) enum MoldKind {
    /// Flat, of any position and tilt.
    Plane,
    /// A cylinder about its x axis; from inside, a trough.
    Cylinder,
    /// A sphere; from inside, a bowl.
    Sphere,
    /// A torus about its z axis; from inside, a ring-shaped channel.
    Torus,
    /// A saddle, z = x²/2r₀ − y²/2r₁.
    Saddle,
    /// A height z over x and y as a formula.
    Formula,
    /// Heights at the nodes of a grid, from a CSV file.
    HeightGrid,
    /// Triangles from a file.
    Mesh,
}

impl MoldKind {
    /// All of them.
    pub const ALL: [Self; 8] = [
        MoldKind::Plane,
        MoldKind::Cylinder,
        MoldKind::Sphere,
        MoldKind::Torus,
        MoldKind::Saddle,
        MoldKind::Formula,
        MoldKind::HeightGrid,
        MoldKind::Mesh,
    ];

    /// As it is written in a scene.
    pub fn name(self) -> &'static str {
        match self {
            MoldKind::Plane => "plane",
            MoldKind::Cylinder => "cylinder",
            MoldKind::Sphere => "sphere",
            MoldKind::Torus => "torus",
            MoldKind::Saddle => "saddle",
            MoldKind::Formula => "formula",
            MoldKind::HeightGrid => "height-grid",
            MoldKind::Mesh => "mesh",
        }
    }

    /// The keys it takes beside `kind`.
    pub fn keys(self) -> &'static [&'static str] {
        match self {
            MoldKind::Plane => &["point", "normal", "tilt", "tilt_direction"],
            MoldKind::Cylinder | MoldKind::Sphere => &["radius", "side", "position", "rotation"],
            MoldKind::Torus => &["ring_radius", "tube_radius", "side", "position", "rotation"],
            MoldKind::Saddle => &["radii", "x", "y", "position", "rotation"],
            MoldKind::Formula => &["z", "x", "y", "position", "rotation"],
            MoldKind::HeightGrid => &["file", "position", "rotation"],
            MoldKind::Mesh => &["file", "unit", "spanned", "position", "rotation"],
        }
    }
}

/// The side of a round mold on which the ply lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
#[schemars(rename = "Side")]
pub(in crate::scene) enum SideKey {
    /// On the mold, from outside.
    Outside,
    /// In its lower half, from inside.
    Inside,
}
