//! The parameters of a front, and the vector of them that a search varies.

use super::fronts::flattest;
use super::preload::{against_errors, loads};
use super::tuning::TUNING;
use crate::ply::Neighbors;
use crate::scene::Scene;
use rayon::prelude::*;
use std::f64::consts::FRAC_PI_2;

/// Parameters of a front: where it starts, its shape, and how steep and how taut the ply is ahead of it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Strategy {
    /// Where the front starts, as shares of the fabric along u and v.
    pub start: [f64; 2],
    /// Ratio of the front's axes: 1 is a circle, a large number a line.
    pub ratio: f64,
    /// Direction of its longer axis in plan (rad).
    pub angle: f64,
    /// How square it is: 0 is an ellipse, 1 near a rectangle whose sides are across its axes, and −1 a rhombus.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "is_zero"))]
    pub squareness: f64,
    /// Curvature of the lifted ply right at the front A, times the shorter side of a cell.
    pub curvature: f64,
    /// Steepest slope of the lifted ply σ.
    pub slope: f64,
    /// Pretension: relative stretch of the net ahead of the front.
    pub pretension: f64,
    /// Load with which grippers on mounts press when they land, as a share of the largest; without meaning for rigid ones.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "is_zero"))]
    pub press: f64,
    /// Pull with which grippers on mounts hold the free ply taut, 0 to 2; without meaning for rigid ones. At 1 a line inside the ply is pulled by a
    /// quarter of the load that a gripper may carry.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "is_zero"))]
    pub pull: f64,
}

#[cfg(feature = "serde")]
/// Whether there is none, which is not written.
fn is_zero(share: &f64) -> bool {
    *share == 0.0
}

/// Ratio of a front's axes from which on it counts as a line.
const LINE: f64 = 100.0;

/// Numbers that an evolution varies: those of rigid grippers.
pub const DIMENSION: usize = TUNING.front.ranges.len();

impl Strategy {
    /// As a point whose every coordinate goes from 0 to 1; what counts for grippers on mounts alone is not in it.
    #[must_use]
    pub fn to_unit(&self) -> [f64; DIMENSION] {
        let values = [
            self.start[0],
            self.start[1],
            self.ratio.ln(),
            self.angle,
            self.curvature.ln(),
            self.slope.ln(),
            self.pretension,
        ];
        let mut unit = [0.0; DIMENSION];
        for n in 0..DIMENSION {
            let [low, high] = TUNING.front.ranges[n];
            unit[n] = ((values[n] - low) / (high - low)).clamp(0.0, 1.0);
        }
        unit
    }

    /// From such a point; a coordinate beyond 0 or 1 is reflected there, so that the score of a search has no wall.
    #[must_use]
    pub fn of_unit(unit: &[f64]) -> Self {
        let value = |n: usize| {
            let [low, high] = TUNING.front.ranges[n];
            let folded = unit[n].rem_euclid(2.0);
            low + (high - low) * if folded > 1.0 { 2.0 - folded } else { folded }
        };
        Strategy {
            start: [value(0), value(1)],
            ratio: value(2).exp(),
            angle: value(3),
            squareness: 0.0,
            curvature: value(4).exp(),
            slope: value(5).exp(),
            pretension: value(6),
            press: 0.0,
            pull: 0.0,
        }
    }

    /// Whether all numbers are in their range of definition.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        let Strategy { start, ratio, angle, squareness, curvature, slope, pretension, press, pull } =
            *self;
        let numbers = [
            start[0], start[1], ratio, angle, squareness, curvature, slope, pretension, press, pull,
        ];
        numbers.iter().all(|n| n.is_finite()) && ratio > 0.0 && curvature > 0.0 && slope > 0.0
    }

    /// The first candidates, those that most molds take first. `steepest` is the steepest slope that the tilt of the
    /// grippers leaves to a front of this shape.
    #[must_use]
    pub fn families(scene: &Scene, steepest: impl Fn(Strategy) -> f64 + Sync) -> Vec<Strategy> {
        let [first, second] = principal_directions(scene);
        let shape = |ratio, angle| Strategy { ratio, angle, ..Strategy::ring() };
        let shapes = [
            shape(1.0, 0.0),
            shape(LINE, second),
            shape(LINE, first),
            shape(2.5, second),
            shape(2.5, first),
        ];
        let on_mounts = scene.layup.settings.pad.gives();
        let steep = |shape: &Strategy| Strategy { slope: steepest(*shape), ..*shape };
        if on_mounts {
            let shapes = shapes.map(|shape| shape.preloaded(scene));
            let shapes: Vec<Strategy> = shapes.par_iter().map(steep).collect();
            // ellipses and rounded rectangles along the lines of cups, so that whole lines of them land together
            let [along, across] = line_directions(scene);
            let aligned =
                |ratio, angle, squareness| Strategy { ratio, angle, squareness, ..shapes[0] };
            let aligned = [
                aligned(1.0, along, 0.6),
                aligned(1.4, along, 0.0),
                aligned(1.4, across, 0.0),
                aligned(2.2, along, 0.0),
                aligned(2.2, across, 0.0),
                aligned(1.0, along, -0.6),
                aligned(1.4, along, 0.6),
                aligned(1.4, across, 0.6),
                aligned(2.2, along, 0.6),
                aligned(2.2, across, 0.6),
            ];
            let aligned: Vec<Strategy> = aligned.par_iter().map(steep).collect();
            let looser = |base: &Strategy| Strategy { pull: 0.4 * base.pull, ..*base };
            let harder = |base: &Strategy| Strategy { press: (2.0 * base.press).min(1.0), ..*base };
            // a ply that is stiff in shear does not stay flat where a steep front shears it
            let flatter = |base: &Strategy| Strategy { slope: 0.5 * base.slope, ..*base };
            let steeper = |base: &Strategy| Strategy { slope: 1.3 * base.slope, ..*base };
            // what is stretched when it lands bridges a hollow
            let softer = |base: &Strategy| Strategy { pretension: 0.25 * base.pretension, ..*base };
            // a ply that is stiff in shear folds less ahead of a front that is not so sharp
            let rounder = |base: &Strategy| Strategy { curvature: 0.5 * base.curvature, ..*base };
            let sharper = |base: &Strategy| Strategy { curvature: 2.2 * base.curvature, ..*base };
            let [_, low] = shapes[0].low();
            let flat: Vec<Strategy> = shapes.iter().map(flatter).collect();
            let round: Vec<Strategy> = flat.iter().map(rounder).collect();
            let flattest: Vec<Strategy> = flat[1..].iter().map(flatter).collect();
            let loose: Vec<Strategy> = flat.iter().map(looser).collect();
            let soft: Vec<Strategy> = flat.iter().map(softer).collect();
            let hard: Vec<Strategy> = flat.iter().map(harder).collect();
            let aligned: Vec<Strategy> = aligned.iter().map(flatter).collect();
            // of each kind all shapes: those along the lines of cups and the circle of every kind first
            let kinds = [flat, round, hard, shapes, loose, soft];
            let circles = kinds.iter().filter_map(|kind| kind.first());
            let blunt: Vec<Strategy> = circles.clone().take(1).chain(&aligned).copied().collect();
            let sharp: Vec<Strategy> = blunt.iter().map(sharper).collect();
            let steep = sharp.iter().chain(&blunt).map(steeper);
            let rounded = blunt[1..].iter().map(rounder);
            let (at_once, later) = sharp.split_at(TUNING.search.batch.min(sharp.len()));
            let taut: Vec<Strategy> = at_once.iter().copied().map(Strategy::taut).collect();
            let first = [at_once, &[low.rhombic(), low], &taut, later, &blunt].concat();
            let first = first.into_iter().chain(circles.skip(1).copied());
            let first = first.chain(steep).chain(rounded);
            let others = kinds.iter().flat_map(|kind| kind.iter().skip(1).copied());
            let others = others.chain(flattest);
            return first.chain(others).collect();
        }
        let shapes: Vec<Strategy> = shapes.par_iter().map(steep).collect();
        let [ring, second_line, first_line, second_ellipse, first_ellipse] = shapes[..] else {
            return shapes;
        };
        let flatter = |share: f64, base: Strategy| Strategy { slope: share * base.slope, ..base };
        let loose = |base: Strategy| Strategy { curvature: 3.0, pretension: 0.0, ..base };
        let tauter = |base: Strategy| Strategy { pretension: 2.0 * base.pretension, ..base };
        let softer = |base: Strategy| Strategy { pretension: 0.5 * base.pretension, ..base };
        // where a cell is in the middle, both starts are one
        let cell = middle_of_cell(scene);
        let beside: &[Strategy] = match cell == ring.start {
            true => &[],
            false => &[Strategy { start: cell, ..softer(ring) }, Strategy { start: cell, ..ring }],
        };
        let rings_and_ellipses = [
            ring,
            flatter(0.8, ring),
            softer(ring),
            tauter(ring),
            softer(second_ellipse),
            softer(first_ellipse),
            second_ellipse,
            first_ellipse,
            loose(ring),
            flatter(0.8, tauter(ring)),
        ];
        let others = [
            second_line,
            first_line,
            loose(second_ellipse),
            loose(first_ellipse),
            flatter(0.6, tauter(ring)),
            flatter(0.6, loose(ring)),
            loose(second_line),
            loose(first_line),
        ];
        [&rings_and_ellipses, beside, &others].concat()
    }

    /// Fronts for grippers on mounts which race before others are draped: low rings and rhombic ones, held taut, from where the drape begins, from the
    /// middle, and from the middle of a cell, so that no line of cups lands at once. On a mold that curves alike in all directions also low ones that
    /// are held as loosely as others; on other molds ellipses along the direction in which it curves least.
    #[must_use]
    pub fn racing_first(scene: &Scene, steepest: impl Fn(Strategy) -> f64 + Sync) -> Vec<Strategy> {
        let steep = |shape: Strategy| Strategy { slope: steepest(shape), ..shape };
        let ring = Strategy::ring().preloaded(scene);
        let [low, _] = steep(ring).low();
        let beside = Some(middle_of_cell(scene)).filter(|start| *start != low.start);
        let starts = [seed(scene), Some(low.start), beside].into_iter().flatten();
        let shapes = [low, low.rhombic()];
        let taut = starts.flat_map(|start| shapes.map(|base| Strategy { start, ..base.taut() }));
        match directions_of_curvature(scene) {
            Some([_, least]) => {
                taut.chain(steep(ring.elongated(least)).at_middle_slopes()).collect()
            }
            None => taut.chain(shapes).collect(),
        }
    }

    /// This one as an ellipse along a direction (rad), less sharp.
    fn elongated(self, angle: f64) -> Self {
        let [ratio, curvature] = TUNING.front.elongated;
        Strategy { ratio, angle, curvature, ..self }
    }

    /// This one with slopes between the low and the steepest ones: taut, less taut, and as loose as others, for molds with hollows.
    fn at_middle_slopes(self) -> [Strategy; 3] {
        let [flat, steep] = TUNING
            .front
            .elongated_slopes
            .map(|share| Strategy { slope: share * self.slope, ..self });
        [flat.taut(), Strategy { pull: 1.0, ..steep.taut() }, steep]
    }

    /// This one with low slopes, which errors of the grippers matter less to.
    fn low(self) -> [Strategy; 2] {
        TUNING.front.low_slopes.map(|share| Strategy { slope: share * self.slope, ..self })
    }

    /// This one across the lines of cups: a ring runs along whole lines at the ends of a long array, and ridges stay beside them.
    fn rhombic(self) -> Strategy {
        Strategy { squareness: TUNING.front.rhombic, ..self }
    }

    /// This one with more pull, so that a ply that is sheared in the air stays flat, and less press.
    fn taut(self) -> Strategy {
        let [pull, press] = TUNING.front.pulled;
        Strategy { pull, press, ..self }
    }

    /// This strategy for grippers on mounts: steeper and sharper, because those give where the ply is pulled too far; and pulled and
    /// pressed at least as hard as the errors of the grippers need.
    fn preloaded(self, scene: &Scene) -> Self {
        let front = TUNING.front;
        let curvature = front.ranges[4][1].exp();
        let slope = front.steepest_on_mounts;
        let ([pull, press], [lateral, axial]) = (against_errors(scene), loads(scene));
        let pull = (pull / (TUNING.preload.pull * lateral)).clamp(0.6, 1.0);
        let press = (press / (TUNING.preload.press * axial)).clamp(0.6, 1.0);
        Strategy { curvature, slope, press, pull, ..self }
    }

    /// Whether its front is a line, which rolls the ply on; others spread from a point.
    #[must_use]
    pub fn is_line(&self) -> bool {
        self.ratio >= LINE
    }

    /// A ring as flat as possible: all of the ply comes down nearly together.
    #[must_use]
    pub fn flat() -> Self {
        Strategy { slope: flattest(), ..Strategy::ring() }
    }

    /// A ring that spreads from the middle of the ply, as steep as no tilt forbids.
    fn ring() -> Self {
        let slope = TUNING.front.steepest;
        let (start, ratio, angle) = ([0.5; 2], 1.0, 0.0);
        Strategy {
            start,
            ratio,
            angle,
            squareness: 0.0,
            curvature: 5.0,
            slope,
            pretension: 1.2e-3,
            press: 0.0,
            pull: 0.0,
        }
    }
}

/// Where the ideal drape begins, as shares of the fabric, if that is more than half a cell from the middle.
fn seed(scene: &Scene) -> Option<[f64; 2]> {
    let placement = scene.layup.target.as_ref()?.drape.as_ref()?.placement;
    let [low, high] = scene.layup.ply.held_bounds();
    let share = |n: usize| {
        let place = placement.origin[n] + placement.seed[n] as f64 * placement.mesh[n];
        // a strip has no width between its grippers
        if high[n] > low[n] { ((place - low[n]) / (high[n] - low[n])).clamp(0.0, 1.0) } else { 0.5 }
    };
    let start = [0, 1].map(share);
    let beside = |n: usize| (start[n] - 0.5).abs() * (high[n] - low[n]);
    let is_beside = (0..2).any(|n| beside(n) > 0.5 * scene.layup.ply.cell[n]);
    is_beside.then_some(start)
}

/// The middle of the cell that is nearest the middle of the ply, as shares of the fabric.
fn middle_of_cell(scene: &Scene) -> [f64; 2] {
    let [low, high] = scene.layup.ply.held_bounds();
    [0, 1].map(|n| {
        let cells = ((high[n] - low[n]) / scene.layup.ply.cell[n]).round().max(1.0) as usize;
        ((cells / 2) as f64 + if cells % 2 == 1 { 0.5 } else { -0.5 }) / cells as f64
    })
}

/// [`directions_of_curvature`]; where there are none, those of a saddle in the middle of the drape, or else of the lines of grippers.
fn principal_directions(scene: &Scene) -> [f64; 2] {
    let directions = directions_of_curvature(scene).or_else(|| directions_of_saddle(scene));
    directions.unwrap_or_else(|| line_directions(scene))
}

/// Directions in plan (rad) in which a saddle curves up and down, in the middle of the drape; `None` where the mold curves one way alone.
fn directions_of_saddle(scene: &Scene) -> Option<[f64; 2]> {
    let (mold, target) = (scene.layup.mold.as_ref()?, scene.layup.target.as_ref()?);
    let count = target.grippers.len() as f64;
    let middle = [0, 1, 2].map(|n| target.grippers.iter().map(|p| p[n]).sum::<f64>() / count);
    let curvatures = mold.curvatures(middle);
    let is_saddle = curvatures.principal[0] * curvatures.principal[1] < 0.0;
    is_saddle.then(|| curvatures.directions.map(|d| folded(d[1].atan2(d[0]))))
}

/// Directions in plan (rad) in which the mold curves most and least below the grippers, whether down or up; `None` where it curves alike in all
/// directions. They are those of the sum of the squares of its curvature tensors, in plan.
fn directions_of_curvature(scene: &Scene) -> Option<[f64; 2]> {
    let (mold, target) = (scene.layup.mold.as_ref()?, scene.layup.target.as_ref()?);
    let [mut mean, mut cos, mut sin] = [0.0; 3];
    for gripper in &target.grippers {
        let curvatures = mold.curvatures(*gripper);
        for (curvature, way) in curvatures.principal.into_iter().zip(curvatures.directions) {
            let (square, angle) = (0.5 * curvature * curvature, 2.0 * way[1].atan2(way[0]));
            (mean, cos, sin) =
                (mean + square, cos + square * angle.cos(), sin + square * angle.sin());
        }
    }
    let [most, least] =
        [mean + cos.hypot(sin), mean - cos.hypot(sin)].map(|sum| sum.max(0.0).sqrt());
    let angle = folded(0.5 * sin.atan2(cos));
    (most - least > TUNING.front.umbilic * most).then(|| [angle, folded(angle + FRAC_PI_2)])
}

/// Directions in plan (rad) of the lines of grippers on the mold, along the first of them and across it.
fn line_directions(scene: &Scene) -> [f64; 2] {
    let ply = &scene.layup.ply;
    let Some(target) = scene.layup.target.as_ref() else { return [0.0, FRAC_PI_2] };
    let plane = |places: [[f64; 2]; 2]| [places[1][0] - places[0][0], places[1][1] - places[0][1]];
    let neighbors = ply.neighbors();
    let fabric = |pair: &Neighbors| plane(pair.grippers.map(|n| ply.place(n)));
    let Some(first) = neighbors.first().map(fabric) else { return [0.0, FRAC_PI_2] };
    // a line has no sense: its mean direction is half of that of the doubled angles
    let mut sums = [[0.0; 2]; 2];
    for pair in &neighbors {
        let way = fabric(pair);
        let along = way[0] * first[0] + way[1] * first[1];
        let aside = way[0] * first[1] - way[1] * first[0];
        let [x, y] = plane(pair.grippers.map(|n| [target.grippers[n][0], target.grippers[n][1]]));
        let sum = &mut sums[usize::from(aside.abs() > along.abs())];
        *sum = [sum[0] + x * x - y * y, sum[1] + 2.0 * x * y];
    }
    let [along, across] = sums.map(|[cos, sin]| 0.5 * sin.atan2(cos));
    [folded(along), if sums[1] == [0.0; 2] { folded(along + FRAC_PI_2) } else { folded(across) }]
}

/// A direction without a sense, between ±90° (rad).
fn folded(angle: f64) -> f64 {
    let pi = std::f64::consts::PI;
    (angle + 0.5 * pi).rem_euclid(pi) - 0.5 * pi
}
