//! What every command that leaves a folder of results takes, and how it prints what it found.

use crate::failure::Failure;
use plydrape_io::{OutputError, json, shown};
use serde::Serialize;
use std::io::{self, Write};
use std::path::PathBuf;

/// Prints the files that were written.
pub fn list(files: &[PathBuf]) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    wrote(&mut out, files).map_err(|error| Failure::stdout(&error, files))
}

fn wrote(out: &mut impl Write, files: &[PathBuf]) -> io::Result<()> {
    files.iter().try_for_each(|file| writeln!(out, "wrote {}", shown::path(file)))?;
    out.flush()
}

/// The scene, and where its results go.
#[derive(Debug, clap::Args)]
pub struct Results {
    /// The scene file.
    pub scene: PathBuf,

    /// Folder of the files; beside the scene, with its name and the ending named below, unless given.
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,

    /// Print one JSON object on standard output instead of tables.
    #[arg(long)]
    pub json: bool,
}

impl Results {
    /// The folder asked for, or else the scene's name with an ending.
    pub fn folder(&self, ending: &str) -> PathBuf {
        self.output.clone().unwrap_or_else(|| self.scene.with_extension(ending))
    }

    /// Prints `object` as one line of JSON, if that is asked for; else, unless `quiet`, the text and the
    /// files that were written.
    pub fn print<T: Serialize>(
        &self,
        quiet: bool,
        object: &T,
        text: &str,
        files: &[PathBuf],
    ) -> Result<(), Failure> {
        let json = match self.json {
            true => Some(json::of(object).map_err(OutputError::from)?),
            false => None,
        };
        let mut out = io::stdout().lock();
        let written = match json {
            Some(json) => write!(out, "{json}").and_then(|()| out.flush()),
            None if quiet => Ok(()),
            None => writeln!(out, "{text}").and_then(|()| wrote(&mut out, files)),
        };
        written.map_err(|error| Failure::stdout(&error, files))
    }
}
