//! `plydrape export`: files for other programs, from a result alone.

use crate::failure::Done;
use crate::results;
use clap::ValueEnum;
use plydrape_io::{export, read};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Make files for other programs from a result.json.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
The result must be as `plydrape simulate` or `plydrape plan` wrote it, by this version. Files of the \
same name in the folder that plydrape did not write, or that were edited since, are never \
overwritten; all others stay.")]
pub struct Arguments {
    /// The result.json of an earlier run.
    result: PathBuf,

    /// What to make.
    #[arg(long, value_name = "FORMAT")]
    to: Format,

    /// Folder of the files; beside the result, with the format's name, unless given.
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
}

/// What a result is made into.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum Format {
    /// Tables: steps.csv, trajectory.csv, and motion.csv of a plan.
    Csv,
    /// The figure: figure.svg.
    Svg,
    /// Abaqus and CalculiX: ply.inp, shells, gripper motion and a rigid mold.
    Inp,
    /// The ply in the flat with its cups and its warp: pattern.dxf, and pattern.pdf at full size.
    Pattern,
    /// The boundary of the ply at the end, for a laser projector: boundary.csv and boundary.dxf.
    Boundary,
    /// ROS 2: trajectory.yaml, and trajectory.mcap, a bag with the ply's shape in it.
    Ros2,
    /// ParaView: drape.pvd and its parts.
    Vtk,
}

impl Format {
    fn of(self) -> export::Format {
        match self {
            Format::Csv => export::Format::Csv,
            Format::Inp => export::Format::Inp,
            Format::Svg => export::Format::Svg,
            Format::Pattern => export::Format::Pattern,
            Format::Boundary => export::Format::Boundary,
            Format::Ros2 => export::Format::Ros2,
            Format::Vtk => export::Format::Vtk,
        }
    }

    fn folder(self) -> &'static str {
        match self {
            Format::Csv => "csv",
            Format::Inp => "inp",
            Format::Svg => "svg",
            Format::Pattern => "pattern",
            Format::Boundary => "boundary",
            Format::Ros2 => "ros2",
            Format::Vtk => "vtk",
        }
    }
}

/// Reads the result and writes the files.
pub fn run(arguments: &Arguments, quiet: bool) -> Done {
    let result = read::read(&arguments.result)?;
    let beside = || arguments.result.parent().unwrap_or(Path::new("")).join(arguments.to.folder());
    let folder = arguments.output.clone().unwrap_or_else(beside);
    let files = export::write(&result, arguments.to.of(), &folder)?;
    if !quiet {
        results::list(&files)?;
    }
    Ok(ExitCode::SUCCESS)
}
