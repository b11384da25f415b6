//! `plydrape simulate`: drapes the ply of a scene along its motion, and says how it went.

use crate::diagnostic::Done;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use plydrape::draping::record::Summary;
use plydrape::output::{json, table};
use plydrape::scene::Scene;
use serde::Serialize;
use std::io::{self, IsTerminal, Write};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Drape the ply along the trajectories of a scene; table of steps, verdict, files.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Writes result.json, steps.csv, trajectory.csv and figure.svg. A file in the folder that plydrape did
not write, or that was edited since, is never overwritten. Ctrl-C ends after the step under way and
writes the steps done.")]
pub struct Arguments {
    /// The scene file.
    scene: PathBuf,

    /// Folder of the results; beside the scene, with its name and `.results`, unless given.
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,

    /// Print one JSON object on standard output instead of tables.
    #[arg(long)]
    json: bool,
}

/// What `--json` prints: the summary of the result file, and how long an equilibrium took.
#[derive(Serialize)]
struct Printed<'a> {
    #[serde(flatten)]
    summary: &'a Summary,
    mean_equilibrium_us: f64,
}

/// Simulates, writes the files and judges.
pub fn run(arguments: &Arguments, quiet: bool) -> Done {
    // first of all, so that even a long read ends in files of what was done
    let stop = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&stop);
    // a second handler cannot be set; then Ctrl-C ends the program as it always did
    let _ = ctrlc::set_handler(move || flag.store(true, Ordering::Relaxed));
    let scene = plydrape::scene::read(&arguments.scene)?;

    let bar = progress_bar(&scene, quiet);
    let drape = plydrape::draping::simulate(&scene, |done| {
        bar.set_position(done as u64);
        if stop.load(Ordering::Relaxed) {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    });
    bar.finish_and_clear();

    let result = &drape.result;
    let folder = arguments.output.clone().unwrap_or_else(|| beside(&arguments.scene));
    let files = plydrape::output::write_all(result, &folder)?;
    let summary = &result.summary;
    let mut out = io::stdout().lock();
    if arguments.json {
        let mean_equilibrium_us =
            drape.solving.as_secs_f64() * 1e6 / summary.equilibria.max(1) as f64;
        let printed = Printed { summary, mean_equilibrium_us };
        write!(out, "{}", json::of(&printed).map_err(plydrape::output::OutputError::from)?)?;
    } else if !quiet {
        writeln!(out, "{}\n", result.scene.title)?;
        write!(out, "{}\n{}", table::steps_table(result), table::verdict(result))?;
        writeln!(out)?;
        for file in files {
            writeln!(out, "wrote {}", file.display())?;
        }
    }
    out.flush()?;
    let unsolved = result.steps.iter().any(|step| step.solver.status != "converged");
    Ok(match (summary.steps < summary.steps_planned, unsolved, summary.accepted) {
        (true, _, _) => ExitCode::from(130),
        (_, true, _) => ExitCode::from(3),
        (_, _, true) => ExitCode::SUCCESS,
        (_, _, false) => ExitCode::from(1),
    })
}

/// The folder of a scene's results unless another is asked for.
fn beside(scene: &Path) -> PathBuf {
    scene.with_extension("results")
}

/// A bar on standard error where someone watches it; it appears only if the work takes a while.
fn progress_bar(scene: &Scene, quiet: bool) -> ProgressBar {
    let steps = scene.motion.positions.len() as u64;
    if quiet || !io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::with_draw_target(Some(steps), ProgressDrawTarget::stderr_with_hz(5));
    match ProgressStyle::with_template("draping {bar:40} step {pos} of {len}, {eta} left") {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}
