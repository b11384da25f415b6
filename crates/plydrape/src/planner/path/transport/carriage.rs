//! The steps in which an array is lifted, carried and lowered as a rigid body.
//!
//! What is planned are control points of a cubic B-spline (`docs/theory`, section 18), which rounds corners and draws
//! in what turns. So the height is found for the spline, and the control points are turned in such a way that the
//! spline is rigid at its knots: with the rotations R_k that it shall have there, they are the matrices A_k of
//! `A_(k−1) + 4 A_k + A_(k+1) = 6 R_k`.

use super::clearance::Clearance;
use super::turn::{Rotation, Turn, center, turned};
use crate::geometry::Point;
use crate::geometry::vector::{along, distance, sub};
use crate::mold::Mold;
use crate::motion::farthest;
use crate::planner::path::tuning::TUNING;
use crate::scene::Scene;

/// The way of an array as a rigid body.
#[derive(Debug)]
pub struct Carriage<'a> {
    clearance: Clearance<'a>,
    turn: Turn,
    /// Center of the array at its start and where it is formed (m).
    ends: [Point; 2],
    /// The start, from its center (m).
    array: Vec<Point>,
    /// Lowest height of the center over the place where the array is formed (m).
    lowest: f64,
    /// Length of the way at one height (m), of the gripper that goes farthest.
    level: f64,
    /// Farthest way of a gripper while the array is formed, from its lowest height on (m).
    forming: f64,
    /// Unit of length (m).
    cell: f64,
}

/// Control points of the way: the center (m), and the share of the turn.
type Control = (Point, f64);

impl<'a> Carriage<'a> {
    /// The way of the grippers of a scene from its start to where they form a shape (m).
    pub fn new(scene: &'a Scene, mold: &'a Mold, start: &[Point], shape: &[Point]) -> Self {
        let ends = [center(start), center(shape)];
        let clearance = Clearance::new(scene, mold, start, ends[1]);
        let turn = Turn::new(&scene.layup.ply, start, shape);
        let array: Vec<Point> = start.iter().map(|p| sub(*p, ends[0])).collect();
        let lowest = ends[1][2] + clearance.shortfall_over_mold(ends[1], &turn.at(1.0)).max(0.0);
        let there = [ends[1][0], ends[1][1], lowest];
        let there: Vec<Point> = placed(&array, there, &turn.at(1.0));
        let forming = farthest(&there, shape);
        let cell = scene.layup.ply.shorter_side();
        let mut carriage =
            Carriage { clearance, turn, ends, array, lowest, level: 0.0, forming, cell };
        carriage.level = carriage.length();
        carriage
    }

    /// Positions (m) of its steps in a plan of this many: the start is the first, the place where the array is formed the
    /// last. Only the start, where there is no step for so short a way.
    pub fn positions(&self, start: &[Point], steps: usize) -> Vec<Vec<Point>> {
        let controls = self.clear_controls(steps);
        let last = controls.len() - 1;
        let rounded = |k: usize| self.turn.at(spline(&controls, k, 0.0).1);
        let rotations = control_rotations((0..=last).map(rounded).collect());
        let place = |k: usize| match k {
            0 => start.to_vec(),
            _ => placed(&self.array, controls[k].0, &rotations[k]),
        };
        (0..=last).map(place).collect()
    }

    /// The control points of the lowest way that is clear.
    fn clear_controls(&self, steps: usize) -> Vec<Control> {
        let mut low = self.ends[0][2].max(self.lowest);
        let mut high = low;
        let mut controls = self.controls(high, steps);
        let enough = TUNING.transport.tolerance * TUNING.transport.margin * self.cell;
        for _ in 0..TUNING.transport.rounds {
            let shortfall = self.shortfall(&controls);
            if shortfall <= enough {
                break;
            }
            (low, high) = (high, high + shortfall);
            controls = self.controls(high, steps);
        }
        // where a corner is rounded over a steep place, the last round raised it too far
        while high - low > TUNING.transport.spare * self.cell {
            let middle = 0.5 * (low + high);
            let lower = self.controls(middle, steps);
            if self.shortfall(&lower) > enough {
                low = middle;
            } else {
                (high, controls) = (middle, lower);
            }
        }
        controls
    }

    /// The control points of a way at one height (m), as many for each part of it as its length asks for.
    fn controls(&self, height: f64, steps: usize) -> Vec<Control> {
        let transport = TUNING.transport;
        let [start, end] = self.ends;
        let lowered = height.min(self.lowest + transport.forming_height * self.cell);
        let lengths = [height - start[2], self.level, height - lowered];
        let way: f64 = lengths.iter().sum();
        let forming = self.forming + lowered - self.lowest;
        let share = if way > 0.0 { way / (way + forming) } else { 0.0 };
        let count = (transport.carrying * steps as f64 * share).round();
        if count == 0.0 {
            return vec![(start, 0.0)];
        }
        // a part that is much shorter than a step joins the next one
        let [lift, level, lowering] =
            lengths.map(|length| (length / way * count - 0.02).ceil().max(0.0));
        let turning = (self.turn.angle() / transport.turn).ceil();
        let level = level.max(turning.min((transport.most_turning * steps as f64).floor()));
        let corners = [
            (start, 0.0),
            ([start[0], start[1], height], 0.0),
            ([end[0], end[1], height], 1.0),
            ([end[0], end[1], lowered], 1.0),
        ];
        let mut controls = vec![corners[0]];
        for (pair, parts) in corners.windows(2).zip([lift, level, lowering]) {
            let ((from, s), (to, t)) = (pair[0], pair[1]);
            controls.extend((1..=parts as usize).map(|k| {
                let part = k as f64 / parts;
                (along(from, part, sub(to, from)), s + part * (t - s))
            }));
        }
        controls
    }

    /// By how much the spline of control points is too low where that is worst (m).
    fn shortfall(&self, controls: &[Control]) -> f64 {
        let transport = TUNING.transport;
        let legs = controls.len().saturating_sub(1);
        // a corner is rounded within legs beside it, however short these are
        let leg = |pair: &[Control]| farthest(&self.array_at(pair[0]), &self.array_at(pair[1]));
        let longest = controls.windows(2).map(leg).fold(0.0, f64::max);
        let parts = (longest / (transport.sampling * self.cell)).ceil() as usize;
        let parts = parts.clamp(1, (transport.most_samples / legs.max(1)).max(1));
        let (mut shortfall, mut worst) = (f64::NEG_INFINITY, 0.0);
        let mut width = 1.0 / parts as f64;
        for sample in 1..=legs * parts {
            let at = sample as f64 * width;
            let short = self.shortfall_at(controls, at);
            if short > shortfall {
                (shortfall, worst) = (short, at);
            }
        }
        // the worst place is between two samples
        for _ in 0..if legs > 0 { transport.halvings } else { 0 } {
            width *= 0.5;
            for at in [worst - width, worst + width].map(|at| at.clamp(0.0, legs as f64)) {
                let short = self.shortfall_at(controls, at);
                if short > shortfall {
                    (shortfall, worst) = (short, at);
                }
            }
        }
        shortfall
    }

    /// By how much the spline is too low at a parameter that counts legs (m).
    fn shortfall_at(&self, controls: &[Control], at: f64) -> f64 {
        let leg = (at as usize).min(controls.len() - 2);
        let (center, turned) = spline(controls, leg, at - leg as f64);
        let rotation = self.turn.at(turned);
        // a table is on the first half of the way: the mold may be lower
        if turned < 0.5 {
            self.clearance.shortfall(center, &rotation)
        } else {
            self.clearance.shortfall_over_mold(center, &rotation)
        }
    }

    /// Length of the way at one height (m), of the gripper that goes farthest.
    fn length(&self) -> f64 {
        let parts = (self.turn.angle() / TUNING.transport.turn).ceil().max(1.0) as usize;
        let [from, to] = self.ends.map(|p| [p[0], p[1], 0.0]);
        let array = |k: usize| {
            let part = k as f64 / parts as f64;
            self.array_at((along(from, part, sub(to, from)), part))
        };
        let mut lengths = vec![0.0; self.array.len()];
        for k in 0..parts {
            for ((sum, a), b) in lengths.iter_mut().zip(array(k)).zip(array(k + 1)) {
                *sum += distance(a, b);
            }
        }
        lengths.into_iter().fold(0.0, f64::max)
    }

    fn array_at(&self, (center, share): Control) -> Vec<Point> {
        placed(&self.array, center, &self.turn.at(share))
    }
}

/// An array (m) turned, with its center at a place.
fn placed(array: &[Point], center: Point, rotation: &Rotation) -> Vec<Point> {
    array.iter().map(|p| along(center, 1.0, turned(rotation, *p))).collect()
}

/// The cubic B-spline with evenly spaced knots at a share `t` of the way from knot `k` to the next; it begins and ends at
/// the first and the last control point.
fn spline(controls: &[Control], k: usize, t: f64) -> Control {
    let last = controls.len() - 1;
    let control = |n: usize| controls[n.min(last)];
    let reflected = |a: Control, b: Control| (along(a.0, 1.0, sub(a.0, b.0)), 2.0 * a.1 - b.1);
    let before = if k == 0 { reflected(control(0), control(1)) } else { control(k - 1) };
    let after = |n: usize| match n {
        _ if n <= last => control(n),
        _ if n == last + 1 => reflected(control(last), control(last.saturating_sub(1))),
        _ => control(last),
    };
    let (s, cubes) = (1.0 - t, t * t * t);
    let weights = [
        s * s * s / 6.0,
        (4.0 - 6.0 * t * t + 3.0 * cubes) / 6.0,
        (1.0 + 3.0 * t + 3.0 * t * t - 3.0 * cubes) / 6.0,
        cubes / 6.0,
    ];
    let points = [before, after(k), after(k + 1), after(k + 2)];
    let mut sum = ([0.0; 3], 0.0);
    for (weight, (place, share)) in weights.into_iter().zip(points) {
        sum = (along(sum.0, weight, place), sum.1 + weight * share);
    }
    sum
}

/// The matrices of control points whose spline has these rotations at its knots; the first and the last stay.
fn control_rotations(knots: Vec<Rotation>) -> Vec<Rotation> {
    let last = knots.len() - 1;
    let mut out = knots.clone();
    if last < 2 {
        return out;
    }
    // elimination forwards, then substitution backwards, for every entry of the matrices
    let mut pivots = vec![4.0; last];
    for k in 1..last {
        let [before, after] = [k - 1, k + 1].map(|n| if n == 0 || n == last { 1.0 } else { 0.0 });
        let factor = if k > 1 { 1.0 / pivots[k - 1] } else { 0.0 };
        pivots[k] = 4.0 - factor;
        for r in 0..3 {
            for c in 0..3 {
                let known = before * knots[0][r][c] + after * knots[last][r][c];
                let eliminated = if k > 1 { factor * out[k - 1][r][c] } else { 0.0 };
                out[k][r][c] = 6.0 * knots[k][r][c] - known - eliminated;
            }
        }
    }
    for k in (1..last).rev() {
        for r in 0..3 {
            for c in 0..3 {
                let next = if k + 1 < last { out[k + 1][r][c] } else { 0.0 };
                out[k][r][c] = (out[k][r][c] - next) / pivots[k];
            }
        }
    }
    out
}
