//! One step: what it should do, as least squares, and what it must keep to.
//!
//! All terms are linear in the moves of the grippers, their derivatives exact
//! ([`crate::planner::sensitivity`]). Objective: the height of each gripper above the mold; edges as long
//! as they will lie; the way to where grippers and points about to touch belong, weighed by how near they
//! are; rolling, the rise of the ply from the mold at each contact end; a little smoothness. What the step
//! must keep to is in `bounds`.

use super::front::Front;
use crate::draping::spans::{FreeSpan, Point};
use crate::mold::vector::{dot, sub};
use crate::planner::program::{MM, Program};
use crate::planner::sensitivity::{Quantity, Sensitivity};
use crate::scene::Scene;

/// Pull beyond the length that an edge is meant to have, as a share of the whole edge.
const PULL: f64 = 5e-5;

/// What an edge over a hollow is looser than it will lie, as a share of the whole edge: too short it would
/// bridge the hollow, too long it is drawn taut at the end.
const LOOSE: f64 = 2e-4;

/// Height (mm) at which what lands next counts half.
const NEAR: f64 = 1.0;

/// Weights of the objective, of residuals in millimetres.
mod weight {
    pub const HEIGHT: f64 = 1.0;
    pub const LENGTH: f64 = 100.0;
    pub const PLACE: f64 = 1e-2;
    pub const LANDING: f64 = 1.0;
    pub const ROLLING: f64 = 1e-3;
    pub const SMOOTH: f64 = 1e-2;
}

/// What one step starts from.
pub struct Step<'a> {
    pub scene: &'a Scene,
    pub targets: &'a [Point],
    pub front: &'a Front,
    pub positions: &'a [Point],
    /// Grippers that have arrived and keep still.
    pub arrived: &'a [bool],
    /// The last moves (m).
    pub before: &'a [[f64; 3]],
    /// Something has touched.
    pub landing: bool,
    /// Farthest that a gripper may move (m).
    pub reach: f64,
    /// Grippers that are to come down do so on their places.
    pub firm: bool,
}

impl Step<'_> {
    /// The moves of all grippers (m); none if the program has no solution.
    pub fn moves(&self, look: &Sensitivity) -> Option<Vec<[f64; 3]>> {
        let mut program = Program::new(self.positions.len());
        self.heights(look, &mut program);
        self.places(&mut program);
        self.lengths(look, &mut program);
        self.landings(look, &mut program);
        self.rolling(look, &mut program);
        self.smoothness(&mut program);
        self.limits(look, &mut program);
        self.reaches(look, &mut program);
        let x = program.solve()?;
        Some(x.chunks(3).map(|c| [c[0] / MM, c[1] / MM, c[2] / MM]).collect())
    }

    /// Whether a gripper stands on its place after this step: once it is down it stays where it is.
    pub(super) fn lands(&self, gripper: usize) -> bool {
        let way = sub(self.targets[gripper], self.positions[gripper]);
        let down = self.firm && self.front.height(gripper) <= 0.0;
        self.arrived[gripper] || (down && dot(way, way).sqrt() <= self.reach)
    }

    /// Height of a gripper above the mold, or above its target where there is no mold.
    pub(super) fn clearance(&self, look: &Sensitivity, gripper: usize) -> Quantity {
        look.clearance(gripper).unwrap_or_else(|| {
            let mut gradient = vec![0.0; look.width()];
            let normal = self.front.normal[gripper];
            gradient[3 * gripper..][..3].copy_from_slice(&normal);
            let value = dot(normal, sub(self.positions[gripper], self.targets[gripper]));
            Quantity { value, gradient }
        })
    }

    fn heights(&self, look: &Sensitivity, program: &mut Program) {
        for gripper in 0..self.positions.len() {
            let height = self.clearance(look, gripper);
            let miss = MM * (height.value - self.front.height(gripper));
            program.square(weight::HEIGHT, miss, &height.gradient);
        }
    }

    /// Along the mold, grippers go where they belong.
    fn places(&self, program: &mut Program) {
        for (gripper, target) in self.targets.iter().enumerate() {
            let way = sub(self.positions[gripper], *target);
            let normal = self.front.normal[gripper];
            let height = MM * self.front.height(gripper);
            let weight = weight::PLACE + weight::LANDING * nearness(height);
            for axis in 0..3 {
                // the part along the mold of the way in this axis
                let mut gradient = vec![0.0; 3 * self.positions.len()];
                for n in 0..3 {
                    let unit = f64::from(u8::from(n == axis));
                    gradient[3 * gripper + n] = unit - normal[axis] * normal[n];
                }
                let value = dot([0, 1, 2].map(|n| gradient[3 * gripper + n]), way);
                program.square(weight, MM * value, &gradient);
            }
        }
    }

    /// The edges that hang.
    pub(super) fn edges<'s>(&self, look: &'s Sensitivity) -> impl Iterator<Item = &'s FreeSpan> {
        let edges = self.scene.ply.grid.edges();
        look.shape.spans.iter().filter(move |span| span.catenary < edges)
    }

    pub(super) fn whole(&self, span: &FreeSpan) -> f64 {
        self.scene.ply.flat_length(self.scene.ply.grid.catenary(span.catenary).kind)
    }

    /// Edges hang taut; over a hollow they sag as deep as it is.
    fn lengths(&self, look: &Sensitivity, program: &mut Program) {
        for span in self.edges(look) {
            let excess = look.overstretch(span);
            let miss = MM * (excess.value - wanted_stretch(self.scene, span));
            program.square(weight::LENGTH, miss, &excess.gradient);
        }
    }

    /// Points that are about to touch, and the rise at the ends of what lies.
    fn landings(&self, look: &Sensitivity, program: &mut Program) {
        for span in self.edges(look) {
            let caught = (0..2).any(|end| look.gripper_at(span, end).is_none());
            for share in [0.25, 0.5, 0.75] {
                let Some(gap) = look.gap(span, share) else {
                    continue;
                };
                let weight = weight::LANDING * nearness(MM * gap.value);
                if caught || weight < 1e-3 {
                    continue;
                }
                let Some(error) = look.landing(span, share) else {
                    continue;
                };
                for axis in 0..2 {
                    let mut unit = [0.0; 3];
                    unit[axis] = 1.0;
                    let part = error.along(unit);
                    program.square(weight, MM * part.value, &part.gradient);
                }
            }
        }
    }

    /// The ply is rolled on: it should leave what lies along the mold.
    fn rolling(&self, look: &Sensitivity, program: &mut Program) {
        for span in self.edges(look) {
            for end in 0..2 {
                let lies = look.gripper_at(span, end).is_none_or(|gripper| self.arrived[gripper]);
                let free = look.gripper_at(span, 1 - end).is_some_and(|n| !self.arrived[n]);
                let Some(rise) = look.rise(span, end).filter(|_| lies && free) else {
                    continue;
                };
                // as the height that it makes at the other end
                let arm = span.length;
                let gradient: Vec<f64> = rise.gradient.iter().map(|g| arm * g).collect();
                program.square(weight::ROLLING, MM * arm * rise.value, &gradient);
            }
        }
    }

    fn smoothness(&self, program: &mut Program) {
        for (gripper, before) in self.before.iter().enumerate() {
            for n in 0..3 {
                program.near(weight::SMOOTH, 3 * gripper + n, MM * before[n]);
            }
        }
    }
}

/// Weight of what is `height` (mm) above where it lands: 1 there, less above.
fn nearness(height: f64) -> f64 {
    1.0 / (1.0 + (height.max(0.0) / NEAR).powi(2))
}

/// By how much the chord of an edge's span should exceed its length (m): taut, or less over a hollow, in which it
/// will lie.
pub fn wanted_stretch(scene: &Scene, span: &FreeSpan) -> f64 {
    let whole = scene.ply.flat_length(scene.ply.grid.catenary(span.catenary).kind);
    let sag = hollow(scene, span).powi(2) * span.length.powi(3) / 24.0;
    if sag > 0.0 { -sag - LOOSE * whole } else { PULL * whole }
}

/// How hollow the mold is below a span, along it (1/m); 0 where it is not.
fn hollow(scene: &Scene, span: &FreeSpan) -> f64 {
    let Some(mold) = &scene.mold else {
        return 0.0;
    };
    let middle = span.point(0.5);
    let foot = mold.closest_point(middle);
    let [a, b] = span.ends;
    let chord = sub(b, a);
    let aside = dot(chord, foot.normal);
    let tangent = [0, 1, 2].map(|n| chord[n] - aside * foot.normal[n]);
    let size = dot(tangent, tangent).sqrt();
    if size <= 0.0 {
        return 0.0;
    }
    (-mold.curvatures(middle).along(tangent.map(|c| c / size))).max(0.0)
}
