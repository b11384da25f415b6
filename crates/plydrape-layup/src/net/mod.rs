//! The ideal drape: a pin-jointed net of warp and weft on the mold.
//!
//! Fibers do not stretch, cells shear freely, and every node lies on the mold (Mack and Taylor 1956). So
//! two lines of nodes determine all others: a node is the common end of two known edges of fabric. The
//! generators run straight over the mold, or cell by cell with the least shear (Krogh et al. 2021,
//! KinDrape). The result is X*(u, v), the place where each point of the fabric should end.
//!
//! Fabric coordinates u and v are meters of fabric along the two fiber directions.
//! Arrays hold node [i, j] at j·nu + i, and the cell whose lowest node is [i, j] at j·(nu − 1) + i.
//!
//! The net's error falls with the square of the mesh width: between two nodes the fabric is taken for
//! the straightest line on the mold, but fibers turn sideways where the shear changes along them.

mod boundary;
#[cfg(test)]
mod boundary_tests;
mod build;
mod coverage;
mod edge;
mod generators;
mod meet;
mod missing;
mod place;
mod placement;
mod region;
mod report;
mod seeds;
mod sharp_edges;
mod shear;
mod surface_point;
mod trim;
mod tuning;

pub use boundary::{Boundary, BoundaryLine, Farthest, LeftOut, PlyPoint};
pub use coverage::Coverage;
pub use edge::EdgeRule;
pub use missing::{Missing, Reason};
pub use placement::{Generators, Placement};
pub use report::Report;
pub use seeds::{Choice, Free, Seeds};
pub use sharp_edges::SharpEdges;
pub use shear::CellShear;
pub use trim::{TargetBoundary, Trim, TrimPlace};

use crate::Error;
use crate::mold::Mold;
use crate::ply::Outline;
use build::Build;
use surface_point::{ExtendedSurface, SurfacePoint};

/// A ply draped as a pin-jointed net.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Net {
    /// The input.
    pub placement: Placement,
    /// The outline of a ply that is cut; `None` where the ply is all that the net covers.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub outline: Option<Outline>,
    /// Place of each node (m); `None` where it has no place on the mold.
    pub nodes: Vec<Option<[f64; 3]>>,
    /// The nodes of the ply without a place, those closest to the seed first.
    pub missing: Vec<Missing>,
    /// Shear of each cell that counts and whose nodes are placed; beyond the mold none of the ply's nodes may be.
    pub shear: Vec<Option<CellShear>>,
    /// The net in a few numbers: of the ply, not of what the net covers beside it.
    pub report: Report,
    /// Nodes beyond the mold's boundary included.
    points: Vec<Option<SurfacePoint>>,
}

impl Net {
    /// Drapes a ply on a mold that is all that the net covers. Nodes that find no place are [`Net::missing`], not an error.
    ///
    /// # Errors
    /// The errors of a placement with which no net can be begun: [`Error::NetNoNodes`], [`Error::NetMeshWidth`], [`Error::NetSeedNode`],
    /// [`Error::NetSeedPlace`], [`Error::NetUpright`] or [`Error::NetShear`].
    pub fn drape(mold: &Mold, placement: Placement) -> Result<Self, Error> {
        Net::drape_cut(mold, placement, None)
    }

    /// Drapes a ply that is cut, if it has an outline: only what is on the ply counts, see [`Coverage`].
    ///
    /// # Errors
    /// The errors of [`Net::drape`].
    pub fn drape_cut(
        mold: &Mold,
        placement: Placement,
        outline: Option<Outline>,
    ) -> Result<Self, Error> {
        let coverage = Coverage::new(&placement, outline.as_ref());
        let net = Net::drape_covered(mold, placement, &coverage)?;
        Ok(Net { outline, ..net })
    }

    /// Drapes a ply of which the net's nodes and cells are known.
    fn drape_covered(
        mold: &Mold,
        placement: Placement,
        coverage: &Coverage,
    ) -> Result<Self, Error> {
        placement.check(mold)?;
        let [nu, nv] = placement.nodes;
        let mut build = Build {
            placement: &placement,
            surface: ExtendedSurface::new(mold),
            points: vec![None; nu * nv],
            folds: Vec::new(),
        };
        build.run()?;

        // nodes without a place on the mold, those next to the seed first: the others follow from them
        let on_mold = |point: &&SurfacePoint| point.beyond == 0.0;
        let nodes =
            build.points.iter().map(|s| s.as_ref().filter(on_mold).map(|s| s.point)).collect();
        let mut missing: Vec<Missing> = (0..nu * nv)
            .filter(|n| coverage.node([n % nu, n / nu]))
            .filter_map(|n| {
                let (reason, near, beyond) = build.reason(n)?;
                Some(Missing { node: [n % nu, n / nu], reason, near, beyond })
            })
            .collect();
        let [i, j] = placement.seed;
        missing.sort_by_key(|m| m.node[0].abs_diff(i) + m.node[1].abs_diff(j));
        let closest_points = build.surface.closest_points();
        let points = build.points;

        // beside the ply a node may lie beyond the mold
        let corner = |i: usize, j: usize| {
            points[j * nu + i].as_ref().filter(|s| on_mold(s) || !coverage.node([i, j]))
        };
        let mut shear = Vec::with_capacity((nu - 1) * (nv - 1));
        for j in 0..nv - 1 {
            for i in 0..nu - 1 {
                let ring = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
                shear.push(match ring {
                    [Some(a), Some(b), Some(c), Some(d)] if coverage.counts([i, j]) => {
                        Some(CellShear::new([a, b, c, d], placement.edges))
                    }
                    _ => None,
                });
            }
        }
        // shear of the whole cells, and the counts of what is missing
        let report = Report::new(&placement, coverage, &points, &shear, &missing, closest_points);
        Ok(Net { placement, outline: None, nodes, missing, shear, report, points })
    }

    /// Which nodes and cells are on the ply.
    #[must_use]
    pub fn coverage(&self) -> Coverage {
        Coverage::new(&self.placement, self.outline.as_ref())
    }

    /// The node at grid indices `[i, j]` (m), if it has a place.
    #[must_use]
    pub fn node(&self, [i, j]: [usize; 2]) -> Option<[f64; 3]> {
        let [nu, nv] = self.placement.nodes;
        (i < nu && j < nv).then(|| self.nodes[j * nu + i])?
    }

    /// The place of a fabric point on the mold (m): of a node, or between nodes as [`Net::place`] has it.
    #[must_use]
    pub fn place_or_node(&self, mold: &Mold, uv: [f64; 2]) -> Option<[f64; 3]> {
        match self.placement.node(uv) {
            Some(node) => self.node(node),
            None => self.place(mold, uv),
        }
    }

    /// Shear of the cell whose lowest node is `[i, j]`.
    #[must_use]
    pub fn cell_shear(&self, [i, j]: [usize; 2]) -> Option<CellShear> {
        let [nu, nv] = self.placement.nodes;
        (i + 1 < nu && j + 1 < nv).then(|| self.shear[j * (nu - 1) + i])?
    }
}
