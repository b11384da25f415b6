//! What moves with grippers and robot, and what stands in the cell, as text.

use super::SummaryLine;
use crate::numbers::millimeters;
use plydrape::bodies::{Mount, Shape};
use plydrape::scene::Scene;
use plydrape_io::store::shown;

/// Bodies, then obstacles; nothing where there are none.
pub(super) fn bodies(scene: &Scene) -> Vec<SummaryLine> {
    let bodies = scene.layup.bodies.bodies().iter().map(|body| {
        let on = match body.on {
            Mount::Pad => "each pad",
            Mount::Stem => "each stem",
            Mount::Flange => "the flange",
            Mount::Link(_) => "the arm",
        };
        format!("{} on {on}: {}", shown::escaped(&body.name), shape(&body.shape))
    });
    let obstacles = scene.layup.bodies.obstacles().iter().map(|obstacle| {
        let [low, high] = obstacle.bounds();
        let side = |n: usize| format!("{} to {}", millimeters(low[n]), millimeters(high[n]));
        let name = shown::escaped(&obstacle.name);
        format!(
            "{name}: {}, x {}, y {}, z {} mm",
            shape(&obstacle.shape),
            side(0),
            side(1),
            side(2)
        )
    });
    let mut lines = numbered("bodies", bodies);
    lines.extend(numbered("obstacles", obstacles));
    lines
}

/// Lines under one noun.
fn numbered(noun: &'static str, texts: impl Iterator<Item = String>) -> Vec<SummaryLine> {
    texts.enumerate().map(|(n, text)| (if n == 0 { noun } else { "" }, text)).collect()
}

fn shape(shape: &Shape) -> String {
    match shape {
        Shape::Cylinder { radius, from, to } => format!(
            "cylinder of {} mm radius, {} to {} mm",
            millimeters(*radius),
            millimeters(*from),
            millimeters(*to)
        ),
        Shape::Box { size: [x, y, z], .. } => {
            format!("box of {} × {} × {} mm", millimeters(*x), millimeters(*y), millimeters(*z))
        }
        Shape::Mesh { triangles, .. } => format!("mesh of {} triangles", triangles.len()),
    }
}
