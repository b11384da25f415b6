//! Refinement of single grippers by gradients: a quadratic program finds smooth corrections of all trajectories, so
//! that the next contacts are where the ideal drape has them.
//!
//! The plan is followed once. At every step the position errors of the spans that are about to come into contact are
//! evaluated, with exact gradients to all gripper positions. A correction of a few
//! B-splines per gripper, zero at the first contact and at the end, is fitted to all of them at once, within
//! the linearized limits of overstretch. Contact events are not differentiated: whether the correction is
//! an improvement is decided by the complete drape.

use super::tuning::TUNING;
use crate::draping::Draping;
use crate::draping::spans::{FreeSpan, Point};
use crate::mold::vector::{along, cross, dot, unit};
use crate::planner::evaluation;
use crate::planner::program::Program;
use crate::planner::row::Row;
use crate::planner::sensitivity::Sensitivity;
use crate::planner::tuning;
use crate::scene::Scene;

/// B-splines of each gripper's correction.
const SPLINES: usize = TUNING.refinement.splines;

/// Smooth corrections (m) of all positions of a plan, one list of all grippers a step; none where nothing
/// comes into contact, or the program has no solution.
#[must_use]
pub fn correction(scene: &Scene, planned: &[Vec<Point>]) -> Option<Vec<Vec<Point>>> {
    let grippers = scene.ply.grid.grippers();
    let scene = evaluation::with_steps_cut(scene);
    let mut draping = Draping::new(&scene);
    let mut program = Program::new(&scene, grippers * SPLINES);
    let mut splines: Option<Splines> = None;
    for (k, positions) in evaluation::rounded(planned).iter().enumerate() {
        let shape = draping.move_to(positions);
        if draping.contacts.iter().all(Option::is_none) {
            continue;
        }
        let splines =
            splines.get_or_insert(Splines { from: k.saturating_sub(1), to: planned.len() - 1 });
        let weights = splines.at(k);
        let (positions, contacts) = (draping.positions.clone(), draping.contacts.clone());
        let sensitivity =
            Sensitivity::new(&scene, &mut draping.solver, &shape, &positions, &contacts);
        let mut terms =
            Terms { scene: &scene, sensitivity: &sensitivity, weights, program: &mut program };
        for span in &shape.spans {
            let edge = span.catenary < scene.ply.grid.edges();
            terms.position(span, edge);
            if edge {
                terms.stretch(span);
            }
        }
        terms.standing(&positions);
    }
    let splines = splines?;
    for n in 0..3 * grippers * SPLINES {
        program.near(TUNING.refinement.correction_weight, n, 0.0);
    }
    let moves = program.solve()?;
    let at = |k: usize| -> Vec<Point> {
        let weights = splines.at(k);
        (0..grippers)
            .map(|g| {
                [0, 1, 2].map(|c| {
                    let part = |j: usize| weights[j] * moves[3 * (j * grippers + g) + c];
                    (0..SPLINES).map(part).sum::<f64>() / program.scale
                })
            })
            .collect()
    };
    Some((0..planned.len()).map(at).collect())
}

/// Cubic B-splines over the steps from the first contact to the end.
struct Splines {
    from: usize,
    to: usize,
}

impl Splines {
    /// The value of each at a step.
    fn at(&self, step: usize) -> [f64; SPLINES] {
        let width = (self.to - self.from) as f64 / (SPLINES + 3) as f64;
        let mut out = [0.0; SPLINES];
        for (j, value) in out.iter_mut().enumerate() {
            let middle = self.from as f64 + width * (j + 2) as f64;
            let t = ((step as f64 - middle) / width).abs();
            *value = match t {
                t if t < 1.0 => 2.0 / 3.0 - t * t + 0.5 * t * t * t,
                t if t < 2.0 => (2.0 - t).powi(3) / 6.0,
                _ => 0.0,
            };
        }
        out
    }
}

/// The terms of one step in the program.
struct Terms<'a, 'b> {
    scene: &'a Scene,
    sensitivity: &'a Sensitivity<'b>,
    weights: [f64; SPLINES],
    program: &'a mut Program,
}

impl Terms<'_, '_> {
    /// A gradient to the positions of this step as one to all corrections.
    fn spread(&self, gradient: &Row) -> Row {
        let width = self.sensitivity.width();
        let part = |(spline, weight): (usize, &f64)| {
            let weight = *weight;
            gradient.entries().map(move |(n, g)| (spline * width + n, weight * g))
        };
        let weights = self.weights.iter().enumerate().filter(|(_, weight)| **weight != 0.0);
        weights.flat_map(part).collect()
    }

    /// The point of a span that comes into contact next shall be where the ideal drape has it; a diagonal, which is no
    /// fibre, counts along itself only.
    fn position(&mut self, span: &FreeSpan, edge: bool) {
        let Some(mold) = &self.scene.mold else { return };
        let near = TUNING.refinement.near * tuning::cell(self.scene);
        let share = match [0, 1].map(|end| self.sensitivity.gripper_at(span, end)) {
            [None, _] => TUNING.refinement.ahead,
            [_, None] => 1.0 - TUNING.refinement.ahead,
            _ if mold.signed_distance(span.point(0.5)) < near => 0.5,
            _ => return,
        };
        let Some(error) = self.sensitivity.landing(span, share) else { return };
        let ideal =
            [0, 1, 2].map(|n| self.sensitivity.fabric_place(span, share).point[n] - error.point[n]);
        let normal = mold.normal(ideal);
        let [x, y] = span.heading();
        let ahead = [x, y, 0.0];
        let Some(ahead) = unit(along(ahead, -dot(ahead, normal), normal)) else { return };
        let across = edge.then(|| cross(normal, ahead));
        for direction in [Some(ahead), across].into_iter().flatten() {
            let part = error.along(direction);
            let gradient = self.spread(&part.gradient);
            self.program.square(1.0, self.program.scale * part.value, &gradient);
        }
    }

    /// No span is stretched far beyond its fabric, and the stretch of taut spans is reduced.
    fn stretch(&mut self, span: &FreeSpan) {
        let scale = self.program.scale;
        let stretch = self.sensitivity.overstretch(span);
        let gradient = self.spread(&stretch.gradient);
        let whole = self.scene.ply.flat_length(self.scene.ply.grid.catenary(span.catenary).kind);
        let most = TUNING.refinement.stretch_share * self.scene.limits.overstretch * whole;
        self.program.at_most(&gradient, 1.0, scale * (most - stretch.value).max(0.0));
        let excess = (stretch.value - TUNING.refinement.taut * whole).max(0.0);
        self.program.square(1.0, scale * excess, &gradient);
    }

    /// A gripper that stands on the mold stays there.
    fn standing(&mut self, positions: &[Point]) {
        let Some(mold) = &self.scene.mold else { return };
        let tolerance = self.scene.settings.contact.tolerance;
        for (g, place) in positions.iter().enumerate() {
            if mold.signed_distance(*place) > tolerance {
                continue;
            }
            for c in 0..3 {
                let gradient = self.spread(&[(3 * g + c, 1.0)].into_iter().collect());
                self.program.square(TUNING.refinement.standing_weight, 0.0, &gradient);
            }
        }
    }
}
