//! Files for other programs, all made from a result alone.
//!
//! Some of them drive machines: robots and axes follow them as they are. Of a motion that is not accepted these are written
//! only if the caller says so, see [`Options::even_if_rejected`].

use crate::Error;
use crate::result::ResultFile;
use crate::robot::program::{Program, Robot, Template, Tolerance, cam, template, wide};
use crate::robot::ros2;
use crate::store::folder::{self, Files};
use crate::write::{csv, inp, ngsolve, pattern, vtk};
use std::path::{Path, PathBuf};

pub use crate::write::ngsolve::TENSION;

/// What a result is made into.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Tables: `steps.csv`, `trajectory.csv`, `motion_wide.csv`, for a plan `motion.csv`, for a tool with axes `array_cam.csv`.
    Csv,
    /// Abaqus and CalculiX: `ply.inp`, shells, gripper motion and a rigid mold.
    Inp,
    /// NGSolve: `drape.py`, which drapes the motion in this finite element code, and its data `ply.json`.
    Ngsolve,
    /// The ply in the flat, with its cups and its warp: `pattern.dxf` for a cutter, `pattern.pdf` at full size.
    Pattern,
    /// The boundary of the ply on the mold at the end, for a laser projector: `boundary.csv` and `boundary.dxf`.
    Boundary,
    /// ROS 2: the motion of axes, flange and vacuum as YAML, and a bag of it with the ply's markers.
    Ros2,
    /// A program for the controller of a robot.
    Robot(Robot),
    /// VTK: series of ply, catenaries and grippers, and the mold.
    Vtk,
}

impl Format {
    /// The formats that are no program, by their names.
    const NAMES: [(&str, Format); 7] = [
        ("csv", Format::Csv),
        ("inp", Format::Inp),
        ("ngsolve", Format::Ngsolve),
        ("pattern", Format::Pattern),
        ("boundary", Format::Boundary),
        ("ros2", Format::Ros2),
        ("vtk", Format::Vtk),
    ];

    /// The format of a name; of a program also by the maker of its controller.
    #[must_use]
    pub fn named(word: &str) -> Option<Format> {
        let found = Self::NAMES.iter().find(|(name, _)| *name == word);
        found.map(|(_, format)| *format).or(Robot::named(word).map(Format::Robot))
    }

    /// The name of the format; of a program that of its language.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Format::Robot(robot) => robot.name(),
            _ => Self::NAMES.iter().find(|(_, format)| *format == self).map_or("", |found| found.0),
        }
    }

    /// Whether a machine follows its files as they are.
    #[must_use]
    pub fn drives(self) -> bool {
        match self {
            Format::Csv | Format::Ros2 | Format::Robot(_) => true,
            Format::Inp | Format::Ngsolve | Format::Pattern | Format::Boundary | Format::Vtk => {
                false
            }
        }
    }
}

/// How files are made.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Options {
    /// Write what drives a machine also of a motion that is not accepted. Such files say so in their heads.
    pub even_if_rejected: bool,
    /// How far what a controller interpolates may be from the motion.
    pub tolerance: Tolerance,
    /// Write what drives a machine also of a motion of more than ten minutes or 50 MB.
    pub large: bool,
    /// Frames over time (`/tf`) in a bag for ROS 2.
    pub tf: bool,
    /// Largest side (m) of the quads of `ngsolve`; a quarter of the distance of neighboring grippers unless given.
    pub mesh: Option<f64>,
    /// Tension stiffness per width (N/m) of `inp` and `ngsolve`; [`TENSION`] unless given.
    pub tension: Option<f64>,
    /// Templates of the user's own, in place of shipped ones; for robots alone.
    pub templates: Vec<Template>,
}

/// Longest motion that is written without request (s).
const LONGEST: f64 = 600.0;

/// Largest tables of a motion that are written without request (bytes).
const LARGEST: f64 = 50e6;

/// Bytes of a gripper in a row of the tables of a motion, about.
const ROW: f64 = 220.0;

/// Why files with all samples of a planned motion are only written on request: it takes more than ten minutes, or a table of it would have
/// more than 50 MB. `None` of any other result.
#[must_use]
pub fn too_large(result: &ResultFile) -> Option<String> {
    let plan = result.plan.as_ref()?;
    let duration = result.motion().ok()??.motion.duration();
    let bytes = duration * plan.rate * result.scene.ply.grippers() as f64 * ROW;
    let is_large = duration > LONGEST || bytes > LARGEST;
    is_large.then(|| {
        format!(
            "the motion takes {duration:.0} s, and its samples would have some {:.0} MB",
            bytes / 1e6
        )
    })
}

/// The files of a format. Same result, same options, same bytes.
///
/// # Errors
/// [`Error`] if the result cannot be shown in the format, or is not accepted and the format drives a machine.
pub fn files(result: &ResultFile, format: Format, options: &Options) -> Result<Files, Error> {
    // what drives a machine must be accepted, and not too large, unless the options allow it
    if format.drives() && !options.even_if_rejected {
        gate(result)?;
    }
    if let Some(why) = too_large(result).filter(|_| format.drives() && !options.large) {
        let help = "see in the verdict what limits its speed, give a lower `rate` in [plan], or write them with --large (in Python large=True)";
        return Err(Error::not_possible(why, help));
    }

    // the tension stiffness of the options is a number above 0
    let is_stiffness = |tension: f64| tension > 0.0 && tension.is_finite();
    if let Some(tension) = options.tension.filter(|tension| !is_stiffness(*tension)) {
        let message =
            format!("the tension stiffness is {tension} N/m, which is not a number above 0");
        return Err(Error::not_possible(message, "give a number above 0, e.g. 2e4"));
    }

    // the files of the format, each with its name
    let text = |name: &str, text: String| (name.to_owned(), text.into_bytes());
    Ok(match format {
        Format::Csv => {
            let program = Program::new(result)?;
            let mut files = vec![
                text("steps.csv", csv::steps(result)?),
                text("trajectory.csv", csv::trajectory(result)?),
            ];
            let motion = csv::planned_motion(result)?;
            files.extend(motion.map(|motion| text("motion.csv", wide::head(&program) + &motion)));
            files.push(text(wide::FILE, wide::text(&program)?));
            files.extend(cam::text(&program)?.map(|cam| text(cam::FILE, cam)));
            files
        }
        Format::Pattern => pattern::result::flat(result),
        Format::Boundary => pattern::result::boundary(result)?,
        Format::Ros2 => ros2::files(result, options.tf)?,
        Format::Robot(robot) => {
            let program = Program::new(result)?;
            template::files(&program, robot, &options.templates, &options.tolerance)?
        }
        Format::Vtk => vtk::files(result)?,
        Format::Inp => {
            vec![text("ply.inp", inp::text(result, options.tension.unwrap_or(TENSION))?)]
        }
        Format::Ngsolve => ngsolve::files(result, options.mesh, options.tension)?,
    })
}

/// Refuses a result that is not accepted, by its verdict and by its motion, which is judged again.
fn gate(result: &ResultFile) -> Result<(), Error> {
    let judged = result.judged_again();
    if judged.accepted() {
        return Ok(());
    }
    let verdict = Program::verdict(result, &judged);
    let message = format!(
        "the motion is not accepted, and these files would drive a machine along it ({verdict})"
    );
    let help = "change the scene or plan again, or write them with --even-if-rejected (in Python even_if_rejected=True); they then say so in their heads";
    Err(Error::not_possible(message, help))
}

/// Writes the files of a format into a folder, all or none, and returns their paths. Other files there stay; those
/// of the same names only make way if plydrape wrote them and nobody has changed them since. What is measured in a cell is written once and
/// stays where it exists.
///
/// # Errors
/// [`Error`], as for [`files`] and [`crate::write_all`].
pub fn write(
    result: &ResultFile,
    format: Format,
    options: &Options,
    dir: &Path,
) -> Result<Vec<PathBuf>, Error> {
    let files = to_write(files(result, format, options)?, format, options, dir);
    put(&files, dir, &result.files)
}

/// The files without those that are written once and exist: what was measured in a cell.
#[must_use]
pub fn to_write(files: Files, format: Format, options: &Options, dir: &Path) -> Files {
    let stays = |name: &str| match format {
        Format::Robot(robot) => {
            robot.is_of_cell(name, &options.templates) && dir.join(name).exists()
        }
        _ => false,
    };
    files.into_iter().filter(|(name, _)| !stays(name)).collect()
}

/// Writes files as [`write()`] does, by a run that has `read` others: none of them is replaced.
///
/// # Errors
/// [`Error`], as for [`crate::write_all`].
pub fn put(files: &Files, dir: &Path, read: &[PathBuf]) -> Result<Vec<PathBuf>, Error> {
    let files: Vec<(&str, &[u8])> =
        files.iter().map(|(name, content)| (name.as_str(), content.as_slice())).collect();
    folder::add(dir, "export", &files, read)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample;
    use plydrape::measure::Name;

    /// A result whose rows leave the speed out, as one of an earlier version or one that was edited: its own word is that it is accepted, and the
    /// limit of its scene is judged all the same. So is one that nothing measured.
    #[test]
    fn a_verdict_that_leaves_a_limit_out_passes_no_gate() {
        let mut result = sample::draped(4, 2, 3);
        let csv = |result: &ResultFile| files(result, Format::Csv, &Options::default());
        assert!(result.summary.accepted() && csv(&result).is_ok());
        for (name, limit, said) in
            [(Name::Speed, 0.01, "speed 0."), (Name::Height, 0.02, "the sheet alone measures it")]
        {
            let usual = result.scene.limits.clone();
            result.scene.limits.set(name, Some(limit));
            assert!(result.summary.accepted());
            let refused = csv(&result).unwrap_err();
            assert!(refused.message().contains(said), "{refused}");
            let options = Options { even_if_rejected: true, ..Options::default() };
            assert!(files(&result, Format::Csv, &options).is_ok());
            result.scene.limits = usual;
        }
    }

    /// No thickness of a shell follows from them, and NaN would be in the file.
    #[test]
    fn a_tension_stiffness_that_is_none_is_refused() {
        let result = sample::draped(4, 2, 3);
        for tension in [f64::NAN, f64::INFINITY, 0.0, -2e4] {
            let options = Options { tension: Some(tension), ..Options::default() };
            let refused = files(&result, Format::Inp, &options).unwrap_err();
            assert!(refused.message().contains("tension stiffness"), "{refused}");
        }
    }
}
