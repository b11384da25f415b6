//! `plydrape check`: reads a scene and says what was understood.

use crate::diagnostic::Done;
use crate::numbers::{degrees, millimetres, short};
use plydrape::material::{Material, Section, ShearCurve};
use plydrape::mold::{Face, MeshReport, Mold, Plane, Pose, Surface};
use plydrape::ply::Direction;
use plydrape::scene::{ContactEnd, Limits, PlanMethod, Scene, SlopeRule, Stepping};
use std::fmt::Write as _;
use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;

/// Read a scene, and say what was understood or what is wrong.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The scene file.
    scene: PathBuf,
}

/// Reads the scene; prints a summary unless `quiet`.
pub fn run(arguments: &Arguments, quiet: bool) -> Done {
    let scene = plydrape::scene::read(&arguments.scene)?;
    if !quiet {
        let mut out = io::stdout().lock();
        writeln!(out, "{}", scene.title)?;
        for (noun, text) in summary(&scene) {
            writeln!(out, "  {noun:<9} {text}")?;
        }
        out.flush()?;
    }
    Ok(ExitCode::SUCCESS)
}

/// The nouns of a scene, each in a line.
fn summary(scene: &Scene) -> Vec<(&'static str, String)> {
    let ply = &scene.ply;
    let mut lines = vec![
        (
            "ply",
            format!(
                "{} × {} grippers, cells of {} × {} mm, warp along {}",
                ply.grid.nu,
                ply.grid.nv,
                millimetres(ply.cell[0]),
                millimetres(ply.cell[1]),
                match ply.warp {
                    Direction::U => "u",
                    Direction::V => "v",
                }
            ),
        ),
        ("material", material(&ply.material)),
        ("", ply.material.source.clone()),
    ];
    lines.extend(mold(scene));
    lines.extend([("motion", motion(scene)), ("target", target(scene))]);
    lines.extend(rules(scene));
    lines.extend(plan(scene));
    lines
}

fn material(material: &Material) -> String {
    let section = match material.section {
        Section::Line { mass, flexural_rigidity } => {
            format!("{} kg/m, EI {} N·m²", short(mass), short(flexural_rigidity))
        }
        Section::Areal { mass, warp_rigidity, weft_rigidity } => format!(
            "{} kg/m², bending rigidity {} N·m in warp, {} N·m in weft",
            short(mass),
            short(warp_rigidity),
            short(weft_rigidity)
        ),
    };
    let shear = match &material.shear_curve {
        Some(ShearCurve::Table { angle, .. }) => format!("shear curve of {} points", angle.len()),
        Some(ShearCurve::Polynomial { .. }) => "shear curve as a polynomial".into(),
        None => "no shear curve: shear forces stay unknown".into(),
    };
    let locking = match material.locking_angle {
        Some(angle) => format!(", locks at {} deg", degrees(angle)),
        None => String::new(),
    };
    format!("{}: {section}; {shear}{locking}", material.name)
}

/// The mold, and what was repaired in a mesh: one line each.
fn mold(scene: &Scene) -> Vec<(&'static str, String)> {
    let Some(mold) = &scene.mold else {
        return vec![("mold", "none: the ply just hangs".into())];
    };
    let mm = |length: f64| format!("{} mm", millimetres(length));
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
            standing("centre", &s.pose)
        ),
        Mold::Torus(t) => format!(
            "torus, ring of {} and tube of {}, from {}, {}",
            mm(t.ring_radius),
            mm(t.tube_radius),
            side(t.face),
            standing("centre", &t.pose)
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
                Surface::Lifted(_) => "mold lifted ahead of a front".into(),
            };
            let range = match graph.domain {
                Some([x, y]) => {
                    let [x, y] = [x, y].map(|ends| ends.map(millimetres).join(" to "));
                    format!("x from {x} mm, y from {y} mm")
                }
                None => "without border".into(),
            };
            format!("{surface}, {range}, {}", standing("origin", &graph.pose))
        }
        Mold::Mesh(_) => match &scene.mesh {
            Some(report) => return mesh(report),
            None => "mesh".into(),
        },
    };
    vec![("mold", text)]
}

fn level(plane: &Plane) -> String {
    let [x, y, z] = plane.point.map(millimetres);
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

/// Where a mold stands, and whether it is turned.
fn standing(what: &str, pose: &Pose) -> String {
    let [x, y, z] = pose.position.map(millimetres);
    let upright = *pose == Pose::new(pose.position, [0.0; 3]);
    format!("{what} ({x}, {y}, {z}) mm{}", if upright { "" } else { ", turned" })
}

/// A mesh in the lines of its report.
fn mesh(report: &MeshReport) -> Vec<(&'static str, String)> {
    let text = report.to_string();
    let nouns = std::iter::once("mold").chain(std::iter::repeat(""));
    nouns.zip(text.lines()).map(|(noun, line)| (noun, line.to_string())).collect()
}

fn motion(scene: &Scene) -> String {
    let heights = |step: Option<&Vec<[f64; 3]>>| {
        let z = || step.into_iter().flatten().map(|point| point[2]);
        let (low, high) =
            (z().fold(f64::INFINITY, f64::min), z().fold(f64::NEG_INFINITY, f64::max));
        if millimetres(low) == millimetres(high) {
            format!("z = {} mm", millimetres(low))
        } else {
            format!("z = {} to {} mm", millimetres(low), millimetres(high))
        }
    };
    let positions = &scene.motion.positions;
    match scene.motion.times.as_slice() {
        [] | [_] => format!("held still at {}", heights(positions.first())),
        [.., last] => format!(
            "{} steps in {} s, from {} to {}",
            positions.len(),
            short(*last),
            heights(positions.first()),
            heights(positions.last())
        ),
    }
}

fn target(scene: &Scene) -> String {
    let Some(target) = &scene.target else {
        return "none".into();
    };
    let Some(net) = &target.drape else {
        return "gripper positions as given".into();
    };
    let layup = &net.layup;
    let [x, y, z] = layup.place.map(millimetres);
    let [u, v] = [0, 1].map(|n| millimetres(layup.seed[n] as f64 * layup.mesh[n]));
    let mut text = format!(
        "on the mold, fabric point ({u}, {v}) mm at ({x}, {y}, {z}) mm, sheared by {} deg, u heading {} deg",
        degrees(layup.shear),
        degrees(layup.heading)
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

/// How a motion would be planned; nothing where there is nothing to plan.
fn plan(scene: &Scene) -> Option<(&'static str, String)> {
    let (Some(_), Some(_), plan) = (&scene.mold, &scene.target, &scene.plan) else {
        return None;
    };
    let method = match plan.method {
        PlanMethod::Path => "path",
        PlanMethod::Stepwise => "stepwise",
    };
    let far = plan.move_limit.map(|far| format!(" of up to {} mm", millimetres(far)));
    let text = format!(
        "{method}, {} steps{}, up to {} drapes, seed {}, motion at {} Hz",
        plan.steps,
        far.unwrap_or_default(),
        plan.evaluations,
        plan.seed,
        short(plan.rate)
    );
    Some(("plan", text))
}

/// Rules of the model, contact and limits.
fn rules(scene: &Scene) -> [(&'static str, String); 7] {
    let settings = &scene.settings;
    let limits = &scene.limits;
    let slopes = match settings.slopes {
        SlopeRule::MinForce => "min-force",
        SlopeRule::MomentBalance => "moment-balance",
    };
    let stepping = match settings.contact.stepping {
        Stepping::Once => "looked for once per step",
        Stepping::Cut => "steps cut where they dip deeper",
    };
    let end = match settings.contact.end {
        ContactEnd::Free => "free slope at its ends",
        ContactEnd::Tangent => "mold's slope at its ends",
    };
    let force =
        |limit: Option<f64>| limit.map_or("any".into(), |force| format!("{} N", short(force)));
    [
        (
            "model",
            format!(
                "{slopes} slopes, EA {} N, g {} m/s², gripper tilt up to {} deg",
                short(settings.axial_stiffness),
                short(settings.gravity),
                degrees(settings.max_tilt)
            ),
        ),
        (
            "contact",
            format!("within {} mm, {stepping}, {end}", millimetres(settings.contact.tolerance)),
        ),
        (
            "limits",
            format!(
                "slack {} %, bridging {} mm, overstretch {} %, strain {} %, force {}",
                short(limits.slack_ratio * 100.0),
                millimetres(limits.bridging),
                short(limits.overstretch * 100.0),
                short(limits.strain * 100.0),
                force(limits.force),
            ),
        ),
        (
            "",
            format!(
                "shear {} deg, {} deg after landing; penetration {} mm",
                degrees(limits.shear),
                degrees(limits.landing_shear),
                millimetres(limits.penetration),
            ),
        ),
        (
            "",
            format!(
                "landing within {} mm (contact), {} mm (grippers), fibres within {} deg, {} % in contact",
                millimetres(limits.landing_contact),
                millimetres(limits.landing_gripper),
                degrees(limits.fibre_angle),
                short(limits.contact_share * 100.0)
            ),
        ),
        (
            "",
            format!(
                "each gripper: tilt {} deg, {} deg/s; load {}, pull {}",
                degrees(limits.tilt),
                degrees(limits.tilt_rate),
                force(Some(limits.gripper_load)),
                force(limits.gripper_pull),
            ),
        ),
        ("", reach(limits)),
    ]
}

/// Where grippers may be and how fast they may move.
fn reach(limits: &Limits) -> String {
    let workspace = match limits.workspace {
        Some(sides) => {
            let [x, y, z] = sides.map(|ends| ends.map(millimetres).join(" to "));
            format!("x {x}, y {y}, z {z} mm")
        }
        None => "anywhere".into(),
    };
    format!(
        "grippers {workspace}, {} mm apart, up to {} m/s, {} m/s², {} m/s³{}",
        millimetres(limits.gripper_distance),
        short(limits.speed),
        short(limits.acceleration),
        short(limits.jerk),
        limits
            .duration
            .map_or(String::new(), |longest| format!("; done within {} s", short(longest)))
    )
}
