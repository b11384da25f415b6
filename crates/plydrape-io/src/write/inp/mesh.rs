//! The flat ply in quadratic shells of eight nodes, a grid of squares or nearly so.
//!
//! Nodes lie on a grid of half an element's side, without the middles of the elements: a row through corners has
//! `2n+1` nodes, a row between them `n+1`. Numbers count from 1, along u first. A side of an element is a whole part of
//! the cell's, so that every gripper has a node of its own.

use plydrape::ply::{Grid, GripperId};

/// Side of an element that is aimed at (m). Half of it changes the sag of the paper's ply by one percent.
const SIDE: f64 = 0.010;
/// Fewest elements on the side of a cell.
const FEWEST: usize = 4;
/// Most elements of a ply, short of [`FEWEST`] in each cell.
const MOST: f64 = 20_000.0;

/// The flat ply in elements.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Mesh {
    grid: Grid,
    /// Elements on the sides of a cell, along u and v; of a strip, across it.
    per_cell: [usize; 2],
    /// Elements on the sides of the ply, along u and v.
    pub count: [usize; 2],
    /// Sides of an element (m).
    pub side: [f64; 2],
}

impl Mesh {
    /// Elements of about 10 mm, or larger where the ply would have more than 20 000.
    pub fn new(grid: Grid, cell: [f64; 2]) -> Mesh {
        // a strip is one cell wide
        let cells = [grid.nu.saturating_sub(1).max(1), grid.nv.saturating_sub(1).max(1)];
        let area = (0..2).map(|c| cells[c] as f64 * cell[c]).product::<f64>();
        let aim = SIDE.max((area / MOST).sqrt());
        // `as` saturates: a cell of a kilometer has as many elements as a large one
        let per_cell = cell.map(|side| ((side / aim).round() as usize).clamp(FEWEST, 1000));
        let count = [0, 1].map(|c| cells[c] * per_cell[c]);
        Mesh { grid, per_cell, count, side: [0, 1].map(|c| cell[c] / per_cell[c] as f64) }
    }

    /// Whether the ply is a strip with one line of grippers.
    pub fn strip(&self) -> bool {
        self.grid.nv == 1
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        let [n, m] = self.count;
        (m + 1) * (2 * n + 1) + m * (n + 1)
    }

    /// Fabric coordinates (m) of all nodes in the order of their numbers. A strip lies on both sides of v = 0.
    pub fn places(&self) -> impl Iterator<Item = [f64; 2]> {
        let [n, m] = self.count;
        let low = if self.strip() { -0.5 * m as f64 * self.side[1] } else { 0.0 };
        let rows =
            (0..=2 * m).flat_map(move |j| (0..=2 * n).step_by(1 + j % 2).map(move |i| [i, j]));
        let side = self.side;
        rows.map(move |[i, j]| [0.5 * i as f64 * side[0], low + 0.5 * j as f64 * side[1]])
    }

    /// Number of the node at a place of the half-element grid that has one: not both odd.
    fn node(&self, [i, j]: [usize; 2]) -> usize {
        let n = self.count[0];
        let rows = (j / 2) * (3 * n + 2);
        1 + rows + if j % 2 == 0 { i } else { 2 * n + 1 + i / 2 }
    }

    /// Nodes of the elements in their order: corners counterclockwise about u × v, then the middles of the sides.
    pub fn elements(&self) -> impl Iterator<Item = [usize; 8]> {
        const RING: [[usize; 2]; 8] =
            [[0, 0], [2, 0], [2, 2], [0, 2], [1, 0], [2, 1], [1, 2], [0, 1]];
        let [n, m] = self.count;
        let corners = (0..m).flat_map(move |j| (0..n).map(move |i| [2 * i, 2 * j]));
        corners.map(|[i, j]| RING.map(|[a, b]| self.node([i + a, j + b])))
    }

    /// Nodes that a gripper holds: one, or of a strip the whole line across it.
    pub fn gripper(&self, [i, j]: GripperId) -> Vec<usize> {
        let at = 2 * i * self.per_cell[0];
        if self.strip() {
            (0..=2 * self.count[1]).map(|j| self.node([at, j])).collect()
        } else {
            vec![self.node([at, 2 * j * self.per_cell[1]])]
        }
    }

    /// The node in the middle of the edge from a gripper to the next one along u or v, if there is one.
    pub fn middle(&self, [i, j]: GripperId, along: usize) -> Option<usize> {
        let last = [self.grid.nu, self.grid.nv].map(|n| n.saturating_sub(1));
        if [i, j][along] >= last[along] {
            return None;
        }
        let mut at = [2 * i * self.per_cell[0], 2 * j * self.per_cell[1]];
        if self.strip() {
            at[1] = self.count[1] - self.count[1] % 2;
        }
        at[along] += self.per_cell[along];
        Some(self.node(at))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    fn plies() -> [Mesh; 3] {
        let ply = |nu, nv, cell| Mesh::new(Grid { nu, nv }, cell);
        [ply(4, 2, [0.1, 0.1]), ply(3, 4, [0.05, 0.083]), ply(2, 1, [0.1, 0.07])]
    }

    /// 4 × 2 grippers on cells of 100 mm: 30 × 10 squares of 10 mm, and the sides and middles by Euler's formula.
    #[test]
    fn the_paper_s_ply_has_elements_of_ten_millimeters() {
        let [mesh, ..] = plies();
        assert_eq!(mesh.count, [30, 10]);
        assert!(mesh.side.iter().all(|side| (side - 0.01).abs() < 1e-15));
        let (corners, sides) = (31 * 11, 30 * 11 + 31 * 10);
        assert_eq!(mesh.nodes(), corners + sides);
    }

    /// Numbers count the places, every node belongs to an element, and every element is a rectangle with nodes in the
    /// middles of its sides, seen counterclockwise.
    #[test]
    fn elements_are_rectangles_that_use_every_node() {
        for mesh in plies() {
            let places: Vec<_> = mesh.places().collect();
            assert_eq!(places.len(), mesh.nodes());
            let mut used = BTreeSet::new();
            let [a, b] = mesh.side;
            for nodes in mesh.elements() {
                used.extend(nodes);
                let at = nodes.map(|n| places[n - 1]);
                let [u, v] = at[0];
                let ring = [[0., 0.], [a, 0.], [a, b], [0., b]];
                let sides = [[a / 2., 0.], [a, b / 2.], [a / 2., b], [0., b / 2.]];
                for (found, due) in at.iter().zip(ring.iter().chain(&sides)) {
                    assert!((found[0] - u - due[0]).abs() + (found[1] - v - due[1]).abs() < 1e-12);
                }
            }
            assert!(used.into_iter().eq(1..=mesh.nodes()));
        }
    }

    /// Gripper [i, j] holds the node at (i a, j b); a strip is held across its whole width, about v = 0.
    #[test]
    fn grippers_hold_their_fabric_points() {
        for mesh in plies() {
            let places: Vec<_> = mesh.places().collect();
            let cell = [0, 1].map(|c| mesh.side[c] * mesh.per_cell[c] as f64);
            for (i, j) in (0..mesh.grid.nu).flat_map(|i| (0..mesh.grid.nv).map(move |j| (i, j))) {
                let nodes = mesh.gripper([i, j]);
                let mean = [0, 1].map(|c| {
                    nodes.iter().map(|n| places[n - 1][c]).sum::<f64>() / nodes.len() as f64
                });
                assert!((mean[0] - i as f64 * cell[0]).abs() < 1e-12);
                assert!((mean[1] - j as f64 * cell[1]).abs() < 1e-12);
                let middle = mesh.middle([i, j], 0).map(|n| places[n - 1][0]);
                let due = (i + 1 < mesh.grid.nu).then_some((i as f64 + 0.5) * cell[0]);
                assert!(middle.zip(due).is_none_or(|(m, d)| (m - d).abs() < 1e-12));
                assert_eq!(middle.is_some(), due.is_some());
            }
        }
        let [.., strip] = plies();
        assert_eq!(strip.gripper([1, 0]).len(), 2 * strip.count[1] + 1);
    }

    /// 400 grippers would make 36 100 elements of 10 mm: they become larger instead.
    #[test]
    fn a_large_ply_has_larger_elements() {
        let large = Mesh::new(Grid { nu: 20, nv: 20 }, [0.1, 0.1]);
        assert!(large.count[0] * large.count[1] <= 20_000 && large.side[0] > 0.01);
    }
}
