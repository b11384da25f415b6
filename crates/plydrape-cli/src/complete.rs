//! `plydrape completions` and `plydrape man`: made from the definition of the command line.

use crate::Cli;
use crate::failure::Done;
use clap::CommandFactory;
use clap_complete::Shell;
use std::io::{self, Write};
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
    let mut out = io::stdout().lock();
    out.write_all(&text)?;
    out.flush()?;
    Ok(ExitCode::SUCCESS)
}

/// Prints the manual page.
pub fn man(_: &Man) -> Done {
    let mut text = Vec::new();
    clap_mangen::Man::new(Cli::command()).render(&mut text)?;
    let mut out = io::stdout().lock();
    out.write_all(&text)?;
    out.flush()?;
    Ok(ExitCode::SUCCESS)
}
