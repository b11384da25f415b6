//! `plydrape schema`: the JSON Schema of scene files.

use crate::failure::Done;
use crate::results;
use std::process::ExitCode;

/// Print the JSON Schema of scene files, for editors that complete and check TOML.
#[derive(Debug, clap::Args)]
pub struct Arguments {}

/// Prints the schema.
pub fn run(_: &Arguments) -> Done {
    results::print(&plydrape_io::scene::schema(), &[])?;
    Ok(ExitCode::SUCCESS)
}
