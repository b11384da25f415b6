//! Files of plydrape: scenes, mesh readers, result files, exports, pictures and the page.
//!
//! The crate `plydrape` computes; this one reads what it needs and writes what it found, and computes no physics. Its folders, from the
//! bottom to the top:
//!
//! | folder | what it does |
//! |---|---|
//! | [`error`](mod@error) | why something could not be read, made or written |
//! | [`store`] | writes folders whole or not at all, JSON without NaN, reads regular files alone, and refuses what would not fit the memory |
//! | [`read`] | readers of meshes, drawings and formulas |
//! | [`result`] | the result file, and the states of a sheet beside it |
//! | [`scene`] | a file becomes a checked scene |
//! | [`text`] | results as tables for people |
//! | [`write`](mod@write) | files for other programs, each made from a result alone |
//! | [`robot`] | what a cell does over time: programs for controllers of robots, messages of ROS 2 |
//! | [`page`] | the results page |
//! | [`export`], [`fit`], [`plan`], [`replan`] | all exports by name, fitted materials, the files of a plan and of one whose ply lies elsewhere |
//! | [`rerun`] | where a run that was interrupted writes, if an earlier one has left better results |
//! | [`peer`] | a result beside the drape of its motion in another program |

pub mod error;
pub mod export;
pub mod fit;
pub mod page;
pub mod peer;
pub mod plan;
pub mod read;
pub mod replan;
pub mod rerun;
pub mod result;
pub mod robot;
pub mod scene;
pub mod store;
pub mod text;
pub mod write;

#[cfg(test)]
mod sample;

pub use error::{Diagnostic, Error};

pub use result::ResultFile;
pub use store::folder::{Content, Files, Folder, Staged};

use plydrape::layup::Model;
use plydrape::scene::Scene;
use std::path::{Path, PathBuf};

/// Name and version of this program, as it is written into its files.
pub const PROGRAM: &str = concat!("plydrape ", env!("CARGO_PKG_VERSION"));

/// Writes `result.json`, `steps.csv`, `trajectory.csv`, for a plan `motion.csv`, and `report.html` into a folder, all or
/// none.
///
/// Returns the paths. Same result, same bytes.
///
/// # Errors
/// [`Error`] if a number is not finite, a file in the way is not plydrape's, or the disk refuses;
/// the folder is then as it was.
pub fn write_all(result: &ResultFile, dir: &Path) -> Result<Vec<PathBuf>, Error> {
    write_into(Folder::claim(dir, "simulate", &result.files)?, result, &[])
}

/// The names of the files of [`write_all`], and of those that a plan has beside them.
pub const NAMES: [&str; 7] = [
    store::format::FILE,
    "steps.csv",
    "trajectory.csv",
    "report.html",
    result::sheet::NAME,
    "motion.csv",
    plan::FILE,
];

/// The files among [`NAMES`] that a drape of a scene writes, or a plan of it.
#[must_use]
pub fn names(scene: &Scene, planned: bool) -> Vec<&'static str> {
    let draped = scene.also || scene.layup.settings.model == Model::Sheet;
    let names = if planned { &NAMES[..] } else { &NAMES[..5] };
    names.iter().copied().filter(|name| draped || *name != result::sheet::NAME).collect()
}

/// As [`write_all`] into a folder that is claimed already, with `more` files (plain name and content) behind them.
///
/// # Errors
/// As [`write_all`].
pub fn write_into(
    folder: Folder,
    result: &ResultFile,
    more: &[(&str, &dyn Content)],
) -> Result<Vec<PathBuf>, Error> {
    stage_into(folder, result, more)?.write()
}

/// Writes the files without putting them in place, see [`Staged`].
///
/// # Errors
/// As [`write_all`].
pub fn stage_into(
    folder: Folder,
    result: &ResultFile,
    more: &[(&str, &dyn Content)],
) -> Result<Staged, Error> {
    // First of all: no number that is not finite goes on.
    result.check_finite()?;
    let steps = write::csv::steps(result)?;
    let trajectory = write::csv::trajectory(result)?;
    // of a motion that is too large, on request: export makes it
    let motion = match export::too_large(result) {
        Some(_) => None,
        None => write::csv::planned_motion(result)?,
    };
    let page = page::html(result)?;
    let [steps, trajectory, page] = [&steps, &trajectory, &page].map(|text| text.as_bytes());
    let motion = motion.as_ref().map(|motion| motion.as_bytes());
    let mut files: Vec<(&str, &dyn Content)> =
        vec![(store::format::FILE, result), ("steps.csv", &steps), ("trajectory.csv", &trajectory)];
    files.extend(motion.as_ref().map(|motion| ("motion.csv", motion as &dyn Content)));
    files.push(("report.html", &page));
    files.extend(
        result.sheet_states.as_ref().map(|states| (result::sheet::NAME, states as &dyn Content)),
    );
    files.extend(more);
    folder.stage_files(&files)
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
