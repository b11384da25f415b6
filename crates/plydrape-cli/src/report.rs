//! `plydrape report`: the page of a result once more.

use crate::failure::Done;
use crate::results;
use crate::watch::whole;
use plydrape_io::page;
use plydrape_io::peer;
use plydrape_io::result::read;
use plydrape_io::store::folder;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Make the page report.html again from a result.json.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
The page is one file that any browser opens, without a network. The result must be as `plydrape \
simulate` or `plydrape plan` wrote it, by this version.")]
pub struct Arguments {
    /// The result.json of an earlier run, or its folder.
    result: PathBuf,

    /// Folder of the page; that of the result unless given.
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,

    /// Show the drape of the same motion in NGSolve beside it, from the folder in which drape.py has run.
    #[arg(long, value_name = "FOLDER")]
    compare: Option<PathBuf>,
}

/// Reads the result and writes the page.
pub fn run(arguments: &Arguments, quiet: bool) -> Done {
    let file = read::file_of(&arguments.result);
    let result = read::read(&file)?;
    let html = match &arguments.compare {
        Some(folder) => {
            page::compared_html(&result, &peer::compare(&result, &peer::read(folder)?)?)?
        }
        None => page::html(&result)?,
    };
    let beside = || match file.parent() {
        Some(folder) if folder != Path::new("") => folder.to_path_buf(),
        _ => PathBuf::from("."),
    };
    let folder = arguments.output.clone().unwrap_or_else(beside);
    let page = [("report.html", html.as_bytes())];
    let files = whole(|| folder::add(&folder, "report", &page, &result.files))?;
    if !quiet {
        results::print(&results::list(&files), &files)?;
    }
    Ok(ExitCode::SUCCESS)
}
