//! The ply between the catenaries: shapes as polylines, and a surface inside each cell.
//!
//! Inside a cell with edges c₀(s), c₁(s) along u and d₀(t), d₁(t) along v the surface is the Coons patch
//!
//! ```text
//! S(s,t) = (1−t) c₀ + t c₁ + (1−s) d₀ + s d₁ − bilinear(corners)
//! ```
//!
//! plus a correction that vanishes on the edges and takes the surface through both diagonals, as they are
//! drawn. With p = s − t and q = s + t − 1, where the diagonals are p = 0 and q = 0 and the edges
//! |p| + |q| = 1, and with e_r(q), e_f(p) the diagonals' distances from S, it is the Boolean sum
//!
//! ```text
//! e_r(q) A + e_f(p) B − e₀ A B ,   A = 1 − (p/(1−|q|))² ,   B = 1 − (q/(1−|p|))² .
//! ```
//!
//! If the diagonals miss each other, e₀ is the lower of both, so that the surface holds the higher.

use crate::result::{ResultFile, catenaries};
use plydrape::draping::record::{CatenaryState, Hold, SpanState};
use plydrape::geometry::vector::sub;
use plydrape::outcome::Step;
use plydrape::ply::{Catenary, Grid, Kind, LineCell, Lines};

type Point = [f64; 3];

/// The ply of one step as a structured grid of points, every catenary along its lines.
#[derive(Debug, Clone, PartialEq)]
pub struct Surface {
    /// Points along u and along v: the gripper `[i, j]` is point `[i n, j n]` with n intervals a cell.
    pub size: [usize; 2],
    /// Points (m), u running fastest.
    pub vertices: Vec<[f64; 3]>,
    /// Distance of each point from the mold (m), negative inside it; `None` without a mold. The model follows
    /// the catenaries alone: between them the ply may be drawn a little inside.
    pub gap: Option<Vec<f64>>,
}

impl Surface {
    /// The ply of a step of a result with this many intervals along each side of a cell, at least one. A strip
    /// is one row of points.
    #[must_use]
    pub fn new(result: &ResultFile, step: &Step, intervals: usize) -> Self {
        Surface::from_curves(result, step, &result.curves(step), intervals)
    }

    /// The surface between the curves of a step.
    pub(crate) fn from_curves(
        result: &ResultFile,
        step: &Step,
        curves: &[Vec<Vec<Point>>],
        intervals: usize,
    ) -> Self {
        let (graph, n) = (result.scene.ply.lines(), intervals.max(1));
        let grid = graph.surface();
        let size = [grid.nu, grid.nv].map(|grippers| grippers.saturating_sub(1) * n + 1);
        let size = if grid == Grid::NONE { [0; 2] } else { size };
        let lines = lines(result, step, curves, n);
        let mut vertices = vec![[0.0; 3]; size[0] * size[1]];
        let mut put = |i: usize, j: usize, p: Point| vertices[j * size[0] + i] = p;
        for j in 0..grid.nv.saturating_sub(1) {
            for i in 0..grid.nu.saturating_sub(1) {
                let place = &graph.cells()[j * (grid.nu - 1) + i];
                for (k, p) in cell(&graph, place, &lines, n).into_iter().enumerate() {
                    put(i * n + k % (n + 1), j * n + k / (n + 1), p);
                }
            }
        }
        // the edges last: exact, and all there is of a strip
        let edges = if grid == Grid::NONE { 0 } else { graph.edges() };
        for edge in 0..edges {
            let Catenary { kind, from: [i, j], .. } = graph.catenary(edge);
            let along = usize::from(kind == Kind::EdgeV);
            for (k, p) in lines[edge].iter().enumerate() {
                put(i * n + k * (1 - along), j * n + k * along, *p);
            }
        }
        let gap = result.scene.mold.as_ref();
        let gap = gap.map(|mold| vertices.iter().map(|p| mold.signed_distance(*p)).collect());
        Surface { size, vertices, gap }
    }

    /// Corners of two triangles a quad of the grid, counterclockwise from above where the ply is not turned over; none
    /// of a strip.
    #[must_use]
    pub fn triangles(&self) -> Vec<[u32; 3]> {
        let [nu, nv] = self.size;
        let mut out = Vec::with_capacity(2 * nu.saturating_sub(1) * nv.saturating_sub(1));
        for j in 0..nv.saturating_sub(1) {
            for i in 0..nu.saturating_sub(1) {
                let [a, b, c, d] =
                    [j * nu + i, j * nu + i + 1, (j + 1) * nu + i + 1, (j + 1) * nu + i]
                        .map(|n| n as u32);
                out.extend([[a, b, c], [a, c, d]]);
            }
        }
        out
    }
}

fn mix(a: Point, b: Point, t: f64) -> Point {
    [0, 1, 2].map(|c| a[c] + t * (b[c] - a[c]))
}

/// The whole shape of a catenary, the curves of its spans and its contact in their order, from gripper to gripper.
#[must_use]
pub fn shape(line: &CatenaryState, curves: &[Vec<Point>], ends: [Point; 2]) -> Vec<Point> {
    let side = |after: usize| {
        let spans = line.spans.iter().zip(curves);
        spans.filter(move |(span, _)| span.segment == after).flat_map(|(_, curve)| curve)
    };
    let contact = line.contact.iter().flat_map(|contact| &contact.points);
    let mut points: Vec<Point> = side(0).chain(contact).chain(side(1)).copied().collect();
    // Fabric that lies begins at the closest point of the mold to the gripper; the line begins at the gripper itself. A line
    // without stations still has its two grippers.
    points.insert(0, ends[0]);
    points.push(ends[1]);
    points.dedup();
    points
}

/// Slack ratio below which a lying segment counts as contact, not as a wrinkle.
const FLAT: f64 = 5e-4;

/// The line in which a catenary touches the mold, first to last (m): its contact segment, and segments that lie flat beside
/// it; `None` where it does not touch.
fn touching(line: &CatenaryState, curves: &[Vec<Point>]) -> Option<Vec<Point>> {
    let contact = line.contact.as_ref()?;
    let flat = |span: &SpanState| span.hold == Hold::Lying && span.slack_ratio(line.length) < FLAT;
    let beside = |segment: usize| {
        let spans = line.spans.iter().zip(curves);
        let lying = spans.filter(move |(span, _)| span.segment == segment && flat(span));
        lying.flat_map(|(_, curve)| curve)
    };
    Some(beside(0).chain(&contact.points).chain(beside(1)).copied().collect())
}

/// The lines in which the ply touches the mold in a step (m), one for each of its first `count` catenaries that does.
#[must_use]
pub fn contact_lines(step: &Step, curves: &[Vec<Vec<Point>>], count: usize) -> Vec<Vec<Point>> {
    let lines = catenaries(step).iter().zip(curves).take(count);
    lines.filter_map(|(line, curves)| touching(line, curves)).collect()
}

/// Points of a polyline at equal shares of its horizontal way (of its length, if it is upright).
#[must_use]
pub fn stations(line: &[Point], count: usize) -> Vec<Point> {
    if line.len() < 2 {
        return line.to_vec();
    }
    let lengths = |axes: usize| -> Vec<f64> {
        let mut sum = 0.0;
        let step = |pair: &[Point]| {
            let square: f64 = (0..axes).map(|c| (pair[1][c] - pair[0][c]).powi(2)).sum();
            sum += square.sqrt();
            sum
        };
        std::iter::once(0.0).chain(line.windows(2).map(step)).collect()
    };
    let (flat, full) = (lengths(2), lengths(3));
    let ends = [flat.last(), full.last()].map(|e| e.copied().unwrap_or(0.0));
    let way = if ends[0] > 1e-3 * ends[1] { flat } else { full };
    let total = way.last().copied().unwrap_or(0.0);
    let mut k = 0;
    (0..=count)
        .map(|n| {
            if n == count {
                // also where the line ends upright
                return line[line.len() - 1];
            }
            let goal = total * n as f64 / count as f64;
            while k + 2 < way.len() && way[k + 1] < goal {
                k += 1;
            }
            let length = way[k + 1] - way[k];
            let part = if length > 0.0 { (goal - way[k]) / length } else { 0.0 };
            mix(line[k], line[k + 1], part.clamp(0.0, 1.0))
        })
        .collect()
}

/// All catenaries of a step, each at `count + 1` stations, in the grid's order; a catenary that is
/// missing in the result is straight.
pub(crate) fn lines(
    result: &ResultFile,
    step: &Step,
    curves: &[Vec<Vec<Point>>],
    count: usize,
) -> Vec<Vec<Point>> {
    let graph = result.scene.ply.lines();
    (0..graph.catenaries())
        .map(|k| {
            let ends = graph.ends(k).map(|gripper| step.grippers[gripper].position);
            let whole = match catenaries(step).get(k) {
                Some(state) => shape(state, &curves[k], ends),
                None => ends.to_vec(),
            };
            stations(&whole, count)
        })
        .collect()
}

/// One cell whose sides are fibers: `(n + 1)²` points, s running fastest, from its six lines at `n + 1` stations.
pub(crate) fn cell(graph: &Lines, cell: &LineCell, lines: &[Vec<Point>], n: usize) -> Vec<Point> {
    let [low, right, _, left] = cell.corners;
    // the sides of a cell of a whole array are there
    let behind = |gripper: usize, d: usize| &lines[graph.beside(gripper, d)[1].unwrap_or_default()];
    let (c0, c1) = (behind(low, 0), behind(left, 0));
    let (d0, d1) = (behind(low, 1), behind(right, 1));
    let [rising, falling] = cell.bias.map(|bias| &lines[bias.list()[0]]);
    let patch = |s: f64, t: f64| {
        let [a, b] = [interpolate(c0, s), interpolate(c1, s)];
        let [c, d] = [interpolate(d0, t), interpolate(d1, t)];
        let corners = mix(mix(c0[0], c0[n], s), mix(c1[0], c1[n], s), t);
        let (across, along) = (mix(a, b, t), mix(c, d, s));
        [0, 1, 2].map(|k| across[k] + along[k] - corners[k])
    };
    // Distance of each diagonal from the patch, by q along the rising and by p along the falling one.
    let rising_gap = |q: f64| {
        let s = (1.0 + q) / 2.0;
        sub(interpolate(rising, s), patch(s, s))
    };
    let falling_gap = |p: f64| {
        let s = (1.0 + p) / 2.0;
        sub(interpolate(falling, 1.0 - s), patch(s, 1.0 - s))
    };
    let (r0, f0) = (rising_gap(0.0), falling_gap(0.0));
    let center = if r0[2] < f0[2] { r0 } else { f0 };

    let mut points = Vec::with_capacity((n + 1) * (n + 1));
    for row in 0..=n {
        for column in 0..=n {
            let (s, t) = (column as f64 / n as f64, row as f64 / n as f64);
            let (p, q) = (s - t, s + t - 1.0);
            let (a, b) = (fade(p, q), fade(q, p));
            let (er, ef, base) = (rising_gap(q), falling_gap(p), patch(s, t));
            points.push([0, 1, 2].map(|k| base[k] + er[k] * a + ef[k] * b - center[k] * a * b));
        }
    }
    points
}

/// 1 on the diagonal `p = 0`, 0 on the edges of the cell.
fn fade(p: f64, q: f64) -> f64 {
    let reach = 1.0 - q.abs();
    if reach <= 1e-12 {
        return 0.0;
    }
    (1.0 - (p / reach).powi(2)).max(0.0)
}

/// The point of a line of equally spaced stations at a share of its length.
fn interpolate(line: &[Point], share: f64) -> Point {
    let last = line.len() - 1;
    let place = share.clamp(0.0, 1.0) * last as f64;
    let low = (place as usize).min(last.saturating_sub(1));
    mix(line[low], line[(low + 1).min(last)], place - low as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample;

    /// On its edges and on both diagonals the surface is the catenaries themselves.
    #[test]
    fn the_surface_passes_through_edges_and_diagonals() {
        let result = sample::hanging(3, 2);
        let (graph, n) = (result.scene.ply.lines(), 8);
        let step = &result.steps[0];
        let lines = lines(&result, step, &result.curves(step), n);
        let at = &graph.cells()[1];
        let cell = cell(&graph, at, &lines, n);
        let node = |s: usize, t: usize| cell[t * (n + 1) + s];
        let near = |a: Point, b: Point| {
            assert!((0..3).all(|c| (a[c] - b[c]).abs() < 1e-12), "{a:?} {b:?}");
        };
        let [rising, falling] = at.bias.map(|bias| bias.list()[0]);
        let number = |kind, from| {
            (0..graph.edges()).find(|n| {
                let line = graph.catenary(*n);
                (line.kind, line.from) == (kind, from)
            })
        };
        let [c0, c1] = [[1, 0], [1, 1]].map(|id| number(Kind::EdgeU, id).unwrap());
        let [d0, d1] = [[1, 0], [2, 0]].map(|id| number(Kind::EdgeV, id).unwrap());
        let each = |line: usize, on_cell: &dyn Fn(usize) -> Point| {
            for (k, point) in lines[line].iter().enumerate() {
                near(on_cell(k), *point);
            }
        };
        each(c0, &|k| node(k, 0));
        each(c1, &|k| node(k, n));
        each(d0, &|k| node(0, k));
        each(d1, &|k| node(n, k));
        each(rising, &|k| node(k, k));
        each(falling, &|k| node(n - k, k));
    }

    /// Stations of a plain line are equally spaced, whatever the spacing of its points.
    #[test]
    fn stations_are_equally_spaced_in_the_horizontal() {
        let line = [[0.0; 3], [0.1, 0.0, 0.0], [0.15, 0.0, 0.0], [1.0, 0.0, 0.0]];
        for (k, p) in stations(&line, 10).iter().enumerate() {
            assert!((p[0] - 0.1 * k as f64).abs() < 1e-15);
        }
        // both ends are met, also from a point straight below them
        let corners = [[0.0, 0.0, 1.0], [0.0; 3], [1.0, 0.0, 0.0], [1.0, 0.0, 1.0]];
        assert_eq!([stations(&corners, 4)[0], stations(&corners, 4)[4]], [corners[0], corners[3]]);
        let upright = [[0.0; 3], [0.0, 0.0, 2.0]];
        assert_eq!(stations(&upright, 2)[1], [0.0, 0.0, 1.0]);
    }
}
