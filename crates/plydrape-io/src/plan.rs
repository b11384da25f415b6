//! The files of a plan: those of its drape, the motion, and `plan.json`, the checkpoint from which a later search continues.
//!
//! While a search runs, its checkpoint is written to `search.json` now and then, with all that it has judged: from there one that was cut off goes
//! on to the end that it would have had. The files of the plan take its place.

use crate::result::SceneEcho;
use crate::store::json;
use crate::store::manifest::Stamping;
use crate::{Error, Folder, ResultFile, Staged};
use plydrape::planner::Checkpoint;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// Name of the format, the first key of every plan file.
const FORMAT: &str = "plydrape-plan";
/// Version of the format; it grows when a key changes its meaning.
const VERSION: u32 = 4;

/// Name of the checkpoint of a search that has ended.
pub const FILE: &str = "plan.json";
/// Name of the checkpoint of a search that runs.
pub const RUNNING: &str = "search.json";

/// A plan file as it is written.
#[derive(Serialize)]
struct Written<'a> {
    format: &'static str,
    version: u32,
    #[serde(skip_serializing_if = "Option::is_none")]
    scene: Option<u32>,
    search: &'a Checkpoint,
}

/// What tells whether a plan file can be read.
#[derive(Deserialize)]
struct Head {
    format: String,
    version: u32,
}

/// A plan file as it is read.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Whole {
    #[serde(rename = "format")]
    _format: String,
    #[serde(rename = "version")]
    _version: u32,
    /// Check sum of the scene of a search that was cut off.
    scene: Option<u32>,
    search: Checkpoint,
}

/// A check sum of all that a scene says of its drapes.
fn checksum(scene: &SceneEcho) -> Result<u32, Error> {
    let mut sum = Stamping::new(std::io::sink());
    let scene = SceneEcho { input: None, title: String::new(), ..scene.clone() };
    serde_json::to_writer(&mut sum, &scene).map_err(Error::json)?;
    Ok(sum.stamp().crc32)
}

/// The text of a plan file, the checkpoint of a search of a scene.
///
/// # Errors
/// [`Error`] if a number is not finite.
pub fn text(search: &Checkpoint, scene: &SceneEcho) -> Result<String, Error> {
    let scene = search.is_unfinished().then(|| checksum(scene)).transpose()?;
    json::to_text(&Written { format: FORMAT, version: VERSION, scene, search })
}

/// Reads the text of a plan file for a search of a scene. Of a search of another one that was cut off only its best plan is left.
///
/// # Errors
/// [`Error::File`] if it is of another version.
pub fn read(text: &str, scene: &SceneEcho) -> Result<Checkpoint, Error> {
    let refused = |message: String| Error::file(FILE, message, "plan anew");
    let json = |fault: serde_json::Error| refused(fault.to_string());
    let Head { format, version } = serde_json::from_str(text).map_err(json)?;
    if (format.as_str(), version) != (FORMAT, VERSION) {
        return Err(refused(format!(
            "it is of format `{format}`, version {version}, expected `{FORMAT}`, version {VERSION}"
        )));
    }
    let Whole { scene: own, search, .. } = serde_json::from_str(text).map_err(json)?;
    let is_same = own.map_or(Ok(true), |own| checksum(scene).map(|sum| sum == own))?;
    Ok(if is_same { search } else { search.finished() })
}

/// Writes the files of a plan's result with `motion.csv`, and `plan.json`, into a folder, all or none, and returns
/// their paths.
///
/// # Errors
/// [`Error`], as for [`crate::write_all`].
pub fn write_all(
    result: &ResultFile,
    search: &Checkpoint,
    dir: &Path,
) -> Result<Vec<PathBuf>, Error> {
    write_into(Folder::claim(dir, "plan", &result.files)?, result, search)
}

/// Writes a plan into a folder that is claimed already.
///
/// # Errors
/// As [`write_all`].
pub fn write_into(
    folder: Folder,
    result: &ResultFile,
    search: &Checkpoint,
) -> Result<Vec<PathBuf>, Error> {
    stage_into(folder, result, search)?.write()
}

/// Writes the files without putting them in place, see [`Staged`].
///
/// # Errors
/// As [`write_all`].
pub fn stage_into(
    folder: Folder,
    result: &ResultFile,
    search: &Checkpoint,
) -> Result<Staged, Error> {
    let plan = text(search, &result.scene)?;
    super::stage_into(folder, result, &[(FILE, &plan.as_bytes())])
}
