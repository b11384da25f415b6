//! The flat ply in quadratic shells of eight nodes: rectangles along its fibers, squares or nearly so.
//!
//! Corners of elements are where lines along u and along v cross, and every gripper is on lines of both. Between
//! the grippers of an array the lines divide each cell evenly, and the elements are the rectangle of all cells. A ply that is cut has
//! the elements of which half or more is ply, and those that grippers hold. Nodes lie on a grid of half an element's side, without the middles
//! of the elements. Numbers count from 1, along u first.

use plydrape::ply::{Outline, Ply};
use plydrape::sheet::fabric::lines;

/// Elements on the shorter side of a cell that are aimed at. Twice as many change the sag of the paper's ply by one percent.
const AIM: f64 = 10.0;
/// Fewest elements on the side of a cell.
const FEWEST: usize = 4;
/// Most elements of a ply, short of [`FEWEST`] in each cell.
const MOST: f64 = 20_000.0;
/// Least share of an element that is ply, where a gripper holds it.
const LEAST: f64 = 0.05;
/// Nodes of an element in the grid, from its lowest corner.
const RING: [[usize; 2]; 8] = [[0, 0], [2, 0], [2, 2], [0, 2], [1, 0], [2, 1], [1, 2], [0, 1]];

/// The flat ply in elements.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Mesh {
    /// Coordinates (m) of the nodes' grid along u and along v: lines of corners, and the middles between them.
    grid: [Vec<f64>; 2],
    /// Number of the node at each point of this grid, those along u fastest; none where there is no node.
    numbers: Vec<Option<usize>>,
    /// Lowest corner of each element in this grid.
    corners: Vec<[usize; 2]>,
    /// Whether it is a strip with one line of grippers, which hold it across its whole width.
    pub strip: bool,
    /// Longest sides of an element (m).
    pub side: [f64; 2],
}

impl Mesh {
    /// Elements of about a tenth of the shorter side of a cell, or larger where the ply would have more than 20 000.
    pub fn new(ply: &Ply) -> Mesh {
        match &ply.cut {
            None => Mesh::between_grippers(ply),
            Some(cut) => Mesh::within(ply, &cut.outline),
        }
    }

    /// All of the rectangle between the grippers of an array.
    fn between_grippers(ply: &Ply) -> Mesh {
        // a strip is one cell wide
        let cells = [ply.grid.nu, ply.grid.nv].map(|grippers| grippers.saturating_sub(1).max(1));
        let area = (0..2).map(|c| cells[c] as f64 * ply.cell[c]).product::<f64>();
        let aim = (ply.shorter_side() / AIM).max((area / MOST).sqrt());
        // `as` saturates: a cell of a kilometer has as many elements as a large one
        let parts = ply.cell.map(|side| ((side / aim).round() as usize).clamp(FEWEST, 1000));
        let strip = ply.grid.nv <= 1;
        let along = [0, 1].map(|c| {
            let (count, side) = (cells[c] * parts[c], ply.cell[c] / parts[c] as f64);
            let low = if strip && c == 1 { -0.5 * ply.cell[c] } else { 0.0 };
            (0..=count).map(|n| low + n as f64 * side).collect()
        });
        Mesh::between_lines(along, strip, |_, _| true)
    }

    /// What is within an outline.
    fn within(ply: &Ply, outline: &Outline) -> Mesh {
        let [low, high] = outline.bounds();
        let side = ply.shorter_side();
        let aim = (side / AIM).max((outline.area() / MOST).sqrt()).min(side / FEWEST as f64);
        let grippers: Vec<[f64; 2]> = (0..ply.grippers()).map(|n| ply.place(n)).collect();
        let along = [0, 1].map(|c| {
            let places = grippers.iter().map(|place| place[c]);
            lines(places.chain([low[c], high[c]]).collect(), aim)
        });
        let close = 1e-6 * aim;
        let touches = |at: f64, low: f64, high: f64| at > low - close && at < high + close;
        Mesh::between_lines(along, false, |low, high| {
            let is_corner = |place: &[f64; 2]| (0..2).all(|c| touches(place[c], low[c], high[c]));
            let held = grippers.iter().any(is_corner);
            let whole = (high[0] - low[0]) * (high[1] - low[1]);
            outline.area_in(low, high) >= if held { LEAST } else { 0.5 } * whole
        })
    }

    /// The rectangles between lines along u and along v (m) that are `kept`, by their lowest and highest corner.
    fn between_lines(
        along: [Vec<f64>; 2],
        strip: bool,
        kept: impl Fn([f64; 2], [f64; 2]) -> bool,
    ) -> Mesh {
        let grid = along.each_ref().map(|lines| {
            let mut halves: Vec<f64> =
                lines.windows(2).flat_map(|pair| [pair[0], 0.5 * (pair[0] + pair[1])]).collect();
            halves.extend(lines.last());
            halves
        });
        let [n, m] = along.each_ref().map(|lines| lines.len() - 1);
        let all = (0..m).flat_map(|j| (0..n).map(move |i| [i, j]));
        let elements = all.filter(|[i, j]| {
            kept([along[0][*i], along[1][*j]], [along[0][i + 1], along[1][j + 1]])
        });
        let corners: Vec<[usize; 2]> = elements.map(|[i, j]| [2 * i, 2 * j]).collect();
        let mut numbers = vec![None; grid[0].len() * grid[1].len()];
        for [i, j] in &corners {
            for [a, b] in RING {
                numbers[(j + b) * grid[0].len() + i + a] = Some(0);
            }
        }
        (1..).zip(numbers.iter_mut().flatten()).for_each(|(number, node)| *node = number);
        let side =
            along.map(|lines| lines.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max));
        Mesh { grid, numbers, corners, strip, side }
    }

    /// Number of elements.
    pub fn count(&self) -> usize {
        self.corners.len()
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.numbers.iter().flatten().count()
    }

    /// Fabric coordinates (m) of all nodes in the order of their numbers. A strip lies on both sides of v = 0.
    pub fn places(&self) -> impl Iterator<Item = [f64; 2]> {
        let [u, v] = &self.grid;
        let points = v.iter().flat_map(move |v| u.iter().map(move |u| [*u, *v]));
        points.zip(&self.numbers).filter_map(|(place, number)| number.map(|_| place))
    }

    /// Number of the node at a point of the grid that has one.
    fn node(&self, [i, j]: [usize; 2]) -> Option<usize> {
        self.numbers[j * self.grid[0].len() + i]
    }

    /// The point of the grid nearest to a fabric point (m).
    fn nearest(&self, place: [f64; 2]) -> [usize; 2] {
        [0, 1].map(|c| {
            let distance = |n: &usize| (self.grid[c][*n] - place[c]).abs();
            let points = 0..self.grid[c].len();
            points.min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or_default()
        })
    }

    /// Nodes of the elements in their order: corners counterclockwise about u × v, then the middles of the sides.
    pub fn elements(&self) -> impl Iterator<Item = [usize; 8]> {
        let node = |at| self.node(at).unwrap_or_default();
        self.corners.iter().map(move |[i, j]| RING.map(|[a, b]| node([i + a, j + b])))
    }

    /// Nodes that a gripper at a fabric point (m) holds: one, or of a strip the whole line across it.
    pub fn gripper(&self, place: [f64; 2]) -> Vec<usize> {
        let [i, j] = self.nearest(place);
        let rows = if self.strip { 0..self.grid[1].len() } else { j..j + 1 };
        rows.filter_map(|j| self.node([i, j])).collect()
    }

    /// The node in the middle between two neighboring grippers (m); none in the middle of an element.
    pub fn middle(&self, [a, b]: [[f64; 2]; 2]) -> Option<usize> {
        let [i, mut j] = self.nearest([0, 1].map(|c| 0.5 * (a[c] + b[c])));
        if self.strip {
            j -= j % 2;
        }
        self.node([i, j])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample;
    use plydrape::ply::{Cut, Grid, Held};
    use std::collections::BTreeSet;

    fn ply(nu: usize, nv: usize, cell: [f64; 2]) -> Ply {
        Ply::of_array(Grid { nu, nv }, cell, sample::hanging(2, 2).scene.ply.material)
    }

    fn plies() -> [Ply; 3] {
        [ply(4, 2, [0.1, 0.1]), ply(3, 4, [0.05, 0.083]), ply(2, 1, [0.1, 0.07])]
    }

    /// 4 × 2 grippers, whatever their pitch: 30 × 10 squares of a tenth of it, and the sides and middles by Euler's formula.
    #[test]
    fn elements_are_a_tenth_of_the_pitch() {
        for pitch in [0.1, 0.004, 3.0] {
            let mesh = Mesh::new(&ply(4, 2, [pitch; 2]));
            assert_eq!(mesh.count(), 300);
            assert!(mesh.side.iter().all(|side| (side - 0.1 * pitch).abs() < 1e-12 * pitch));
        }
        let [mesh, ..] = plies().map(|ply| Mesh::new(&ply));
        let (corners, sides) = (31 * 11, 30 * 11 + 31 * 10);
        assert_eq!(mesh.nodes(), corners + sides);
    }

    /// Numbers count the places, every node belongs to an element, and every element is a rectangle with nodes in the
    /// middles of its sides, seen counterclockwise.
    #[test]
    fn elements_are_rectangles_that_use_every_node() {
        for mesh in plies().map(|ply| Mesh::new(&ply)) {
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

    /// A gripper holds the node at its fabric point, and a strip across its whole width, about v = 0; middles are halfway.
    #[test]
    fn grippers_hold_their_fabric_points() {
        for ply in plies() {
            let mesh = Mesh::new(&ply);
            let places: Vec<_> = mesh.places().collect();
            for n in 0..ply.grippers() {
                let place = ply.place(n);
                let nodes = mesh.gripper(place);
                let mean = [0, 1].map(|c| {
                    nodes.iter().map(|n| places[n - 1][c]).sum::<f64>() / nodes.len() as f64
                });
                assert!((mean[0] - place[0]).hypot(mean[1] - place[1]) < 1e-12);
                let next = [place[0] + ply.cell[0], place[1]];
                if n + 1 < ply.grid.nu {
                    let middle = places[mesh.middle([place, next]).unwrap() - 1];
                    assert!((middle[0] - 0.5 * (place[0] + next[0])).abs() < 1e-12);
                }
            }
        }
        let strip = Mesh::new(&plies()[2]);
        assert_eq!(strip.gripper([0.1, 0.0]).len(), 2 * 10 + 1);
    }

    /// 400 grippers would make 36 100 elements of 10 mm: they become larger instead.
    #[test]
    fn a_large_ply_has_larger_elements() {
        let large = Mesh::new(&ply(20, 20, [0.1, 0.1]));
        assert!(large.count() <= 20_000 && large.side[0] > 0.01);
    }

    /// Of a ply with a cut corner and a hole, held off the lines of an array, the elements leave both out, cover the ply to half an element
    /// at its boundary, use every node, and every gripper has a node of its own.
    #[test]
    fn a_cut_ply_has_elements_where_it_is() {
        let outer = vec![[0.0, 0.0], [0.2, 0.0], [0.2, 0.2], [0.05, 0.2], [0.0, 0.15]];
        let hole = vec![[0.02, 0.02], [0.02, 0.06], [0.06, 0.06], [0.06, 0.02]];
        let outline = Outline::new(outer, vec![hole]).unwrap();
        let area = outline.area();
        let places = [[0.013, 0.1], [0.187, 0.011], [0.15, 0.183], [0.2, 0.2]];
        let held = places.iter().enumerate().map(|(n, place)| Held { id: [n, 0], place: *place });
        let held = held.collect();
        let mut ply = ply(2, 2, [0.1, 0.1]);
        ply.grid = Grid::NONE;
        ply.cut = Some(Cut { outline, held, angle: 0.0, turn: 0.0, origin: [0.0; 2] });
        let mesh = Mesh::new(&ply);
        assert!(mesh.side.iter().all(|side| *side < 0.01 + 1e-12));
        let nodes: Vec<_> = mesh.places().collect();
        let mut used = BTreeSet::new();
        let mut covered = 0.0;
        for element in mesh.elements() {
            used.extend(element);
            let [a, _, c, ..] = element.map(|n| nodes[n - 1]);
            let [u, v] = [0, 1].map(|n| 0.5 * (a[n] + c[n]));
            covered += (c[0] - a[0]) * (c[1] - a[1]);
            assert!(!((0.02..0.06).contains(&u) && (0.02..0.06).contains(&v)), "{u} {v}");
            assert!(v < 0.15 + u + 1e-9, "{u} {v}");
        }
        assert!(used.into_iter().eq(1..=nodes.len()));
        assert!((covered - area).abs() < 5e-4, "{covered} {area}");
        for place in places {
            let [node] = mesh.gripper(place)[..] else { panic!("{place:?}") };
            let [u, v] = nodes[node - 1];
            assert!((u - place[0]).hypot(v - place[1]) < 1e-12);
        }
    }
}
