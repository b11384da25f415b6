//! `plydrape plan`: finds a motion that puts the ply on its mold, and says how it went.

use crate::failure::{Done, Failure};
use crate::numbers::short;
use crate::outcome::{self, exit_code};
use crate::results::Results;
use crate::watch::{Interrupt, bar};
use clap::{ValueEnum, value_parser};
use plydrape::planner::infeasible_limits::infeasible_limits;
use plydrape::planner::{self, Checkpoint, Planned, Progress};
use plydrape::scene::PlanMethod;
use plydrape_io::scene::{SceneError, SceneFile};
use plydrape_io::{Folder, NAMES, ResultFile, input, plan, table};
use serde::Serialize;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Find trajectories that lay the ply on its mold, and drape along them; verdict, files.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
The scene needs [mold] and [target]; [plan] and [limits] say how to look and what to keep. Grippers \
start where they start in `simulate`: of a motion from a file only the first step is used, and a \
`duration` in [motion] is refused: limits.duration is what a plan keeps. What no \
plan can keep is said first. The best plan found is written even if it is not accepted. Ctrl-C ends \
the search and writes the best plan so far.

Writes result.json, steps.csv, trajectory.csv, motion.csv, figure.svg, report.html and plan.json to \
the scene's name with `.plan`. A file in the folder that plydrape did not write, or that was edited \
since, is never overwritten.")]
pub struct Arguments {
    #[command(flatten)]
    results: Results,

    /// The planner, instead of the scene's.
    #[arg(long)]
    method: Option<Method>,

    /// Seed of the search, instead of the scene's: the same seed, the same plan.
    #[arg(long, value_name = "N")]
    seed: Option<u64>,

    /// Threads of the search, one per core unless given; the plan does not depend on it.
    #[arg(long, value_name = "N", value_parser = value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,

    /// Go on from the plan in the folder of an earlier run.
    #[arg(long = "continue", value_name = "DIR")]
    earlier: Option<PathBuf>,
}

/// The planner of a motion.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum Method {
    /// Whole trajectories, judged by complete drapes.
    Path,
    /// Step by step, as Krogh et al. 2018 sketch it.
    Stepwise,
}

impl From<Method> for PlanMethod {
    fn from(method: Method) -> Self {
        match method {
            Method::Path => PlanMethod::Path,
            Method::Stepwise => PlanMethod::Stepwise,
        }
    }
}

/// What `--json` prints: the finished drape, and the plan it follows.
#[derive(Serialize)]
struct Printed<'a> {
    method: PlanMethod,
    plan_time_s: f64,
    evaluations: usize,
    motion: Motion,
    #[serde(flatten)]
    drape: outcome::Printed<'a>,
}

/// The motion in a few numbers; largest values of any gripper.
#[derive(Serialize)]
struct Motion {
    duration_s: f64,
    max_speed: f64,
    max_acceleration: f64,
    max_jerk: f64,
}

impl Motion {
    fn of(planned: &Planned) -> Self {
        let peaks = planned.motion.peaks();
        Motion {
            duration_s: planned.motion.duration(),
            max_speed: peaks.speed.value,
            max_acceleration: peaks.acceleration.value,
            max_jerk: peaks.jerk.value,
        }
    }
}

/// Plans, drapes, writes the files and judges.
pub fn run(arguments: &Arguments, quiet: bool) -> Done {
    let results = &arguments.results;
    // first of all, so that even a long read ends in files
    let interrupt = Interrupt::listen();
    let scene = scene(arguments)?;
    let earlier = arguments.earlier.as_deref().map(checkpoint).transpose()?;
    if let Some(threads) = arguments.threads {
        // the pool cannot be set a second time, and has not been set before
        let _ = rayon::ThreadPoolBuilder::new().num_threads(threads.into()).build_global();
    }
    crate::sheet::check(&scene)?;
    let folder = Folder::claim(&results.folder("plan"), "plan")?;
    folder.refuse_inputs(&NAMES, &scene.files)?;
    let verbose = !quiet && !results.json;
    if verbose {
        let mut out = io::stdout().lock();
        writeln!(out, "{}\n", scene.title)?;
        let found = infeasible_limits(&scene);
        if !found.is_empty() {
            writeln!(out, "{}", table::infeasible_limits(&found))?;
        }
        out.flush()?;
    }

    let template = "planning {bar:40} {pos} of {len} drapes, {eta} left\n{wide_msg}";
    let bar = bar(scene.plan.evaluations, template, quiet);
    let start = Instant::now();
    let planned = planner::plan(&scene, earlier.as_ref(), &mut |progress| {
        bar.set_length(progress.most as u64);
        bar.set_position(progress.evaluations as u64);
        bar.set_message(best(progress));
        interrupt.asked()
    });
    let plan_time_s = start.elapsed().as_secs_f64();
    bar.finish_and_clear();
    let mut planned = planned?;

    let mut result = ResultFile::planned(&scene, scene.input.clone(), &planned);
    let keep = |sheet| result.keep_sheet(sheet, folder.stage());
    let took = planned.sheet.take().map(keep).transpose()?;
    let files = plan::write_into(folder, &result, &planned.checkpoint, &scene.files)?;
    let printed = Printed {
        method: planned.record.method,
        plan_time_s,
        evaluations: planned.record.evaluations,
        motion: Motion::of(&planned),
        drape: outcome::Printed::of(&result, planned.drape.solving, took),
    };
    results.print(quiet, &printed, &text(&planned, &result, &printed), &files)?;
    Ok(exit_code(&result, planned.interrupted || result.summary.interrupted()))
}

/// The scene, with what the options say instead of it.
fn scene(arguments: &Arguments) -> Result<SceneFile, Failure> {
    let file = &arguments.results.scene;
    let mut scene = plydrape_io::scene::read(file)?;
    let refused = |message: &str, help: &str| {
        Failure::from(SceneError {
            file: file.display().to_string(),
            text: "".into(),
            span: None,
            message: format!("`{}` {message}", file.display()),
            help: help.into(),
        })
    };
    if scene.mold.is_none() {
        return Err(refused(
            "has no [mold] to lay the ply on",
            "add [mold] with kind = \"plane\", or another one; a ply that just hangs needs no plan",
        ));
    }
    if scene.target.is_none() {
        return Err(refused(
            "has no [target]: a plan needs to know where the ply shall end",
            "add [target] with `origin`, `direction`, `shear` and `seed`, or empty, or with `positions`",
        ));
    }
    if let Some(refusal) = scene.plan_refusal.take() {
        return Err(Failure::from(*refusal));
    }
    if let Some(method) = arguments.method {
        scene.plan.method = method.into();
    }
    if let Some(seed) = arguments.seed {
        scene.plan.seed = seed;
    }
    Ok(scene)
}

/// Largest plan.json that is read (bytes).
const LARGEST_CHECKPOINT: u64 = 1 << 30;

/// The checkpoint of an earlier search in its folder.
fn checkpoint(folder: &Path) -> Result<Checkpoint, Failure> {
    let file = folder.join("plan.json");
    let refused = |reason: String, help: &str| Failure::Argument {
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

/// Where the search stands, for the bar.
fn best(progress: &Progress) -> String {
    let best = match table::limiting(progress.best) {
        _ if progress.accepted => "; the best so far is accepted".into(),
        Some(worst) => format!("; best so far: {}", table::verdict_text(worst)),
        None => String::new(),
    };
    format!("{}{best}", progress.stage)
}

/// What is printed for people, below the infeasible limits.
fn text(planned: &Planned, result: &ResultFile, printed: &Printed) -> String {
    let method = match printed.method {
        PlanMethod::Path => "path",
        PlanMethod::Stepwise => "stepwise",
    };
    let Motion { duration_s, max_speed, max_acceleration, max_jerk } = &printed.motion;
    let found = format!(
        "{method} plan after {} drapes in {:.1} s{}\nmotion of {duration_s:.1} s, at most {} m/s, {} m/s², {} m/s³",
        printed.evaluations,
        printed.plan_time_s,
        if planned.interrupted { ", interrupted: the best so far" } else { "" },
        short(*max_speed),
        short(*max_acceleration),
        short(*max_jerk),
    );
    let mut text = format!("{found}\n\n{}\n{}", table::steps_table(result), table::verdict(result));
    if result.summary.accepted
        && let Some(closest) = table::closest(result.deciding_limits())
    {
        text += &format!("closest to its limit: {}\n", table::verdict_text(closest));
    }
    text
}
