//! `plydrape completions` and `plydrape man`: made from the definition of the command line.

use crate::Cli;
use crate::failure::{Done, Failure};
use crate::results;
use clap::CommandFactory;
use clap_complete::Shell;
use std::process::ExitCode;

/// Print completions for a shell.
#[derive(Debug, clap::Args)]
pub struct Completions {
    /// The shell.
    shell: Shell,
}

/// Print the manual page.
#[derive(Debug, clap::Args)]
pub struct Man {}

/// Prints the completions.
pub fn completions(arguments: &Completions) -> Done {
    let mut text = Vec::new();
    clap_complete::generate(arguments.shell, &mut Cli::command(), "plydrape", &mut text);
    results::print(&String::from_utf8_lossy(&text), &[])?;
    Ok(ExitCode::SUCCESS)
}

/// Prints the manual page.
pub fn man(_: &Man) -> Done {
    let mut text = Vec::new();
    clap_mangen::Man::new(Cli::command())
        .render(&mut text)
        .map_err(|error| Failure::stdout(&error, &[]))?;
    results::print(&String::from_utf8_lossy(&text), &[])?;
    Ok(ExitCode::SUCCESS)
}
