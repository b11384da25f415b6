//! `plydrape export`: files for other programs and for machines, from a result alone.

use crate::argument::{refused, value};
use crate::failure::{Done, Failure};
use crate::results;
use crate::watch::whole;
use clap::ValueEnum;
use plydrape_io::export;
use plydrape_io::result::read;
use plydrape_io::robot::program::{LONGEST_TEMPLATE, Robot, Template, Tolerance};
use plydrape_io::scene::{Measured, usual};
use plydrape_io::store::input;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Make files for other programs and for machines from a result.json.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
The result must be as `plydrape simulate` or `plydrape plan` wrote it, by this version. Files of the \
same name in the folder that plydrape did not write, or that were edited since, are never \
overwritten; all others stay. The tool, the mold, the load and the signals of rapid, krl and urscript are in a \
file of their own (NAME_cell.mod, NAME.dat, NAME_cell.script), which is written once and stays as it is \
where it exists.

abb, kuka and ur mean rapid, krl and urscript.

csv, ros2, rapid, krl and urscript drive machines: of a result that is not accepted they are only \
written with --even-if-rejected.")]
pub struct Arguments {
    /// The result.json of an earlier run, or its folder.
    result: PathBuf,

    /// What to make.
    #[arg(long, value_name = "FORMAT")]
    to: Format,

    /// Folder of the files; beside the result, with the format's name, unless given.
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,

    /// Write what drives a machine although the result is not accepted; the files say so in their heads.
    #[arg(long)]
    even_if_rejected: bool,

    /// How far what rapid, krl and urscript pass between their points may be from the motion; 0.1 mm unless given.
    #[arg(long, value_name = "LENGTH")]
    position_error: Option<String>,

    /// Least way between two points of rapid, krl and urscript, whatever error that leaves; 1 mm unless given.
    #[arg(long, value_name = "LENGTH")]
    least_way: Option<String>,

    /// Least time between two points of rapid, krl and urscript, whatever error that leaves; 0.1 s unless given.
    #[arg(long, value_name = "TIME")]
    least_time: Option<String>,

    /// Write what drives a machine also of a motion of more than ten minutes, or with samples of more than 50 MB.
    #[arg(long)]
    large: bool,

    /// Write the frames over time (/tf) into the bag of ros2.
    #[arg(long)]
    tf: bool,

    /// Largest side of the quads of ngsolve; a quarter of the distance of neighboring grippers unless given.
    #[arg(long, value_name = "LENGTH")]
    mesh: Option<String>,

    /// Tension stiffness per width of inp and ngsolve, far below that of a yarn, because shells of a ply's thickness converge then; 2e4 N/m unless given.
    #[arg(long, value_name = "STIFFNESS")]
    tension: Option<String>,

    /// A template of your own for rapid, krl or urscript, such as a changed copy of what `plydrape template` prints; its name ends
    /// as in cell.mod.j2. May be given several times.
    #[arg(long, value_name = "FILE")]
    template: Vec<PathBuf>,
}

/// What a result is made into.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    /// Tables: steps.csv, trajectory.csv, motion_wide.csv, and motion.csv of a plan.
    Csv,
    /// Abaqus and CalculiX: ply.inp, shells, gripper motion and a rigid mold.
    Inp,
    /// NGSolve: drape.py, a script that drapes the motion in this finite element code, and its data ply.json.
    Ngsolve,
    /// The ply in the flat with its cups and its warp: pattern.dxf, and pattern.pdf at full size.
    Pattern,
    /// The boundary of the ply at the end, for a laser projector: boundary.csv and boundary.dxf.
    Boundary,
    /// ROS 2: axes, flange and vacuum as YAML, and trajectory.mcap, a bag with frames and the ply's shape in it.
    Ros2,
    /// ABB: a RAPID module.
    #[value(alias = Robot::Rapid.maker())]
    Rapid,
    /// KUKA: a KRL program, .src and .dat.
    #[value(alias = Robot::Krl.maker())]
    Krl,
    /// Universal Robots: a URScript.
    #[value(alias = Robot::Urscript.maker())]
    Urscript,
    /// ParaView: drape.pvd and its parts.
    Vtk,
}

impl Format {
    fn format(self) -> export::Format {
        match self {
            Format::Csv => export::Format::Csv,
            Format::Inp => export::Format::Inp,
            Format::Ngsolve => export::Format::Ngsolve,
            Format::Pattern => export::Format::Pattern,
            Format::Boundary => export::Format::Boundary,
            Format::Ros2 => export::Format::Ros2,
            Format::Rapid => export::Format::Robot(Robot::Rapid),
            Format::Krl => export::Format::Robot(Robot::Krl),
            Format::Urscript => export::Format::Robot(Robot::Urscript),
            Format::Vtk => export::Format::Vtk,
        }
    }
}

/// Range of the position error (m): below it doubles and controllers cannot tell, above it no motion is left.
const POSITION_ERRORS: [f64; 2] = [1e-7, 1.0];

/// Range of the least way (m) and of the least time (s) between two points.
const LEAST: [f64; 2] = [0.0, 1.0];
/// Range of the tension stiffness (N/m).
const TENSIONS: [f64; 2] = [1.0, 1e9];
/// Range of the quads' sides (m).
const MESHES: [f64; 2] = [1e-4, 10.0];

/// Reads the result and writes the files.
pub fn run(arguments: &Arguments, quiet: bool) -> Done {
    let options = options(arguments)?;
    let file = read::file_of(&arguments.result);
    let result = read::read(&file)?;
    let beside = || file.parent().unwrap_or(Path::new("")).join(arguments.to.format().name());
    let folder = arguments.output.clone().unwrap_or_else(beside);
    let made = export::files(&result, arguments.to.format(), &options)?;
    let names: Vec<String> = made.iter().map(|(name, _)| name.clone()).collect();
    let files = export::to_write(made, arguments.to.format(), &options, &folder);
    let written = |name: &String| files.iter().any(|(file, _)| file == name);
    let stays: Vec<String> = names.into_iter().filter(|name| !written(name)).collect();
    let read = [&result.files[..], &arguments.template].concat();
    let files = whole(|| export::put(&files, &folder, &read))?;
    if !quiet {
        let mut text = results::list(&files);
        if !stays.is_empty() {
            text += &format!("stays as it is: {}\n", stays.join(", "));
        }
        results::print(&text, &files)?;
    }
    Ok(ExitCode::SUCCESS)
}

fn options(arguments: &Arguments) -> Result<export::Options, Failure> {
    // options that mean nothing for a format are refused, not ignored
    let is_robot = matches!(arguments.to.format(), export::Format::Robot(_));
    if !is_robot && !arguments.template.is_empty() {
        return Err(Failure::Refused {
            message: format!("there are no templates for {}", arguments.to.format().name()),
            help: "rapid, krl and urscript are written by templates".into(),
        });
    }
    if arguments.tf && arguments.to != Format::Ros2 {
        return Err(Failure::Refused {
            message: format!("--tf has no meaning for {}", arguments.to.format().name()),
            help: "it is for ros2, whose bag then has the frames over time".into(),
        });
    }

    // how far points of a program may be thinned out
    let Arguments { position_error, least_way, least_time, .. } = arguments;
    let mut tolerance = Tolerance::default();
    let lengths = Measured::Length;
    for (option, text, measured, usual, range, to) in [
        (
            "--position-error",
            position_error,
            lengths,
            &usual::PositionError::USUAL,
            POSITION_ERRORS,
            &mut tolerance.position,
        ),
        (
            "--least-way",
            least_way,
            lengths,
            &usual::PositionError::USUAL,
            LEAST,
            &mut tolerance.least_way,
        ),
        ("--least-time", least_time, Measured::Time, &usual::ANY, LEAST, &mut tolerance.least_time),
    ] {
        let Some(text) = text else { continue };
        if !is_robot {
            let fault = format!("has no meaning for {}", arguments.to.format().name());
            let help = "it is for rapid, krl and urscript, whose points are thinned out";
            return Err(refused(option, text, &fault, help));
        }
        let help = match option {
            "--position-error" => {
                "give a length from 0.0001 mm to 1 m, as in --position-error \"0.1 mm\""
            }
            "--least-way" => "give a length from 0 to 1 m, as in --least-way \"1 mm\"",
            _ => "give a time from 0 to 1 s, as in --least-time \"0.1 s\"",
        };
        *to = value(option, text, measured, usual, range, help)?;
    }

    // mesh and tension stiffness of shells, which only some formats have
    let checked = |option, text: &Option<String>, formats: &[Format], what, usual, range, help| {
        let Some(text) = text else { return Ok(None) };
        let names =
            formats.iter().map(|format| format.format().name()).collect::<Vec<_>>().join(" and ");
        if !formats.contains(&arguments.to) {
            let fault = format!("has no meaning for {}", arguments.to.format().name());
            return Err(refused(option, text, &fault, &format!("it is for {names}")));
        }
        value(option, text, what, usual, range, help).map(Some)
    };
    let mesh = checked(
        "--mesh",
        &arguments.mesh,
        &[Format::Ngsolve],
        Measured::Length,
        &usual::Mesh::USUAL,
        MESHES,
        "give a length from 0.1 mm to 10 m, as in --mesh \"10 mm\"",
    )?;
    let shells = [Format::Inp, Format::Ngsolve];
    let tension = checked(
        "--tension",
        &arguments.tension,
        &shells,
        Measured::ForcePerLength,
        &usual::Tension::USUAL,
        TENSIONS,
        "give a force per length from 1 to 1e9 N/m, as in --tension \"2e4 N/m\"",
    )?;

    // templates are read before anything is written
    let read = |path: &PathBuf| {
        let text = input::text(path, LONGEST_TEMPLATE).map_err(|error| Failure::Refused {
            message: format!("the template `{}` cannot be read: {error}", path.display()),
            help: "`plydrape template rapid > cell.mod.j2` makes one that you can change".into(),
        })?;
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        Ok(Template { name, text })
    };
    let templates = arguments.template.iter().map(read).collect::<Result<_, Failure>>()?;

    let Arguments { even_if_rejected, large, tf, .. } = *arguments;
    Ok(export::Options { even_if_rejected, tolerance, large, tf, mesh, tension, templates })
}
