//! `plydrape plan`: finds a motion that puts the ply on its mold, and says how it went.

mod arguments;
mod book;
mod found;

pub use arguments::Arguments;

use crate::argument;
use crate::errors;
use crate::failure::{Done, Failure};
use crate::mesh;
use crate::numbers::short;
use crate::outcome::{self, exit_code};
use crate::search::{Ended, Search, time_text};
use crate::watch::Interrupt;
use found::{Found, Motion};
use plydrape::planner::infeasible_limits::infeasible_limits;
use plydrape::planner::{self, Checkpoint, Progress};
use plydrape::scene::PlanMethod;
use plydrape_io::scene::Measured;
use plydrape_io::store::input;
use plydrape_io::text::table;
use plydrape_io::{Folder, NAMES, plan};
use serde::Serialize;
use std::io::{self, Write};
use std::path::Path;
use std::time::Duration;

/// What `--json` prints: the finished drape, and the plan it follows.
#[derive(Serialize)]
struct Printed<'a> {
    #[serde(flatten)]
    drape: outcome::Printed<'a>,
    method: PlanMethod,
    plan_time_s: f64,
    evaluations: usize,
    decisions: usize,
    motion: &'a Motion,
}

/// Plans, drapes, writes the files and judges.
pub fn run(arguments: &Arguments, quiet: bool) -> Done {
    let results = &arguments.results;
    // first of all, so that even a long read ends in files
    let interrupt = Interrupt::listen();
    let time = arguments.time.as_deref().map(time).transpose()?;
    if let Some(threads) = arguments.threads {
        // the pool cannot be set a second time, and has not been set before
        let _ = rayon::ThreadPoolBuilder::new().num_threads(threads.into()).build_global();
    }
    if plydrape_io::scene::is_book(&results.scene) {
        return book::plan(arguments, &interrupt, time, quiet);
    }
    let also = arguments.also.map(Into::into);
    let mut scene = plydrape_io::scene::read_for(&results.scene, None, also)?;
    arguments.apply(&mut scene)?;
    outcome::warn(&mesh::warnings(scene.layup.mold.as_ref(), scene.mesh.as_ref()));
    let earlier = arguments.earlier.as_deref().map(checkpoint).transpose()?;
    if arguments.compare {
        return crate::compare::run(results, &scene, &interrupt, quiet);
    }
    let folder = Folder::claim(&results.folder("plan"), "plan")?;
    folder.refuse_inputs(&NAMES, &scene.files)?;
    let infeasible = infeasible_limits(&scene);
    if !quiet && !results.json && !infeasible.is_empty() {
        let mut out = io::stdout().lock();
        writeln!(out, "{}", table::infeasible_limits(&infeasible))?;
        out.flush()?;
    }

    let mut search = Search::new(&scene, arguments.without_errors, time, &interrupt, quiet);
    let watch = &mut |progress: &Progress| search.watch(progress);
    let planned = planner::plan_without_errors(&scene, earlier.as_ref(), watch);
    let (took, ended) = search.finish();
    let found = arguments.judged(&scene, planned?, folder.stage(), &interrupt, quiet)?;
    let Found { result, checkpoint, motion, decisions, solving, .. } = &found;
    let files = plan::write_into(folder, result, checkpoint, &scene.files)?;
    let printed = Printed {
        drape: outcome::Printed::of(result, *solving),
        method: scene.plan.method,
        plan_time_s: took.as_secs_f64(),
        evaluations: result.plan.as_ref().map_or(0, |plan| plan.evaluations),
        decisions: *decisions,
        motion,
    };
    let mut text = results.text(result, &text(&printed, ended, time));
    text += errors::left_out(result, found.interrupted);
    results.print(quiet, &printed, &text, &files)?;
    Ok(exit_code(result, ended == Some(Ended::Interrupted) || found.interrupted))
}

/// Shortest and longest time of a search (s).
const TIMES: [f64; 2] = [1e-3, 1e7];

/// The time after which the search ends.
fn time(text: &str) -> Result<Duration, Failure> {
    let help = "a time of up to some 100 days is wanted, e.g. 5min, 90s or 1.5h";
    let seconds = argument::value("--time", text, Measured::Time, TIMES, help)?;
    Ok(Duration::from_secs_f64(seconds))
}

/// Largest plan.json that is read (bytes).
const LARGEST_CHECKPOINT: u64 = 1 << 30;

/// The checkpoint of an earlier search in its folder.
fn checkpoint(folder: &Path) -> Result<Checkpoint, Failure> {
    let file = folder.join("plan.json");
    let refused = |reason: String, help: &str| Failure::Refused {
        message: format!("there is no plan to go on from in `{}`: {reason}", folder.display()),
        help: help.into(),
    };
    let text = input::text(&file, LARGEST_CHECKPOINT).map_err(|error| {
        let help = "--continue takes the folder of an earlier `plydrape plan`, with its plan.json";
        refused(format!("plan.json cannot be read, {error}"), help)
    })?;
    plan::read(&text).map_err(|error| {
        let help =
            "plan.json is not as this version of plydrape writes it: plan anew, without --continue";
        refused(error.to_string(), help)
    })
}

/// What was found and how long that took, in two lines.
fn text(printed: &Printed, ended: Option<Ended>, time: Option<Duration>) -> String {
    let Printed { evaluations, decisions, .. } = printed;
    let tried = match printed.method {
        PlanMethod::Stepwise => format!("stepwise plan of {evaluations} steps"),
        PlanMethod::Path => {
            format!(
                "path plan after {evaluations} drapes, {decisions} of them to decide on a plan,"
            )
        }
    };
    let ended = match (ended, time) {
        (Some(Ended::Interrupted), _) => ", interrupted: the best so far".into(),
        (Some(Ended::TimeOver), Some(time)) => {
            format!(", stopped after {}, as asked: the best so far", time_text(time))
        }
        _ => String::new(),
    };
    let Motion { duration_s, max_speed, max_acceleration, max_jerk, .. } = printed.motion;
    format!(
        "{tried} in {:.1} s{ended}\nmotion of {duration_s:.1} s, at most {} m/s, {} m/s², {} m/s³",
        printed.plan_time_s,
        short(*max_speed),
        short(*max_acceleration),
        short(*max_jerk),
    )
}
