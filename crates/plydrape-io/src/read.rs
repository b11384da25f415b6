//! A result file, read back: the whole of it, unchanged, in this version of the format, or a refusal.
//!
//! Everything that is made of a result is made of these numbers, so a file that was cut short, edited or
//! written by another version is no basis. The check sum stands for all its bytes but white space at the end.

use super::finite;
use super::folder;
use super::json::{CHECKSUM, JsonError, checksum};
use crate::result::{FORMAT, ResultFile, SceneEcho, VERSION};
use crate::size::{self, SizeError};
use crate::{input, shown};
use plydrape::draping::record::{CatenaryKind, CatenaryState};
use plydrape::material::Section;
use plydrape::ply::{Catenary, FARTHEST, Grid, GripperId, is_near};
use plydrape::scene::Settings;
use serde::Deserialize;
use serde_json::error::Category;
use std::path::{Path, PathBuf};

/// Why a file is no result that can be used, and what to do.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// The file system refused.
    #[error("`{}` cannot be read: {source}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// The file system's answer.
        source: std::io::Error,
    },
    /// It would not fit the memory that is allowed.
    #[error("`{}`: {source}", path.display())]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// What is too large.
        source: SizeError,
    },
    /// The text breaks off.
    #[error("`{}` ends in the middle, at line {line}, column {column}: it was cut short", path.display())]
    Truncated {
        /// The file.
        path: PathBuf,
        /// Line of the end, from 1.
        line: usize,
        /// Column of the end, from 1.
        column: usize,
    },
    /// Something else, not written by plydrape.
    #[error("`{}` is not a result of plydrape: {reason}", path.display())]
    Foreign {
        /// The file.
        path: PathBuf,
        /// How that shows.
        reason: String,
    },
    /// Written in a later format.
    #[error("`{}` is a result in version {found} of the format, written by {program}; this is {} and reads version {VERSION}", path.display(), crate::PROGRAM)]
    Newer {
        /// The file.
        path: PathBuf,
        /// Version of the format.
        found: u64,
        /// The program that wrote it.
        program: String,
    },
    /// Written in an earlier format.
    #[error("`{}` is a result in version {found} of the format, written by {program}; this is {} and reads version {VERSION}", path.display(), crate::PROGRAM)]
    Older {
        /// The file.
        path: PathBuf,
        /// Version of the format.
        found: u64,
        /// The program that wrote it.
        program: String,
    },
    /// Beside files of another run: the last one was cut off while it replaced them.
    #[error("the files of `{}` are of two runs: the last one was cut off while it wrote them", path.display())]
    Mixed {
        /// The folder.
        path: PathBuf,
    },
    /// Changed since it was written.
    #[error("`{}` was changed since plydrape wrote it{}", path.display(), reason)]
    Changed {
        /// The file.
        path: PathBuf,
        /// How that shows, beginning with a colon; empty where only the check sum tells.
        reason: String,
    },
}

impl ReadError {
    /// What would help.
    #[must_use]
    pub fn remedy(&self) -> &'static str {
        match self {
            ReadError::Unreadable { .. } => "give the path of a result.json that you may read",
            ReadError::TooLarge { source, .. } => source.remedy(),
            ReadError::Truncated { .. } => {
                "copy it again, or run `plydrape simulate` or `plydrape plan` again"
            }
            ReadError::Foreign { .. } => {
                "give the result.json of `plydrape simulate` or `plydrape plan`"
            }
            ReadError::Newer { .. } => "update plydrape, or run the scene again with this version",
            ReadError::Mixed { .. } => "run the scene again into that folder",
            ReadError::Older { .. } => "run the scene again with this version",
            ReadError::Changed { .. } => {
                "put the file back as it was, or run `plydrape simulate` or `plydrape plan` again"
            }
        }
    }
}

/// What tells a result file before all of it is understood.
#[derive(Deserialize)]
struct Head {
    format: Option<serde_json::Value>,
    version: Option<u64>,
    program: Option<String>,
}

/// Reads a result file.
///
/// # Errors
/// [`ReadError`] if it cannot be read, or is not, to the last byte, what this version writes.
pub fn read(path: &Path) -> Result<ResultFile, ReadError> {
    let fault = |source| ReadError::Unreadable { path: path.into(), source };
    let size = input::size(path).map_err(fault)?;
    size::result(size).map_err(|source| ReadError::TooLarge { path: path.into(), source })?;
    let folder = path.parent().filter(|parent| *parent != Path::new("")).unwrap_or(Path::new("."));
    if !folder::is_sealed(folder) {
        return Err(ReadError::Mixed { path: folder.into() });
    }
    let bytes = input::bytes(path, size).map_err(fault)?;
    parse(&bytes, path)
}

/// The same from the bytes of a file; its path stands in messages.
///
/// # Errors
/// As [`read`].
pub fn parse(bytes: &[u8], path: &Path) -> Result<ResultFile, ReadError> {
    let path = path.to_path_buf();
    let Ok(text) = std::str::from_utf8(bytes) else {
        return Err(ReadError::Foreign { path, reason: "it is not text".into() });
    };
    let head: Head = match serde_json::from_str(text) {
        Ok(head) => head,
        Err(error) if error.classify() == Category::Eof && begins_as_ours(text) => {
            return Err(ReadError::Truncated { path, line: error.line(), column: error.column() });
        }
        Err(error) if begins_as_ours(text) => {
            return Err(ReadError::Changed { path, reason: format!(": {error}") });
        }
        Err(error) if error.classify() == Category::Data => {
            return Err(ReadError::Foreign {
                path,
                reason: format!("it has no `format` \"{FORMAT}\""),
            });
        }
        Err(error) => {
            return Err(ReadError::Foreign { path, reason: format!("it is not JSON, {error}") });
        }
    };
    let (version, program) = match head {
        Head { format: Some(format), version: Some(version), program } if format == FORMAT => {
            (version, program.unwrap_or_else(|| "an unknown program".into()))
        }
        _ => {
            let reason = format!("it has no `format` \"{FORMAT}\" with a `version`");
            return Err(ReadError::Foreign { path, reason });
        }
    };
    match version.cmp(&u64::from(VERSION)) {
        std::cmp::Ordering::Less => {
            return Err(ReadError::Older { path, found: version, program });
        }
        std::cmp::Ordering::Greater => {
            return Err(ReadError::Newer { path, found: version, program });
        }
        std::cmp::Ordering::Equal => {}
    }
    let result: ResultFile = serde_json::from_str(text)
        .map_err(|error| ReadError::Changed { path: path.clone(), reason: format!(": {error}") })?;
    if let Some(what) = fault(&result) {
        return Err(ReadError::Changed { path, reason: format!(": {what}") });
    }
    let value = format!("{CHECKSUM}\"{}\"", result.checksum);
    match text.split_once(&value) {
        Some((head, tail)) if checksum(head, tail) == result.checksum => Ok(result),
        _ => Err(ReadError::Changed {
            path,
            reason: ": its check sum does not match its contents".into(),
        }),
    }
}

/// What is impossible in a result, in words: a file whose check sum was made anew may hold anything, and everything made of
/// it relies on this.
fn fault(result: &ResultFile) -> Option<String> {
    of_ply(&result.scene)
        .or_else(|| of_net(&result.scene))
        .or_else(|| of_steps(result))
        .or_else(|| of_summary(result))
        .or_else(|| match finite::within(result, LARGEST_NUMBER) {
            Err(JsonError::NotFinite { key, value }) => {
                Some(format!("`{key}` is {value}, beyond {LARGEST_NUMBER:e}"))
            }
            _ => None,
        })
}

/// Largest number of a result in size: its square and its cube are far from overflow.
const LARGEST_NUMBER: f64 = 1e30;
/// Most grippers along a side, as in scenes.
const MOST_GRIPPERS: usize = 1000;
/// Smallest and largest fabric length of a cell (m), as in scenes.
const CELLS: [f64; 2] = [1e-6, 1e4];

fn of_ply(scene: &SceneEcho) -> Option<String> {
    let Grid { nu, nv } = scene.grid;
    if !(2..=MOST_GRIPPERS).contains(&nu) || !(1..=MOST_GRIPPERS).contains(&nv) {
        return Some(format!("there is no ply of {nu} × {nv} grippers"));
    }
    let [a, b] = scene.cell;
    if ![a, b].iter().all(|side| (CELLS[0]..=CELLS[1]).contains(side)) {
        return Some(format!("there is no cell of {a} × {b} m"));
    }
    if let Some(c) = shown::control(&scene.title) {
        return Some(format!("its title holds the control character {}", c.escape_unicode()));
    }
    let sound = match scene.material.section {
        Section::Line { mass, flexural_rigidity } => mass > 0.0 && flexural_rigidity >= 0.0,
        Section::Areal { mass, warp_rigidity, weft_rigidity } => {
            mass > 0.0 && warp_rigidity >= 0.0 && weft_rigidity >= 0.0
        }
    };
    let Settings { axial_stiffness, gravity, max_tilt, .. } = scene.settings;
    if !(sound && axial_stiffness > 0.0 && gravity > 0.0) {
        return Some("mass, stiffness and gravity must be above zero".into());
    }
    if !(max_tilt > 0.0 && max_tilt < std::f64::consts::FRAC_PI_2) {
        return Some(format!("there is no largest tilt of {max_tilt} rad"));
    }
    let target = scene.target_grippers.as_ref()?;
    match (target.len(), scene.grid.grippers()) {
        (found, wanted) if found != wanted => {
            Some(format!("its target has {found} grippers, not {wanted}"))
        }
        _ => target.iter().find_map(|place| far("a target", place)),
    }
}

fn of_net(scene: &SceneEcho) -> Option<String> {
    let net = scene.ideal_drape.as_ref()?;
    let [nu, nv] = net.layup.nodes;
    let nodes = nu.checked_mul(nv).filter(|_| nu > 0 && nv > 0);
    let cells = nodes.map(|_| (nu - 1) * (nv - 1));
    let seed = (0..2).all(|n| net.layup.seed[n] < net.layup.nodes[n]);
    let missing = net.missing.iter().all(|m| m.node[0] < nu && m.node[1] < nv);
    let mesh = net.layup.mesh.iter().all(|width| (CELLS[0]..=CELLS[1]).contains(width));
    if nodes != Some(net.nodes.len())
        || cells != Some(net.shear.len())
        || !seed
        || !missing
        || !mesh
    {
        return Some(format!("its ideal drape is no net of {nu} × {nv} nodes"));
    }
    net.nodes.iter().flatten().find_map(|place| far("a node of the ideal drape", place))
}

fn of_steps(result: &ResultFile) -> Option<String> {
    let grid = result.scene.grid;
    if result.steps.is_empty() {
        return Some("it has no step".into());
    }
    if let Some(n) =
        (1..result.steps.len()).find(|n| result.steps[*n].time <= result.steps[n - 1].time)
    {
        return Some(format!("the time of step {} is not after that of the step before", n + 1));
    }
    result.steps.iter().zip(1..).find_map(|(step, number)| {
        if step.step != number {
            return Some(format!("step {number} has the number {}", step.step));
        }
        let counts = [
            ("grippers", step.grippers.len(), grid.grippers()),
            ("catenaries", step.catenaries.len(), grid.catenaries()),
            ("cells", step.cells.len(), grid.cells()),
        ];
        if let Some((what, found, wanted)) =
            counts.into_iter().find(|(_, found, wanted)| found != wanted)
        {
            return Some(format!("step {number} has {found} {what}, not {wanted}"));
        }
        let grippers = step.grippers.iter().enumerate().find_map(|(n, gripper)| {
            if gripper.id != grid.id(n) {
                return Some(format!(
                    "gripper {:?} stands in the place of {:?}",
                    gripper.id,
                    grid.id(n)
                ));
            }
            let length = gripper.quaternion.iter().map(|q| q * q).sum::<f64>().sqrt();
            if (length - 1.0).abs() > 1e-3 {
                return Some(format!(
                    "the quaternion of gripper {:?} has the length {length}",
                    gripper.id
                ));
            }
            far("a gripper", &gripper.position)
        });
        let catenaries =
            || step.catenaries.iter().enumerate().find_map(|(n, line)| of_catenary(grid, n, line));
        let cells = || {
            step.cells.iter().enumerate().find_map(|(n, cell)| {
                let id = [n % (grid.nu - 1), n / (grid.nu - 1)];
                (cell.cell != id)
                    .then(|| format!("cell {:?} stands in the place of {id:?}", cell.cell))
            })
        };
        grippers.or_else(catenaries).or_else(cells).map(|what| format!("in step {number}, {what}"))
    })
}

fn of_catenary(grid: Grid, index: usize, line: &CatenaryState) -> Option<String> {
    let Catenary { from, to, kind } = grid.catenary(index);
    let edge = line.kind == CatenaryKind::Edge;
    if line.from != from || line.to != to || edge != kind.is_edge() {
        return Some(format!("catenary {index} does not lead from {from:?} to {to:?}"));
    }
    let name = || format!("catenary {from:?}–{to:?}");
    if line.length <= 0.0 {
        return Some(format!("{} has the length {}", name(), line.length));
    }
    for span in &line.spans {
        if let Some(what) = span.points.iter().find_map(|place| far("a span", place)) {
            return Some(what);
        }
    }
    let contact = line.contact.as_ref()?;
    let errors = contact.landing_error_mm.as_ref().map_or(contact.points.len(), Vec::len);
    if contact.points.is_empty() || errors != contact.points.len() {
        return Some(format!(
            "the contact of {} has {} points and {errors} errors",
            name(),
            contact.points.len()
        ));
    }
    contact.points.iter().find_map(|place| far("a contact", place))
}

fn of_summary(result: &ResultFile) -> Option<String> {
    let (summary, grid, steps) = (&result.summary, result.scene.grid, result.steps.len());
    if summary.steps != steps || summary.steps_planned < steps {
        return Some(format!(
            "its summary has {} of {} steps",
            summary.steps, summary.steps_planned
        ));
    }
    let named = [summary.first_contact_step, summary.first_shear_step, summary.all_shear_step];
    let judged = summary.limits.iter().map(|verdict| verdict.step);
    if let Some(step) = named.into_iter().chain(judged).flatten().find(|n| !(1..=steps).contains(n))
    {
        return Some(format!("its summary names step {step} of {steps}"));
    }
    let known = |[i, j]: GripperId| i < grid.nu && j < grid.nv;
    let unknown =
        summary.first_contact.iter().find(|line| !(known(line.from) && known(line.to)))?;
    Some(format!("its summary names a catenary from {:?} to {:?}", unknown.from, unknown.to))
}

/// What is wrong with a place (m) out of all range.
fn far(what: &str, place: &[f64; 3]) -> Option<String> {
    (!is_near(place)).then(|| format!("{what} is at {place:?} m, beyond {FARTHEST:e} m"))
}

/// Whether a text that is no JSON begins as a result file does.
fn begins_as_ours(text: &str) -> bool {
    let start: String = text.chars().filter(|c| !c.is_whitespace()).take(64).collect();
    start.starts_with(&format!("{{\"format\":\"{FORMAT}\""))
}

#[cfg(test)]
#[path = "read_tests.rs"]
mod tests;
