//! The constraints of one step: limits of the ply and of the grippers, moves, and lengths of edges.

use super::program::Program;
use super::step::Step;
use super::tuning::TUNING;
use crate::geometry::vector::sub;
use crate::sensitivity::{Quantity, Row, Sensitivity};

impl Step<'_> {
    /// Shear, tilt, force, distances: linear. A limit that is exceeded already must not be exceeded further.
    pub(super) fn limits(&self, sensitivity: &Sensitivity, program: &mut Program) {
        let limits = &self.task.limits;
        let (grid, scale) = (self.task.layup.ply.grid, program.scale);

        // what exceeds its limit already may stay as it is
        let mut keep = |q: Option<Quantity>, limit: f64| {
            if let Some(q) = q {
                program.at_most(&q.gradient, 1.0 / scale, limit.max(q.value) - q.value);
            }
        };
        // shear of cells, tilt of grippers, and force of free spans
        let cells = self.task.layup.ply.lines().cells().len();
        (0..cells).for_each(|cell| keep(sensitivity.shear(cell), limits.shear));
        for gripper in 0..grid.grippers() {
            keep(Some(sensitivity.tilt(gripper)), limits.tilt);
        }
        sensitivity.shape.spans.iter().for_each(|span| keep(sensitivity.force(span), limits.force));

        // grippers that do not land stay above the mold; all keep their distance from their neighbors
        let mut above = |q: Quantity, least: f64| {
            program.at_most(&q.gradient, -1.0, scale * (q.value - least.min(q.value)));
        };
        for gripper in 0..grid.grippers() {
            if !self.lands(gripper) {
                above(self.clearance(sensitivity, gripper), 0.0);
            }
            let [i, j] = grid.id(gripper);
            if i > 0 {
                above(sensitivity.separation(gripper - 1, gripper), limits.gripper_distance);
            }
            if j > 0 {
                above(sensitivity.separation(gripper - grid.nu, gripper), limits.gripper_distance);
            }
        }

        // once a part of the ply is in contact, no gripper rises
        if self.landing {
            for gripper in (0..grid.grippers()).filter(|n| !self.lands(*n)) {
                program.at_most(&self.clearance(sensitivity, gripper).gradient, 1.0, 0.0);
            }
        }

        // the workspace, along each axis
        if let Some(ranges) = limits.workspace {
            for (gripper, p) in self.positions.iter().enumerate() {
                for axis in 0..3 {
                    let unit: Row = [(3 * gripper + axis, 1.0)].into_iter().collect();
                    let [low, high] = ranges[axis];
                    program.at_most(&unit, 1.0, scale * (high.max(p[axis]) - p[axis]));
                    program.at_most(&unit, -1.0, scale * (p[axis] - low.min(p[axis])));
                }
            }
        }
    }

    /// Moves and lengths of edges: cones, exact for any move.
    pub(super) fn reaches(&self, sensitivity: &Sensitivity, program: &mut Program) {
        let scale = program.scale;
        for (gripper, target) in self.targets.iter().enumerate() {
            // a gripper that lands goes to its target, the others no farther than one step
            let way = sub(*target, self.positions[gripper]);
            if self.lands(gripper) {
                program.fix(gripper, way.map(|c| scale * c));
            } else {
                program.cone(vec![(gripper, 1.0)], [0.0; 3], scale * self.reach);
            }
        }

        // a hanging edge whose grippers all land is fixed already; the others may stretch by little
        for span in self.edges(sensitivity) {
            let ends = [(0, -1.0), (1, 1.0)];
            let free: Vec<(usize, f64)> = ends
                .into_iter()
                .filter_map(|(end, sign)| Some((sensitivity.gripper_at(span, end)?, sign)))
                .collect();
            if free.iter().all(|(gripper, _)| self.lands(*gripper)) {
                continue;
            }
            let [a, b] = span.ends;
            let lands = free.iter().any(|(gripper, _)| self.lands(*gripper));
            // beside a gripper that lands, a part of the overstretch limit may be used; what is stretched more now may stay so
            let stretch = if lands {
                TUNING.stretch_share * self.task.limits.overstretch
            } else {
                TUNING.most_stretch
            };
            let most = (span.length + stretch * self.whole(span)).max(span.chord());
            program.cone(free, sub(b, a).map(|c| scale * c), scale * most);
        }
    }
}
