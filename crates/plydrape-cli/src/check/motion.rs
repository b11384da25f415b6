//! The motion of the grippers, as text: the start, the target, and how far apart they are.

use super::SummaryLine;
use crate::numbers::{degrees, millimeters, short};
use plydrape::geometry::distance;
use plydrape::ply::{Direction, GripperId, Ply, gripper_name};
use plydrape::scene::Scene;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::fmt::Write as _;

/// Angles that differ by less (rad) are the same.
const ROUNDING: f64 = 1e-9;

/// The motion, the start, the target and the longest way between them.
pub(super) fn motion(scene: &Scene) -> Vec<SummaryLine> {
    let mut lines = vec![("motion", duration(scene)), ("start", place(start(scene)))];
    lines.push(("target", target(scene)));
    if let Some(target) = &scene.layup.target {
        lines.push(("", place(&target.grippers)));
    }
    if let Some((gripper, way)) = longest(scene) {
        lines.push((
            "way",
            format!(
                "{} mm in a straight line at most, of gripper {}",
                millimeters(way),
                gripper_name(gripper)
            ),
        ));
    }
    lines
}

fn duration(scene: &Scene) -> String {
    match scene.layup.motion.times.as_slice() {
        [] | [_] => "held still at the start".into(),
        [.., last] => format!("{} steps in {} s", scene.layup.motion.positions.len(), short(*last)),
    }
}

/// Where the grippers start (m).
fn start(scene: &Scene) -> &[[f64; 3]] {
    scene.layup.start()
}

/// Where they shall end (m): at the target, or else where the motion ends.
fn end(scene: &Scene) -> &[[f64; 3]] {
    let last = || scene.layup.motion.positions.last().map_or(&[][..], Vec::as_slice);
    scene.layup.target.as_ref().map_or_else(last, |target| &target.grippers)
}

/// The gripper with the longest straight way from its start to its end, and that way (m); `None` where all stay.
pub(super) fn longest(scene: &Scene) -> Option<(GripperId, f64)> {
    let ways = start(scene).iter().zip(end(scene)).map(|(from, to)| distance(*from, *to));
    let (gripper, way) = ways.enumerate().max_by(|a, b| a.1.total_cmp(&b.1))?;
    (way > 0.0).then(|| (scene.layup.ply.id(gripper), way))
}

/// The box around some places and its middle.
fn place(points: &[[f64; 3]]) -> String {
    let ends = [0, 1, 2].map(|n| {
        let along = || points.iter().map(|point| point[n]);
        [along().fold(f64::INFINITY, f64::min), along().fold(f64::NEG_INFINITY, f64::max)]
    });
    let range = |[low, high]: [f64; 2]| {
        let [low, high] = [low, high].map(millimeters);
        if low == high { low } else { format!("{low} to {high}") }
    };
    let [x, y, z] = ends.map(range);
    let middle = ends.map(|[low, high]| millimeters(0.5 * (low + high))).join(", ");
    format!("x {x} mm, y {y} mm, z {z} mm, middle ({middle}) mm")
}

/// The heading of u (rad) in words; of a ply that is cut, those of its warp, which has two ends, and of its drawing's x axis.
fn headings(ply: &Ply, heading: f64) -> String {
    let Some(cut) = &ply.cut else { return format!("u heading {} deg", degrees(heading)) };
    let across = if ply.warp == Direction::V { FRAC_PI_2 } else { 0.0 };
    // within half a turn, and half of that for what has no sense
    let within = |angle: f64, turn: f64| {
        let angle = angle.rem_euclid(turn);
        if angle > 0.5 * turn + ROUNDING { angle - turn } else { angle }
    };
    format!(
        "warp heading {} deg, the drawing's x axis {} deg",
        degrees(within(heading + across, PI)),
        degrees(within(heading - cut.angle, TAU))
    )
}

fn target(scene: &Scene) -> String {
    let Some(target) = &scene.layup.target else {
        return "none".into();
    };
    let Some(net) = &target.drape else {
        return "gripper positions as given".into();
    };
    let layup = &net.placement;
    let [x, y, z] = layup.place.map(millimeters);
    let [u, v] = layup.fabric(layup.seed).map(millimeters);
    let mut text = format!(
        "on the mold, fabric point ({u}, {v}) mm at ({x}, {y}, {z}) mm, sheared by {} deg, {}",
        degrees(layup.shear),
        headings(&scene.layup.ply, layup.heading)
    );
    let [nu, nv] = layup.nodes;
    let _ = write!(text, "; net of {nu} × {nv} nodes");
    if let Some((shear, _)) = net.report.largest_shear {
        let _ = write!(text, ", shear up to {} deg", degrees(shear));
    }
    if !net.missing.is_empty() {
        let _ = write!(text, ", {} without a place on the mold", net.missing.len());
    }
    text
}
