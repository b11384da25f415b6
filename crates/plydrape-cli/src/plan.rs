//! `plydrape plan`: finds a motion that puts the ply on its mold, and says how it went.

use crate::argument;
use crate::errors;
use crate::failure::{Done, Failure};
use crate::model::{self, ModelName};
use crate::numbers::short;
use crate::outcome::{self, exit_code};
use crate::results::Results;
use crate::search::{Ended, Search, time_text};
use crate::watch::Interrupt;
use clap::{ValueEnum, value_parser};
use plydrape::outcome::Robustness;
use plydrape::planner::infeasible_limits::infeasible_limits;
use plydrape::planner::{self, Checkpoint, LimitedBy, Planned, Progress};
use plydrape::scene::PlanMethod;
use plydrape_io::scene::{Measured, SceneError, SceneFile};
use plydrape_io::{Folder, NAMES, ResultFile, input, plan, table};
use serde::Serialize;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Find trajectories that lay the ply on its mold, and drape along them; verdict, files.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
The scene needs [mold] and [target]; [plan] and [limits] say how to look and what to keep. Grippers \
start where they start in `simulate`: of a motion from a file only the first step is used, and a \
`duration` in [motion] is refused: limits.duration is what a plan keeps. What no \
plan can keep is said first. The search ends with a plan that keeps all limits with a margin. The best \
plan found is written even if it is not accepted. Ctrl-C or SIGTERM ends the search, finishes the best \
plan so far and writes it; a second one ends that too. Without a terminal, how far the search is stands on \
standard error once a minute.

One model drapes and decides, that of the scene: its steps, its limits and its verdict are printed, written and returned as the exit \
code. With --also the other model is draped along the plan too and shown beside it; it never judges.

The plan is then judged with errors. With [errors] in the scene, a sample of complete drapes of cells that are off by them decides \
too, 64 unless set there. The verdict says which errors the plan tolerates, of each gripper's position where the scene has none. \
--time does not bound these drapes; Ctrl-C ends them, and the plan is written without what they would say.

Writes result.json, steps.csv, trajectory.csv, motion.csv, figure.svg, report.html and plan.json, and sheet.npz \
where the sheet was draped, to the scene's name with `.plan`. A file in the folder that plydrape did not write, or that was edited \
since, is never overwritten.

A plybook, a file with [[plies]], is planned ply by ply, each on those that it lies on, several at once; see `docs/guide/plybook.md`. Each ply has a \
folder of its own in the book's, beside book.json and a report.html over all plies. --time, --seed and the other options are for each \
ply; the exit code is 0 if all plies are accepted.

With --compare nothing is searched: the ply is draped by each of five strategies, straight (every gripper to its \
target), all at once (formed over its place and let down flat), rolled (a line lands first), from a point (the middle lands \
first) and stepwise. A table says which limits each one breaks, the worst first. comparison.csv (all limits) and comparison.svg \
(how each one ends) go to the scene's name with `.compare`. The exit code is 0 if one of them is accepted, 1 if none is.")]
pub struct Arguments {
    #[command(flatten)]
    results: Results,

    /// The planner, instead of the scene's.
    #[arg(long)]
    method: Option<Method>,

    /// Seed of the search, instead of the scene's: the same seed, the same plan.
    #[arg(long, value_name = "N")]
    seed: Option<u64>,

    /// Go on improving a plan that keeps all limits with a margin, until all drapes of [plan] evaluations are used up or
    /// the time is over.
    #[arg(long)]
    improve: bool,

    /// End the search after this time, e.g. 5min or 90s, with the best plan so far; the drape that decides on it may
    /// take a little longer.
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    time: Option<String>,

    /// Drape the plan by the other model too, and show it beside; it never judges.
    #[arg(long, value_name = "MODEL")]
    also: Option<ModelName>,

    /// Judge the plan without errors: no sample of cells, and nothing about the errors that it tolerates.
    #[arg(long)]
    without_errors: bool,

    /// Drape by every named strategy instead of a search, and say side by side why the others fail.
    #[arg(long, conflicts_with_all = ["method", "seed", "improve", "time", "earlier", "also", "without_errors"])]
    compare: bool,

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
    #[serde(flatten)]
    drape: outcome::Printed<'a>,
    method: PlanMethod,
    plan_time_s: f64,
    evaluations: usize,
    decisions: usize,
    motion: &'a Motion,
}

/// The motion in a few numbers; largest values of any gripper.
#[derive(Serialize)]
pub struct Motion {
    duration_s: f64,
    max_speed: f64,
    max_acceleration: f64,
    max_jerk: f64,
    limited_by: Vec<LimitedBy>,
}

impl Motion {
    fn of(planned: &Planned) -> Self {
        let peaks = planned.motion.peaks();
        Motion {
            duration_s: planned.motion.duration(),
            max_speed: peaks.speed.value,
            max_acceleration: peaks.acceleration.value,
            max_jerk: peaks.jerk.value,
            limited_by: planned.record.limited_by.clone(),
        }
    }
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
        return crate::book::plan(arguments, &interrupt, time, quiet);
    }
    let also = arguments.also.map(Into::into);
    let mut scene = plydrape_io::scene::read_for(&results.scene, None, also)?;
    arguments.apply(&mut scene)?;
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

    let mut search = Search::new(&scene.plan, time, &interrupt, quiet);
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

/// A plan and its result, judged by the model that decides and with errors.
pub struct Found {
    /// What is written.
    pub result: ResultFile,
    /// From where another search goes on.
    pub checkpoint: Checkpoint,
    /// The motion in a few numbers.
    motion: Motion,
    /// Drapes that decided on a plan.
    decisions: usize,
    /// How long the model took that decides.
    solving: Duration,
    /// Whether somebody broke off what follows the search.
    pub interrupted: bool,
}

impl Arguments {
    /// Whether something is asked for that only a scene of one ply has.
    pub fn of_one_ply(&self) -> Option<&'static str> {
        match (self.compare, &self.earlier, self.also) {
            (true, ..) => Some("--compare"),
            (_, Some(_), _) => Some("--continue"),
            (.., Some(_)) => Some("--also"),
            _ => None,
        }
    }

    /// The scene, the folder of results and the way to print.
    pub fn results(&self) -> &Results {
        &self.results
    }

    /// What becomes of a planned motion: its result, with the sheet's states in a stage, with the other model beside if that is asked for, and
    /// judged with errors unless the options say otherwise.
    pub fn judged(
        &self,
        scene: &SceneFile,
        planned: Planned,
        stage: &Path,
        interrupt: &Interrupt,
        quiet: bool,
    ) -> Result<Found, Failure> {
        let (motion, checkpoint) = (Motion::of(&planned), planned.checkpoint.clone());
        let (decisions, solving) = (planned.decisions, planned.outcome.drape.solving);
        let along = planner::along(scene, &planned.motion);
        let steps = planned.motion.steps();
        let mut result = ResultFile::planned(scene, scene.input.clone(), planned, stage)?;
        let mut interrupted = model::show_also(&mut result, &along, stage, interrupt, quiet)?;
        if !self.without_errors {
            let robustness = Robustness::of_planned(scene, steps);
            interrupted |= !errors::judge(&mut result, &robustness, interrupt, quiet);
        }
        interrupted |= result.summary.interrupted();
        Ok(Found { result, checkpoint, motion, decisions, solving, interrupted })
    }

    /// Puts what the options say in place of the scene's own; refuses a scene that cannot be planned.
    pub fn apply(&self, scene: &mut SceneFile) -> Result<(), Failure> {
        let file = &self.results.scene;
        let refused = |message: &str, help: &str| {
            Failure::from(SceneError {
                file: file.display().to_string(),
                text: "".into(),
                span: None,
                message: format!("`{}` {message}", file.display()),
                help: help.into(),
                unread: None,
            })
        };
        if scene.layup.mold.is_none() {
            return Err(refused(
                "has no [mold] to lay the ply on",
                "add [mold] with kind = \"plane\", or another one; a ply that just hangs needs no plan",
            ));
        }
        if scene.layup.target.is_none() {
            return Err(refused(
                "has no [target]: a plan needs to know where the ply shall end",
                "add [target] with `origin`, `direction`, `shear` and `seed`, or empty, or with `positions`",
            ));
        }
        if let Some(refusal) = scene.plan_refusal.take() {
            return Err(Failure::from(*refusal));
        }
        if let Some(method) = self.method {
            scene.plan.method = method.into();
        }
        if let Some(seed) = self.seed {
            scene.plan.seed = seed;
        }
        scene.plan.improve |= self.improve;
        Ok(())
    }
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
