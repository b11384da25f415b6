//! The fabric in the flat: lines of nodes along warp and weft, and what joins them.
//!
//! Nodes lie where lines cross. Every gripper point, every edge of a pad and the boundary lie on lines, which are
//! evenly spaced in between. All areas and widths are tributary: half the spacing to each side, so that all of the ply
//! is there once.

use crate::ply::Outline;
use std::collections::{HashMap, HashSet};

/// A yarn segment between two neighboring nodes of a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    /// Nodes.
    pub nodes: [u32; 2],
    /// The direction along which it runs: 0 along u, 1 along v.
    pub direction: usize,
    /// Length in the flat (m).
    pub length: f64,
    /// Width of fabric that it stands for (m).
    pub width: f64,
    /// Share of that width that is ply: less than 1 where the boundary cuts the cells beside it.
    pub share: f64,
}

impl Segment {
    /// Whether half of its width or more is ply.
    #[must_use]
    pub fn is_ply(&self) -> bool {
        self.share >= 0.5
    }
}

/// A cell between four nodes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cell {
    /// Nodes at (u, v) = (0, 0), (1, 0), (1, 1) and (0, 1).
    pub nodes: [u32; 4],
    /// Area of the ply in it in the flat (m²).
    pub area: f64,
    /// Share of it that is ply: less than 1 where the boundary cuts it.
    pub share: f64,
}

impl Cell {
    /// Whether half of it or more is ply, and so its middle.
    #[must_use]
    pub fn is_ply(&self) -> bool {
        self.share >= 0.5
    }
}

/// A point of the boundary, on a side of a cell or at a corner of the outline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoundaryPoint {
    /// Fabric coordinates (m).
    pub place: [f64; 2],
    /// Nodes of its cell.
    pub nodes: [u32; 4],
    /// Their shares in it.
    pub weights: [f64; 4],
}

/// Three neighboring nodes of a line, at whose middle one the line bends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bend {
    /// Nodes.
    pub nodes: [u32; 3],
    /// The direction along which the line runs: 0 along u, 1 along v.
    pub direction: usize,
    /// Distance of the neighbors in the flat (m).
    pub spacing: [f64; 2],
    /// Width of fabric that it stands for (m).
    pub width: f64,
}

/// A ply divided by lines.
#[derive(Debug, Clone, PartialEq)]
pub struct Fabric {
    /// Fabric coordinates (u, v) of each node (m).
    pub places: Vec<[f64; 2]>,
    /// Area that each node stands for (m²).
    pub areas: Vec<f64>,
    /// Yarn segments, those along u first.
    pub segments: Vec<Segment>,
    /// Cells.
    pub cells: Vec<Cell>,
    /// Where lines bend, those along u first.
    pub bends: Vec<Bend>,
    /// Coordinates of the lines (m): `lines[0]` those at constant u, `lines[1]` those at constant v.
    pub lines: [Vec<f64>; 2],
    /// Node where lines of both directions cross, those along u fastest; `None` where there is no ply.
    crossings: Vec<Option<u32>>,
    /// Whether each node is on the ply: those of cells that the boundary cuts may be beyond it.
    pub inside: Vec<bool>,
    /// The rings of the boundary, each as points in order; none for a rectangle, whose boundary is lines of nodes.
    pub boundary: Vec<Vec<BoundaryPoint>>,
    /// Length in the flat over the difference of fabric coordinates, [`crate::Ply::length_factor`].
    pub length_factor: f64,
}

impl Fabric {
    /// A rectangle between its first and last lines; a single line along u stands for a strip of `strip` width (m).
    ///
    /// Nodes are numbered along u first.
    #[must_use]
    pub fn rectangle(lines: [Vec<f64>; 2], strip: f64) -> Self {
        let [nu, nv] = [lines[0].len(), lines[1].len()];
        let node = |i: usize, j: usize| (j * nu + i) as u32;
        let widths = [tributary(&lines[0], strip), tributary(&lines[1], strip)];

        // each node stands for the area half-way to its neighbors
        let mut places = Vec::with_capacity(nu * nv);
        let mut areas = Vec::with_capacity(nu * nv);
        for j in 0..nv {
            for i in 0..nu {
                places.push([lines[0][i], lines[1][j]]);
                areas.push(widths[0][i] * widths[1][j]);
            }
        }

        // yarns resist stretch between neighboring nodes, and bending at three nodes in a row; both for the width that a line stands
        // for
        let mut segments = Vec::new();
        let mut bends = Vec::new();
        for direction in 0..2 {
            let (along, across) = (&lines[direction], &widths[1 - direction]);
            for (line, width) in across.iter().enumerate() {
                let nth = |n: usize| if direction == 0 { node(n, line) } else { node(line, n) };
                for n in 1..along.len() {
                    let length = along[n] - along[n - 1];
                    segments.push(Segment {
                        nodes: [nth(n - 1), nth(n)],
                        direction,
                        length,
                        width: *width,
                        share: 1.0,
                    });
                }
                for n in 1..along.len().saturating_sub(1) {
                    let spacing = [along[n] - along[n - 1], along[n + 1] - along[n]];
                    let nodes = [nth(n - 1), nth(n), nth(n + 1)];
                    bends.push(Bend { nodes, direction, spacing, width: *width });
                }
            }
        }

        // the fabric shears in the cells between four nodes
        let mut cells = Vec::with_capacity(nu.saturating_sub(1) * nv.saturating_sub(1));
        for j in 1..nv {
            for i in 1..nu {
                let nodes = [node(i - 1, j - 1), node(i, j - 1), node(i, j), node(i - 1, j)];
                let area = (lines[0][i] - lines[0][i - 1]) * (lines[1][j] - lines[1][j - 1]);
                cells.push(Cell { nodes, area, share: 1.0 });
            }
        }
        let nodes = places.len();
        Fabric {
            crossings: (0..nodes as u32).map(Some).collect(),
            inside: vec![true; nodes],
            boundary: Vec::new(),
            places,
            areas,
            segments,
            cells,
            bends,
            lines,
            length_factor: 1.0,
        }
    }

    /// What is within an outline of the rectangle between its first and last lines.
    ///
    /// Cells that the boundary cuts keep their four nodes, also those beyond it, and count with the share of them that is
    /// ply: their shear with its area, the yarns along their sides with the width of what is beside them, their mass at the
    /// four nodes so that its center is where it is. So the boundary may run anywhere between the lines. Cells with less
    /// than `least` of them in the ply are left out, and their mass goes to the cells beside them.
    #[must_use]
    pub fn cut(lines: [Vec<f64>; 2], outline: &Outline, least: f64) -> Self {
        let whole = Fabric::rectangle(lines, 0.0);
        let count = whole.places.len();
        let inside_of = |cell: &Cell| {
            let [low, high] = whole.corners(cell);
            outline.area_in(low, high)
        };
        let inside: Vec<f64> = whole.cells.iter().map(inside_of).collect();
        let kept: Vec<bool> = whole
            .cells
            .iter()
            .zip(&inside)
            .map(|(cell, area)| *area > 0.0 && *area >= least * cell.area)
            .collect();
        let areas = whole.areas_within(outline, &inside, &kept);
        let segments = whole.segments_within(outline, &kept);
        let widths: HashMap<[u32; 2], f64> = segments.iter().map(|s| (s.nodes, s.width)).collect();
        let cells: Vec<Cell> = (0..inside.len())
            .filter(|n| kept[*n])
            .map(|n| (&whole.cells[n], inside[n]))
            .map(|(cell, area)| Cell { area, share: area / cell.area, ..*cell })
            .collect();

        // nodes of no cell are left out
        let mut number = vec![None; count];
        for node in cells.iter().flat_map(|cell| cell.nodes) {
            number[node as usize] = Some(0);
        }
        for (kept, own) in (0_u32..).zip(number.iter_mut().flatten()) {
            *own = kept;
        }
        let renumbered = |node: u32| number[node as usize].unwrap_or_default();
        let keep = |n: &usize| number[*n].is_some();
        // a node beyond the boundary goes on where the ply leads: it would hang down from cells that are hardly ply and shear them
        let sides: HashSet<[u32; 2]> = cells
            .iter()
            .flat_map(|Cell { nodes: [a, b, c, d], .. }| [[*a, *b], [*b, *c], [*d, *c], [*a, *d]])
            .collect();
        let leads = |[a, b, c]: [u32; 3]| sides.contains(&[a, b]) && sides.contains(&[b, c]);
        let bends = whole.bends.iter().filter(|bend| leads(bend.nodes));
        let bends = bends.map(|bend| {
            let [a, b, c] = bend.nodes;
            let width = |ends| widths.get(&ends).copied().unwrap_or_default();
            let width = width([a, b]).min(width([b, c])).max(least * bend.width);
            Bend { width, ..*bend }
        });
        let places: Vec<[f64; 2]> = (0..count).filter(keep).map(|n| whole.places[n]).collect();
        let [low, high] = outline.bounds();
        let rounding = 1e-9 * (high[0] - low[0]).max(high[1] - low[1]);
        let mut fabric = Fabric {
            areas: (0..count).filter(keep).map(|n| areas[n]).collect(),
            segments: segments
                .into_iter()
                .map(|s| Segment { nodes: s.nodes.map(renumbered), ..s })
                .collect(),
            bends: bends.map(|b| Bend { nodes: b.nodes.map(renumbered), ..b }).collect(),
            cells: cells
                .into_iter()
                .map(|c| Cell { nodes: c.nodes.map(renumbered), ..c })
                .collect(),
            inside: places.iter().map(|place| outline.depth(*place) >= -rounding).collect(),
            crossings: number,
            boundary: Vec::new(),
            places,
            lines: whole.lines,
            length_factor: 1.0,
        };
        fabric.boundary = outline.rings().map(|ring| fabric.boundary_along(ring)).collect();
        fabric
    }

    /// Lowest and highest corner of a cell of a rectangle (m).
    fn corners(&self, cell: &Cell) -> [[f64; 2]; 2] {
        [0, 2].map(|n| self.places[cell.nodes[n] as usize])
    }

    /// Area of ply (m²) that each node of this rectangle stands for, so that the center of the ply in each cell is where it is. The mass of a
    /// sliver in a cell that is not `kept` goes to the cell beside it that has the most ply; `inside` is the ply in each cell (m²).
    fn areas_within(&self, outline: &Outline, inside: &[f64], kept: &[bool]) -> Vec<f64> {
        let mut areas = vec![0.0; self.places.len()];
        let columns = self.lines[0].len() - 1;
        for (n, cell) in self.cells.iter().enumerate().filter(|(n, _)| inside[*n] > 0.0) {
            let beside = [
                (n % columns > 0).then(|| n - 1),
                ((n + 1) % columns > 0).then_some(n + 1),
                n.checked_sub(columns),
                Some(n + columns).filter(|n| *n < inside.len()),
            ];
            let most = beside.into_iter().flatten().filter(|n| kept[*n]);
            let most = most.max_by(|a, b| inside[*a].total_cmp(&inside[*b]));
            let home = if kept[n] { Some(n) } else { most };
            let Some(home) = home else { continue };
            let ([low, high], [from, to]) = (self.corners(cell), self.corners(&self.cells[home]));
            let middle = [0, 1].map(|c| 0.5 * (low[c] + high[c]));
            let center = outline.center_in(low, high).unwrap_or(middle);
            let nearest = [0, 1].map(|c| center[c].clamp(from[c], to[c]));
            let weights = bilinear(from, to, nearest);
            for (node, weight) in self.cells[home].nodes.iter().zip(weights) {
                areas[*node as usize] += weight * inside[n];
            }
        }
        areas
    }

    /// The yarns of this rectangle along the sides of cells that are `kept`, each as wide as the ply beside it in these.
    fn segments_within(&self, outline: &Outline, kept: &[bool]) -> Vec<Segment> {
        // width of ply beside each pair of neighboring nodes, times their distance
        let mut strips: HashMap<[u32; 2], f64> = HashMap::new();
        for (cell, _) in self.cells.iter().zip(kept).filter(|(_, kept)| **kept) {
            let [low, high] = self.corners(cell);
            let middle = [0, 1].map(|n| 0.5 * (low[n] + high[n]));
            let halves = [
                ([0, 1], low, [high[0], middle[1]]),
                ([3, 2], [low[0], middle[1]], high),
                ([0, 3], low, [middle[0], high[1]]),
                ([1, 2], [middle[0], low[1]], high),
            ];
            for (ends, low, high) in halves {
                let strip = outline.area_in(low, high);
                if strip > 0.0 {
                    *strips.entry(ends.map(|n: usize| cell.nodes[n])).or_default() += strip;
                }
            }
        }
        let within = |segment: &Segment| {
            let width = strips.get(&segment.nodes)? / segment.length;
            Some(Segment { width, share: width / segment.width, ..*segment })
        };
        self.segments.iter().filter_map(within).collect()
    }

    /// The points at which a ring (m) crosses lines of nodes, and its corners; those in cells that are left out are left out.
    #[must_use]
    pub fn boundary_along(&self, ring: &[[f64; 2]]) -> Vec<BoundaryPoint> {
        let mut out = Vec::new();
        // a strip is a line without cells
        if self.cells.is_empty() {
            return out;
        }
        for n in 0..ring.len() {
            let (from, to) = (ring[n], ring[(n + 1) % ring.len()]);
            let mut shares = vec![0.0];
            for axis in 0..2 {
                let way = to[axis] - from[axis];
                shares.extend(self.lines[axis].iter().map(|line| (line - from[axis]) / way));
            }
            shares.retain(|share| (0.0..1.0).contains(share));
            shares.sort_by(f64::total_cmp);
            shares.dedup();
            for (k, share) in shares.iter().enumerate() {
                let point = |t: f64| [0, 1].map(|axis| from[axis] + t * (to[axis] - from[axis]));
                // the cell ahead of it, or behind it
                let next = shares.get(k + 1).copied().unwrap_or(1.0);
                let place = point(*share);
                out.extend(self.boundary_point(place, point(0.5 * (share + next))));
            }
        }
        out
    }

    /// A point of the boundary in the cell of another point (m) beside it.
    fn boundary_point(&self, place: [f64; 2], beside: [f64; 2]) -> Option<BoundaryPoint> {
        let [i, j] = [0, 1].map(|axis| {
            let lines = &self.lines[axis];
            lines.partition_point(|line| *line <= beside[axis]).clamp(1, lines.len() - 1)
        });
        let nu = self.lines[0].len();
        let node = |i: usize, j: usize| self.crossings[j * nu + i];
        let nodes = [node(i - 1, j - 1)?, node(i, j - 1)?, node(i, j)?, node(i - 1, j)?];
        let [low, high] = [nodes[0], nodes[2]].map(|n| self.places[n as usize]);
        Some(BoundaryPoint { place, nodes, weights: bilinear(low, high, place) })
    }

    /// A point (m) of a cell; `None` where there is no cell.
    #[must_use]
    pub fn point_at(&self, place: [f64; 2]) -> Option<BoundaryPoint> {
        let covers = |axis: usize| {
            let lines = &self.lines[axis];
            let (low, high) = (lines[0], lines[lines.len() - 1]);
            let rounding = 1e-9 * (high - low);
            (low - rounding..=high + rounding).contains(&place[axis])
        };
        let is_within = !self.cells.is_empty() && covers(0) && covers(1);
        is_within.then(|| self.boundary_point(place, place)).flatten()
    }

    /// This fabric, larger by a factor along u and v alike: the lines keep their fabric coordinates, and lengths, widths, spacings and
    /// areas in the flat grow.
    #[must_use]
    pub fn enlarged(mut self, factor: f64) -> Self {
        self.length_factor *= factor;
        for segment in &mut self.segments {
            segment.length *= factor;
            segment.width *= factor;
        }
        for bend in &mut self.bends {
            bend.spacing = bend.spacing.map(|spacing| spacing * factor);
            bend.width *= factor;
        }
        for area in &mut self.areas {
            *area *= factor * factor;
        }
        for cell in &mut self.cells {
            cell.area *= factor * factor;
        }
        self
    }

    /// The nodes of each line in order, lines along u first.
    #[must_use]
    pub fn chains(&self) -> Vec<Vec<usize>> {
        let mut chains: Vec<Vec<usize>> = Vec::new();
        let mut before = None;
        for segment in &self.segments {
            let [from, to] = segment.nodes.map(|n| n as usize);
            match chains.last_mut() {
                Some(chain) if before == Some((segment.direction, from)) => chain.push(to),
                _ => chains.push(vec![from, to]),
            }
            before = Some((segment.direction, to));
        }
        chains
    }

    /// The node at a fabric point (m) on two lines; `None` elsewhere.
    #[must_use]
    pub fn node_at(&self, place: [f64; 2]) -> Option<usize> {
        let close = |at: f64, line: f64, span: f64| (at - line).abs() <= 1e-9 * span;
        let find = |n: usize| {
            let lines = &self.lines[n];
            let span = lines[lines.len() - 1] - lines[0];
            lines.iter().position(|line| close(place[n], *line, span.max(f64::MIN_POSITIVE)))
        };
        let (i, j) = (find(0)?, find(1)?);
        self.crossings[j * self.lines[0].len() + i].map(|node| node as usize)
    }
}

impl BoundaryPoint {
    /// Interpolates values of the nodes at this point.
    #[must_use]
    pub fn interpolate<const N: usize>(&self, values: &[[f64; N]]) -> [f64; N] {
        let mut sum = [0.0; N];
        for (node, weight) in self.nodes.iter().zip(self.weights) {
            for (sum, value) in sum.iter_mut().zip(values[*node as usize]) {
                *sum += weight * value;
            }
        }
        sum
    }
}

/// Shares of the corners (0, 0), (1, 0), (1, 1) and (0, 1) of a rectangle in a point of it.
fn bilinear(low: [f64; 2], high: [f64; 2], place: [f64; 2]) -> [f64; 4] {
    let [s, t] = [0, 1].map(|n| (place[n] - low[n]) / (high[n] - low[n]));
    [(1.0 - s) * (1.0 - t), s * (1.0 - t), s * t, (1.0 - s) * t]
}

/// Half the spacing to each side of each line (m); `alone` of a single line.
fn tributary(lines: &[f64], alone: f64) -> Vec<f64> {
    if lines.len() == 1 {
        return vec![alone];
    }
    let half = |n: usize| 0.5 * (lines[n] - lines[n - 1]);
    let last = lines.len() - 1;
    (0..=last)
        .map(|n| if n > 0 { half(n) } else { 0.0 } + if n < last { half(n + 1) } else { 0.0 })
        .collect()
}

/// Lines that meet all of the given coordinates (m), not farther apart than `mesh` (m) and evenly spaced in between.
#[must_use]
pub fn lines(mut meet: Vec<f64>, mesh: f64) -> Vec<f64> {
    meet.sort_by(f64::total_cmp);
    let span = meet.last().zip(meet.first()).map_or(0.0, |(last, first)| last - first);
    // two that differ by rounding are one line
    meet.dedup_by(|b, a| *b - *a <= 1e-9 * span);
    let mut out = Vec::new();
    for pair in meet.windows(2) {
        let parts = ((pair[1] - pair[0]) / mesh * (1.0 - 1e-9)).ceil().max(1.0) as usize;
        out.extend((0..parts).map(|n| pair[0] + (pair[1] - pair[0]) * n as f64 / parts as f64));
    }
    out.extend(meet.last());
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    /// However lines are spaced, the areas of nodes and of cells add up to that of the rectangle, and the lengths times
    /// widths of the segments of each direction too.
    #[test]
    fn all_of_the_ply_is_there_once() {
        let u = lines(vec![0.0, 0.013, 0.1, 0.3], 0.02);
        let v = lines(vec![-0.03, 0.2], 0.011);
        let fabric = Fabric::rectangle([u, v], 1.0);
        let area = 0.3 * 0.23;
        let near = |sum: f64| assert!((sum - area).abs() < 1e-14, "{sum} {area}");
        near(fabric.areas.iter().sum());
        near(fabric.cells.iter().map(|cell| cell.area).sum());
        for direction in 0..2 {
            let segments = fabric.segments.iter().filter(|s| s.direction == direction);
            near(segments.map(|s| s.length * s.width).sum());
        }
    }

    /// Every coordinate that must be met is a line, and no two lines are farther apart than the mesh.
    #[test]
    fn lines_meet_what_they_must() {
        let meet = vec![0.3, 0.0, 0.1, 0.1 + 1e-13, 0.115, 0.085];
        let found = lines(meet.clone(), 0.01);
        for coordinate in meet {
            let is_met = found.iter().any(|line| (line - coordinate).abs() < 1e-12);
            assert!(is_met, "{coordinate}");
        }
        assert!(
            found.windows(2).all(|pair| pair[1] - pair[0] <= 0.01 + 1e-12 && pair[1] > pair[0])
        );
        assert_eq!(lines(vec![0.0, 0.3], 0.01).len(), 31);
    }

    /// A strip is one line of nodes without cells, so no ring has points in them.
    #[test]
    fn a_strip_has_no_boundary() {
        let strip = Fabric::rectangle([lines(vec![0.0, 0.3], 0.1), vec![0.0]], 0.1);
        let ring = [[0.0, 0.0], [0.3, 0.0], [0.3, 0.1], [0.0, 0.1]];
        assert!(strip.boundary_along(&ring).is_empty());
    }

    /// A rectangle that is cut out along lines of nodes is that rectangle, whatever lies beyond it.
    #[test]
    fn what_is_cut_along_lines_is_a_rectangle() {
        let u = lines(vec![0.0, 0.013, 0.1, 0.3], 0.02);
        let v = lines(vec![-0.03, 0.2], 0.011);
        let whole = Fabric::rectangle([u.clone(), v.clone()], 1.0);
        let outline = Outline::rectangle([0.0, -0.03], [0.3, 0.2]).unwrap();
        let beyond =
            |lines: &[f64]| [&[lines[0] - 0.02], lines, &[lines[lines.len() - 1] + 0.01]].concat();
        let cut = Fabric::cut([beyond(&u), beyond(&v)], &outline, 0.05);
        assert_eq!(cut.places, whole.places);
        let nodes = |fabric: &Fabric| fabric.segments.iter().map(|s| s.nodes).collect::<Vec<_>>();
        assert_eq!(nodes(&cut), nodes(&whole));
        assert_eq!(cut.bends.len(), whole.bends.len());
        assert!(cut.inside.iter().all(|inside| *inside));
        let near = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-9, "{a} {b}");
        cut.areas.iter().zip(&whole.areas).for_each(|(a, b)| near(*a, *b));
        cut.segments.iter().zip(&whole.segments).for_each(|(a, b)| near(a.width, b.width));
        cut.bends.iter().zip(&whole.bends).for_each(|(a, b)| near(a.width, b.width));
        for place in &whole.places {
            assert_eq!(cut.node_at(*place), whole.node_at(*place));
        }
    }

    /// A disc with a hole, at no whole number of meshes: mass, its center and its moments of inertia, and the area of the
    /// yarns along u and along v, are those of the ring to a share of a mesh; the mass is the polygon's but for slivers.
    #[test]
    fn a_ring_has_its_mass_where_it_is() {
        let circle = |radius: f64, sides: usize| -> Vec<[f64; 2]> {
            let angle = |n: usize| std::f64::consts::TAU * n as f64 / sides as f64;
            (0..sides)
                .map(|n| [0.11 + radius * angle(n).cos(), 0.07 + radius * angle(n).sin()])
                .collect()
        };
        let (outer, inner) = (0.1, 0.04);
        let outline = Outline::new(circle(outer, 720), vec![circle(inner, 360)]).unwrap();
        for mesh in [0.01, 0.005] {
            let [low, high] = outline.bounds();
            let lines = [0, 1].map(|n| lines(vec![low[n], high[n]], mesh));
            let fabric = Fabric::cut(lines, &outline, 0.05);
            let sum = |weight: &dyn Fn([f64; 2]) -> f64| -> f64 {
                fabric.places.iter().zip(&fabric.areas).map(|(p, area)| weight(*p) * area).sum()
            };
            let area = outline.area();
            assert!((sum(&|_| 1.0) / area - 1.0).abs() < 1e-12);
            let center = [sum(&|p| p[0]) / area, sum(&|p| p[1]) / area];
            assert!((center[0] - 0.11).hypot(center[1] - 0.07) < 0.02 * mesh, "{center:?}");
            let polar = sum(&|p| (p[0] - 0.11).powi(2) + (p[1] - 0.07).powi(2)) / area;
            let exact = 0.5 * (outer * outer + inner * inner);
            assert!((polar / exact - 1.0).abs() < 8.0 * (mesh / outer).powi(2), "{polar} {exact}");
            for direction in 0..2 {
                let segments = fabric.segments.iter().filter(|s| s.direction == direction);
                let yarns: f64 = segments.map(|s| s.length * s.width).sum();
                assert!((yarns / area - 1.0).abs() < 5e-3 * mesh / 0.01, "{yarns} {area}");
            }
            // the boundary is met where it is, though nodes are not
            let length: f64 = fabric
                .boundary
                .iter()
                .map(|ring| {
                    let next = |n: usize| ring[(n + 1) % ring.len()].place;
                    let side_length = |n: usize| {
                        (next(n)[0] - ring[n].place[0]).hypot(next(n)[1] - ring[n].place[1])
                    };
                    (0..ring.len()).map(side_length).sum::<f64>()
                })
                .sum();
            let expected = std::f64::consts::TAU * (outer + inner);
            assert!((length / expected - 1.0).abs() < 0.02, "{length} {expected}");
            for point in fabric.boundary.iter().flatten() {
                let at = point.interpolate(&fabric.places);
                assert!((at[0] - point.place[0]).hypot(at[1] - point.place[1]) < 1e-12);
                assert!(outline.depth(at).abs() < 1e-9);
            }
        }
    }

    /// Yarns that lead across a hole, along a sliver of ply in the cells beside them, are no ply; those that count have their middle on
    /// the ply.
    #[test]
    fn a_yarn_across_a_hole_is_no_ply() {
        let middle = [0.07, 0.065];
        let angle = |n: usize| std::f64::consts::TAU * n as f64 / 90.0;
        for radius in [0.0145, 0.016, 0.02] {
            let hole = (0..90)
                .map(|n| [angle(n).cos(), angle(n).sin()].map(|c| radius * c))
                .collect::<Vec<_>>();
            let hole = hole.iter().map(|p| [0, 1].map(|n| middle[n] + p[n])).collect();
            let edge = vec![[0.0, 0.0], [0.14, 0.0], [0.14, 0.13], [0.0, 0.13]];
            let outline = Outline::new(edge, vec![hole]).unwrap();
            let lines = [0.14, 0.13].map(|end| lines(vec![0.0, end], 0.01));
            let fabric = Fabric::cut(lines, &outline, 0.05);
            let depth = |s: &Segment| {
                let [a, b] = s.nodes.map(|node| fabric.places[node as usize]);
                outline.depth([0, 1].map(|n| 0.5 * (a[n] + b[n])))
            };
            let (ply, slivers): (Vec<_>, Vec<_>) =
                fabric.segments.iter().partition(|segment| segment.is_ply());
            assert!(ply.iter().all(|segment| depth(segment) > -1e-3), "{radius}");
            assert!(!slivers.is_empty() && slivers.iter().all(|segment| depth(segment) < 3e-3));
        }
    }
}
