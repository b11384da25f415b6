//! `plydrape net`: lays the ply of a scene on its mold as a net, and says how it lies.

use crate::diagnostic::{Done, Failure};
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
    /// The scene file; its [target] says where the net begins.
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
    let scene = plydrape::scene::read(&arguments.scene)?;
    let (Some(mold), Some(target)) = (&scene.mold, &scene.target) else {
        return Err(nothing_to_lay("the scene has no [mold] or no [target]"));
    };
    let Some(layup) = target.layup else {
        return Err(nothing_to_lay("the [target] of the scene gives all `positions`"));
    };
    let start = Instant::now();
    let net = Net::drape(mold, layup).map_err(|error| nothing_to_lay(&error.to_string()))?;
    let time_ms = start.elapsed().as_secs_f64() * 1e3;

    let limit = scene.limits.shear.or(scene.ply.material.locking_angle);
    let summary = Summary::of(&net, limit);
    let folder = arguments.output.clone().unwrap_or_else(|| arguments.scene.with_extension("net"));
    let files = write_all(&net, mold, &scene.title, &folder)?;
    let mut out = io::stdout().lock();
    if arguments.json {
        let printed = Printed { summary: &summary, time_ms };
        write!(out, "{}", json::of(&printed).map_err(OutputError::from)?)?;
    } else if !quiet {
        writeln!(out, "{}\n", scene.title)?;
        writeln!(out, "{}", summary.table())?;
        for file in files {
            writeln!(out, "wrote {}", file.display())?;
        }
    }
    out.flush()?;
    Ok(if summary.accepted { ExitCode::SUCCESS } else { ExitCode::from(1) })
}

/// A scene that does not say how the ply is laid.
fn nothing_to_lay(why: &str) -> Failure {
    Failure::Argument {
        message: format!("there is no net to lay: {why}"),
        help: "give a [mold], and a [target] with `origin`, `direction`, `shear` and `seed`".into(),
    }
}
