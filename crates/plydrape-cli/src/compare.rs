//! `plydrape compare`: a result beside the drape of its motion in another program.

use crate::failure::Done;
use crate::results;
use plydrape_io::peer;
use plydrape_io::result::read;
use plydrape_io::store::json;
use std::path::PathBuf;
use std::process::ExitCode;

/// Lay a result beside the drape of its motion in NGSolve, at the same fabric points.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
`plydrape export RESULT --to ngsolve` writes the folder, and `python drape.py` in it drapes the motion. Nothing is judged: the \
exit code is 0 whatever the differences are. `plydrape report RESULT --compare FOLDER` shows the comparison in the page.")]
pub struct Arguments {
    /// The result.json of an earlier run, or its folder.
    result: PathBuf,

    /// The folder in which drape.py has run.
    folder: PathBuf,

    /// Print one JSON object on standard output instead of tables.
    #[arg(long)]
    json: bool,
}

/// Reads both and prints the tables.
pub fn run(arguments: &Arguments) -> Done {
    let result = read::read(&read::file_of(&arguments.result))?;
    let comparison = peer::compare(&result, &peer::read(&arguments.folder)?)?;
    let text = match arguments.json {
        true => json::to_text(&comparison)?,
        false => format!("{}\n\n{}", result.scene.title, peer::table(&comparison)),
    };
    results::print(&text, &[])?;
    Ok(ExitCode::SUCCESS)
}
