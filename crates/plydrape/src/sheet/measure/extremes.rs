//! Extremes over the steps: strain, shear, force at a gripper, tilt, depth in the mold, folds in the air, first contact.

use super::super::fabric::Fabric;
use super::super::model::Sheet;
use super::super::state::State;
use super::super::stretch::strain;
use super::{Most, Place, middle};
use crate::mold::Mold;
use crate::mold::vector::{along, angle_between, cross, dot, norm, sub, unit};

/// Extremes over the steps that were seen.
#[derive(Debug, Clone, Default)]
pub struct Extremes {
    pub(super) strain: Most,
    pub(super) shear: Most,
    pub(super) force: Most,
    pub(super) lateral: Most,
    pub(super) along: Most,
    pub(super) across: Most,
    pub(super) slide: Most,
    pub(super) tilt: Most,
    pub(super) depth: Most,
    pub(super) fold: Most,
    pub(super) first_contact: Option<Place>,
}

impl Extremes {
    /// Evaluates the state of a step; `gripped` are the nodes that grippers hold, `touching` is the height that counts as
    /// contact (m).
    pub fn see(&mut self, sheet: &Sheet, gripped: &[bool], state: &State, touching: f64) {
        let (fabric, x, step) = (&sheet.fabric, &state.positions, state.step);
        let reach = TILT_REACH * sheet.pitch;
        let of = |nodes: [u32; 2]| {
            let [a, b] = nodes.map(|n| n as usize);
            (middle([fabric.places[a], fabric.places[b]]), middle([x[a], x[b]]))
        };
        for segment in &fabric.segments {
            let (uv, at) = of(segment.nodes);
            self.strain.meet(strain(segment, x), uv, at, step);
        }
        for (cell, shear) in fabric.cells.iter().zip(&state.shear).filter(|(c, _)| c.is_ply()) {
            let uv = middle(cell.nodes.map(|n| fabric.places[n as usize]));
            let at = middle(cell.nodes.map(|n| x[n as usize]));
            self.shear.meet(shear.abs(), uv, at, step);
        }
        for bend in &fabric.bends {
            let [a, b, c] = bend.nodes.map(|n| n as usize);
            if state.contact[b] {
                continue;
            }
            let [first, second] = [sub(x[b], x[a]), sub(x[c], x[b])];
            let turn = norm(cross(first, second)).atan2(dot(first, second));
            self.fold.meet(turn, fabric.places[b], x[b], step);
        }
        let pads = state.pads.iter().zip(&state.forces).zip(&state.holds);
        for (gripper, ((pad, force), _)) in
            sheet.grippers.iter().zip(pads).filter(|(_, (_, holds))| **holds)
        {
            let at = pad.position;
            self.force.meet(norm(*force), gripper.place, at, step);
            self.lateral.meet(force[0].hypot(force[1]), gripper.place, at, step);
            // what draws the ply off the pad, and along it; what presses the pad on the mold holds the ply
            let normal = pad.normal();
            let off = -dot(*force, normal);
            self.across.meet(off.max(0.0), gripper.place, at, step);
            self.along.meet(norm(along(*force, off, normal)), gripper.place, at, step);
            self.slide.meet(norm(pad.slip), gripper.place, at, step);
            let tilt = match gripper.radius {
                0.0 => tilt(fabric, x, gripper.place, reach, pad.stem).unwrap_or(0.0),
                _ => pad.tilt(),
            };
            self.tilt.meet(tilt, gripper.place, at, step);
        }
        for (node, height) in state.heights.iter().enumerate().filter(|(n, _)| fabric.inside[*n]) {
            self.depth.meet((-height).max(0.0), fabric.places[node], x[node], step);
        }
        if let Some(mold) = &sheet.mold {
            self.between(fabric, mold, state, sheet.mesh);
        }
        if self.first_contact.is_none() {
            let free = |node: usize| fabric.inside[node] && !gripped[node];
            let heights = state.heights.iter().enumerate().filter(|(node, _)| free(*node));
            let lowest = heights.min_by(|a, b| a.1.total_cmp(b.1));
            self.first_contact =
                lowest.filter(|(_, height)| **height <= touching).map(|(node, height)| Place {
                    value: *height,
                    uv: fabric.places[node],
                    at: x[node],
                    step,
                });
        }
    }

    /// Depth of the middles of cells: what they are deeper than a chord of the mold's own curvature.
    fn between(&mut self, fabric: &Fabric, mold: &Mold, state: &State, mesh: f64) {
        if matches!(mold, Mold::Plane(_)) {
            return;
        }
        for cell in fabric.cells.iter().filter(|cell| cell.is_ply()) {
            let nodes = cell.nodes.map(|n| n as usize);
            if nodes.iter().all(|n| state.heights[*n] > mesh) {
                continue;
            }
            let at = middle(nodes.map(|n| state.positions[n]));
            let closest = mold.closest_point(at);
            if closest.beyond || closest.distance >= 0.0 {
                continue;
            }
            let normals = nodes.map(|n| mold.normal(state.positions[n]));
            // a chord of length l over an arc that turns by φ lies l φ / 8 under its middle
            let sagitta = |a: usize, b: usize| {
                let length = norm(sub(state.positions[nodes[a]], state.positions[nodes[b]]));
                length * norm(sub(normals[a], normals[b])) / 8.0
            };
            let depth = -closest.distance - sagitta(0, 2).max(sagitta(1, 3));
            let uv = middle(nodes.map(|n| fabric.places[n]));
            self.depth.meet(depth.max(0.0), uv, at, state.step);
        }
    }
}

/// Fabric to each side of a gripper that is a point, over which its tilt is measured (of the pitch of the grippers).
///
/// Right beside a point that holds it, fabric is the steeper the finer the mesh. A gripper is a cup, and a fifth of the
/// pitch is the size of a usual one, 40 mm of 100 mm.
pub(in crate::sheet) const TILT_REACH: f64 = 0.2;

/// Tilt (rad) from a stem (unit vector) of the fabric around a place: of the area vector of the cells whose middles are within `reach` (m) of it
/// along u and v, which depends on the boundary of that patch alone and so hardly on the mesh; none without cells.
#[must_use]
pub fn tilt(
    fabric: &Fabric,
    x: &[[f64; 3]],
    place: [f64; 2],
    reach: f64,
    stem: [f64; 3],
) -> Option<f64> {
    let mut sum = [0.0; 3];
    for cell in &fabric.cells {
        let at = middle(cell.nodes.map(|n| fabric.places[n as usize]));
        if (0..2).any(|n| (at[n] - place[n]).abs() > reach) {
            continue;
        }
        let [a, b, c, d] = cell.nodes.map(|n| x[n as usize]);
        let normal = cross(sub(c, a), sub(d, b));
        for n in 0..3 {
            sum[n] += normal[n];
        }
    }
    unit(sum).map(|normal| angle_between(normal, stem))
}
