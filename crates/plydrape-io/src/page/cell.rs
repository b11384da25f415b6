//! What the grippers carry, what stands in the cell, and what the vacuum does: bodies as triangles, and where they are in every step.

use super::Form;
use super::block::Block;
use super::packing::{micrometers, short};
use crate::result::{ResultFile, SceneEcho};
use plydrape::arm::JOINTS;
use plydrape::bodies::{Body, Mount, Obstacle, Shape};
use plydrape::geometry::Pose;
use plydrape::outcome::Step;
use plydrape::ply::gripper_name;
use plydrape::sheet::EventKind;
use plydrape::tool::Posture;
use serde::Serialize;

/// Sides of a cylinder as it is drawn.
const SIDES: u32 = 20;
/// What a component of a unit quaternion counts in the page's integers.
const TURN: f64 = 1e6;

/// Bodies, obstacles and tool.
#[derive(Serialize)]
pub(super) struct Cell<'a> {
    bodies: Vec<Carried<'a>>,
    obstacles: Vec<Solid<'a>>,
    /// Where the tool holds each gripper with its strokes at zero, in the coordinates of the flange (m); `None` without a tool.
    mounts: Option<Vec<f64>>,
    /// How many links of an arm there are, its foot among them; 0 where it is not known.
    links: usize,
}

/// A body, in the coordinates of what it is mounted on.
#[derive(Serialize)]
struct Carried<'a> {
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

/// The cell of a scene; `None` without bodies, obstacles and tool.
pub(super) fn cell(scene: &SceneEcho) -> Option<Cell<'_>> {
    if scene.bodies.is_nothing() && scene.tool.is_none() {
        return None;
    }
    let mounts = scene.tool.as_ref().map(|tool| {
        let into = tool.flange.inverse();
        tool.mounts.iter().flat_map(|mount| into.place(*mount).map(short)).collect()
    });
    Some(Cell {
        bodies: scene.bodies.bodies().iter().map(carried).collect(),
        obstacles: scene.bodies.obstacles().iter().map(standing).collect(),
        mounts,
        links: if scene.tool.as_ref().is_some_and(|t| t.arm.is_some()) { JOINTS + 1 } else { 0 },
    })
}

/// Where in some steps everything is that moves: the pads, the stems, of a tool its flange, and of its arm the links, each as a place in micrometers and a
/// quaternion in millionths; `None` where nothing is drawn there.
pub(super) fn origins(result: &ResultFile, steps: &[&Step], form: Form) -> Option<Block> {
    // nothing is drawn of a cell that has neither bodies nor a tool
    let scene = &result.scene;
    let tool = scene.tool.as_ref();
    if scene.bodies.is_nothing() && tool.is_none() {
        return None;
    }

    // where the tool and the links of its arm are in each step
    let held = |step: &&Step| step.grippers.iter().map(|g| g.commanded).collect::<Vec<_>>();
    let postures: Option<Vec<Posture>> =
        tool.map(|tool| steps.iter().map(|step| tool.posture(&held(step))).collect());
    let links = arm_links(result, steps, postures.as_deref().unwrap_or_default());
    let mut origins: Vec<i32> = Vec::new();
    for (n, step) in steps.iter().enumerate() {
        let frame = postures.as_ref().map(|postures| postures[n].frame);
        let mut add = |place: [f64; 3], quaternion: [f64; 4]| {
            origins.extend(micrometers(&place));
            origins.extend(quaternion.map(|c| (c * TURN).round() as i32));
        };
        // pads lie along the ply; stems are upright in the frame of the tool
        for gripper in &step.grippers {
            add(gripper.position, gripper.quaternion);
        }
        let upright = frame.unwrap_or(Pose::ORIGIN).quaternion();
        for gripper in &step.grippers {
            add(gripper.commanded, upright);
        }
        // the flange, and the links of the arm
        if let (Some(frame), Some(tool)) = (frame, tool) {
            let flange = frame.compose(&tool.flange);
            add(flange.position, flange.quaternion());
            for link in links.get(n).into_iter().flatten() {
                add(link.position, link.quaternion());
            }
        }
    }
    Some(form.block(steps.len(), 7, origins))
}

/// Where the links of the arm are in each step, in the configuration of the whole motion; nothing where the arm is not known.
fn arm_links(result: &ResultFile, steps: &[&Step], postures: &[Posture]) -> Vec<Vec<Pose>> {
    let Some(tool) = result.judged_tool() else { return Vec::new() };
    let times: Vec<f64> = steps.iter().map(|step| step.time).collect();
    let course = tool.arm_along(&times, postures, &[]);
    course.iter().flat_map(|course| &course.angles).map(|angles| tool.links(angles)).collect()
}

fn carried(body: &Body) -> Carried<'_> {
    Carried { on: body.on, solid: solid(&body.name, &body.shape, &Pose::ORIGIN) }
}

fn standing(obstacle: &Obstacle) -> Solid<'_> {
    solid(&obstacle.name, &obstacle.shape, &obstacle.pose)
}

/// A shape in triangles, placed.
fn solid<'a>(name: &'a str, shape: &Shape, pose: &Pose) -> Solid<'a> {
    let (vertices, triangles) = shape.triangles(SIDES);
    Solid {
        name,
        vertices: vertices.iter().flat_map(|p| pose.place(*p).map(short)).collect(),
        triangles: triangles.into_iter().flatten().collect(),
    }
}
