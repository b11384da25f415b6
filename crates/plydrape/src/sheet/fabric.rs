//! The fabric in the flat: lines of nodes along warp and weft, and what joins them.
//!
//! Nodes stand where lines cross. Every gripper point, every edge of a pad and the boundary lie on lines, which are
//! evenly spaced in between. All areas and widths are tributary: half the spacing to each side, so that all of the ply
//! is there once.

/// A yarn segment between two neighbouring nodes of a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    /// Its nodes.
    pub nodes: [u32; 2],
    /// The direction along which it runs: 0 along u, 1 along v.
    pub direction: usize,
    /// Its length in the flat (m).
    pub length: f64,
    /// Width of fabric that it stands for (m).
    pub width: f64,
}

/// A cell between four nodes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cell {
    /// Its nodes at (u, v) = (0, 0), (1, 0), (1, 1) and (0, 1).
    pub nodes: [u32; 4],
    /// Its area in the flat (m²).
    pub area: f64,
}

/// Three neighbouring nodes of a line, at whose middle one the line bends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bend {
    /// Its nodes.
    pub nodes: [u32; 3],
    /// The direction along which the line runs: 0 along u, 1 along v.
    pub direction: usize,
    /// Distance of the neighbours in the flat (m).
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
    /// Length in the flat over the difference of fabric coordinates, [`crate::Ply::length_factor`].
    pub length_factor: f64,
}

impl Fabric {
    /// A rectangle between its first and last lines; a single line along u stands for a strip of `strip` width (m).
    ///
    /// Nodes stand in the order of u first.
    #[must_use]
    pub fn rectangle(lines: [Vec<f64>; 2], strip: f64) -> Self {
        let [nu, nv] = [lines[0].len(), lines[1].len()];
        let node = |i: usize, j: usize| (j * nu + i) as u32;
        let widths = [tributary(&lines[0], strip), tributary(&lines[1], strip)];

        let mut places = Vec::with_capacity(nu * nv);
        let mut areas = Vec::with_capacity(nu * nv);
        for j in 0..nv {
            for i in 0..nu {
                places.push([lines[0][i], lines[1][j]]);
                areas.push(widths[0][i] * widths[1][j]);
            }
        }

        let mut segments = Vec::new();
        let mut bends = Vec::new();
        for direction in 0..2 {
            let (along, across) = (&lines[direction], &widths[1 - direction]);
            for (line, width) in across.iter().enumerate() {
                let at = |n: usize| if direction == 0 { node(n, line) } else { node(line, n) };
                for n in 1..along.len() {
                    let length = along[n] - along[n - 1];
                    segments.push(Segment {
                        nodes: [at(n - 1), at(n)],
                        direction,
                        length,
                        width: *width,
                    });
                }
                for n in 1..along.len().saturating_sub(1) {
                    let spacing = [along[n] - along[n - 1], along[n + 1] - along[n]];
                    let nodes = [at(n - 1), at(n), at(n + 1)];
                    bends.push(Bend { nodes, direction, spacing, width: *width });
                }
            }
        }

        let mut cells = Vec::with_capacity(nu.saturating_sub(1) * nv.saturating_sub(1));
        for j in 1..nv {
            for i in 1..nu {
                let nodes = [node(i - 1, j - 1), node(i, j - 1), node(i, j), node(i - 1, j)];
                let area = (lines[0][i] - lines[0][i - 1]) * (lines[1][j] - lines[1][j - 1]);
                cells.push(Cell { nodes, area });
            }
        }
        Fabric { places, areas, segments, cells, bends, lines, length_factor: 1.0 }
    }

    /// The same lines on a fabric that is larger by a factor along u and v alike: fabric coordinates stay, and lengths,
    /// widths, spacings and areas in the flat grow.
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

    /// The node at a fabric point (m) on two lines; none elsewhere.
    #[must_use]
    pub fn node_at(&self, place: [f64; 2]) -> Option<usize> {
        let close = |at: f64, line: f64, span: f64| (at - line).abs() <= 1e-9 * span;
        let find = |n: usize| {
            let lines = &self.lines[n];
            let span = lines[lines.len() - 1] - lines[0];
            lines.iter().position(|line| close(place[n], *line, span.max(f64::MIN_POSITIVE)))
        };
        let (i, j) = (find(0)?, find(1)?);
        Some(j * self.lines[0].len() + i)
    }
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
        for at in meet {
            assert!(found.iter().any(|line| (line - at).abs() < 1e-12), "{at}");
        }
        assert!(
            found.windows(2).all(|pair| pair[1] - pair[0] <= 0.01 + 1e-12 && pair[1] > pair[0])
        );
        assert_eq!(lines(vec![0.0, 0.3], 0.01).len(), 31);
    }
}
