//! Files of plydrape: scenes, mesh readers, result files, exports, pictures and the page.
//!
//! The crate `plydrape` computes; this one reads what it needs and writes what it found, and computes no physics:
//!
//! 1. [`scene`]: a file becomes a checked scene, with [`mesh`] and [`formula`] for its mold and [`outline`] for its ply;
//! 2. [`result`]: a drape becomes a result file, [`json`] writes it and [`read`] reads it back;
//! 3. [`csv`], [`vtk`], [`inp`], [`ros2`], [`page`], [`pattern`]: everything else is made from a result;
//!    [`program`] is what a cell does over time, for the controllers of robots;
//! 4. [`net`] does the same for an ideal drape, with pictures by [`figure`], [`plan`] for a plan, [`replan`] for one whose ply lies elsewhere, [`comparison`] for several strategies, [`book`] for the plies of a part, [`sheet`] keeps the states of a sheet beside its result;
//!    [`table`] prints for people;
//! 5. [`folder`] writes files whole or not at all, [`input`] reads regular files alone, and [`size`] refuses what would not fit
//!    the memory.

pub mod book;
pub mod comparison;
pub mod csv;
mod error;
pub mod export;
pub mod figure;
mod file_kind;
pub mod fit;
pub mod folder;
pub mod format;
pub mod formula;
pub mod inp;
pub mod input;
pub mod json;
mod loads;
mod manifest;
pub mod mesh;
pub mod mold_patch;
pub mod net;
pub mod outline;
pub mod page;
pub mod pattern;
pub mod plan;
pub mod program;
mod read_error;
pub mod replan;
pub mod result;
pub mod ros2;
pub mod scene;
pub mod sheet;
pub mod shown;
pub mod size;
pub mod strategy;
pub mod surface;
pub mod table;
pub mod vtk;

#[cfg(test)]
mod sample;

pub use error::OutputError;

pub use folder::{Content, Files, Folder, Staged};
pub use read_error::ReadError;
pub use result::{ResultFile, read};

use std::path::{Path, PathBuf};

/// Name and version of this program, as it stands in what it writes.
pub const PROGRAM: &str = concat!("plydrape ", env!("CARGO_PKG_VERSION"));

/// Writes `result.json`, `steps.csv`, `trajectory.csv`, for a plan `motion.csv`, and `report.html` into a folder, all or
/// none.
///
/// Returns the paths. Same result, same bytes.
///
/// # Errors
/// [`OutputError`] if a number is not finite, a file in the way is not plydrape's, or the disk refuses;
/// the folder is then as it was.
pub fn write_all(result: &ResultFile, dir: &Path) -> Result<Vec<PathBuf>, OutputError> {
    write_into(Folder::claim(dir, "simulate")?, result, &[], &[])
}

/// The names of the files of [`write_all`], and of those that a plan has beside them.
pub const NAMES: [&str; 7] = [
    "result.json",
    "steps.csv",
    "trajectory.csv",
    "report.html",
    sheet::NAME,
    "motion.csv",
    "plan.json",
];

/// As [`write_all`] into a folder that is claimed already, with `more` files (plain name and content) behind them; files
/// that the run has `read` are not removed.
///
/// # Errors
/// As [`write_all`].
pub fn write_into(
    folder: Folder,
    result: &ResultFile,
    more: &[(&str, &dyn Content)],
    read: &[PathBuf],
) -> Result<Vec<PathBuf>, OutputError> {
    stage_into(folder, result, more, read)?.write()
}

/// The same, but the files only stand ready, see [`Staged`].
///
/// # Errors
/// As [`write_all`].
pub fn stage_into(
    folder: Folder,
    result: &ResultFile,
    more: &[(&str, &dyn Content)],
    read: &[PathBuf],
) -> Result<Staged, OutputError> {
    // First of all: no number that is not finite goes on.
    result.check_finite()?;
    let steps = csv::steps(result)?;
    let trajectory = csv::trajectory(result)?;
    let motion = csv::planned_motion(result)?;
    let page = page::html(result)?;
    let [steps, trajectory, page] = [&steps, &trajectory, &page].map(|text| text.as_bytes());
    let motion = motion.as_ref().map(|motion| motion.as_bytes());
    let mut files: Vec<(&str, &dyn Content)> =
        vec![("result.json", result), ("steps.csv", &steps), ("trajectory.csv", &trajectory)];
    files.extend(motion.as_ref().map(|motion| ("motion.csv", motion as &dyn Content)));
    files.push(("report.html", &page));
    files.extend(result.sheet_states.as_ref().map(|states| (sheet::NAME, states as &dyn Content)));
    files.extend(more);
    folder.stage_files(&files, read)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Four files, and the same bytes again from the same result.
    #[test]
    fn write_all_is_complete_and_repeats_itself() {
        let dir = tempfile::tempdir().unwrap();
        let result = sample::draped(4, 2, 30);
        let paths = write_all(&result, dir.path()).unwrap();
        let names: Vec<_> = paths.iter().filter_map(|p| p.file_name()).collect();
        assert_eq!(names, ["result.json", "steps.csv", "trajectory.csv", "report.html"]);
        let read = || -> Vec<Vec<u8>> { paths.iter().map(|p| std::fs::read(p).unwrap()).collect() };
        let first = read();
        write_all(&result, dir.path()).unwrap();
        assert_eq!(read(), first);
    }

    /// A result that cannot be written leaves no folder behind.
    #[test]
    fn a_number_that_is_not_finite_writes_nothing() {
        let home = tempfile::tempdir().unwrap();
        let mut result = sample::draped(2, 2, 2);
        result.steps[0].time = f64::NAN;
        let fault = write_all(&result, &home.path().join("out")).unwrap_err();
        assert!(fault.to_string().contains("steps[0].time"), "{fault}");
        assert!(!home.path().join("out").exists());
    }
}
