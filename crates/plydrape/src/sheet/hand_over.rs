//! What the sheet says of itself after a step, as a [`PlyState`] that measures evaluate.

use super::fabric::Fabric;
use super::gripper::Pad;
use super::model::Sheet;
use super::state::ClothState;
use super::stretch;
use crate::geometry::Point;
use crate::geometry::rotation::{continued, oriented};
use crate::geometry::vector::{angle_between, cross, direction, norm, sub};
use crate::layup::{Layup, Model};
use crate::mold::{Mold, distance};
use crate::state::{CellState, FabricPoint, GripperState, LineState, PlyState, Site};

/// Fabric to each side of a gripper that is a point, over which its tilt is measured (of the pitch of the grippers).
///
/// Right beside a point that holds it, fabric is the steeper the finer the mesh. A gripper is a cup, and a fifth of the
/// pitch is the size of a usual one, 40 mm of 100 mm.
pub(super) const TILT_REACH: f64 = 0.2;

/// Hands over the states of a sheet one after the other.
#[derive(Debug, Clone, Default)]
pub struct HandOver {
    /// Orientations of the pads in the step before (x, y, z, w).
    turned: Vec<[f64; 4]>,
}

impl HandOver {
    /// The ply of a step; `last` if no other follows, so that what counts at the end alone is looked for.
    #[must_use]
    pub fn state(
        &mut self,
        layup: &Layup,
        sheet: &Sheet,
        state: &ClothState,
        last: bool,
    ) -> PlyState {
        let view = View { layup, sheet, turned: &self.turned };
        let normals = normals(&sheet.fabric, &state.positions);
        let grippers = view.grippers(state);
        // what lies off the mold has no height and no angle to it; that is asked at the end, where it counts
        let mold = sheet.mold.as_ref().filter(|_| last);
        let beside: Vec<bool> = match mold {
            Some(mold) => state.positions.iter().map(|x| mold.closest_point(*x).beyond).collect(),
            None => vec![false; state.positions.len()],
        };
        let (points, lines) = (view.points(state, &normals, &beside, last), view.lines(state));
        let cells = view.cells(state, &beside, last);
        self.turned = grippers.iter().map(|gripper| gripper.quaternion).collect();
        PlyState {
            model: Model::Sheet,
            step: state.step,
            time: state.time,
            points,
            lines,
            cells,
            grippers,
            unsolved: None,
        }
    }
}

/// A sheet whose state is handed over.
struct View<'a> {
    layup: &'a Layup,
    sheet: &'a Sheet,
    /// Orientations of the pads in the step before (x, y, z, w).
    turned: &'a [[f64; 4]],
}

impl View<'_> {
    /// The nodes of the ply, at the end its boundary too, and middles of cells in the mold.
    fn points(
        &self,
        state: &ClothState,
        normals: &[Option<Point>],
        beside: &[bool],
        last: bool,
    ) -> Vec<FabricPoint> {
        let (fabric, mold) = (&self.sheet.fabric, self.sheet.mold.as_ref());
        let ideal = self.layup.target.as_ref().and_then(|target| target.drape.as_deref());
        let ply = &self.layup.ply;
        let tolerance = self.layup.settings.contact.tolerance;
        let inside = (0..fabric.places.len()).filter(|node| fabric.inside[*node]);
        let mut points: Vec<FabricPoint> = inside
            .map(|node| {
                let (uv, place) = (fabric.places[node], state.positions[node]);
                let height = state.heights.get(node).copied();
                let lies = height.is_some_and(|height| height <= tolerance);
                let error = |place| Some(distance(place, ideal?.held_place(mold?, ply, uv)?));
                FabricPoint {
                    site: Site::Fabric(uv),
                    place,
                    normal: normals[node],
                    height: height.filter(|_| !beside[node]),
                    lies,
                    area: fabric.areas[node],
                    error: (last && lies).then(|| error(place)).flatten(),
                }
            })
            .collect();
        let Some(mold) = mold else { return points };
        let extra = |uv: [f64; 2], place: Point, height: f64| FabricPoint {
            site: Site::Fabric(uv),
            place,
            normal: None,
            height: Some(height),
            lies: height <= tolerance,
            area: 0.0,
            error: None,
        };
        if last {
            for point in fabric.boundary.iter().flatten() {
                let place = point.interpolate(&state.positions);
                let closest = mold.closest_point(place);
                if !closest.beyond {
                    // a point of the boundary lies on the chord between nodes, which may be in the mold
                    points.push(extra(point.place, place, closest.distance.max(0.0)));
                }
            }
        }
        points.extend(self.sunk_cells(mold, state).map(|(uv, at, depth)| extra(uv, at, -depth)));
        points
    }

    /// Middles of cells that are in the mold: fabric coordinates (m), place (m), and by how much they are deeper (m) than a chord of the
    /// mold's own curvature.
    fn sunk_cells<'b>(
        &'b self,
        mold: &'b Mold,
        state: &'b ClothState,
    ) -> impl Iterator<Item = ([f64; 2], Point, f64)> + 'b {
        let (fabric, mesh) = (&self.sheet.fabric, self.sheet.mesh);
        let curved = !matches!(mold, Mold::Plane(_));
        fabric.cells.iter().filter(move |cell| curved && cell.is_ply()).filter_map(move |cell| {
            let nodes = cell.nodes.map(|n| n as usize);
            if nodes.iter().all(|n| state.heights[*n] > mesh) {
                return None;
            }
            let place = middle(nodes.map(|n| state.positions[n]));
            let closest = mold.closest_point(place);
            if closest.beyond || closest.distance >= 0.0 {
                return None;
            }
            let normals = nodes.map(|n| mold.normal(state.positions[n]));
            // a chord of length l over an arc that turns by φ lies l φ / 8 under its middle
            let sagitta = |a: usize, b: usize| {
                let length = distance(state.positions[nodes[a]], state.positions[nodes[b]]);
                length * norm(sub(normals[a], normals[b])) / 8.0
            };
            let depth = -closest.distance - sagitta(0, 2).max(sagitta(1, 3));
            // a cell that bends over the border of the mold cuts its corner
            let cuts = || nodes.iter().any(|n| mold.closest_point(state.positions[*n]).beyond);
            (depth > 0.0 && !cuts())
                .then(|| (middle(nodes.map(|n| fabric.places[n])), place, depth))
        })
    }

    fn lines(&self, state: &ClothState) -> Vec<LineState> {
        let fabric = &self.sheet.fabric;
        let line = |(n, segment): (usize, &super::fabric::Segment)| {
            let [a, b] = segment.nodes.map(|node| node as usize);
            LineState {
                site: Site::Fabric(middle([fabric.places[a], fabric.places[b]])),
                catenary: None,
                is_fiber: true,
                place: middle([state.positions[a], state.positions[b]]),
                length: segment.length,
                whole: segment.length,
                path: segment.length * (1.0 + stretch::strain(segment, &state.positions)),
                force: Some(state.tension[n] * segment.width),
                hangs: false,
                lies: state.contact[a] && state.contact[b],
                sag: None,
                slope: None,
                bridge: None,
                fiber_angle: None,
            }
        };
        // what is hardly ply is stretched by the mesh, as yarns that the mesh leads across the edge of a hole
        let yarns = fabric.segments.iter().enumerate().filter(|(_, segment)| segment.is_ply());
        yarns.map(line).collect()
    }

    /// The cells of the ply; at the end with directions, but for those that bend over the border of the mold: nodes of them hang `beside` it.
    fn cells(&self, state: &ClothState, beside: &[bool], last: bool) -> Vec<CellState> {
        let fabric = &self.sheet.fabric;
        let cells = fabric.cells.iter().zip(&state.shear).filter(|(cell, _)| cell.is_ply());
        let cell = |(cell, shear): (&super::fabric::Cell, &f64)| {
            let corners = cell.nodes.map(|n| state.positions[n as usize]);
            let uv = middle(cell.nodes.map(|n| fabric.places[n as usize]));
            let lies_over = last && cell.nodes.iter().all(|n| !beside[*n as usize]);
            CellState {
                site: Site::Fabric(uv),
                place: middle(corners),
                shear: shear.abs(),
                directions: lies_over.then(|| Some((mid_lines(corners)?, uv))).flatten(),
                landing_error: None,
            }
        };
        cells.map(cell).collect()
    }

    fn grippers(&self, state: &ClothState) -> Vec<GripperState> {
        let pads = state.pads.iter().zip(&state.forces).zip(&state.holds).enumerate();
        let gripper = |(n, ((pad, force), holds)): (usize, ((&Pad, &[f64; 3]), &bool))| {
            let before = self.turned.get(n).copied();
            let (quaternion, tilt) = self.attitude(n, pad, state, before);
            GripperState {
                position: pad.position,
                commanded: pad.target,
                quaternion,
                tilt,
                force: *force,
                slide: norm(pad.slip),
                holds: *holds,
            }
        };
        pads.map(gripper).collect()
    }

    /// How a pad is turned (x, y, z, w), with the sign that continues the step before, and how far it is tilted from its stem (rad). A pad
    /// that is a point has the direction of the fabric around it; one that has let go keeps its own.
    fn attitude(
        &self,
        n: usize,
        pad: &Pad,
        state: &ClothState,
        before: Option<[f64; 4]>,
    ) -> ([f64; 4], f64) {
        let gripper = &self.sheet.grippers[n];
        if gripper.radius > 0.0 {
            return (continued(pad.quaternion(), before), pad.tilt());
        }
        if let (false, Some(before)) = (state.holds[n], before) {
            return (before, 0.0);
        }
        let reach = TILT_REACH * self.sheet.pitch;
        let around = frame_around(&self.sheet.fabric, &state.positions, gripper.place, reach);
        let Some((normal, along)) = around else {
            return (continued(pad.quaternion(), before), pad.tilt());
        };
        let turned = match self.layup.fixed_pads(&[pad.target]) {
            Some(_) => pad.quaternion(),
            None => oriented(normal, along),
        };
        (continued(turned, before), angle_between(normal, pad.stem))
    }
}

/// Unit vectors along the mid-lines of a cell, u and v, by its corners (m); `None` if one has no length.
fn mid_lines([a, b, c, d]: [Point; 4]) -> Option<[Point; 2]> {
    let line = |p, q, r, s| direction(sub(middle([p, q]), middle([r, s])));
    Some([line(b, c, a, d)?, line(c, d, a, b)?])
}

/// Unit normals of the ply at the nodes (m), by the areas of the cells around each; `None` at nodes without cells.
fn normals(fabric: &Fabric, x: &[Point]) -> Vec<Option<Point>> {
    let mut sums = vec![[0.0; 3]; x.len()];
    for cell in &fabric.cells {
        let nodes = cell.nodes.map(|n| n as usize);
        let [a, b, c, d] = nodes.map(|n| x[n]);
        let normal = cross(sub(c, a), sub(d, b));
        for node in nodes {
            sums[node] = [0, 1, 2].map(|k| sums[node][k] + normal[k]);
        }
    }
    sums.into_iter().map(direction).collect()
}

/// Unit normal of the fabric around a place, and its direction along u: of the area vector and the mid-lines of the cells whose middles are
/// within `reach` (m) of it along u and v. The area vector depends on the boundary of that patch alone and so hardly on the mesh. `None`
/// without cells.
#[must_use]
pub(super) fn frame_around(
    fabric: &Fabric,
    x: &[Point],
    place: [f64; 2],
    reach: f64,
) -> Option<(Point, Point)> {
    let (mut area, mut along) = ([0.0; 3], [0.0; 3]);
    for cell in &fabric.cells {
        let at = middle(cell.nodes.map(|n| fabric.places[n as usize]));
        if (0..2).any(|n| (at[n] - place[n]).abs() > reach) {
            continue;
        }
        let [a, b, c, d] = cell.nodes.map(|n| x[n as usize]);
        let normal = cross(sub(c, a), sub(d, b));
        for n in 0..3 {
            area[n] += normal[n];
            along[n] += b[n] + c[n] - a[n] - d[n];
        }
    }
    Some((direction(area)?, direction(along)?))
}

/// The middle of some points.
fn middle<const N: usize, const D: usize>(points: [[f64; D]; N]) -> [f64; D] {
    let mut sum = [0.0; D];
    for point in points {
        for n in 0..D {
            sum[n] += point[n] / N as f64;
        }
    }
    sum
}
