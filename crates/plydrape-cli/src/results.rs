//! What every command that leaves a folder of results takes, and how it prints what it found.

use crate::failure::Failure;
use plydrape_io::ResultFile;
use plydrape_io::store::{json, shown};
use plydrape_io::text::table::{self, Ink};
use serde::Serialize;
use std::env;
use std::io::{self, IsTerminal, Write};
use std::path::{Path, PathBuf};

/// Prints the files that were written: of one its path, of several their folder and their names.
pub fn list(files: &[PathBuf]) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    wrote(&mut out, files).map_err(|error| Failure::stdout(&error, files))
}

/// Colors where standard output is a terminal, unless the environment asks for none.
pub fn ink() -> Ink {
    let asked = |name: &str| env::var_os(name).is_some_and(|value| !value.is_empty());
    let dumb = env::var_os("TERM").is_some_and(|kind| kind == "dumb");
    match io::stdout().is_terminal() && !asked("NO_COLOR") && !dumb {
        true => Ink::Colored,
        false => Ink::Plain,
    }
}

fn wrote(out: &mut impl Write, files: &[PathBuf]) -> io::Result<()> {
    match files {
        [] => {}
        [file] => writeln!(out, "wrote {}", shown::path(file))?,
        [first, ..] => {
            let folder = first.parent().filter(|folder| *folder != Path::new(""));
            writeln!(out, "wrote {}:", shown::path(folder.unwrap_or(Path::new("."))))?;
            let name = |file: &PathBuf| shown::path(file.file_name().map_or(file, Path::new));
            names(&files.iter().map(name).collect::<Vec<_>>())
                .iter()
                .try_for_each(|line| writeln!(out, "  {line}"))?;
        }
    }
    out.flush()
}

/// Widest line of names.
const WIDTH: usize = 97;

/// Names in lines, with commas between.
fn names(names: &[String]) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for (n, name) in names.iter().enumerate() {
        let comma = if n + 1 < names.len() { "," } else { "" };
        match lines.last_mut() {
            Some(line) if line.chars().count() + name.chars().count() + 2 <= WIDTH => {
                *line += &format!(" {name}{comma}");
            }
            _ => lines.push(format!("{name}{comma}")),
        }
    }
    lines
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

    /// Print all steps and all limits, and all that is known beside them.
    #[arg(long, conflicts_with = "json")]
    verbose: bool,
}

impl Results {
    /// The folder asked for, or else the scene's name with an ending.
    pub fn folder(&self, ending: &str) -> PathBuf {
        self.output.clone().unwrap_or_else(|| self.scene.with_extension(ending))
    }

    /// What is printed for people of a result, of which `found` says in two lines what was found and how long that took: one screen, or all
    /// that is known if that is asked for.
    pub fn text(&self, result: &ResultFile, found: &str) -> String {
        if !self.verbose {
            return table::screen(result, found, ink());
        }
        let (heading, details) = (table::heading(result), table::details(result));
        format!("{heading}\n{found}\n\n{details}\n{}", table::verdict(result, ink()))
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
            true => Some(json::of(object)?),
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
