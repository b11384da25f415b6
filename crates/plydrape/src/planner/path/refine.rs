//! Single grippers, refined by gradients: a quadratic program moves smooth corrections of all trajectories so
//! that what touches next lands where the ideal drape has it.
//!
//! The plan is followed once. At every step the spans of edges that are about to touch say by how much they
//! would land beside their place, with exact gradients to all gripper positions. A correction of a few
//! B-splines per gripper, zero at the start of the landing and at the end, is fitted to all of them at once, within
//! the limits of overstretch, linearized. Contact events are not differentiated: whether the correction is
//! an improvement is for the complete drape to say.

use crate::draping::Draping;
use crate::draping::spans::{FreeSpan, Point};
use crate::mold::vector::{along, cross, dot, unit};
use crate::planner::judge;
use crate::planner::program::{MM, Program};
use crate::planner::sensitivity::Sensitivity;
use crate::scene::Scene;

/// B-splines of each gripper's correction.
const SPLINES: usize = 5;
/// Coordinates beyond which the program would outgrow what the drapes cost.
const LARGEST: usize = 800;
/// Fabric ahead of a contact end whose landing is looked at, as a share of the catenary.
const AHEAD: f64 = 0.1;
/// Height (m) below which a span that has not touched is about to.
const NEAR: f64 = 5e-3;
/// Share of the overstretch limit that the correction may use.
const STRETCH: f64 = 0.5;
/// Stretch of a taut span, as a share of its edge: what is beyond is to go.
const TAUT: f64 = 1e-4;
/// Weight of the correction itself beside the landing errors.
const SMALL: f64 = 1e-2;
/// Weight of every gripper that has landed: it stays.
const LANDED: f64 = 1e2;
/// Smooth corrections (m) of all positions of a plan, one list of all grippers a step; none where nothing
/// touches, or the program has no solution or would be too large.
#[must_use]
pub fn correction(scene: &Scene, planned: &[Vec<Point>]) -> Option<Vec<Vec<Point>>> {
    let grippers = scene.ply.grid.grippers();
    if 3 * grippers * SPLINES > LARGEST {
        return None;
    }
    let scene = judge::as_judged(scene);
    let mut draping = Draping::new(&scene);
    let mut program = Program::new(grippers * SPLINES);
    let mut splines: Option<Splines> = None;
    for (k, positions) in judge::rounded(planned).iter().enumerate() {
        let shape = draping.move_to(positions);
        if draping.contacts.iter().all(Option::is_none) {
            continue;
        }
        let splines =
            splines.get_or_insert(Splines { from: k.saturating_sub(1), to: planned.len() - 1 });
        let weights = splines.at(k);
        let (positions, contacts) = (draping.positions.clone(), draping.contacts.clone());
        let look = Sensitivity::new(&scene, &mut draping.solver, &shape, &positions, &contacts);
        let mut rows = Rows { scene: &scene, look: &look, weights, program: &mut program };
        for span in &shape.spans {
            let edge = span.catenary < scene.ply.grid.edges();
            rows.landing(span, edge);
            if edge {
                rows.overstretch(span);
            }
        }
        rows.landed(&positions);
    }
    let splines = splines?;
    for n in 0..3 * grippers * SPLINES {
        program.near(SMALL, n, 0.0);
    }
    let moves = program.solve()?;
    let at = |k: usize| -> Vec<Point> {
        let weights = splines.at(k);
        (0..grippers)
            .map(|g| {
                [0, 1, 2].map(|c| {
                    let part = |j: usize| weights[j] * moves[3 * (j * grippers + g) + c];
                    (0..SPLINES).map(part).sum::<f64>() / MM
                })
            })
            .collect()
    };
    Some((0..planned.len()).map(at).collect())
}

/// Cubic B-splines over the steps of the landing.
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

/// Puts what one step has to say into the program.
struct Rows<'a, 'b> {
    scene: &'a Scene,
    look: &'a Sensitivity<'b>,
    weights: [f64; SPLINES],
    program: &'a mut Program,
}

impl Rows<'_, '_> {
    /// A gradient to the positions of this step as one to all corrections.
    fn spread(&self, gradient: &[f64]) -> Vec<f64> {
        self.weights.iter().flat_map(|w| gradient.iter().map(move |g| w * g)).collect()
    }

    /// What of a span touches next shall land where it belongs; of a diagonal, which is no fibre, along it.
    fn landing(&mut self, span: &FreeSpan, edge: bool) {
        let Some(mold) = &self.scene.mold else { return };
        let share = match [0, 1].map(|end| self.look.gripper_at(span, end)) {
            [None, _] => AHEAD,
            [_, None] => 1.0 - AHEAD,
            _ if mold.signed_distance(span.point(0.5)) < NEAR => 0.5,
            _ => return,
        };
        let Some(off) = self.look.landing(span, share) else { return };
        let ideal = [0, 1, 2].map(|n| self.look.fabric_place(span, share).point[n] - off.point[n]);
        let normal = mold.normal(ideal);
        let [x, y] = span.heading();
        let ahead = [x, y, 0.0];
        let Some(ahead) = unit(along(ahead, -dot(ahead, normal), normal)) else { return };
        let aside = edge.then(|| cross(normal, ahead));
        for direction in [Some(ahead), aside].into_iter().flatten() {
            let error = off.along(direction);
            let gradient = self.spread(&error.gradient);
            self.program.square(1.0, MM * error.value, &gradient);
        }
    }

    /// No span is pulled far beyond its fabric, and none is let loose.
    fn overstretch(&mut self, span: &FreeSpan) {
        let stretch = self.look.overstretch(span);
        let gradient = self.spread(&stretch.gradient);
        let whole = self.scene.ply.flat_length(self.scene.ply.grid.catenary(span.catenary).kind);
        let most = STRETCH * self.scene.limits.overstretch * whole;
        self.program.at_most(&gradient, 1.0, MM * (most - stretch.value).max(0.0));
        let excess = (stretch.value - TAUT * whole).max(0.0);
        self.program.square(1.0, MM * excess, &gradient);
    }

    /// What stands on the mold stays there.
    fn landed(&mut self, positions: &[Point]) {
        let Some(mold) = &self.scene.mold else { return };
        let tolerance = self.scene.settings.contact.tolerance;
        for (g, place) in positions.iter().enumerate() {
            if mold.signed_distance(*place) > tolerance {
                continue;
            }
            for c in 0..3 {
                let mut gradient = vec![0.0; 3 * positions.len()];
                gradient[3 * g + c] = 1.0;
                let gradient = self.spread(&gradient);
                self.program.square(LANDED, 0.0, &gradient);
            }
        }
    }
}
