//! A net in a few numbers.

use super::coverage::Coverage;
use super::missing::{Missing, Reason};
use super::placement::Placement;
use super::shear::CellShear;
use super::surface_point::SurfacePoint;

/// A net in a few numbers.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Report {
    /// Nodes of the ply with a place on the mold.
    pub placed: usize,
    /// Nodes beyond the mold's boundary.
    pub off_mold: usize,
    /// Nodes where the ply folds.
    pub folded: usize,
    /// Nodes behind a fold.
    pub unreached: usize,
    /// Of each reason that occurs, the missing node closest to the seed.
    pub first: Vec<Missing>,
    /// Largest error of an edge between placed nodes, measured by the placement's rule (m).
    pub largest_edge_error: f64,
    /// Largest magnitude of a cell's shear (rad) and its cell; `None` without whole cells.
    pub largest_shear: Option<(f64, [usize; 2])>,
    /// Mean magnitude of the cells' shear (rad); 0 without whole cells.
    pub mean_shear: f64,
    /// Number of closest points that were computed.
    pub closest_points: usize,
}

impl Report {
    pub(super) fn new(
        placement: &Placement,
        coverage: &Coverage,
        points: &[Option<SurfacePoint>],
        shear: &[Option<CellShear>],
        missing: &[Missing],
        closest_points: usize,
    ) -> Self {
        let [nu, nv] = placement.nodes;
        // the first missing node of each reason stands for all of it
        let count = |reason: Reason| missing.iter().filter(|m| m.reason == reason).count();
        let first = [Reason::OffMold, Reason::Folded, Reason::Unreached]
            .iter()
            .filter_map(|reason| missing.iter().find(|m| m.reason == *reason).cloned())
            .collect();

        // by how much edges of the net differ from the mesh
        let node = |i: usize, j: usize| {
            if i < nu && j < nv { points[j * nu + i].filter(|s| s.beyond == 0.0) } else { None }
        };
        let error = |a: Option<SurfacePoint>, b: Option<SurfacePoint>, width: f64| match (a, b) {
            (Some(a), Some(b)) => (placement.edges.length(&a, &b) - width).abs(),
            _ => 0.0,
        };
        let mut largest_edge_error = 0.0_f64;
        for j in 0..nv {
            for i in 0..nu {
                let along_u = error(node(i, j), node(i + 1, j), placement.mesh[0]);
                let along_v = error(node(i, j), node(i, j + 1), placement.mesh[1]);
                largest_edge_error = largest_edge_error.max(along_u).max(along_v);
            }
        }

        // shear of the cells that are whole
        let on_ply = (0..nu * nv).filter(|n| coverage.node([n % nu, n / nu])).count();
        let whole = || shear.iter().enumerate().filter_map(|(n, s)| Some((n, (*s)?.magnitude)));
        let largest_shear = whole()
            .max_by(|a, b| a.1.total_cmp(&b.1))
            .map(|(n, magnitude)| (magnitude, [n % (nu - 1), n / (nu - 1)]));
        let cells = whole().count();
        let mean_shear = whole().map(|(_, s)| s).sum::<f64>() / cells.max(1) as f64;
        Report {
            placed: on_ply - missing.len(),
            off_mold: count(Reason::OffMold),
            folded: count(Reason::Folded),
            unreached: count(Reason::Unreached),
            first,
            largest_edge_error,
            largest_shear,
            mean_shear,
            closest_points,
        }
    }
}
