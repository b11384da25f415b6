//! `plydrape net`: lays the ply of a scene on its mold as a net, and says how it lies.

use crate::diagnostic::Done;
use plydrape::net::Net;
use plydrape::output::net::{Summary, write_all};
use plydrape::output::{OutputError, json};
use serde::Serialize;
use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Instant;

/// Lay the ply on the mold as a net of yarns: where every point should end, and how it shears.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Writes nodes.csv, shear.svg, net.vtu and mold.vtu. A file in the folder that plydrape did not write, or
that was edited since, is never overwritten. Not accepted, with exit code 1, is a ply that runs off the
mold, folds, or shears beyond the scene's limit or the material's locking angle.")]
pub struct Arguments {
    /// The scene file; of it [ply], [mold], [target] and [limits] are read.
    scene: PathBuf,

    /// Folder of the files; beside the scene, with its name and `.net`, unless given.
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,

    /// Print one JSON object on standard output instead of a table.
    #[arg(long)]
    json: bool,
}

/// What `--json` prints: the summary of the net, and how long it took.
#[derive(Serialize)]
struct Printed<'a> {
    #[serde(flatten)]
    summary: &'a Summary,
    time_ms: f64,
}

/// Lays the net, writes the files and judges.
pub fn run(arguments: &Arguments, quiet: bool) -> Done {
    let ideal = plydrape::scene::read_ideal_drape(&arguments.scene)?;
    let (mold, net) = (&ideal.mold, &ideal.net);
    // once more, to tell how long it takes apart from all else that reading a scene does
    let start = Instant::now();
    let again = Net::drape(mold, net.layup);
    let time_ms = start.elapsed().as_secs_f64() * 1e3;
    debug_assert_eq!(again.as_ref(), Ok(net));

    let summary = Summary::of(net, ideal.shear_limit);
    let folder = arguments.output.clone().unwrap_or_else(|| arguments.scene.with_extension("net"));
    let files = write_all(net, mold, &ideal.title, &folder)?;
    let mut out = io::stdout().lock();
    if arguments.json {
        let printed = Printed { summary: &summary, time_ms };
        write!(out, "{}", json::of(&printed).map_err(OutputError::from)?)?;
    } else if !quiet {
        writeln!(out, "{}\n", ideal.title)?;
        writeln!(out, "{}", summary.table())?;
        for file in files {
            writeln!(out, "wrote {}", file.display())?;
        }
    }
    out.flush()?;
    Ok(if summary.accepted { ExitCode::SUCCESS } else { ExitCode::from(1) })
}
