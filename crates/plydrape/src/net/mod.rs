//! The ideal drape: a pin-jointed net of warp and weft on the mold.
//!
//! Fibres do not stretch, cells shear freely, and every node lies on the mold (Mack and Taylor 1956). So
//! two lines of nodes determine all others: a node is the common end of two known edges of fabric. The
//! generators run straight over the mold, or cell by cell with the least shear (Krogh et al. 2021,
//! KinDrape). The result is X*(u, v), the place where each point of the fabric should end.
//!
//! Fabric coordinates u and v are metres of fabric along the two fibre directions.
//! Arrays hold node [i, j] at j·nu + i, and the cell whose lowest node is [i, j] at j·(nu − 1) + i.
//!
//! The net's error falls with the square of the mesh width: between two nodes the fabric is taken for
//! the straightest line on the mold, but fibres turn sideways where the shear changes along them.

mod build;
mod edge;
mod generators;
mod layup;
mod meet;
mod missing;
mod place;
mod report;
mod shear;
mod surface_point;
mod tuning;

pub use edge::EdgeRule;
pub use layup::{Generators, Layup, LayupError};
pub use missing::{Missing, Reason};
pub use report::Report;
pub use shear::CellShear;

use crate::mold::Mold;
use build::Build;
use surface_point::{ExtendedSurface, SurfacePoint};

/// A ply draped as a pin-jointed net.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Net {
    /// The input.
    pub layup: Layup,
    /// Place of each node (m); none where it has no place on the mold.
    pub nodes: Vec<Option<[f64; 3]>>,
    /// The nodes without a place, those closest to the seed first.
    pub missing: Vec<Missing>,
    /// Shear of each cell whose four nodes are placed.
    pub shear: Vec<Option<CellShear>>,
    /// The net in a few numbers.
    pub report: Report,
    /// Nodes beyond the mold's boundary included.
    #[cfg_attr(feature = "serde", serde(skip))]
    points: Vec<Option<SurfacePoint>>,
}

impl Net {
    /// Drapes a ply on a mold. Nodes that find no place are [`Net::missing`], not an error.
    ///
    /// # Errors
    /// [`LayupError`] if no net can be begun.
    pub fn drape(mold: &Mold, layup: Layup) -> Result<Self, LayupError> {
        layup.check(mold)?;
        let [nu, nv] = layup.nodes;
        let mut build = Build {
            layup: &layup,
            surface: ExtendedSurface::new(mold),
            points: vec![None; nu * nv],
            folds: Vec::new(),
        };
        build.run()?;

        let on_mold = |point: &&SurfacePoint| point.beyond == 0.0;
        let nodes =
            build.points.iter().map(|s| s.as_ref().filter(on_mold).map(|s| s.point)).collect();
        let mut missing: Vec<Missing> = (0..nu * nv)
            .filter_map(|n| {
                let (reason, near, beyond) = build.reason(n)?;
                Some(Missing { node: [n % nu, n / nu], reason, near, beyond })
            })
            .collect();
        let [i, j] = layup.seed;
        missing.sort_by_key(|m| m.node[0].abs_diff(i) + m.node[1].abs_diff(j));
        let closest_points = build.surface.closest_points();
        let points = build.points;

        let at = |i: usize, j: usize| points[j * nu + i].as_ref().filter(on_mold);
        let mut shear = Vec::with_capacity((nu - 1) * (nv - 1));
        for j in 0..nv - 1 {
            for i in 0..nu - 1 {
                let ring = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                shear.push(match ring {
                    [Some(a), Some(b), Some(c), Some(d)] => {
                        Some(CellShear::of([a, b, c, d], layup.edges))
                    }
                    _ => None,
                });
            }
        }
        let report = Report::new(&layup, &points, &shear, &missing, closest_points);
        Ok(Net { layup, nodes, missing, shear, report, points })
    }

    /// The node at grid indices `[i, j]` (m), if it has a place.
    #[must_use]
    pub fn node(&self, [i, j]: [usize; 2]) -> Option<[f64; 3]> {
        let [nu, nv] = self.layup.nodes;
        (i < nu && j < nv).then(|| self.nodes[j * nu + i])?
    }

    /// The place of a fabric point on the mold (m): of a node, or between nodes as [`Net::place`] has it.
    #[must_use]
    pub fn place_or_node(&self, mold: &Mold, uv: [f64; 2]) -> Option<[f64; 3]> {
        match self.layup.node(uv) {
            Some(node) => self.node(node),
            None => self.place(mold, uv),
        }
    }

    /// Shear of the cell whose lowest node is `[i, j]`.
    #[must_use]
    pub fn cell_shear(&self, [i, j]: [usize; 2]) -> Option<CellShear> {
        let [nu, nv] = self.layup.nodes;
        (i + 1 < nu && j + 1 < nv).then(|| self.shear[j * (nu - 1) + i])?
    }
}
