//! The ply as a net of catenaries: lines, the surface between them, and where they touch the mold.
//!
//! Places are packed in micrometers, angles in hundredths of a degree.

use super::Form;
use super::block::Block;
use super::field::{Field, ends};
use super::packing::{MICRO, hundredths, micrometers};
use crate::result::ResultFile;
use crate::write::surface::{Surface, contact_lines, lines, stations};
use plydrape::draping::record::Cell;
use plydrape::geometry::distance;
use plydrape::measure::{Name, Verdict};
use plydrape::outcome::Step;
use plydrape::ply::{Direction, Grid};
use rayon::prelude::*;
use serde::Serialize;

/// Points of all steps that the page holds at most.
const MOST_POINTS: usize = 3_000_000;
/// Intervals along each side of a cell, from fine to coarse.
const INTERVALS: [usize; 6] = [12, 10, 8, 6, 4, 2];
/// Contact marks along a cell of a small array.
const MARKS: f64 = 8.0;
/// Cells up to which an array is small.
const SMALL: usize = 64;

/// How finely catenaries are drawn, and what is left out for it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Detail {
    /// Intervals along each side of a cell.
    pub intervals: usize,
    /// Whether diagonals are drawn.
    pub diagonals: bool,
    /// The steps that are drawn, by their index.
    pub steps: Vec<usize>,
}

impl Detail {
    /// The finest of this many steps that keeps the page small.
    pub fn new(result: &ResultFile, all: usize) -> Self {
        let grid = result.scene.ply.lines().surface();
        let surface =
            |n: usize| (grid.nu.saturating_sub(1) * n + 1) * (grid.nv.saturating_sub(1) * n + 1);
        let across = |n: usize| 2 * grid.cells() * (n + 1);
        let fits = |points: usize, steps: usize| points.saturating_mul(steps) <= MOST_POINTS;
        let whole = |n: &usize| fits(surface(*n) + across(*n), all);
        if let Some(intervals) = INTERVALS.into_iter().find(whole) {
            return Detail { intervals, diagonals: true, steps: (0..all).collect() };
        }
        let [.., coarsest] = INTERVALS;
        let every = (1..all).find(|k| fits(surface(coarsest), all.div_ceil(*k))).unwrap_or(all);
        // the last step is always drawn
        let steps = (0..all).rev().step_by(every.max(1)).collect::<Vec<_>>();
        Detail { intervals: coarsest, diagonals: false, steps: steps.into_iter().rev().collect() }
    }
}

/// Integers that the page draws catenaries from, over the steps that are drawn.
#[derive(Serialize)]
pub(super) struct Catenaries {
    /// Grippers along u and v; zeros where catenaries make no surface: they are no whole array, or lines are missing.
    grid: [usize; 2],
    /// Fabric between neighboring grippers along u and v (mm).
    pitch: [f64; 2],
    /// Intervals along each side of a cell.
    divisions: usize,
    surface: Block,
    gap: Option<Block>,
    /// Fiber lines where they are no lines of a surface.
    fibers: Option<Block>,
    diagonals: Block,
    shear: Block,
    direction: Block,
    contacts: Contacts,
}

#[derive(Serialize)]
struct Contacts {
    counts: Vec<usize>,
    points: Block,
}

/// What is drawn of one step.
struct Shape {
    surface: Surface,
    fibers: Vec<[f64; 3]>,
    diagonals: Vec<[f64; 3]>,
    contacts: Vec<[f64; 3]>,
}

impl Catenaries {
    /// The catenaries of the steps that are drawn, and what colors tell of them; `judged` are the verdicts of a model that decides.
    pub fn new(
        result: &ResultFile,
        steps: &[&Step],
        detail: &Detail,
        judged: &[Verdict],
        form: Form,
    ) -> (Self, Vec<Field>) {
        let grid = result.scene.ply.lines().surface();
        let shapes: Vec<Shape> = steps.par_iter().map(|step| shape(result, step, detail)).collect();
        let points = |select: fn(&Shape) -> &Vec<[f64; 3]>| -> Vec<i32> {
            shapes.iter().flat_map(select).flat_map(micrometers).collect()
        };

        // the surface, and the values at its vertices
        let surface = points(|shape| &shape.surface.vertices);
        let gap: Option<Vec<i32>> = result.scene.mold.as_ref().map(|_| {
            let all = shapes.iter().filter_map(|shape| shape.surface.gap.as_ref()).flatten();
            all.map(|gap| (gap * MICRO).round() as i32).collect()
        });

        // without a surface there is nothing to color cell by cell
        let in_cells = steps.iter().flat_map(|step| cells(step).iter().take(grid.cells()));
        let shear: Vec<i32> = in_cells.map(|cell| hundredths(cell.shear_deg)).collect();
        let first = steps.first().copied();
        let angles = steps.iter().flat_map(|step| directions(result, step, first));
        let direction: Vec<i32> = angles.map(hundredths).collect();

        let fields = match grid.cells() {
            0 => Vec::new(),
            _ => fields(&surface, gap.as_deref(), &shear, &direction, judged),
        };
        let block = |components, values| form.block(steps.len(), components, values);
        let contacts = Contacts {
            counts: shapes.iter().map(|shape| shape.contacts.len()).collect(),
            points: form.block(1, 3, points(|shape| &shape.contacts)),
        };
        let catenaries = Catenaries {
            grid: [grid.nu, grid.nv],
            pitch: result.scene.ply.cell.map(|side| side * 1e3),
            divisions: detail.intervals,
            gap: gap.map(|gap| block(1, gap)),
            fibers: are_alone(result).then(|| block(3, points(|shape| &shape.fibers))),
            diagonals: block(3, points(|shape| &shape.diagonals)),
            surface: block(3, surface),
            shear: block(1, shear),
            direction: block(1, direction),
            contacts,
        };
        (catenaries, fields)
    }
}

/// What colors tell, from heights in micrometers and angles in hundredths of a degree.
fn fields(
    surface: &[i32],
    gap: Option<&[i32]>,
    shear: &[i32],
    direction: &[i32],
    judged: &[Verdict],
) -> Vec<Field> {
    let in_units = |values: &[i32], unit: f64| ends(values.iter().map(|v| f64::from(*v) / unit));
    let heights = surface.iter().skip(2).step_by(3).map(|z| f64::from(*z) / 1e3);
    let mut out = vec![Field::new("height", "Height", "height", "mm", ends(heights))];
    if let Some(gap) = gap {
        let range = in_units(gap, 1e3);
        out.push(Field::of_measure("gap", "Gap", Name::Gap, judged, range));
    }
    let range = in_units(shear, 1e2);
    out.push(Field::of_measure("shear", "Shear", Name::Shear, judged, range).on_cells());
    let range = in_units(direction, 1e2);
    let direction = Field::new("direction", "Fiber direction", "warp direction", "°", range);
    out.push(direction.on_cells());
    out
}

/// Whether the fibers are drawn by themselves: those of a whole array are lines of the surface.
fn are_alone(result: &ResultFile) -> bool {
    let graph = result.scene.ply.lines();
    graph.surface() == Grid::NONE && !graph.is_empty()
}

/// Ply, diagonals and contact marks of a step.
fn shape(result: &ResultFile, step: &Step, detail: &Detail) -> Shape {
    let (graph, curves) = (result.scene.ply.lines(), result.curves(step));
    let drawn = if detail.diagonals { graph.catenaries() } else { graph.edges() };
    let mut along = match are_alone(result) || drawn > graph.edges() {
        true => lines(result, step, &curves, detail.intervals),
        false => Vec::new(),
    };
    let across = along.split_off(graph.edges().min(along.len()));
    Shape {
        surface: Surface::from_curves(result, step, &curves, detail.intervals),
        fibers: if are_alone(result) { along.concat() } else { Vec::new() },
        diagonals: if drawn > graph.edges() { across.concat() } else { Vec::new() },
        contacts: contacts(result, step, &curves),
    }
}

/// The cells of a step, i running fastest.
fn cells(step: &Step) -> &[Cell] {
    step.catenaries.as_ref().map_or(&[], |catenaries| &catenaries.cells)
}

/// Angle of the warp in each cell from the x axis, as seen from above (°): the mean of its two edges along the
/// warp. A fiber has no sign; angles stay within 90° of the warp at the first gripper of the first step.
fn directions(result: &ResultFile, step: &Step, first: Option<&Step>) -> Vec<f64> {
    let grid = result.scene.ply.lines().surface();
    let [[a, b], [c, d]] = match result.scene.ply.warp {
        Direction::U => [[1, 0], [0, 1]],
        Direction::V => [[0, 1], [1, 0]],
    };
    let angle = |step: &Step, [i, j]: [usize; 2]| {
        let corner = |di: usize, dj: usize| step.grippers[grid.index([i + di, j + dj])].position;
        let edges = [[corner(0, 0), corner(a, b)], [corner(c, d), corner(a + c, b + d)]];
        let sum = |n: usize| edges.iter().map(|[from, to]| to[n] - from[n]).sum::<f64>();
        sum(1).atan2(sum(0)).to_degrees()
    };
    if grid.cells() == 0 {
        return Vec::new();
    }
    let middle = first.map_or(0.0, |first| angle(first, [0, 0]));
    let angles = cells(step).iter().map(|cell| {
        let turn = (angle(step, cell.cell) - middle).rem_euclid(180.0);
        middle + if turn > 90.0 { turn - 180.0 } else { turn }
    });
    angles.collect()
}

/// Places where the ply touches the mold, evenly along everything that lies.
fn contacts(result: &ResultFile, step: &Step, curves: &[Vec<Vec<[f64; 3]>>]) -> Vec<[f64; 3]> {
    let [a, b] = result.scene.ply.cell;
    let marks = if result.scene.ply.lines().cells().len() <= SMALL { MARKS } else { 1.0 };
    let apart = a.min(b) / marks;
    let mut out = Vec::new();
    for line in contact_lines(step, curves, usize::MAX) {
        let (Some(first), Some(last)) = (line.first(), line.last()) else { continue };
        match (distance(*first, *last) / apart).round() as usize {
            0 => out.push(line[line.len() / 2]),
            count => out.extend(stations(&line, count)),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample;

    /// Large results are drawn coarser, then without diagonals, then in fewer steps, the last among them.
    #[test]
    fn large_results_are_drawn_coarser() {
        let small = Detail::new(&sample::draped(4, 2, 3), 3);
        assert_eq!((small.intervals, small.diagonals, small.steps.len()), (12, true, 3));
        let mut result = sample::draped(2, 2, 2);
        result.scene.ply.grid = Grid { nu: 100, nv: 100 };
        let large = Detail::new(&result, 200);
        assert!(!large.diagonals && large.steps.last() == Some(&199), "{large:?}");
        assert!(large.steps.len() * 199 * 199 <= MOST_POINTS);
    }
}
