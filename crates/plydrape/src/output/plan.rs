//! The files of a plan: those of its drape, the dense motion and what the search remembers.

use super::{OutputError, csv, json, write_with};
use crate::planner::Planned;
use std::path::{Path, PathBuf};

/// Writes the files of the drape, `motion.csv` with `rate` samples a second (Hz) and `plan.json` into a folder,
/// all or none, and returns their paths.
///
/// # Errors
/// [`OutputError`], as for [`super::write_all`].
pub fn write_all(planned: &Planned, rate: f64, dir: &Path) -> Result<Vec<PathBuf>, OutputError> {
    let grid = planned.drape.result.scene.grid;
    let motion = csv::motion(&planned.motion, &planned.attitudes, grid, rate)?;
    let memory = json::of(&planned.memory)?;
    let own = [("motion.csv", motion.as_bytes()), ("plan.json", memory.as_bytes())];
    write_with(&planned.drape.result, &own, dir)
}
