//! The ply as a net of catenaries between grippers.

mod contact_segment;
mod cut;
mod grid;
mod outline;
mod places;
mod ruck;
pub mod shear;
mod tuning;

pub use contact_segment::{ContactSegment, LandedCell};
pub use cut::{Cut, Held, Neighbours, directions, tangents};
pub use grid::{Catenary, Grid, GripperId, Kind};
pub use outline::{Outline, OutlineError, Ring, RingId};
pub use places::{FARTHEST, PlaceError, STEEPEST, is_near};
pub use ruck::Ruck;

use crate::material::{Line, Material, Section};

/// A woven ply held by grippers: a rectangle that ends at its array of grippers, or as it is cut.
///
/// Fabric coordinates (u, v) are metres along its two families of yarns, from the first gripper.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Ply {
    /// Grippers along u and v, between which catenaries hang; [`Grid::NONE`] where grippers are no array along the yarns.
    pub grid: Grid,
    /// Fabric length of a cell along u and along v: a, b (m); where grippers are no array along the yarns, the pitch of the
    /// array, or the distance of neighbours.
    pub cell: [f64; 2],
    /// What it is made of.
    pub material: Material,
    /// The grid direction along which the warp runs.
    pub warp: Direction,
    /// Length of the fabric that is really there between two of its points over what their fabric coordinates say: 1,
    /// unless an error of the length is examined. Fabric coordinates are those of the nominal ply all the same.
    #[cfg_attr(feature = "serde", serde(default = "nominal", skip_serializing_if = "is_nominal"))]
    pub length_factor: f64,
    /// How it is cut and where it is held; none of a rectangle with a gripper at every node of its grid.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub cut: Option<Cut>,
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
    /// Length of the fabric along the sides of a cell (m): those of [`Self::cell`] times [`Self::length_factor`].
    #[must_use]
    pub fn fabric_cell(&self) -> [f64; 2] {
        self.cell.map(|side| side * self.length_factor)
    }

    /// Fabric length of a catenary in the flat ply (m): a, b, or √(a²+b²) for a diagonal.
    #[must_use]
    pub fn flat_length(&self, kind: Kind) -> f64 {
        let [a, b] = self.fabric_cell();
        match kind {
            Kind::EdgeU => a,
            Kind::EdgeV => b,
            Kind::Rising | Kind::Falling => a.hypot(b),
        }
    }

    /// Sides of a cell (m) as its diagonals measure it: those of the fabric, scaled where a diagonal lies on a
    /// curved mold ([`shear::curved_scale`]). `contacts` holds the contact segment of each catenary.
    #[must_use]
    pub fn sides(&self, cell: usize, contacts: &[Option<ContactSegment>]) -> [f64; 2] {
        let first = self.grid.edges() + 2 * cell;
        let landed = contacts[first..first + 2].iter().flatten().find_map(|contact| contact.landed);
        self.fabric_cell().map(|side| landed.map_or(1.0, |landed| landed.scale) * side)
    }

    /// Share of an edge's forces that is the ply's.
    ///
    /// Each family of edges has the weight of the whole ply, so where there are two families each counts half. A line
    /// inside the ply stands for a strip one cell wide, one on its boundary for half a strip.
    #[must_use]
    pub(crate) fn tributary(&self, edge: usize) -> f64 {
        let (grid, c) = (self.grid, self.grid.catenary(edge));
        let (line, lines) =
            if c.kind == Kind::EdgeU { (c.from[1], grid.nv) } else { (c.from[0], grid.nu) };
        let families = if grid.nv > 1 { 2.0 } else { 1.0 };
        let boundary = lines > 1 && (line == 0 || line + 1 == lines);
        if boundary { 0.5 / families } else { 1.0 / families }
    }

    /// Mass per length and flexural rigidity of a catenary.
    ///
    /// With areal properties each catenary stands for a strip one cell wide: `b` for the lines along
    /// u, `a` for those along v. A diagonal is no tow; it takes the mean of both.
    #[must_use]
    pub fn line(&self, kind: Kind) -> Line {
        match self.material.section {
            Section::Line { mass, flexural_rigidity } => Line { mass, flexural_rigidity },
            Section::Areal { mass, warp_rigidity, weft_rigidity } => {
                let (along_u, along_v) = match self.warp {
                    Direction::U => (warp_rigidity, weft_rigidity),
                    Direction::V => (weft_rigidity, warp_rigidity),
                };
                let [a, b] = self.fabric_cell();
                let (width, rigidity) = match kind {
                    Kind::EdgeU => (b, along_u),
                    Kind::EdgeV => (a, along_v),
                    Kind::Rising | Kind::Falling => ((a + b) / 2.0, (along_u + along_v) / 2.0),
                };
                Line { mass: mass * width, flexural_rigidity: rigidity * width }
            }
        }
    }
}

/// A ply of no matter what between the grippers of an array, 100 mm apart.
#[cfg(test)]
pub(crate) fn cloth(grid: Grid) -> Ply {
    let material = Material {
        name: "cloth".into(),
        source: String::new(),
        section: Section::Line { mass: 0.3, flexural_rigidity: 1e-5 },
        tension: None,
        shear_curve: None,
        locking_angle: None,
    };
    let (cell, warp) = ([0.1; 2], Direction::U);
    Ply { grid, cell, material, warp, length_factor: 1.0, cut: None }
}
