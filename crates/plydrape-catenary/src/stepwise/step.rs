//! The program of one step: least squares with constraints.
//!
//! All terms are linear in the moves of the grippers, with exact derivatives
//! ([`crate::sensitivity`]). Objective, eq. (15) of `docs/theory/planner.md`: the height of each gripper above
//! the mold; the stretch of edges; position errors of grippers and of points about to come into contact, with a weight
//! that grows as they come near; rolling, the rise of the ply from the mold at each contact end; a little smoothness.
//! The constraints are in `constraints`.

use super::Task;
use super::front::Front;
use super::program::Program;
use super::tuning::TUNING;
use crate::draping::spans::{FreeSpan, Point};
use crate::geometry::vector::{dot, sub};
use crate::sensitivity::{Quantity, Row, Sensitivity};

/// The state from which a step starts.
pub struct Step<'a> {
    pub task: &'a Task<'a>,
    pub targets: &'a [Point],
    pub front: &'a Front,
    pub positions: &'a [Point],
    /// Grippers that have arrived and keep still.
    pub arrived: &'a [bool],
    /// The last moves (m).
    pub before: &'a [[f64; 3]],
    /// Whether some part of the ply is in contact.
    pub landing: bool,
    /// Farthest that a gripper may move (m).
    pub reach: f64,
    /// Whether grippers that are to come down do so on their targets.
    pub firm: bool,
}

impl Step<'_> {
    /// The moves of all grippers (m); `None` if the program has no solution.
    pub fn moves(&self, sensitivity: &Sensitivity) -> Option<Vec<[f64; 3]>> {
        let program = self.program(sensitivity);
        let x = program.solve()?;
        Some(x.chunks(3).map(|c| [c[0], c[1], c[2]].map(|x| x / program.scale)).collect())
    }

    /// The program whose solution they are.
    pub fn program(&self, sensitivity: &Sensitivity) -> Program {
        let mut program = Program::new(&self.task.layup.ply, self.positions.len());
        self.heights(sensitivity, &mut program);
        self.places(&mut program);
        self.lengths(sensitivity, &mut program);
        self.landings(sensitivity, &mut program);
        self.rolling(sensitivity, &mut program);
        self.smoothness(&mut program);
        self.limits(sensitivity, &mut program);
        self.reaches(sensitivity, &mut program);
        program
    }

    /// Whether a gripper stands on its target after this step; it then stays there.
    pub(super) fn lands(&self, gripper: usize) -> bool {
        let way = sub(self.targets[gripper], self.positions[gripper]);
        let down = self.firm && self.front.height(gripper) <= 0.0;
        self.arrived[gripper] || (down && dot(way, way).sqrt() <= self.reach)
    }

    /// Height of a gripper above the mold, or above its target where there is no mold.
    pub(super) fn clearance(&self, sensitivity: &Sensitivity, gripper: usize) -> Quantity {
        sensitivity.clearance(gripper).unwrap_or_else(|| {
            let mut gradient = Row::default();
            let normal = self.front.normal[gripper];
            gradient.add_from(3 * gripper, 1.0, normal);
            let value = dot(normal, sub(self.positions[gripper], self.targets[gripper]));
            Quantity { value, gradient }
        })
    }

    fn heights(&self, sensitivity: &Sensitivity, program: &mut Program) {
        for gripper in 0..self.positions.len() {
            let height = self.clearance(sensitivity, gripper);
            let residual = program.scale * (height.value - self.front.height(gripper));
            program.square(TUNING.weights.height, residual, &height.gradient);
        }
    }

    /// Position errors of grippers along the mold.
    fn places(&self, program: &mut Program) {
        for (gripper, target) in self.targets.iter().enumerate() {
            let error = sub(self.positions[gripper], *target);
            let normal = self.front.normal[gripper];
            let height = self.front.height(gripper);
            let weight = TUNING.weights.place + TUNING.weights.landing * self.nearness(height);
            for axis in 0..3 {
                // the part along the mold of the error in this axis
                let unit = |n: usize| f64::from(u8::from(n == axis));
                let part = [0, 1, 2].map(|n| unit(n) - normal[axis] * normal[n]);
                let mut gradient = Row::default();
                gradient.add_from(3 * gripper, 1.0, part);
                program.square(weight, program.scale * dot(part, error), &gradient);
            }
        }
    }

    /// The edges that hang.
    pub(super) fn edges<'s>(
        &self,
        sensitivity: &'s Sensitivity,
    ) -> impl Iterator<Item = &'s FreeSpan> {
        let edges = self.task.layup.ply.lines().edges();
        sensitivity.shape.spans.iter().filter(move |span| span.catenary < edges)
    }

    pub(super) fn whole(&self, span: &FreeSpan) -> f64 {
        self.task.layup.ply.flat_length(span.catenary)
    }

    /// Stretch of edges: they hang taut; over a hollow they sag as deep as the hollow is.
    fn lengths(&self, sensitivity: &Sensitivity, program: &mut Program) {
        for span in self.edges(sensitivity) {
            let stretch = sensitivity.overstretch(span);
            let residual = program.scale * (stretch.value - target_stretch(self.task, span));
            program.square(TUNING.weights.stretch, residual, &stretch.gradient);
        }
    }

    /// Position errors in plan of points that are about to come into contact.
    fn landings(&self, sensitivity: &Sensitivity, program: &mut Program) {
        for span in self.edges(sensitivity) {
            let contact = (0..2).any(|end| sensitivity.gripper_at(span, end).is_none());
            for share in TUNING.points {
                let Some(gap) = sensitivity.gap(span, share) else {
                    continue;
                };
                let weight = TUNING.weights.landing * self.nearness(gap.value);
                if contact || weight < TUNING.least_weight {
                    continue;
                }
                let Some(error) = sensitivity.landing(span, share) else {
                    continue;
                };
                for axis in 0..2 {
                    let mut unit = [0.0; 3];
                    unit[axis] = 1.0;
                    let part = error.along(unit);
                    program.square(weight, program.scale * part.value, &part.gradient);
                }
            }
        }
    }

    /// Rolling: the ply should leave its contact along the mold.
    fn rolling(&self, sensitivity: &Sensitivity, program: &mut Program) {
        for span in self.edges(sensitivity) {
            for end in 0..2 {
                let lies =
                    sensitivity.gripper_at(span, end).is_none_or(|gripper| self.arrived[gripper]);
                let free = sensitivity.gripper_at(span, 1 - end).is_some_and(|n| !self.arrived[n]);
                let Some(rise) = sensitivity.rise(span, end).filter(|_| lies && free) else {
                    continue;
                };
                // in terms of the height that it makes at the other end
                let arm = span.length;
                let mut gradient = rise.gradient;
                gradient.scale(arm);
                let value = program.scale * arm * rise.value;
                program.square(TUNING.weights.rolling, value, &gradient);
            }
        }
    }

    /// Weight of a point at a height (m) above the mold: 1 on the mold, less above.
    fn nearness(&self, height: f64) -> f64 {
        let near = TUNING.near * self.task.layup.ply.shorter_side();
        1.0 / (1.0 + (height.max(0.0) / near).powi(2))
    }

    fn smoothness(&self, program: &mut Program) {
        for (gripper, before) in self.before.iter().enumerate() {
            for n in 0..3 {
                program.near(TUNING.weights.smoothness, 3 * gripper + n, program.scale * before[n]);
            }
        }
    }
}

/// Stretch (m) that a span of an edge should have: a little, or slack over a hollow, in which it will lie.
pub fn target_stretch(task: &Task, span: &FreeSpan) -> f64 {
    let whole = task.layup.ply.flat_length(span.catenary);
    let sag = hollow(task, span).powi(2) * span.length.powi(3) / 24.0;
    if sag > 0.0 { -sag - TUNING.hollow_slack * whole } else { TUNING.target_stretch * whole }
}

/// Curvature of the hollow below a span, along it (1/m); 0 where the mold is not hollow.
fn hollow(task: &Task, span: &FreeSpan) -> f64 {
    let Some(mold) = &task.layup.mold else {
        return 0.0;
    };
    let middle = span.point(0.5);
    let closest = mold.closest_point(middle);
    let [a, b] = span.ends;
    let chord = sub(b, a);
    let height = dot(chord, closest.normal);
    let tangent = [0, 1, 2].map(|n| chord[n] - height * closest.normal[n]);
    let size = dot(tangent, tangent).sqrt();
    if size <= 0.0 {
        return 0.0;
    }
    (-mold.curvatures(middle).along(tangent.map(|c| c / size))).max(0.0)
}
