//! What every command that leaves a folder of results takes, and how it prints what it found.

use crate::failure::Failure;
use crate::outcome::warn;
use plydrape_io::store::{json, shown};
use plydrape_io::text::table::{self, Ink};
use plydrape_io::{Folder, ResultFile, rerun};
use serde::Serialize;
use std::env;
use std::io::{self, IsTerminal, Write};
use std::path::{Path, PathBuf};

/// Prints a text, after these files were written. A reader that has seen enough, such as `head`, is no failure and changes no exit code.
pub fn print(text: &str, files: &[PathBuf]) -> Result<(), Failure> {
    print_to_reader(text, files).map(drop)
}

/// Prints a text as [`print`] does, and returns whether somebody reads it.
pub fn print_to_reader(text: &str, files: &[PathBuf]) -> Result<bool, Failure> {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Ok(()) => Ok(true),
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(false),
        Err(error) => Err(Failure::stdout(&error, files)),
    }
}

/// The folder for the files of a run, and the claimed one if another one takes its place: beside what is there, if the run was interrupted and
/// is not better than that. Says where that is on standard error.
pub fn place(
    folder: Folder,
    interrupted: bool,
    is_better: impl Fn(&Path) -> bool,
) -> Result<(Folder, Option<Folder>), Failure> {
    let beside = if interrupted { rerun::beside(&folder, is_better)? } else { None };
    let Some(other) = beside else { return Ok((folder, None)) };
    let [kept, to] = [&folder, &other].map(|folder| shown::path(folder.path()));
    warn(&[format!(
        "this run was interrupted, and what {kept} holds is no worse and stays: the files of this run are in {to}"
    )]);
    Ok((other, Some(folder)))
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

/// The files that were written: of one its path, of several their folder and their names.
pub fn list(files: &[PathBuf]) -> String {
    match files {
        [] => String::new(),
        [file] => format!("wrote {}\n", shown::path(file)),
        [first, ..] => {
            let folder = first.parent().filter(|folder| *folder != Path::new(""));
            let folder = shown::path(folder.unwrap_or(Path::new(".")));
            let name = |file: &PathBuf| shown::path(file.file_name().map_or(file, Path::new));
            let lines = names(&files.iter().map(name).collect::<Vec<_>>());
            let lines = lines.iter().map(|line| format!("  {line}\n"));
            format!("wrote {folder}:\n{}", lines.collect::<String>())
        }
    }
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
        let text = match self.json {
            true => json::to_text(object)?,
            false if quiet => return Ok(()),
            false => format!("{text}\n{}", list(files)),
        };
        print(&text, files)
    }
}
