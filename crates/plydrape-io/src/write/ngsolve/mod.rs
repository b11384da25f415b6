//! A drape for NGSolve: `drape.py`, a script of its own that anybody can read, and `ply.json`, which it reads.
//!
//! The data are those of the sheet, per width: the ply in rectangles along its fibers, mass, shear curve and flexural
//! rigidities, cups with their mounts and their motion, the mold as signed distance on a grid. The tension stiffness alone is another one, see
//! [`TENSION`]. What the script writes, `drape.json`, is read by [`crate::peer`].

mod mold;

use crate::Error;
use crate::result::ResultFile;
use crate::store::folder::Files;
use crate::store::json;
use crate::write::pose::Pose;
use mold::DistanceGrid;
use plydrape::layup::Friction;
use plydrape::sheet::fabric::Cell;
use plydrape::sheet::{Sheet, coarsest_mesh, pitch};
use serde::Serialize;
use std::collections::BTreeMap;

/// The script.
const SCRIPT: &str = include_str!("drape.py");
/// Tension stiffness per width (N/m), unless another one is asked for. A yarn has 10⁶ N/m, with which a turn within an iteration of
/// Newton's method makes false tension that keeps shells of this thickness from converging.
pub const TENSION: f64 = 2e4;
/// Quads on the shortest distance of two grippers, unless a mesh is asked for.
const QUADS: f64 = 4.0;
/// Stiffness of a rigid mount, as a multiple of the tension stiffness: it gives a fiftieth of what a square of ply does.
const RIGID: f64 = 50.0;
/// How deep the ply's own weight sinks into the mold, and how high a node is clear of it, as shares of the pitch.
const DEPTH: f64 = 1e-4;
const CLEAR: f64 = 5e-4;
/// Options of the script: names, values unless others are given, and meanings.
const SETTINGS: [(&str, f64, &str); 7] = [
    ("step", 4e-3, "longest time step (s)"),
    ("hang", 1.0, "time before the motion, in which the ply comes to rest (s)"),
    ("longest", 4.0, "time of the motion, which runs faster if it takes longer (s)"),
    ("rest", 1.0, "time after the motion (s)"),
    ("drag", 2.0, "drag of the air, per mass (1/s)"),
    ("twist", 0.1, "rigidity in twist, as a share of the mean of the other two"),
    ("green", 0.0, "1 for shear as 2 E12, 0 for the angle between the fibers"),
];
/// Angles of the table of the shear curve (°).
const ANGLES: std::ops::RangeInclusive<u32> = 0..=90;

/// `ply.json`: lengths in meters, all in SI units.
#[derive(Debug, Serialize)]
struct Data<'a> {
    format: &'static str,
    version: u32,
    title: &'a str,
    program: &'a str,
    /// Check sum of the states that the result was written with; `None` without a sheet.
    result: Option<&'a str>,
    /// Values and meanings of the options of the script.
    settings: BTreeMap<&'static str, (f64, &'static str)>,
    nodes: Vec<[f64; 2]>,
    quads: Vec<[u32; 4]>,
    /// Fabric points at which the drape is compared.
    points: Vec<[f64; 2]>,
    mass: f64,
    gravity: f64,
    tension: f64,
    /// Angles (rad), and shear forces per length (N/m).
    shear: [Vec<f64>; 2],
    /// Along u and along v.
    rigidity: [f64; 2],
    /// Place of the fabric point (0, 0) of the flat ply, and its directions.
    origin: [f64; 3],
    axes: [[f64; 3]; 2],
    time: Vec<f64>,
    grippers: Vec<Cup>,
    contact: Contact,
    mold: Option<DistanceGrid>,
}

/// A cup: where it holds the fabric, and where the robot holds it.
#[derive(Debug, Serialize)]
struct Cup {
    name: String,
    place: [f64; 2],
    radius: f64,
    /// Radius (m) and flexural rigidity (N·m) of its soft lip; `None` without one.
    lip: Option<[f64; 2]>,
    stiffness: [f64; 3],
    /// Whether its mount yields, and so acts on all of the fabric under the lip.
    yields: bool,
    /// When it lets go (s); `None` if it holds to the end.
    release: Option<f64>,
    positions: Vec<[f64; 3]>,
    quaternions: Vec<[f64; 4]>,
}

/// What holds a node that touches.
#[derive(Debug, Serialize)]
struct Contact {
    depth: f64,
    clear: f64,
    /// Coulomb's coefficient; `None` if what touches sticks.
    friction: Option<f64>,
    tack: f64,
}

/// Script and data of a result. Same result, same bytes.
///
/// # Errors
/// [`Error::NotPossible`] if there is no step, if the grippers start on one line, or if the ply is a single line or has nothing that
/// the sheet needs; [`Error`] of its mesh.
pub(crate) fn files(
    result: &ResultFile,
    mesh: Option<f64>,
    tension: Option<f64>,
) -> Result<Files, Error> {
    result.check_finite()?;

    // the sheet of the scene as quads, fine enough for the pads unless a mesh is asked for
    let mut layup = result.layup();
    let pitch = pitch(&layup.ply);
    let finest = coarsest_mesh(pitch, layup.settings.pad.radius);
    layup.settings.sheet.mesh = Some(mesh.unwrap_or(finest.min(pitch / QUADS)));
    let sheet = Sheet::new(&layup)?;
    let fabric = &sheet.fabric;
    let (nodes, quads) = quads(&sheet);
    if quads.is_empty() {
        let message = "the ply is a single line of grippers, and NGSolve has shells of a surface";
        return Err(Error::not_possible(message, "take `inp`, whose strip is one cell wide"));
    }

    // the flat ply begins at the rigid place that best fits the grippers of step 1
    let places: Vec<[f64; 2]> = sheet.grippers.iter().map(|gripper| gripper.place).collect();
    let pose = Pose::start(result, &places, |gripper| gripper.commanded)?;

    // the nodes at which the two drapes are compared
    let points = match &result.sheet_states {
        Some(states) => states.open()?.mesh().places.to_vec(),
        None => fabric.places.clone(),
    };

    // stiffness in tension, and the angles of the table of the shear curve
    let tension = tension.unwrap_or(TENSION);
    let angles: Vec<f64> = ANGLES.map(|degrees| f64::from(degrees).to_radians()).collect();

    // cups follow the commanded motion of their grippers; one that lets go does so for good
    let start = &result.steps[0].grippers;
    let cups = sheet.grippers.iter().zip(start).enumerate().map(|(n, (held, gripper))| {
        let track = || result.steps.iter().map(|step| &step.grippers[n]);
        let last = track().rposition(|gripper| gripper.holds).unwrap_or_default();
        Cup {
            name: plydrape::ply::gripper_name(gripper.id),
            place: held.place,
            radius: held.radius,
            lip: layup.settings.pad.lip.map(|lip| [lip.radius, lip.rigidity]),
            stiffness: held.mount.unwrap_or([RIGID * tension; 3]),
            yields: held.mount.is_some(),
            release: (last + 1 < result.steps.len()).then(|| result.steps[last].time),
            positions: track().map(|gripper| gripper.commanded).collect(),
            quaternions: track().map(|gripper| gripper.quaternion).collect(),
        }
    });

    // all data of the script, in SI units
    let reach = layup.settings.sheet.overhang.max(0.5 * pitch);
    let data = Data {
        format: "plydrape-ngsolve",
        version: 1,
        title: &result.scene.title,
        program: &result.program,
        result: result.sheet_states.as_ref().map(|states| states.seal().checksum.as_str()),
        settings: SETTINGS.map(|(name, value, meaning)| (name, (value, meaning))).into(),
        nodes,
        quads,
        points,
        mass: sheet.areal_mass,
        gravity: sheet.gravity,
        tension,
        shear: [angles.clone(), angles.iter().map(|angle| sheet.shear.force(*angle).0).collect()],
        rigidity: sheet.rigidity,
        origin: pose.origin,
        axes: pose.axes,
        time: result.steps.iter().map(|step| step.time).collect(),
        grippers: cups.collect(),
        contact: Contact {
            depth: DEPTH * pitch,
            clear: CLEAR * pitch,
            friction: match sheet.friction {
                Friction::Coulomb(coefficient) => Some(coefficient),
                Friction::Stick | Friction::StickForEver => None,
            },
            tack: sheet.tack,
        },
        mold: DistanceGrid::under(result, reach, pitch),
    };

    Ok(vec![
        ("drape.py".into(), SCRIPT.as_bytes().to_vec()),
        ("ply.json".into(), json::to_text(&data)?.into_bytes()),
    ])
}

/// Corners of quads, and the quads by numbers of corners: the cells of which half or more is ply, and those that cups hold.
fn quads(sheet: &Sheet) -> (Vec<[f64; 2]>, Vec<[u32; 4]>) {
    let places = &sheet.fabric.places;
    let mut held = vec![false; places.len()];
    sheet.held().iter().flatten().for_each(|(node, _)| held[*node] = true);
    let is_held = |cell: &Cell| cell.nodes.iter().any(|node| held[*node as usize]);
    let cells = sheet.fabric.cells.iter().filter(|cell| cell.is_ply() || is_held(cell));
    let (mut number, mut nodes) = (vec![None; places.len()], Vec::new());
    let quads: Vec<[u32; 4]> = cells
        .map(|cell| {
            cell.nodes.map(|node| {
                *number[node as usize].get_or_insert_with(|| {
                    nodes.push(places[node as usize]);
                    nodes.len() as u32 - 1
                })
            })
        })
        .collect();
    (nodes, quads)
}

#[cfg(test)]
mod tests;
