//! The lines of fabric between the cups, as a graph that follows from where cups hold the fabric.
//!
//! A *fiber line* joins two cups on one yarn with no cup between them, one or two pitches apart. A *bias line* runs across
//! the yarns. Fibers and bias lines meet in cells, of which there are two arrangements:
//!
//! - four fiber lines are the sides, and two bias lines the diagonals (cups in rows along the yarns);
//! - two fiber lines that cross in their middles are the diagonals, and four bias lines the sides (rows at 45° to the yarns).
//!
//! In both, each bias line is the diagonal of a trellis of fibers: of the cell itself, or of the parallelogram of half
//! fibers around the bias line. So one set of formulas, that of [`super::shear`], holds for both.

use super::cells::{bias_cells, fiber_cells};
use super::tuning::TUNING;
use super::{Catenary, Grid, GripperId, Kind, Outline, Ply};
use std::collections::BTreeMap;
use std::sync::{Arc, OnceLock};

/// All lines of a ply, and the cells between them.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Lines {
    grid: Grid,
    pitch: [f64; 2],
    grippers: usize,
    lines: Vec<FabricLine>,
    fibers: usize,
    cells: Vec<LineCell>,
    /// The fiber lines at each gripper: `[direction][before, after]`.
    beside: Vec<[[Option<usize>; 2]; 2]>,
    /// Grippers on one yarn that fiber lines join: direction and grippers in order.
    chains: Vec<(usize, Vec<usize>)>,
    /// The cells of each bias line.
    cells_of: Vec<[Option<usize>; 2]>,
}

/// A line of fabric from cup to cup.
#[derive(Debug, Clone, Copy, PartialEq)]
struct FabricLine {
    catenary: Catenary,
    ends: [usize; 2],
    /// Where its first end is in the fabric, and the offset of the second one from it, in pitches along u and along v.
    start: [f64; 2],
    offset: [f64; 2],
    /// Share of its forces that is the ply's.
    tributary: f64,
}

/// A cell of the fabric between four cups.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineCell {
    /// Name: the gripper at its first corner.
    pub id: GripperId,
    /// Corners in order around it.
    pub corners: [usize; 4],
    /// Sides along u and along v (m) of the trellis whose diagonals its bias lines are, of the nominal ply: the cell's own sides,
    /// or half of each fiber that is its diagonal.
    pub trellis: [f64; 2],
    /// Which of its lines are fibers.
    pub fibers: Fibers,
    /// Bias lines: the rising ones, and the falling ones.
    pub bias: [BiasLines; 2],
}

/// Which lines of a cell are fibers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fibers {
    /// Four sides; bias lines are its diagonals.
    Sides,
    /// Two diagonals; bias lines are its sides.
    Diagonals,
}

/// The bias lines of a cell in one direction: one diagonal, or two sides.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BiasLines {
    lines: [usize; 2],
    count: usize,
}

impl BiasLines {
    /// The catenaries.
    #[must_use]
    pub fn list(&self) -> &[usize] {
        &self.lines[..self.count]
    }
}

/// Two grippers, and the offset through the fabric of the second from the first along u and v (m).
#[derive(Debug, Clone, Copy)]
pub(super) struct Pair {
    pub ends: [usize; 2],
    pub offset: [f64; 2],
}

/// A cell as geometry has it: its corners, its trellis, and its bias lines of each direction.
pub(super) struct Quad {
    pub name: usize,
    pub corners: [usize; 4],
    pub trellis: [f64; 2],
    pub fibers: Fibers,
    pub bias: [Vec<Pair>; 2],
}

/// The lines of a ply once they have been found; no part of what the ply is.
#[derive(Debug, Clone, Default)]
pub struct FoundLines(OnceLock<Arc<Lines>>);

impl PartialEq for FoundLines {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Ply {
    /// Lines between cups; none where the sheet alone can drape it.
    #[must_use]
    pub fn lines(&self) -> Arc<Lines> {
        let lines = self.found.0.get_or_init(|| Arc::new(Lines::from_ply(self)));
        if lines.are_of(self) { Arc::clone(lines) } else { Arc::new(Lines::from_ply(self)) }
    }

    /// Whether catenaries hang between its cups.
    #[must_use]
    pub fn has_lines(&self) -> bool {
        !self.lines().is_empty()
    }
}

impl Lines {
    fn from_ply(ply: &Ply) -> Lines {
        match &ply.cut {
            None => Lines::array(ply.grid, ply.cell),
            Some(cut) => Lines::found(ply, &cut.outline),
        }
    }

    fn are_of(&self, ply: &Ply) -> bool {
        self.grid == ply.grid && self.pitch == ply.cell && self.grippers == ply.grippers()
    }

    /// The lines of a whole array along the yarns: edges along u, edges along v, then two diagonals per cell.
    #[must_use]
    pub fn array(grid: Grid, cell: [f64; 2]) -> Lines {
        let Grid { nu, nv } = grid;
        let [a, b] = cell;
        let (across, along) = (nu.saturating_sub(1), nv.saturating_sub(1));
        let gripper = |id| grid.index(id);
        let u = (0..nv).flat_map(|j| (0..across).map(move |i| [[i, j], [i + 1, j]].map(gripper)));
        let v = (0..along).flat_map(|j| (0..nu).map(move |i| [[i, j], [i, j + 1]].map(gripper)));
        let u = u.map(|ends| Pair { ends, offset: [a, 0.0] }).collect();
        let v = v.map(|ends| Pair { ends, offset: [0.0, b] }).collect();
        let quad = |[i, j]: [usize; 2]| {
            let corners = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]].map(gripper);
            fiber_quad(corners, cell)
        };
        let cells = (0..along).flat_map(|j| (0..across).map(move |i| [i, j])).map(quad).collect();
        let families = if nv > 1 { 2.0 } else { 1.0 };
        let share = |line: &FabricLine| {
            let c = line.catenary;
            let (line, lines) =
                if c.kind == Kind::EdgeU { (c.from[1], nv) } else { (c.from[0], nu) };
            let boundary = lines > 1 && (line == 0 || line + 1 == lines);
            if boundary { 0.5 / families } else { 1.0 / families }
        };
        let id = |n| grid.id(n);
        let mut lines = Lines { grid, pitch: cell, grippers: grid.grippers(), ..Lines::default() };
        lines.join([u, v], cells, |n| (id(n), id(n).map(|k| k as f64)));
        let fibers = lines.fibers;
        lines.lines[..fibers].iter_mut().for_each(|line| line.tributary = share(line));
        lines
    }

    /// The lines between the cups of a cut ply, from their places in the fabric.
    fn found(ply: &Ply, outline: &Outline) -> Lines {
        let count = ply.grippers();
        let places: Vec<[f64; 2]> = (0..count).map(|n| ply.place(n)).collect();
        let mut own =
            Lines { grid: ply.grid, pitch: ply.cell, grippers: count, ..Lines::default() };
        // rows at 45° to the yarns: cups on one yarn are a diagonal of the array apart
        let turned = ply.is_turned();
        let pitch = if turned { [ply.cell[0].hypot(ply.cell[1]); 2] } else { ply.cell };
        let mut edges = [0, 1].map(|d| fiber_lines(&places, outline, d, pitch));
        let mut cells = fiber_cells(&places, outline, &edges, pitch);
        let side = ply.cell[0].max(ply.cell[1]);
        cells.extend(bias_cells(&places, outline, &edges, side));
        let mut held = vec![false; count];
        edges.iter().flatten().flat_map(|edge| edge.ends).for_each(|n| held[n] = true);
        let is_bias = cells.iter().any(|cell| cell.fibers == Fibers::Diagonals);
        // a cup without a line would hold nothing, and an array across the yarns has no shear without cells
        if !held.iter().all(|held| *held) || (turned && !is_bias) {
            edges = [Vec::new(), Vec::new()];
            cells.clear();
        }
        let shares = [0, 1].map(|d| tributaries(&places, &edges, d, ply.line_widths()[d]));
        let start = |n: usize| [0, 1].map(|d| places[n][d] / ply.cell[d]);
        own.join(edges, cells, |n| (ply.id(n), start(n)));
        for (line, share) in own.lines.iter_mut().zip(shares.into_iter().flatten()) {
            line.tributary = share;
        }
        own
    }

    /// Joins grippers by fiber lines and cells; `name_and_place` gives a gripper's name and its place in pitches.
    fn join(
        &mut self,
        edges: [Vec<Pair>; 2],
        quads: Vec<Quad>,
        name_and_place: impl Fn(usize) -> (GripperId, [f64; 2]),
    ) {
        let fibers = edges[0].len() + edges[1].len();
        let (pitch, mut beside) = (self.pitch, vec![[[None; 2]; 2]; self.grippers]);
        let mut lines = Vec::with_capacity(fibers + 2 * quads.len());
        let line = |kind, Pair { ends, offset: [a, b] }: Pair| {
            let [(from, start), (to, _)] = ends.map(&name_and_place);
            let (catenary, offset) = (Catenary { kind, from, to }, [a / pitch[0], b / pitch[1]]);
            FabricLine { catenary, ends, start, offset, tributary: 1.0 }
        };
        // fiber lines first; each gripper knows those that begin and end at it
        for (d, kind) in [Kind::EdgeU, Kind::EdgeV].into_iter().enumerate() {
            for pair in &edges[d] {
                let [a, b] = pair.ends;
                beside[a][d][1] = Some(lines.len());
                beside[b][d][0] = Some(lines.len());
                lines.push(line(kind, *pair));
            }
        }
        // lines across the yarns belong to the one or two cells beside them
        let (mut known, mut cells_of) = (BTreeMap::new(), Vec::new());
        let mut cells = Vec::with_capacity(quads.len());
        for (number, quad) in quads.into_iter().enumerate() {
            let mut bias = [BiasLines { lines: [0; 2], count: 0 }; 2];
            for (d, kind) in [Kind::Rising, Kind::Falling].into_iter().enumerate() {
                for pair in &quad.bias[d] {
                    let n = *known.entry(pair.ends).or_insert_with(|| {
                        lines.push(line(kind, *pair));
                        cells_of.push([None; 2]);
                        lines.len() - 1
                    });
                    let beside: &mut [Option<usize>; 2] = &mut cells_of[n - fibers];
                    beside[usize::from(beside[0].is_some())] = Some(number);
                    bias[d].lines[bias[d].count] = n;
                    bias[d].count += 1;
                }
            }
            let Quad { name, corners, trellis, fibers, .. } = quad;
            cells.push(LineCell { id: name_and_place(name).0, corners, trellis, fibers, bias });
        }
        self.chains = chains(&lines, &beside, &edges);
        (self.lines, self.fibers, self.beside) = (lines, fibers, beside);
        (self.cells, self.cells_of) = (cells, cells_of);
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.lines.is_empty()
    }

    /// The array whose lines these all are; `None` where cups or lines are missing, or rows cross the yarns.
    #[must_use]
    pub fn whole_array(&self) -> Option<Grid> {
        let Grid { nu, nv } = self.grid;
        let edges = nu.saturating_sub(1) * nv + nu * nv.saturating_sub(1);
        let whole = self.fibers == edges && self.cells.len() == self.grid.cells();
        (whole && self.fibers > 0).then_some(self.grid)
    }

    /// The array; a grid without cells where it is not whole.
    #[must_use]
    pub fn surface(&self) -> Grid {
        self.whole_array().unwrap_or(Grid::NONE)
    }

    /// Number of grippers.
    #[must_use]
    pub fn grippers(&self) -> usize {
        self.grippers
    }

    /// Number of lines: fiber lines along u, along v, then bias lines. A catenary hangs in each.
    #[must_use]
    pub fn catenaries(&self) -> usize {
        self.lines.len()
    }

    /// Number of fiber lines; they come first.
    #[must_use]
    pub fn edges(&self) -> usize {
        self.fibers
    }

    /// A line by its index.
    #[must_use]
    pub fn catenary(&self, index: usize) -> Catenary {
        self.lines[index].catenary
    }

    /// Positions of its grippers in all per-gripper arrays.
    #[must_use]
    pub fn ends(&self, index: usize) -> [usize; 2] {
        self.lines[index].ends
    }

    /// The cells.
    #[must_use]
    pub fn cells(&self) -> &[LineCell] {
        &self.cells
    }

    /// The cells of a bias line, one or two; none for a fiber line.
    pub fn cells_of(&self, index: usize) -> impl Iterator<Item = usize> + Clone + use<> {
        let cells = index.checked_sub(self.fibers).map_or([None; 2], |n| self.cells_of[n]);
        cells.into_iter().flatten()
    }

    /// Fabric length (m) of a line of the flat ply, `factor` times that of the nominal one.
    #[must_use]
    pub fn flat_length(&self, index: usize, factor: f64) -> f64 {
        let [a, b] = self.offset(index).map(|offset| offset * factor);
        match self.catenary(index).kind {
            Kind::EdgeU => a,
            Kind::EdgeV => b,
            Kind::Rising | Kind::Falling => a.hypot(b),
        }
    }

    /// Offset through the fabric of the second end of a line from its first along u and along v (m), of the nominal ply.
    #[must_use]
    pub fn offset(&self, index: usize) -> [f64; 2] {
        [0, 1].map(|d| self.pitch[d] * self.lines[index].offset[d])
    }

    /// Fabric coordinates (m) of a line at a share of its length from its first end.
    #[must_use]
    pub fn point(&self, index: usize, share: f64) -> [f64; 2] {
        let FabricLine { start, offset, .. } = &self.lines[index];
        [0, 1].map(|d| self.pitch[d] * (start[d] + share * offset[d]))
    }

    /// Share of a fiber line's forces that is the ply's.
    ///
    /// Each family of fiber lines has the weight of the whole ply, so where there are two families each counts half. A line
    /// stands for a strip half-way to the next one of its family on each side.
    #[must_use]
    pub fn tributary(&self, index: usize) -> f64 {
        self.lines[index].tributary
    }

    /// The fiber lines at a gripper along a direction (0: u, 1: v): the one before it, and the one behind it.
    #[must_use]
    pub fn beside(&self, gripper: usize, direction: usize) -> [Option<usize>; 2] {
        self.beside[gripper][direction]
    }

    /// The grippers before and behind one along a direction; itself where no line goes on.
    #[must_use]
    pub fn neighbors(&self, gripper: usize, direction: usize) -> [usize; 2] {
        let [before, after] = self.beside[gripper][direction];
        [
            before.map_or(gripper, |n| self.lines[n].ends[0]),
            after.map_or(gripper, |n| self.lines[n].ends[1]),
        ]
    }

    /// Grippers that fiber lines join along one yarn: those along u (0) first, then those along v (1), each in ascending order.
    pub fn chains(&self) -> impl Iterator<Item = (usize, &[usize])> {
        self.chains.iter().map(|(direction, grippers)| (*direction, grippers.as_slice()))
    }
}

/// A cell whose sides are fibers, from its corners in order around it.
pub(super) fn fiber_quad(corners: [usize; 4], trellis: [f64; 2]) -> Quad {
    let [low, right, top, left] = corners;
    let [a, b] = trellis;
    let pair = |ends, offset| vec![Pair { ends, offset }];
    let bias = [pair([low, top], [a, b]), pair([right, left], [-a, b])];
    let name = corners.into_iter().min().unwrap_or(low);
    Quad { name, corners, trellis, fibers: Fibers::Sides, bias }
}

/// The fiber lines along a direction between cups on one yarn, in ascending order of v, then u of their first ends.
fn fiber_lines(
    places: &[[f64; 2]],
    outline: &Outline,
    direction: usize,
    pitch: [f64; 2],
) -> Vec<Pair> {
    let (along, across) = (direction, 1 - direction);
    let same = TUNING.same_yarn * pitch[0].min(pitch[1]);
    // cups at the same place across are on one yarn
    let mut order: Vec<usize> = (0..places.len()).collect();
    order.sort_by(|a, b| places[*a][across].total_cmp(&places[*b][across]));
    let mut pairs = Vec::new();
    for yarn in order.chunk_by_mut(|a, b| places[*b][across] - places[*a][across] <= same) {
        yarn.sort_by(|a, b| places[*a][along].total_cmp(&places[*b][along]));
        for ends in yarn.windows(2).map(|ends| [ends[0], ends[1]]) {
            let [a, b] = ends.map(|n| places[n]);
            let length = b[along] - a[along];
            if length <= (2.0 + TUNING.same_yarn) * pitch[along] && outline.has_line([a, b]) {
                let mut offset = [0.0; 2];
                offset[along] = length;
                pairs.push(Pair { ends, offset });
            }
        }
    }
    // rows by whole widths of a yarn, so that rounding does not change their order
    let first = |pair: &Pair| places[pair.ends[0]];
    let row = |place: [f64; 2]| (place[1] / same).round();
    pairs.sort_by(|a, b| {
        let (a, b) = (first(a), first(b));
        row(a).total_cmp(&row(b)).then(a[0].total_cmp(&b[0]))
    });
    pairs
}

/// Share of each fiber line along a direction: the fabric from half-way to the next line on one side to half-way to that on
/// the other, over a strip of a width (m) along the line, and halved where there are two families.
fn tributaries(
    places: &[[f64; 2]],
    edges: &[Vec<Pair>; 2],
    direction: usize,
    width: f64,
) -> Vec<f64> {
    let (along, across) = (direction, 1 - direction);
    let families = edges.iter().filter(|edges| !edges.is_empty()).count() as f64;
    let reach = |pair: &Pair| pair.ends.map(|n| places[n][along]);
    let place_across = |pair: &Pair| places[pair.ends[0]][across];
    let same = TUNING.same_yarn * width;
    let own = &edges[direction];
    let tributary = |pair: &Pair| {
        // other lines beside this one begin and end anywhere: cut it where they do
        let [from, to] = reach(pair);
        let beside = |other: &&Pair| {
            let [a, b] = reach(other);
            a < to && b > from && (place_across(other) - place_across(pair)).abs() > same
        };
        let others: Vec<&Pair> = own.iter().filter(beside).collect();
        let mut cuts: Vec<f64> = others.iter().flat_map(|other| reach(other)).collect();
        cuts.extend([from, to]);
        cuts.retain(|cut| (from..=to).contains(cut));
        cuts.sort_by(f64::total_cmp);
        // in each part the nearest line on either side takes half of the fabric; a line alone has the whole width
        let mut area = 0.0;
        for [a, b] in cuts.windows(2).map(|cut| [cut[0], cut[1]]) {
            let middle = 0.5 * (a + b);
            let mut sides = [f64::INFINITY; 2];
            for other in &others {
                let ([c, d], off) = (reach(other), place_across(other) - place_across(pair));
                if c < middle && d > middle {
                    let side = &mut sides[usize::from(off > 0.0)];
                    *side = side.min(off.abs());
                }
            }
            let half = |side: &f64| if side.is_finite() { 0.5 * side } else { 0.0 };
            let strip: f64 = sides.iter().map(half).sum();
            area += (b - a) * if strip > 0.0 { strip } else { width };
        }
        area / ((to - from) * width * families)
    };
    own.iter().map(tributary).collect()
}

/// The grippers along each yarn, line by line.
fn chains(
    lines: &[FabricLine],
    beside: &[[[Option<usize>; 2]; 2]],
    edges: &[Vec<Pair>; 2],
) -> Vec<(usize, Vec<usize>)> {
    let mut out = Vec::new();
    for (d, edges) in edges.iter().enumerate() {
        for start in edges.iter().map(|pair| pair.ends[0]) {
            if beside[start][d][0].is_some() {
                continue;
            }
            let mut chain = vec![start];
            let mut last = start;
            while let Some(line) = beside[last][d][1] {
                last = lines[line].ends[1];
                chain.push(last);
            }
            out.push((d, chain));
        }
    }
    out
}

#[cfg(test)]
#[path = "lines_tests.rs"]
pub(super) mod tests;
