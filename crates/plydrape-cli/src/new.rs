//! `plydrape new`: writes a commented scene to start from.

use crate::diagnostic::{Done, Failure};
use plydrape_io::scene::TEMPLATE;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;

/// Write a commented scene to start from.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// A folder for the scene, or a file that ends in .toml; what exists is not overwritten.
    name: PathBuf,
}

/// Writes `NAME.toml`, or `scene.toml` in a folder NAME.
pub fn run(arguments: &Arguments, quiet: bool) -> Done {
    let name = &arguments.name;
    let file = if name.extension().is_some_and(|ending| ending == "toml") {
        name.clone()
    } else {
        name.join("scene.toml")
    };
    if let Some(folder) = file.parent() {
        fs::create_dir_all(folder).map_err(|error| Failure::output(folder, &error))?;
    }
    File::create_new(&file)
        .and_then(|mut new| new.write_all(TEMPLATE.as_bytes()))
        .map_err(|error| Failure::output(&file, &error))?;
    if !quiet {
        let shown = file.display();
        writeln!(io::stdout(), "{shown} is written; next: plydrape check {shown}")?;
    }
    Ok(ExitCode::SUCCESS)
}
