//! `plydrape schema`: the JSON Schema of scene files.

use crate::failure::Done;
use std::io::{self, Write};
use std::process::ExitCode;

/// Print the JSON Schema of scene files, for editors that complete and check TOML.
#[derive(Debug, clap::Args)]
pub struct Arguments {}

/// Prints the schema.
pub fn run(_: &Arguments) -> Done {
    let mut out = io::stdout().lock();
    out.write_all(plydrape_io::scene::schema().as_bytes())?;
    out.flush()?;
    Ok(ExitCode::SUCCESS)
}
