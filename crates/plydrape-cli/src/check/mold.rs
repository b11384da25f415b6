//! What a mold is, as text.

use super::SummaryLine;
use crate::numbers::{degrees, millimeters};
use plydrape::geometry::Pose;
use plydrape::mold::{Face, MeshReport, Mold, Plane, Surface};
use plydrape_io::scene::SceneFile;

/// The mold, and what was repaired in a mesh: one line each.
pub(super) fn mold(scene: &SceneFile) -> Vec<SummaryLine> {
    let Some(mold) = &scene.layup.mold else {
        return vec![("mold", "none: the ply just hangs".into())];
    };
    shape(mold, scene.mesh.as_ref())
}

/// A mold, with what was repaired if it is a mesh.
pub(super) fn shape(mold: &Mold, report: Option<&MeshReport>) -> Vec<SummaryLine> {
    let mm = |length: f64| format!("{} mm", millimeters(length));
    let side = |face: Face| match face {
        Face::Outside => "outside",
        Face::Inside => "inside",
    };
    let text = match mold {
        Mold::Plane(plane) => level(plane),
        Mold::Cylinder(c) => format!(
            "cylinder of radius {}, from {}, {}",
            mm(c.radius),
            side(c.face),
            standing("axis through", &c.pose)
        ),
        Mold::Sphere(s) => format!(
            "sphere of radius {}, from {}, {}",
            mm(s.radius),
            side(s.face),
            standing("center", &s.pose)
        ),
        Mold::Torus(t) => format!(
            "torus, ring of {} and tube of {}, from {}, {}",
            mm(t.ring_radius),
            mm(t.tube_radius),
            side(t.face),
            standing("center", &t.pose)
        ),
        Mold::Graph(graph) => {
            let surface = match &graph.surface {
                Surface::Saddle(saddle) => {
                    let [a, b] = saddle.radii.map(mm);
                    format!("saddle of radii {a} and {b}")
                }
                Surface::Formula { z } => format!("z = {}", z.text()),
                Surface::HeightGrid(grid) => {
                    let [nx, ny] = grid.size();
                    format!("grid of {nx} × {ny} heights")
                }
                Surface::Front(_) => "mold raised ahead of a front".into(),
            };
            let range = match graph.domain {
                Some([x, y]) => {
                    let [x, y] = [x, y].map(|ends| ends.map(millimeters).join(" to "));
                    format!("x from {x} mm, y from {y} mm")
                }
                None => "without boundary".into(),
            };
            format!("{surface}, {range}, {}", standing("origin", &graph.pose))
        }
        Mold::Mesh(_) => match report {
            Some(report) => return mesh(report),
            None => "mesh".into(),
        },
        // no scene file makes these
        Mold::Layered(_) => "plies on a mold".into(),
        Mold::Wavy(_) => "waves on a mold".into(),
    };
    vec![("mold", text)]
}

fn level(plane: &Plane) -> String {
    let [x, y, z] = plane.point.map(millimeters);
    let [nx, ny, nz] = plane.normal;
    let tilt = nx.hypot(ny).atan2(nz);
    let climb = if tilt > 0.0 {
        let heading = (-ny).atan2(-nx);
        format!("climbing {} deg towards {} deg", degrees(tilt), degrees(heading))
    } else {
        "level".into()
    };
    format!("plane through ({x}, {y}, {z}) mm, {climb}")
}

/// Position of a mold, and whether it is turned.
fn standing(what: &str, pose: &Pose) -> String {
    let [x, y, z] = pose.position.map(millimeters);
    let upright = *pose == Pose::new(pose.position, [0.0; 3]);
    format!("{what} ({x}, {y}, {z}) mm{}", if upright { "" } else { ", turned" })
}

/// A mesh in the lines of its report.
fn mesh(report: &MeshReport) -> Vec<SummaryLine> {
    let text = report.to_string();
    let nouns = std::iter::once("mold").chain(std::iter::repeat(""));
    nouns.zip(text.lines()).map(|(noun, line)| (noun, line.to_string())).collect()
}
