//! Programs for the controllers of robots, written by templates in the language of Jinja.
//!
//! The shipped templates are the files in `templates/`. A user's copy takes the place of that with the same ending; one with
//! another ending, such as `cell.ls.j2`, is used instead of all of them, so that a template can be for any controller.
//!
//! A user's template is a program, whose work `render` bounds.

use super::blocks::Blocks;
use super::context::contexts;
use super::render::{self, ZONES};
use super::sampling::Track;
use super::{Program, Tolerance, cam, names, wide};
use crate::store::folder::Files;
use minijinja::value::{Serde, Value};

/// A controller, by the language of its programs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Robot {
    /// ABB: RAPID.
    Rapid,
    /// KUKA: KRL.
    Krl,
    /// Universal Robots: URScript.
    Urscript,
}

/// A template: what its file is called, and its text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Template {
    /// Name of its file; behind the ending `.j2` stands that of what it makes, as in `cell.src.j2`.
    pub name: String,
    /// Text.
    pub text: String,
}

/// What a controller takes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Limits {
    /// External axes that move with the arm.
    pub axes: usize,
    /// What they are called.
    pub axis_names: [&'static str; 6],
    /// Points of one file.
    pub points: usize,
    /// Number of the first digital output, and how many there are, if that is known.
    pub first_output: usize,
    pub outputs: Option<usize>,
    /// Radii of zones (m), the smallest first.
    pub radii: &'static [f64],
    /// Whether points are passed in zones, and whether on splines.
    pub zones: bool,
    pub splines: bool,
    /// Where its controller has the progress of a motion for that of the array.
    pub progress: &'static str,
    /// What the frames are called in the program, whose name is NAME, and that of its part PART.
    pub mold: &'static str,
    pub tool: &'static str,
    /// The units, in a line.
    pub units: &'static str,
}

impl Robot {
    /// All of them.
    pub const ALL: [Robot; 3] = [Robot::Rapid, Robot::Krl, Robot::Urscript];

    /// Name on the command line and of the folder of templates.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Robot::Rapid => "rapid",
            Robot::Krl => "krl",
            Robot::Urscript => "urscript",
        }
    }

    /// Name of the maker, another name of the controller on the command line.
    #[must_use]
    pub const fn maker(self) -> &'static str {
        match self {
            Robot::Rapid => "abb",
            Robot::Krl => "kuka",
            Robot::Urscript => "ur",
        }
    }

    /// The controller of a name or of a maker.
    #[must_use]
    pub fn named(word: &str) -> Option<Robot> {
        Robot::ALL.into_iter().find(|robot| [robot.name(), robot.maker()].contains(&word))
    }

    /// The command that prints its template, the program where there are data too.
    pub(super) fn printed(self) -> &'static str {
        match self {
            Robot::Rapid => "plydrape template rapid",
            Robot::Krl => "plydrape template krl-src",
            Robot::Urscript => "plydrape template urscript",
        }
    }

    /// The shipped templates: ending of what they make, and text. That of the program comes first; that with the measured values of a cell
    /// makes a file that is written once.
    #[must_use]
    pub fn shipped(self) -> &'static [(&'static str, &'static str)] {
        match self {
            Robot::Rapid => &[
                ("mod", include_str!("templates/rapid.mod.j2")),
                ("cell.mod", include_str!("templates/rapid.cell.mod.j2")),
            ],
            Robot::Krl => &[
                ("src", include_str!("templates/krl.src.j2")),
                ("dat", include_str!("templates/krl.dat.j2")),
            ],
            Robot::Urscript => &[
                ("script", include_str!("templates/urscript.script.j2")),
                ("cell.script", include_str!("templates/urscript.cell.script.j2")),
            ],
        }
    }

    /// Whether a file of the program holds what is measured in a cell, so that an export leaves it as it is where it exists.
    #[must_use]
    pub fn is_of_cell(self, file: &str, templates: &[Template]) -> bool {
        let ending = match self {
            Robot::Rapid => "_cell.mod",
            Robot::Krl => ".dat",
            Robot::Urscript => "_cell.script",
        };
        let own = templates.iter().any(|template| template.name.ends_with(&format!("{ending}.j2")));
        file.ends_with(ending) && !own
    }

    /// What its controller takes. For a number of points none of the makers states a limit, so 5000 to a file is a number
    /// of ours: an editor still opens such a file, and a motion is seldom longer than some hundred points.
    pub(super) fn limits(self) -> Limits {
        let points = 5000;
        match self {
            Robot::Rapid => Limits {
                // extjoint: eax_a to eax_f
                axes: 6,
                axis_names: ["eax_a", "eax_b", "eax_c", "eax_d", "eax_e", "eax_f"],
                points,
                first_output: 1,
                outputs: None,
                radii: &ZONES,
                zones: true,
                splines: false,
                progress: "eax_a, a virtual axis in mm",
                mold: "work object mold_NAME",
                tool: "tool_NAME",
                units: "Units: mm, degrees per second, seconds; quaternions begin with w",
            },
            Robot::Krl => Limits {
                // E6POS: E1 to E6
                axes: 6,
                axis_names: ["E1", "E2", "E3", "E4", "E5", "E6"],
                points,
                first_output: 1,
                // $OUT[1] to $OUT[4096]
                outputs: Some(4096),
                radii: &[],
                zones: false,
                splines: true,
                progress: "E1, a virtual axis in mm",
                mold: "$BASE = mold_NAME",
                tool: "$TOOL = tool_NAME",
                units: "Units: mm, degrees (A about Z, B about Y, C about X), seconds",
            },
            Robot::Urscript => Limits {
                axes: 0,
                axis_names: [""; 6],
                points,
                first_output: 0,
                // 8 standard, 8 configurable and 2 at the tool
                outputs: Some(18),
                radii: &[],
                zones: false,
                splines: false,
                progress: "float output register 0 (output_double_register_0 of RTDE)",
                mold: "mold_NAME, in the base of the robot",
                tool: "the TCP",
                units: "Units: m, rad (rotation vectors), seconds",
            },
        }
    }
}

/// The files of a program for a controller: each in one part, or in several where it has too many points; and the tables of
/// the axes, where the controller cannot move all of them. Same program, same bytes.
///
/// # Errors
/// [`crate::Error::NotPossible`] if there is no flange, a tolerance is none, there are more signals than outputs, or a template cannot be
/// used.
pub fn files(
    program: &Program,
    robot: Robot,
    templates: &[Template],
    tolerance: &Tolerance,
) -> Result<Files, crate::Error> {
    program.check()?;
    tolerance.check()?;
    if program.flange.is_none() {
        let message = format!(
            "a program in {} is for one arm that carries the array, but the grippers of this scene are free",
            robot.name()
        );
        let help = "say in [tool] how the array is carried, or write the motion of each gripper with --to ros2 or --to csv";
        return Err(crate::Error::not_possible(message, help));
    }
    let used = used(robot, templates);
    let limits = robot.limits();
    let separate = program.axes.len() > limits.axes;
    let needed = program.pads.len() + usize::from(separate || program.vacuum_timeout.is_some());
    if let Some(most) = limits.outputs.filter(|most| needed > *most && templates.is_empty()) {
        let format = robot.name();
        let message = format!(
            "{format} has {most} digital outputs of its own, and {needed} are needed for the vacuum of the array"
        );
        let help = format!(
            "switch it by other means in a copy of the template, with --template ({} prints it)",
            robot.printed()
        );
        return Err(crate::Error::not_possible(message, help));
    }

    let track = Track::new(program, !separate);
    let blocks = Blocks::new(&track, tolerance, limits.radii, limits.splines);
    let mut files = Vec::new();
    for context in contexts(&track, &blocks, robot) {
        let part = context.part.clone();
        let value = Value::from(Serde(&context));
        for (ending, Template { name, text }) in &used {
            // what is measured in a cell is the same for all parts
            let file = match ending.starts_with("cell.") {
                true if context.first => format!("{}_{ending}", context.name),
                true => continue,
                false => format!("{part}.{ending}"),
            };
            let made = render::rendered(robot, name, text, &value, render::PATIENCE)?;
            files.push((file, made.into_bytes()));
        }
    }
    if separate {
        let name = names::name(&program.name, program.book_ply.as_ref());
        files.push((wide::beside(&name), wide::text(program)?.into_bytes()));
        let table = cam::text(program)?;
        files.extend(table.map(|table| (cam::beside(&name), table.into_bytes())));
    }
    Ok(files)
}

/// The templates that are used, with the endings of what they make.
fn used(robot: Robot, given: &[Template]) -> Vec<(String, Template)> {
    let shipped = robot.shipped().iter().map(|(ending, text)| {
        let name = format!("{}.{ending}.j2", robot.name());
        ((*ending).to_owned(), Template { name, text: (*text).to_owned() })
    });
    let mut used: Vec<_> = shipped.collect();
    let ending = |name: &str| {
        let bare = name.strip_suffix(".j2").unwrap_or(name);
        bare.rsplit_once('.').map_or("txt", |(_, ending)| ending).to_owned()
    };
    let own: Vec<(String, Template)> =
        given.iter().map(|template| (ending(&template.name), template.clone())).collect();
    if own.iter().any(|(ending, _)| used.iter().all(|(known, _)| known != ending)) {
        return own;
    }
    for (ending, template) in own {
        used.iter_mut()
            .filter(|(known, _)| *known == ending)
            .for_each(|(_, old)| *old = template.clone());
    }
    used
}
