//! Which nodes and cells of a net are on the ply.
//!
//! The net of a ply that is cut covers the box around its outline. A node counts where it is on the ply, its boundary
//! included; a cell counts where half of it or more is.

use super::placement::Placement;
use super::tuning::TUNING;
use crate::ply::Outline;

/// Which nodes and cells of a net are on the ply.
#[derive(Debug, Clone, PartialEq)]
pub struct Coverage {
    nodes: [usize; 2],
    /// Whether node [i, j], at j·nu + i, is on the ply; empty where all are.
    on_ply: Vec<bool>,
    /// Share of cell [i, j] that is on the ply; empty where all are whole.
    share: Vec<f64>,
}

impl Coverage {
    /// The nodes and cells of a net that are within an outline, or all of them without one.
    #[must_use]
    pub fn new(placement: &Placement, outline: Option<&Outline>) -> Self {
        let nodes = placement.nodes;
        let Some(outline) = outline.filter(|_| nodes.iter().all(|n| *n > 1)) else {
            return Coverage { nodes, on_ply: Vec::new(), share: Vec::new() };
        };
        let [nu, nv] = nodes;
        let cells = [nu - 1, nv - 1];
        let cut = cut_cells(placement, outline);
        let mesh = placement.mesh[0].min(placement.mesh[1]);
        let area = placement.mesh[0] * placement.mesh[1];

        let mut share = vec![0.0; cells[0] * cells[1]];
        for j in 0..cells[1] {
            for i in 0..cells[0] {
                let n = j * cells[0] + i;
                let (low, high) = (placement.fabric([i, j]), placement.fabric([i + 1, j + 1]));
                share[n] = if cut[n] {
                    (outline.area_in(low, high) / area).min(1.0)
                } else if i > 0 && !cut[n - 1] {
                    // no line of the outline between them
                    share[n - 1]
                } else {
                    let middle = [0, 1].map(|c| 0.5 * (low[c] + high[c]));
                    if outline.contains(middle) { 1.0 } else { 0.0 }
                };
            }
        }

        let on_ply = (0..nu * nv).map(|n| {
            let [i, j] = [n % nu, n / nu];
            // a cell that no line crosses says it of its corners
            for [a, b] in [[0, 0], [1, 0], [0, 1], [1, 1]] {
                let (Some(k), Some(m)) = (i.checked_sub(a), j.checked_sub(b)) else { continue };
                if k < cells[0] && m < cells[1] && !cut[m * cells[0] + k] {
                    return share[m * cells[0] + k] > 0.5;
                }
            }
            outline.depth(placement.fabric([i, j])) >= -TUNING.boundary_rounding * mesh
        });
        let on_ply = on_ply.collect();
        Coverage { nodes, on_ply, share }
    }

    /// Whether a node is on the ply, or on its boundary.
    #[must_use]
    pub fn node(&self, [i, j]: [usize; 2]) -> bool {
        self.on_ply.is_empty() || self.on_ply[j * self.nodes[0] + i]
    }

    /// The share of a cell that is on the ply, from 0 to 1.
    #[must_use]
    pub fn share(&self, [i, j]: [usize; 2]) -> f64 {
        if self.share.is_empty() { 1.0 } else { self.share[j * (self.nodes[0] - 1) + i] }
    }

    /// Whether a cell counts: half of it or more is on the ply.
    #[must_use]
    pub fn counts(&self, cell: [usize; 2]) -> bool {
        self.share(cell) >= TUNING.counted_share
    }
}

/// The cells that a line of the outline may cross or touch: those in the box around it.
fn cut_cells(placement: &Placement, outline: &Outline) -> Vec<bool> {
    let cells = placement.nodes.map(|n| n - 1);
    let mut cut = vec![false; cells[0] * cells[1]];
    for [a, b] in outline.lines() {
        let [first, last]: [[usize; 2]; 2] = {
            let cell_index = |n: usize, value: f64, rounding: f64| {
                let cell = (value - placement.origin[n]) / placement.mesh[n] + rounding;
                (cell.floor().max(0.0) as usize).min(cells[n] - 1)
            };
            let low = [0, 1].map(|n| cell_index(n, a[n].min(b[n]), -TUNING.boundary_rounding));
            [low, [0, 1].map(|n| cell_index(n, a[n].max(b[n]), TUNING.boundary_rounding))]
        };
        for j in first[1]..=last[1] {
            for i in first[0]..=last[0] {
                cut[j * cells[0] + i] = true;
            }
        }
    }
    cut
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::net::{EdgeRule, Generators};

    fn placement(nodes: [usize; 2], mesh: f64) -> Placement {
        Placement {
            nodes,
            mesh: [mesh; 2],
            origin: [-0.02, 0.01],
            seed: [0, 0],
            place: [0.0; 3],
            heading: 0.0,
            shear: 0.0,
            generators: Generators::Geodesic,
            edges: EdgeRule::Along,
        }
    }

    /// A triangle with a hole: shares of cells sum to its area, and every node is on it as the outline itself says.
    #[test]
    fn shares_of_cells_sum_to_the_area_of_the_ply() {
        let hole = vec![[0.06, 0.06], [0.11, 0.06], [0.08, 0.11]];
        let outline =
            Outline::new(vec![[0.0, 0.02], [0.31, 0.05], [0.02, 0.29]], vec![hole]).unwrap();
        let placement = placement([36, 31], 0.01);
        let coverage = Coverage::new(&placement, Some(&outline));
        let mut area = 0.0;
        for j in 0..30 {
            for i in 0..35 {
                area += 1e-4 * coverage.share([i, j]);
            }
        }
        assert!((area - outline.area()).abs() < 1e-12, "{area} {}", outline.area());
        let mut on = 0;
        for n in 0..36 * 31 {
            let node = [n % 36, n / 36];
            let depth = outline.depth(placement.fabric(node));
            assert_eq!(coverage.node(node), depth > -1e-11, "{node:?} {depth}");
            on += usize::from(depth > 0.0);
        }
        assert!(on > 300);
    }

    /// A rectangle as wide as the net: everything counts, nodes on the boundary too.
    #[test]
    fn a_net_as_large_as_its_ply_is_all_on_it() {
        let placement = placement([4, 3], 0.1);
        let outline =
            Outline::rectangle(placement.fabric([0, 0]), placement.fabric([3, 2])).unwrap();
        let coverage = Coverage::new(&placement, Some(&outline));
        assert!((0..12).all(|n| coverage.node([n % 4, n / 4])));
        assert!((0..6).all(|n| coverage.counts([n % 3, n / 3])));
    }
}
