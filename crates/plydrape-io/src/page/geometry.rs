//! What the page draws: ply, grippers, contact and mold, in micrometers and hundredths of a degree.

use super::Form;
use super::block::Block;
use crate::mold_patch::mold_patch;
use crate::result::ResultFile;
use crate::surface::{Surface, contact_lines, lines, stations};
use plydrape::draping::record::Step;
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

/// Micrometers in a meter.
pub(super) const MICRO: f64 = 1e6;

/// How finely a result is drawn, and what is left out for it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Detail {
    /// Intervals along each side of a cell.
    pub intervals: usize,
    /// Whether diagonals are drawn.
    pub diagonals: bool,
    /// The steps that are shown, by their index.
    pub steps: Vec<usize>,
}

impl Detail {
    /// The finest that keeps the page small.
    pub fn of(result: &ResultFile) -> Self {
        let (grid, all) = (result.scene.ply.lines().surface(), result.steps.len());
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
        // the last step is always shown
        let steps = (0..all).rev().step_by(every.max(1)).collect::<Vec<_>>();
        Detail { intervals: coarsest, diagonals: false, steps: steps.into_iter().rev().collect() }
    }

    /// What is left out, in sentences.
    pub fn left_out(&self, all: usize) -> Vec<String> {
        let mut out = Vec::new();
        if !self.diagonals {
            out.push("The diagonals are left out: the array is large.".into());
        }
        if self.steps.len() < all {
            out.push(format!(
                "{} of {all} steps are shown; steps.csv and result.json hold all of them.",
                self.steps.len()
            ));
        }
        out
    }
}

/// Integers and triangles that the page draws.
#[derive(Serialize)]
pub(super) struct Geometry {
    surface: Block,
    gap: Option<Block>,
    /// Fiber lines where they are no lines of a surface.
    fibres: Option<Block>,
    diagonals: Block,
    grippers: Block,
    normals: Block,
    shear: Block,
    direction: Block,
    contacts: Contacts,
    mold: Option<Mold>,
}

#[derive(Serialize)]
struct Contacts {
    counts: Vec<usize>,
    points: Block,
}

#[derive(Serialize)]
struct Mold {
    vertices: Vec<f64>,
    triangles: Vec<u32>,
}

/// Lowest and highest values over all steps: height and gap (mm), shear and fiber direction (°).
pub(super) struct Ranges {
    pub height: [f64; 2],
    pub gap: Option<[f64; 2]>,
    pub shear: [f64; 2],
    pub direction: [f64; 2],
}

pub(super) fn micrometres(p: &[f64; 3]) -> [i32; 3] {
    p.map(|c| (c * MICRO).round() as i32)
}

pub(super) fn hundredths(degrees: f64) -> i32 {
    (degrees * 1e2).round() as i32
}

/// Lowest and highest of some integers, in a coarser unit; [0, 0] of none.
fn range(values: impl Iterator<Item = i32> + Clone, unit: f64) -> [f64; 2] {
    [values.clone().min(), values.max()].map(|v| v.map_or(0.0, |v| f64::from(v) / unit))
}

impl Geometry {
    /// Everything that is drawn, and the ranges of what its colors tell.
    pub fn of(result: &ResultFile, detail: &Detail, form: Form) -> (Self, Ranges) {
        let (graph, n) = (result.scene.ply.lines(), detail.intervals);
        let grid = graph.surface();
        let steps: Vec<&Step> = detail.steps.iter().map(|k| &result.steps[*k]).collect();
        let count = steps.len();
        // edges of a whole array are lines of the surface
        let alone = grid == Grid::NONE && !graph.is_empty();
        let drawn = if detail.diagonals { graph.catenaries() } else { graph.edges() };
        // ply, diagonals and contact marks of each step
        let shapes = steps.par_iter().map(|step| {
            let curves = result.curves(step);
            let mut fibres = match alone || drawn > graph.edges() {
                true => lines(result, step, &curves, n),
                false => Vec::new(),
            };
            let across = fibres.split_off(graph.edges().min(fibres.len()));
            let across = if drawn > graph.edges() { across.concat() } else { Vec::new() };
            let along = if alone { fibres.concat() } else { Vec::new() };
            (
                Surface::of(result, step, &curves, n),
                [along, across],
                contacts(result, step, &curves),
            )
        });
        let shapes: Vec<_> = shapes.collect();
        let points = |p: &mut dyn Iterator<Item = [f64; 3]>| -> Vec<i32> {
            p.flat_map(|p| micrometres(&p)).collect()
        };
        let surface = points(&mut shapes.iter().flat_map(|(s, ..)| s.vertices.iter().copied()));
        let gap: Option<Vec<i32>> = result.scene.mold.as_ref().map(|_| {
            let all = shapes.iter().filter_map(|(s, ..)| s.gap.as_ref()).flatten();
            all.map(|gap| (gap * MICRO).round() as i32).collect()
        });
        let [fibres, diagonals] = [0, 1]
            .map(|k| points(&mut shapes.iter().flat_map(|(_, lines, _)| lines[k].iter().copied())));
        let hands = || steps.iter().flat_map(|step| &step.grippers);
        let grippers = points(&mut hands().map(|gripper| gripper.position));
        let normals: Vec<i32> =
            hands().flat_map(|g| g.normal().map(|c| (c * 1e4).round() as i32)).collect();
        // without a surface there is nothing to colour cell by cell
        let cells = || steps.iter().flat_map(|step| step.cells.iter().take(grid.cells()));
        let shear: Vec<i32> = cells().map(|cell| hundredths(cell.shear_deg)).collect();
        let direction: Vec<i32> =
            steps.iter().flat_map(|step| directions(result, step)).map(hundredths).collect();
        let marks: Vec<Vec<[f64; 3]>> = shapes.into_iter().map(|(_, _, marks)| marks).collect();

        let ranges = Ranges {
            height: range(surface.iter().skip(2).step_by(3).copied(), 1e3),
            gap: gap.as_ref().map(|gap| range(gap.iter().copied(), 1e3)),
            shear: range(shear.iter().copied(), 1e2),
            direction: range(direction.iter().copied(), 1e2),
        };
        let block = |steps: usize, components: usize, values: Vec<i32>| match form.packed {
            true => Block::new(steps, components, &values),
            false => Block::plain(steps, components, values),
        };
        let geometry = Geometry {
            surface: block(count, 3, surface),
            gap: gap.map(|gap| block(count, 1, gap)),
            fibres: alone.then(|| block(count, 3, fibres)),
            diagonals: block(count, 3, diagonals),
            grippers: block(count, 3, grippers),
            normals: block(count, 3, normals),
            shear: block(count, 1, shear),
            direction: block(count, 1, direction),
            contacts: Contacts {
                counts: marks.iter().map(Vec::len).collect(),
                points: block(1, 3, points(&mut marks.into_iter().flatten())),
            },
            mold: form.triangles.and_then(|most| mold(result, most)),
        };
        (geometry, ranges)
    }
}

/// Angle of the warp in each cell from the x axis, as seen from above (°): the mean of its two edges along the
/// warp. A fiber has no sign; angles stay within 90° of the warp at the first gripper of the first step.
fn directions(result: &ResultFile, step: &Step) -> Vec<f64> {
    let grid = result.scene.ply.lines().surface();
    let [[a, b], [c, d]] = match result.scene.ply.warp {
        Direction::U => [[1, 0], [0, 1]],
        Direction::V => [[0, 1], [1, 0]],
    };
    let angle = |step: &Step, [i, j]: [usize; 2]| {
        let at = |di: usize, dj: usize| step.grippers[grid.index([i + di, j + dj])].position;
        let edges = [[at(0, 0), at(a, b)], [at(c, d), at(a + c, b + d)]];
        let sum = |n: usize| edges.iter().map(|[from, to]| to[n] - from[n]).sum::<f64>();
        sum(1).atan2(sum(0)).to_degrees()
    };
    if grid.cells() == 0 {
        return Vec::new();
    }
    let middle = result.steps.first().map_or(0.0, |first| angle(first, [0, 0]));
    let cells = step.cells.iter().map(|cell| {
        let turn = (angle(step, cell.cell) - middle).rem_euclid(180.0);
        middle + if turn > 90.0 { turn - 180.0 } else { turn }
    });
    cells.collect()
}

/// Places where the ply touches the mold, evenly along everything that lies.
fn contacts(result: &ResultFile, step: &Step, curves: &[Vec<Vec<[f64; 3]>>]) -> Vec<[f64; 3]> {
    let [a, b] = result.scene.ply.cell;
    let marks = if result.scene.ply.lines().cells().len() <= SMALL { MARKS } else { 1.0 };
    let apart = a.min(b) / marks;
    let mut out = Vec::new();
    for line in contact_lines(step, curves, usize::MAX) {
        let (Some(first), Some(last)) = (line.first(), line.last()) else { continue };
        match (plydrape::mold::distance(*first, *last) / apart).round() as usize {
            0 => out.push(line[line.len() / 2]),
            count => out.extend(stations(&line, count)),
        }
    }
    out
}

/// The mold around the ply.
fn mold(result: &ResultFile, most: usize) -> Option<Mold> {
    let found = mold_patch(result, most)?;
    // the nearest micrometre in the fewest digits
    let short = |c: &f64| (c * MICRO).round() / MICRO;
    Some(Mold {
        vertices: found.vertices.iter().flatten().map(short).collect(),
        triangles: found.triangles.into_iter().flatten().collect(),
    })
}
