//! Grippers and cells: tilt, height above the mold, distances, shear.

use super::tuning::TUNING;
use super::{Quantity, Row, Sensitivity};
use crate::geometry::vector::{direction, sub};
use crate::ply::{Grid, Shares, shear, tangent_shares};
use num_dual::{Dual64, DualNum};
use std::collections::BTreeSet;

impl Sensitivity<'_> {
    /// Shear angle γ of a cell (rad); `None` while it does not shear.
    #[must_use]
    pub fn shear(&self, cell: usize) -> Option<Quantity> {
        let path = self.paths[cell].as_ref()?;
        let sides = self.layup.ply.trellis(&self.layup.ply.lines().cells()[cell], self.contacts);
        let value = shear::angle(sides, path.value);
        // from sin γ = (d₁² − a² − b²)/2ab; a folded cell shears no further
        let rate = path.value / (sides[0] * sides[1] * value.cos());
        let rate = if rate.is_finite() && value.cos() > TUNING.folded { rate } else { 0.0 };
        let mut gradient = path.gradient.clone();
        gradient.scale(rate);
        Some(Quantity { value, gradient })
    }

    /// Distance of a gripper from the mold (m); `None` without a mold.
    #[must_use]
    pub fn clearance(&self, gripper: usize) -> Option<Quantity> {
        let point = self.positions[gripper];
        let closest = self.layup.mold.as_ref()?.closest_point(point);
        let mut gradient = Row::default();
        gradient.add_from(3 * gripper, 1.0, self.distance_gradient(point, &closest));
        Some(Quantity { value: closest.distance, gradient })
    }

    /// Distance between two grippers (m).
    #[must_use]
    pub fn separation(&self, a: usize, b: usize) -> Quantity {
        let way = sub(self.positions[b], self.positions[a]);
        let mut gradient = Row::default();
        let direction = direction(way).unwrap_or([0.0; 3]);
        gradient.add_from(3 * a, -1.0, direction);
        gradient.add_from(3 * b, 1.0, direction);
        Quantity { value: way.iter().map(|c| c * c).sum::<f64>().sqrt(), gradient }
    }

    /// Angle between the ply's normal at a gripper and the vertical (rad), eq. (13a) of `docs/theory/measures.md`. A
    /// level gripper's has no derivative and gets zeros.
    #[must_use]
    pub fn tilt(&self, gripper: usize) -> Quantity {
        let value = self.tilt_along(gripper, None).re;
        // its slopes, and the grippers that its lines pass
        let slopes = self.slopes[gripper].iter().flatten();
        let mut columns: BTreeSet<usize> =
            slopes.flat_map(|slope| slope.gradient.entries().map(|(column, _)| column)).collect();
        let lines = self.layup.ply.lines();
        for neighbor in [0, 1].map(|d| lines.neighbors(gripper, d)).as_flattened() {
            columns.extend(3 * neighbor..3 * neighbor + 3);
        }
        for (neighbor, _) in self.neighbor_shares(gripper).iter().flat_map(|it| &it.grippers) {
            columns.extend(3 * neighbor..3 * neighbor + 3);
        }
        columns.extend(3 * gripper..3 * gripper + 3);
        let along = |column: usize| (column, self.tilt_along(gripper, Some(column)).eps);
        let gradient = columns.into_iter().map(along).filter(|(_, x)| *x != 0.0).collect();
        Quantity { value, gradient }
    }

    /// What says how a gripper is tilted along u and v where no fiber line runs through it in one of them; see
    /// [`crate::draping::attitude::attitude`].
    fn neighbor_shares(&self, gripper: usize) -> Option<Shares> {
        let ply = &self.layup.ply;
        let is_by_lines =
            ply.grid != Grid::NONE || self.slopes[gripper].iter().all(Option::is_some);
        (!is_by_lines).then(|| tangent_shares(ply, &ply.neighbors(), gripper))
    }

    fn tilt_along(&self, gripper: usize, column: Option<usize>) -> Dual64 {
        let position = |n: usize, axis: usize| {
            let moves = column == Some(3 * n + axis);
            Dual64::new(self.positions[n][axis], f64::from(u8::from(moves)))
        };
        let lines = self.layup.ply.lines();
        let heading = |d: usize| {
            let [before, after] = lines.neighbors(gripper, d);
            let [x, y] = [0, 1].map(|n| position(after, n) - position(before, n));
            let square = x * x + y * y;
            (square.re > 0.0).then(|| [x, y].map(|c| c / square.sqrt()))
        };
        let (one, zero) = (Dual64::from(1.0), Dual64::from(0.0));
        let by_neighbors = self.neighbor_shares(gripper).and_then(|Shares { grippers, line }| {
            let [u, v] = [0, 1].map(|d| {
                [0, 1, 2].map(|axis| {
                    let here = position(gripper, axis);
                    let way = grippers.iter().map(|(n, s)| (position(*n, axis) - here) * s[d]);
                    way.fold(zero, |sum, way| sum + way)
                })
            });
            let Some([cos, sin]) = line else { return Some([u, v]) };
            let [x, y, z] = [0, 1, 2].map(|n| u[n] * cos + v[n] * sin);
            let level = x * x + y * y;
            let (length, run) = ((level + z * z).sqrt(), level.sqrt());
            // across the line it is level
            let (line, aside) = ([x / length, y / length, z / length], [-y / run, x / run, zero]);
            let axes = [[cos, -sin], [sin, cos]];
            (level.re > 0.0)
                .then(|| axes.map(|[a, b]| [0, 1, 2].map(|n| line[n] * a + aside[n] * b)))
        });
        let by_line = |d: usize| {
            let slope = self.slopes[gripper][d].as_ref()?;
            let [x, y] = heading(d)?;
            Some([
                x,
                y,
                Dual64::new(slope.value, column.map_or(0.0, |c| slope.gradient.value_at(c))),
            ])
        };
        let [u, v] = [0, 1].map(|d| by_line(d).or(by_neighbors.map(|tangents| tangents[d])));
        // across a single line it is level
        let u = u.or_else(|| v.map(|[x, y, _]| [y, -x, zero])).unwrap_or([one, zero, zero]);
        let v = v.unwrap_or([-u[1], u[0], zero]);
        // the normal is the cross product of both tangents
        let (nx, ny) = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2]);
        let nz = u[0] * v[1] - u[1] * v[0];
        let square = nx * nx + ny * ny;
        let horizontal = if square.re > 0.0 { square.sqrt() } else { zero };
        let up = if nz.re < 0.0 { -nz } else { nz };
        horizontal.atan2(up)
    }
}
