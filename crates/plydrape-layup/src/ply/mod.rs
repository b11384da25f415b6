//! The ply as a net of catenaries between grippers.

mod cells;
mod contact_segment;
mod cut;
mod flat;
mod grid;
mod held_off;
mod lines;
mod outline;
mod places;
mod ruck;
pub mod shear;
mod tuning;

pub use crate::gripper::{GripperId, gripper_name, read_gripper_name};
pub use contact_segment::{ContactSegment, LandedCell};
pub use cut::{Cut, Held, Neighbors, Shares, directions, orientations, tangent_shares, tangents};
pub use flat::flat_axes;
pub use grid::{Catenary, Grid, Kind};
pub use held_off::PickUpError;
pub use lines::{BiasLines, Fibers, FoundLines, LineCell, Lines};
pub use outline::{Outline, Ring};
pub use places::{FARTHEST, STEEPEST, is_near};
pub use ruck::Ruck;

use crate::material::{LineSection, Material, Section};

/// A woven ply held by grippers: a rectangle that ends at its array of grippers, or as it is cut.
///
/// Fabric coordinates (u, v) are meters along its two families of yarns, from the first gripper.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Ply {
    /// Grippers along u and v; [`Grid::NONE`] where grippers are no whole array along the yarns.
    pub grid: Grid,
    /// Fabric length of a cell along u and along v: a, b (m); where grippers are no array along the yarns, the pitch of the
    /// array, or the distance of neighbors.
    pub cell: [f64; 2],
    /// What it is made of.
    pub material: Material,
    /// The grid direction along which the warp runs.
    pub warp: Direction,
    /// Length of the fabric that is really there between two of its points over what their fabric coordinates say: 1,
    /// unless an error of the length is examined. Fabric coordinates are those of the nominal ply all the same.
    #[cfg_attr(feature = "serde", serde(default = "nominal", skip_serializing_if = "is_nominal"))]
    pub length_factor: f64,
    /// How far the grippers hold it off its place: not at all, unless an error of the pick-up is examined.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "PickUpError::is_none"))]
    pub pick_up_error: PickUpError,
    /// How it is cut and where it is held; none for a rectangle with a gripper at every node of its grid.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub cut: Option<Cut>,
    /// Lines, see [`Ply::lines`]; empty until they are asked for. Whoever changes [`Self::cut`] of a ply empties it.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub found: FoundLines,
}

/// The length factor of a ply without an error.
#[cfg(feature = "serde")]
fn nominal() -> f64 {
    1.0
}

/// Whether a length factor need not be written.
#[cfg(feature = "serde")]
fn is_nominal(factor: &f64) -> bool {
    *factor == 1.0
}

/// A direction of the gripper grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum Direction {
    /// Along the first gripper index.
    U,
    /// Along the second gripper index.
    V,
}

impl Ply {
    /// A rectangle of a material that is held at every node of an array, with cells of `cell` along u and v (m) and its warp
    /// along u.
    #[must_use]
    pub fn of_array(grid: Grid, cell: [f64; 2], material: Material) -> Self {
        let (warp, found) = (Direction::U, FoundLines::default());
        let pick_up_error = PickUpError::default();
        Ply { grid, cell, material, warp, length_factor: 1.0, pick_up_error, cut: None, found }
    }

    /// Length of the fabric along the sides of a cell (m): those of [`Self::cell`] times [`Self::length_factor`].
    #[must_use]
    pub fn fabric_cell(&self) -> [f64; 2] {
        self.cell.map(|side| side * self.length_factor)
    }

    /// Fabric length of a catenary in the flat ply (m).
    #[must_use]
    pub fn flat_length(&self, catenary: usize) -> f64 {
        self.lines().flat_length(catenary, self.length_factor)
    }

    /// Sides (m) of the trellis of a cell as its bias lines measure it: those of the fabric, scaled where a bias line lies on a
    /// curved mold ([`shear::curved_scale`]). `contacts` holds the contact segment of each catenary.
    #[must_use]
    pub fn trellis(&self, cell: &LineCell, contacts: &[Option<ContactSegment>]) -> [f64; 2] {
        let mut bias = cell.bias.iter().flat_map(BiasLines::list);
        let landed = bias.find_map(|n| contacts[*n].as_ref().and_then(|contact| contact.landed));
        let scale = landed.map_or(1.0, |landed| landed.scale);
        cell.trellis.map(|side| scale * (side * self.length_factor))
    }

    /// The shorter side of a cell (m), of a strip whose cells have no width their length: the unit of length of planners, with which a scaled ply
    /// has the scaled plan.
    #[must_use]
    pub fn shorter_side(&self) -> f64 {
        if self.cell[1] > 0.0 { self.cell[0].min(self.cell[1]) } else { self.cell[0] }
    }

    /// Whether the rows of its cups cross the yarns.
    #[must_use]
    pub(crate) fn is_turned(&self) -> bool {
        self.cut.as_ref().is_some_and(|cut| cut.turn != 0.0)
    }

    /// Width of the strip that a fiber line along u or v stands for (m): from one line to the next; of the nominal ply.
    pub(crate) fn line_widths(&self) -> [f64; 2] {
        let [a, b] = self.cell;
        if self.is_turned() { [0.5 * a.hypot(b); 2] } else { [b, a] }
    }

    /// Mass per area (kg/m²). That of a material by line is spread over strips one cell wide, on average over both directions; a
    /// single line stands for a strip as wide as its cell is along it.
    #[must_use]
    pub fn areal_mass(&self) -> f64 {
        match self.material.section {
            Section::Line { mass, .. } => {
                let [a, b] = self.cell;
                mass * 2.0 / (a + if b > 0.0 { b } else { a })
            }
            Section::Areal { mass, .. } => mass,
        }
    }

    /// Mass per length and flexural rigidity of a catenary.
    ///
    /// With areal properties each fiber line stands for a strip as wide as it is to the next one: `b` for the lines along
    /// u, `a` for those along v. A bias line is no tow; it takes the mean of the array's pitches, and of both rigidities.
    #[must_use]
    pub fn line(&self, kind: Kind) -> LineSection {
        match self.material.section {
            Section::Line { mass, flexural_rigidity } => LineSection { mass, flexural_rigidity },
            Section::Areal { mass, warp_rigidity, weft_rigidity } => {
                let (along_u, along_v) = match self.warp {
                    Direction::U => (warp_rigidity, weft_rigidity),
                    Direction::V => (weft_rigidity, warp_rigidity),
                };
                let [a, b] = self.fabric_cell();
                let [wide_u, wide_v] = self.line_widths().map(|width| width * self.length_factor);
                let (width, rigidity) = match kind {
                    Kind::EdgeU => (wide_u, along_u),
                    Kind::EdgeV => (wide_v, along_v),
                    Kind::Rising | Kind::Falling => ((a + b) / 2.0, (along_u + along_v) / 2.0),
                };
                LineSection { mass: mass * width, flexural_rigidity: rigidity * width }
            }
        }
    }
}

/// A ply of no matter what between the grippers of an array, 100 mm apart.
#[cfg(test)]
pub(crate) fn cloth(grid: Grid) -> Ply {
    let section = Section::Line { mass: 0.3, flexural_rigidity: 1e-5 };
    let material = Material { section, ..Material::woven("cloth", 0.3, 1e-5, 1e6, 0.0) };
    Ply::of_array(grid, [0.1; 2], material)
}
