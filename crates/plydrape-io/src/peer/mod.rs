//! A result beside the drape of its motion in another program: at the same fabric points, in the same steps.
//!
//! [`read()`] reads `drape.json`, which the script of [`crate::export::Format::Ngsolve`] writes; [`compare`] lays it beside the states of the
//! result's sheet. Heights over the mold and shear are computed here from the positions of both, by the same functions. The
//! other program's last state, after it has come to rest, is compared with the end of the sheet.

mod table;

pub use table::table;
pub(crate) use table::{cost, ends, percent};

use crate::Error;
use crate::result::ResultFile;
use crate::store::{input, shown, size};
use plydrape::geometry::vector::{dot, norm, sub};
use serde::{Deserialize, Serialize};
use std::path::Path;

/// The other program, as tables and the page name it.
pub(crate) const NAME: &str = "NGSolve";
/// Name of the file in the folder of the export.
const FILE: &str = "drape.json";
/// Name of the format of the file.
const FORMAT: &str = "plydrape-ngsolve-drape";
/// Version of the format.
const VERSION: u32 = 1;
/// Largest file that is read (bytes).
const LARGEST: u64 = 1 << 30;

/// A drape by another program.
#[derive(Debug, Clone, Deserialize)]
pub struct PeerDrape {
    format: String,
    version: u32,
    /// Check sum of the states of the result whose motion it follows.
    result: Option<String>,
    /// Seconds of processor time.
    pub cpu_s: f64,
    /// Time steps.
    pub steps: u64,
    /// Linear systems that were solved.
    pub solves: u64,
    /// Time steps that were refused and taken again in shorter ones.
    pub refused: u64,
    first_touch: Option<PeerTouch>,
    states: Vec<PeerState>,
}

#[derive(Debug, Clone, Deserialize)]
struct PeerTouch {
    /// Time since the start (s).
    time: f64,
    /// Fabric coordinates (m).
    place: [f64; 2],
}

/// The ply in a step, or at rest after the last one.
#[derive(Debug, Clone, Deserialize)]
struct PeerState {
    /// Of each node of the sheet (m); `None` for one beyond its mesh.
    positions: Vec<Option<[f64; 3]>>,
    /// Force of the ply on each cup (N).
    forces: Vec<[f64; 3]>,
    /// Share of the area that lies on the mold.
    lies: f64,
}

/// A value of the sheet and that of the other program.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Pair {
    /// By plydrape.
    pub plydrape: Option<f64>,
    /// By the other program.
    pub peer: Option<f64>,
}

/// Both drapes in a step.
#[derive(Debug, Clone, Serialize)]
pub struct Compared {
    /// The step, from 1.
    pub step: usize,
    /// Time (s).
    pub time: f64,
    /// Height of the lowest point (mm), in z.
    pub lowest_mm: Pair,
    /// Share of the area that lies on the mold.
    pub lies: Pair,
    /// Largest shear angle of a cell of the sheet (°).
    pub shear_deg: Pair,
    /// Largest force on a cup (N).
    pub load_n: Pair,
    /// Distance of the same fabric points, as the root of its mean square over the area (mm).
    pub apart_rms_mm: f64,
    /// Largest distance of the same fabric point (mm).
    pub apart_max_mm: f64,
    /// Where they are farthest apart, in fabric coordinates (mm).
    pub apart_uv_mm: [f64; 2],
    /// The node of the sheet there.
    #[serde(skip)]
    pub(crate) apart_node: usize,
}

/// Where and when a ply first touched.
#[derive(Debug, Clone, Serialize)]
pub struct Touch {
    /// Step of the motion, from 1; between two steps of the other program, which knows the moment.
    pub step: f64,
    /// Fabric coordinates (mm).
    pub uv_mm: [f64; 2],
}

/// A result beside another drape of its motion.
#[derive(Debug, Clone, Serialize)]
pub struct Comparison {
    /// Largest height over the mold at the end (mm); none without a mold.
    pub height_max_mm: Pair,
    /// Root of the mean square of the height over the area (mm).
    pub height_rms_mm: Pair,
    /// Share of the area above the limit of the height.
    pub height_share: Pair,
    /// First touch of each.
    pub first_touch: [Option<Touch>; 2],
    /// The steps whose states were kept.
    pub steps: Vec<Compared>,
    /// Processor time of the other drape (s).
    pub cpu_s: f64,
    /// Time steps.
    pub time_steps: u64,
    /// Linear systems that it solved.
    pub solves: u64,
    /// Time steps that it refused and took again in shorter ones.
    pub refused: u64,
}

/// Reads the drape that the script left in a folder.
///
/// # Errors
/// [`Error`] if it cannot be read or is another file.
pub fn read(folder: &Path) -> Result<PeerDrape, Error> {
    let path = folder.join(FILE);
    let shown = path.display();
    let help = "run drape.py in this folder; `plydrape export RESULT --to ngsolve` writes it";
    let text = input::text(&path, LARGEST).map_err(|source| Error::Io {
        path: path.clone(),
        message: format!("`{shown}` cannot be read: {source}"),
        help: help.into(),
        source,
    })?;
    size::result(text.len() as u64).map_err(|error| error.of_file(format_args!("`{shown}`")))?;
    let drape: PeerDrape = serde_json::from_str(&text)
        .map_err(|fault| Error::file(&path, format!("`{shown}` is no drape: {fault}"), help))?;
    if (drape.format.as_str(), drape.version) != (FORMAT, VERSION) {
        let message = format!("`{shown}` is no drape of this version of plydrape");
        return Err(Error::file(&path, message, help));
    }
    Ok(drape)
}

/// Lays another drape beside a result.
///
/// # Errors
/// [`Error`] if the result has no sheet, if the drape is that of another result, or if it broke off.
pub fn compare(result: &ResultFile, drape: &PeerDrape) -> Result<Comparison, Error> {
    // the drape must be one of the sheet of this very result, which its checksum proves
    let kept = result.sheet_states.as_ref().ok_or_else(|| {
        let message = "the result has no sheet, whose nodes could be compared";
        Error::not_possible(message, "simulate the scene with `--also sheet`, and export it again")
    })?;
    let again = "export the result again with `plydrape export RESULT --to ngsolve`, and run drape.py there";
    if drape.result.as_deref() != Some(kept.seal().checksum.as_str()) {
        let message =
            format!("the drape is not of the result {}", shown::name(&result.scene.title));
        return Err(Error::not_possible(message, again));
    }

    // the drape must have every step, and in each every node and cup
    let incomplete =
        || Error::not_possible("the drape has not all steps, nodes and cups of the result", again);
    let mut states = kept.open()?;
    let (mesh, steps) = (states.mesh().clone(), result.steps.len());
    let nodes = mesh.places.len();
    let complete =
        |state: &PeerState| state.positions.len() == nodes && state.forces.len() == mesh.grippers;
    if drape.states.len() != steps + 1 || !drape.states.iter().all(complete) {
        return Err(incomplete());
    }

    // height over the mold, where there is mold below, and the weight of nodes in means
    let mold = result.scene.mold.as_ref();
    let height = |x: [f64; 3]| {
        let closest = mold.map(|mold| mold.closest_point(x));
        closest.filter(|closest| !closest.beyond).map(|closest| closest.distance)
    };
    let inside = |n: usize| mesh.areas[n] > 0.0;
    let total: f64 = mesh.areas.iter().sum();

    let mut compared = Vec::new();
    let mut heights = [Vec::new(), Vec::new()];
    for n in 0..states.states() {
        // the same step of both; the last state of the peer is the ply at rest
        let Some(ours) = states.state(n)? else { continue };
        let step = ours.step as usize;
        let is_last = n + 1 == states.states();
        if step > steps {
            return Err(incomplete());
        }
        let theirs = &drape.states[if is_last { steps } else { step - 1 }];

        // nodes of the ply whose place the peer knows
        let known: Vec<(usize, [f64; 3])> = theirs
            .positions
            .iter()
            .enumerate()
            .filter_map(|(n, place)| Some((n, (*place)?)).filter(|(n, _)| inside(*n)))
            .collect();
        if known.is_empty() {
            return Err(incomplete());
        }

        // the distance of both drapes, as a mean over the area and at its largest
        let (mut square, mut area, mut farthest) = (0.0, 0.0, (0.0, 0));
        for (n, place) in &known {
            let apart = norm(sub(*place, ours.positions[*n]));
            square += mesh.areas[*n] * apart * apart;
            area += mesh.areas[*n];
            if apart > farthest.0 {
                farthest = (apart, *n);
            }
        }

        // shear is compared in cells of which the peer knows all four nodes
        let mut their_places = ours.positions.to_vec();
        known.iter().for_each(|(n, place)| their_places[*n] = *place);
        let whole = |cell: &&[u32; 4]| {
            cell.iter().all(|n| theirs.positions[*n as usize].is_some() && inside(*n as usize))
        };
        let cells: Vec<&[u32; 4]> = mesh.cells.iter().filter(whole).collect();
        let sheared = |places: &[[f64; 3]]| {
            cells.iter().map(|cell| shear(places, cell).abs().to_degrees()).fold(0.0, f64::max)
        };

        // the lowest point of the ply, and the largest force on a gripper
        let lowest = |places: &[[f64; 3]]| {
            known.iter().map(|(n, _)| 1e3 * places[*n][2]).fold(f64::INFINITY, f64::min)
        };
        let load =
            |forces: &[[f64; 3]]| forces.iter().map(|force| norm(*force)).fold(0.0, f64::max);

        // the share of the ply in contact
        let touched = (0..nodes).filter(|n| ours.contact[*n]).map(|n| mesh.areas[n]).sum::<f64>();

        let both = |ours: f64, peer: f64| Pair { plydrape: Some(ours), peer: Some(peer) };
        compared.push(Compared {
            step,
            time: ours.time,
            lowest_mm: both(lowest(&ours.positions), lowest(&their_places)),
            lies: both(touched / total, theirs.lies),
            shear_deg: both(sheared(&ours.positions), sheared(&their_places)),
            load_n: both(load(&ours.pad_forces), load(&theirs.forces)),
            apart_rms_mm: 1e3 * (square / area.max(f64::MIN_POSITIVE)).sqrt(),
            apart_max_mm: 1e3 * farthest.0,
            apart_uv_mm: mesh.places[farthest.1].map(|c| 1e3 * c),
            apart_node: farthest.1,
        });

        // heights over the mold are compared at the end
        if is_last {
            let over = |places: &[[f64; 3]]| -> Vec<(f64, f64)> {
                let heights =
                    known.iter().map(|(n, _)| Some((mesh.areas[*n], height(places[*n])?)));
                heights.flatten().collect()
            };
            heights = [over(&ours.positions), over(&their_places)];
        }
    }

    // how high the ply at rest lies over the mold, as far as both drapes have nodes over it
    let limit = result.scene.limits.get(plydrape::measure::Name::Height).unwrap_or_default();
    let pair = |measure: &dyn Fn(&Heights) -> f64| {
        let [plydrape, peer] =
            [0, 1].map(|n| (!heights[n].is_empty()).then(|| measure(&heights[n])));
        Pair { plydrape, peer }
    };

    // where and when the ply first touches the mold
    let ours = result.summary.sheet.as_ref().and_then(|sheet| {
        Some(Touch { step: sheet.first_contact_step? as f64, uv_mm: sheet.first_contact_uv_mm? })
    });
    let theirs = drape.first_touch.as_ref().map(|touch| {
        let uv_mm = touch.place.map(|c| 1e3 * c);
        Touch { step: step_at(result, touch.time), uv_mm }
    });

    Ok(Comparison {
        height_max_mm: pair(&|all| all.iter().map(|(_, height)| 1e3 * height).fold(0.0, f64::max)),
        height_rms_mm: pair(&|all| 1e3 * mean(all, |height| height * height).sqrt()),
        height_share: pair(&|all| mean(all, |height| f64::from(u8::from(height > limit)))),
        first_touch: [ours, theirs],
        steps: compared,
        cpu_s: drape.cpu_s,
        time_steps: drape.steps,
        solves: drape.solves,
        refused: drape.refused,
    })
}

/// Areas (m²) and heights (m).
type Heights = [(f64, f64)];

/// Mean over the area of a function of the height.
fn mean(heights: &Heights, value: impl Fn(f64) -> f64) -> f64 {
    let area: f64 = heights.iter().map(|(area, _)| area).sum();
    heights.iter().map(|(area, height)| area * value(*height)).sum::<f64>() / area
}

/// Shear angle (rad) of a cell, by its two mid-lines as in equation (19b) of docs/theory/sheet.md.
fn shear(places: &[[f64; 3]], cell: &[u32; 4]) -> f64 {
    let [a, b, c, d] = cell.map(|n| places[n as usize]);
    let middle = |p: [f64; 3], q: [f64; 3]| [0, 1, 2].map(|n| 0.5 * (p[n] + q[n]));
    let along = sub(middle(b, c), middle(a, d));
    let across = sub(middle(d, c), middle(a, b));
    (dot(along, across) / (norm(along) * norm(across))).clamp(-1.0, 1.0).asin()
}

/// The step, from 1, at a time (s) since the start; a part of one between two steps.
fn step_at(result: &ResultFile, time: f64) -> f64 {
    let start = result.steps.first().map_or(0.0, |step| step.time);
    let after = result.steps.partition_point(|step| step.time - start < time);
    match (after.checked_sub(1).and_then(|n| result.steps.get(n)), result.steps.get(after)) {
        (Some(before), Some(next)) => {
            let share = (time - (before.time - start)) / (next.time - before.time);
            before.step as f64 + share
        }
        (Some(last), None) => last.step as f64,
        (None, _) => 1.0,
    }
}

#[cfg(test)]
mod tests;
