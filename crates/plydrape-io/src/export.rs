//! Files for other programs, all made from a result alone.

use super::{OutputError, csv, figure, folder, inp, pattern, ros2, vtk};
use crate::result::ResultFile;
use std::path::{Path, PathBuf};

/// What a result is made into.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Tables: `steps.csv`, `trajectory.csv`, for a plan `motion.csv`.
    Csv,
    /// The figure: `figure.svg`.
    Svg,
    /// Abaqus and CalculiX: `ply.inp`, shells, gripper motion and a rigid mold.
    Inp,
    /// The ply in the flat, with its cups and its warp: `pattern.dxf` for a cutter, `pattern.pdf` at full size.
    Pattern,
    /// The boundary of the ply on the mold at the end, for a laser projector: `boundary.csv` and `boundary.dxf`.
    Boundary,
    /// ROS 2: the trajectory as YAML, and a bag of it with the ply's markers.
    Ros2,
    /// VTK: series of ply, catenaries and grippers, and the mold.
    Vtk,
}

/// Files by plain name, with their contents.
pub type Files = Vec<(String, Vec<u8>)>;

/// The files of a format. Same result, same bytes.
///
/// # Errors
/// [`OutputError`] if the result cannot be shown in the format.
pub fn files(result: &ResultFile, format: Format) -> Result<Files, OutputError> {
    let text = |name: &str, text: String| (name.to_owned(), text.into_bytes());
    Ok(match format {
        Format::Csv => {
            let mut files = vec![
                text("steps.csv", csv::steps(result)?),
                text("trajectory.csv", csv::trajectory(result)?),
            ];
            files.extend(csv::planned_motion(result)?.map(|motion| text("motion.csv", motion)));
            files
        }
        Format::Pattern => pattern::result::flat(result),
        Format::Boundary => pattern::result::boundary(result)?,
        Format::Ros2 => ros2::files(result)?,
        Format::Vtk => vtk::files(result)?,
        Format::Inp => vec![text("ply.inp", inp::text(result)?)],
        Format::Svg => {
            vec![text("figure.svg", figure::svg(result, &figure::default_steps(result))?)]
        }
    })
}

/// Writes the files of a format into a folder, all or none, and returns their paths. Other files there stay; those
/// of the same names only make way if plydrape wrote them and nobody has changed them since.
///
/// # Errors
/// [`OutputError`], as for [`super::write_all`].
pub fn write(result: &ResultFile, format: Format, dir: &Path) -> Result<Vec<PathBuf>, OutputError> {
    let files = files(result, format)?;
    let files: Vec<(&str, &[u8])> =
        files.iter().map(|(name, content)| (name.as_str(), content.as_slice())).collect();
    folder::add(dir, "export", &files)
}
