//! `plydrape template`: the templates of programs for robots, to be copied and changed.

use crate::failure::Done;
use crate::results;
use clap::ValueEnum;
use plydrape_io::robot::program::Robot;
use std::process::ExitCode;

/// Print the template of a program for a robot, so that you can change it.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Keep the ending in the name of your copy, and give it to the export:

  plydrape template rapid > cell.mod.j2
  plydrape export RESULT --to rapid --template cell.mod.j2")]
pub struct Arguments {
    /// Which.
    name: Name,
}

/// A shipped template.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum Name {
    /// ABB RAPID, *.mod.j2.
    Rapid,
    /// KUKA KRL, the program, *.src.j2.
    KrlSrc,
    /// KUKA KRL, the data, *.dat.j2.
    KrlDat,
    /// Universal Robots URScript, *.script.j2.
    Urscript,
}

/// Prints the template.
pub fn run(arguments: &Arguments) -> Done {
    let (robot, n) = match arguments.name {
        Name::Rapid => (Robot::Rapid, 0),
        Name::KrlSrc => (Robot::Krl, 0),
        Name::KrlDat => (Robot::Krl, 1),
        Name::Urscript => (Robot::Urscript, 0),
    };
    let (_, text) = robot.shipped()[n];
    results::print(text, &[])?;
    Ok(ExitCode::SUCCESS)
}
