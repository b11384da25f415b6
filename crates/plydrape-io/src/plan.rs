//! The files of a plan: those of its drape, the motion, and `plan.json`, the checkpoint from which a later search continues.

use crate::store::json;
use crate::{Error, Folder, ResultFile, Staged};
use plydrape::planner::Checkpoint;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// Name of the format, the first key of every plan file.
const FORMAT: &str = "plydrape-plan";
/// Version of the format; it grows when a key changes its meaning.
const VERSION: u32 = 4;

#[derive(Serialize)]
struct Written<'a> {
    format: &'static str,
    version: u32,
    search: &'a Checkpoint,
}

#[derive(Deserialize)]
struct Head {
    format: String,
    version: u32,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Whole {
    #[serde(rename = "format")]
    _format: String,
    #[serde(rename = "version")]
    _version: u32,
    search: Checkpoint,
}

/// The text of a plan file.
///
/// # Errors
/// [`Error`] if a number is not finite.
pub fn text(search: &Checkpoint) -> Result<String, Error> {
    json::of(&Written { format: FORMAT, version: VERSION, search })
}

/// Reads the text of a plan file.
///
/// # Errors
/// [`Error::File`] if it is none of this version.
pub fn read(text: &str) -> Result<Checkpoint, Error> {
    let refused = |message: String| Error::file("plan.json", message, "plan anew");
    let json = |fault: serde_json::Error| refused(fault.to_string());
    let Head { format, version } = serde_json::from_str(text).map_err(json)?;
    if (format.as_str(), version) != (FORMAT, VERSION) {
        return Err(refused(format!(
            "it is of format `{format}`, version {version}, expected `{FORMAT}`, version {VERSION}"
        )));
    }
    Ok(serde_json::from_str::<Whole>(text).map_err(json)?.search)
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
    write_into(Folder::claim(dir, "plan")?, result, search, &[])
}

/// The same into a folder that is claimed already; files that the run has `read` are not removed.
///
/// # Errors
/// As [`write_all`].
pub fn write_into(
    folder: Folder,
    result: &ResultFile,
    search: &Checkpoint,
    read: &[PathBuf],
) -> Result<Vec<PathBuf>, Error> {
    stage_into(folder, result, search, read)?.write()
}

/// The same, but the files only stand ready, see [`Staged`].
///
/// # Errors
/// As [`write_all`].
pub fn stage_into(
    folder: Folder,
    result: &ResultFile,
    search: &Checkpoint,
    read: &[PathBuf],
) -> Result<Staged, Error> {
    let plan = text(search)?;
    super::stage_into(folder, result, &[("plan.json", &plan.as_bytes())], read)
}
