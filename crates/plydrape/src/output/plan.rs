//! The files of a plan: those of its drape, the motion, and what a later search can go on from.

use super::{OutputError, json, write_with};
use crate::planner::Planned;
use std::path::{Path, PathBuf};

/// Writes the files of the drape with `motion.csv`, and `plan.json`, into a folder, all or none, and returns
/// their paths.
///
/// # Errors
/// [`OutputError`], as for [`super::write_all`].
pub fn write_all(planned: &Planned, dir: &Path) -> Result<Vec<PathBuf>, OutputError> {
    let memory = json::of(&planned.memory)?;
    write_with(&planned.drape.result, &[("plan.json", memory.as_bytes())], dir)
}
