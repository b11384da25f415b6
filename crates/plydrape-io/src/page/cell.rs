//! What the grippers carry, what stands in the cell, and what the vacuum does: bodies as triangles, and where they are in every step.

use super::block::Block;
use super::geometry::{MICRO, micrometres};
use crate::result::ResultFile;
use plydrape::clearance::{Mount, Shape};
use plydrape::draping::record::Step;
use plydrape::mold::Pose;
use plydrape::ply::gripper_name;
use plydrape::sheet::EventKind;
use serde::Serialize;

/// Sides of a cylinder as it is drawn.
const SIDES: u32 = 20;
/// What a component of a unit quaternion counts in the page's integers.
const TURN: f64 = 1e6;

/// Bodies, obstacles and tool.
#[derive(Serialize)]
pub(super) struct Cell<'a> {
    bodies: Vec<Body<'a>>,
    obstacles: Vec<Solid<'a>>,
    /// Where the tool holds each gripper with its strokes at zero, in the coordinates of the flange (m); none without a tool.
    mounts: Option<Vec<f64>>,
    /// In each step the pads, the stems, and of a tool its flange: a place in micrometres and a quaternion in millionths.
    origins: Block,
}

/// A body, in the coordinates of what it is mounted on.
#[derive(Serialize)]
struct Body<'a> {
    on: Mount,
    #[serde(flatten)]
    solid: Solid<'a>,
}

/// Triangles with a name (m).
#[derive(Serialize)]
struct Solid<'a> {
    name: &'a str,
    vertices: Vec<f64>,
    triangles: Vec<u32>,
}

/// What the vacuum of some grippers does at a time.
#[derive(Serialize)]
pub(super) struct VacuumEvent {
    time: f64,
    kind: EventKind,
    grippers: Vec<String>,
}

/// When pads grip, press and let go.
pub(super) fn events(result: &ResultFile) -> Vec<VacuumEvent> {
    let event = |event: &plydrape::sheet::Event| VacuumEvent {
        time: event.time,
        kind: event.kind,
        grippers: event.grippers.iter().map(|id| gripper_name(*id)).collect(),
    };
    result.events().iter().map(event).collect()
}

/// The cell in the steps that are shown; none of a scene without bodies, obstacles and tool.
pub(super) fn cell<'a>(result: &'a ResultFile, steps: &[&Step]) -> Option<Cell<'a>> {
    let scene = &result.scene;
    let tool = scene.tool.as_ref();
    if scene.bodies.is_nothing() && tool.is_none() {
        return None;
    }
    let body = |body: &'a plydrape::clearance::Body| Body {
        on: body.on,
        solid: solid(&body.name, &body.shape, &Pose::ORIGIN),
    };
    let mounts = tool.map(|tool| {
        let into = tool.flange.inverse();
        tool.mounts.iter().flat_map(|mount| into.place(*mount).map(short)).collect()
    });
    let mut origins: Vec<i32> = Vec::new();
    for step in steps {
        let frame = tool.map(|tool| {
            let held: Vec<[f64; 3]> = step.grippers.iter().map(|g| g.commanded()).collect();
            tool.posture(&held).frame
        });
        let mut add = |place: [f64; 3], quaternion: [f64; 4]| {
            origins.extend(micrometres(&place));
            origins.extend(quaternion.map(|c| (c * TURN).round() as i32));
        };
        for gripper in &step.grippers {
            add(gripper.position, gripper.quaternion);
        }
        let upright = frame.unwrap_or(Pose::ORIGIN).quaternion();
        for gripper in &step.grippers {
            add(gripper.commanded(), upright);
        }
        if let (Some(frame), Some(tool)) = (frame, tool) {
            let flange = frame.compose(&tool.flange);
            add(flange.position, flange.quaternion());
        }
    }
    Some(Cell {
        bodies: scene.bodies.bodies().iter().map(body).collect(),
        obstacles: scene
            .bodies
            .obstacles()
            .iter()
            .map(|obstacle| solid(&obstacle.name, &obstacle.shape, &obstacle.pose))
            .collect(),
        mounts,
        origins: Block::new(steps.len(), 7, &origins),
    })
}

/// The nearest micrometre, in few digits.
fn short(c: f64) -> f64 {
    (c * MICRO).round() / MICRO
}

/// A shape in triangles, placed.
fn solid<'a>(name: &'a str, shape: &Shape, pose: &Pose) -> Solid<'a> {
    let (vertices, triangles) = triangles(shape);
    Solid {
        name,
        vertices: vertices.iter().flat_map(|p| pose.place(*p).map(short)).collect(),
        triangles: triangles.into_iter().flatten().collect(),
    }
}

/// Corners (m) and triangles, counterclockwise as seen from outside.
fn triangles(shape: &Shape) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    match shape {
        Shape::Mesh { vertices, triangles } => (vertices.clone(), triangles.clone()),
        Shape::Box { .. } => {
            let ends = shape.bounds();
            let corner = |n: usize| [0, 1, 2].map(|c| ends[n >> c & 1][c]);
            let faces: [[u32; 4]; 6] = [
                [0, 2, 3, 1],
                [4, 5, 7, 6],
                [0, 1, 5, 4],
                [2, 6, 7, 3],
                [0, 4, 6, 2],
                [1, 3, 7, 5],
            ];
            let halves = |[a, b, c, d]: [u32; 4]| [[a, b, c], [a, c, d]];
            ((0..8).map(corner).collect(), faces.into_iter().flat_map(halves).collect())
        }
        Shape::Cylinder { radius, from, to } => {
            let place = |k: u32, z: f64| {
                let (sin, cos) =
                    (std::f64::consts::TAU * f64::from(k) / f64::from(SIDES)).sin_cos();
                [radius * cos, radius * sin, z]
            };
            let mut vertices: Vec<[f64; 3]> =
                (0..SIDES).flat_map(|k| [place(k, *from), place(k, *to)]).collect();
            let [low, high] = [2 * SIDES, 2 * SIDES + 1];
            vertices.extend([[0.0, 0.0, *from], [0.0, 0.0, *to]]);
            let side = |k: u32| {
                let [a, b] = [2 * k, 2 * ((k + 1) % SIDES)];
                [[a, b, b + 1], [a, b + 1, a + 1], [b, a, low], [a + 1, b + 1, high]]
            };
            (vertices, (0..SIDES).flat_map(side).collect())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Six times the volume that triangles enclose: positive if they are counterclockwise from outside, all of them.
    fn volume(shape: &Shape) -> f64 {
        let (vertices, triangles) = triangles(shape);
        let of = |t: &[u32; 3]| {
            let [[a, b, c], [d, e, f], [g, h, i]] = t.map(|n| vertices[n as usize]);
            a * (e * i - f * h) + b * (f * g - d * i) + c * (d * h - e * g)
        };
        triangles.iter().map(of).sum::<f64>() / 6.0
    }

    /// A box encloses the product of its sides, and a cylinder that of its height and a regular polygon.
    #[test]
    fn bodies_enclose_their_volume() {
        let found = volume(&Shape::Box { size: [0.2, 0.3, 0.5], at: [1.0, -2.0, 0.4] });
        assert!((found - 0.03).abs() < 1e-12, "{found}");
        let found = volume(&Shape::Cylinder { radius: 0.1, from: 0.3, to: 0.8 });
        let sides = f64::from(SIDES);
        let polygon = 0.5 * sides * 0.01 * (std::f64::consts::TAU / sides).sin();
        assert!((found - 0.5 * polygon).abs() < 1e-12, "{found}");
    }
}
