//! `plydrape plan`: finds a motion that puts the ply on its mold, and says how it went.

mod arguments;
mod book;
mod compare;
mod found;

pub use arguments::Arguments;

use crate::argument;
use crate::errors;
use crate::failure::{Done, Failure};
use crate::mesh;
use crate::numbers::short;
use crate::outcome::{self, warn};
use crate::results;
use crate::search::{Ended, Search, time_text};
use crate::watch::Interrupt;
use found::{Found, Motion};
use plydrape::planner::infeasible_limits::with_spring_back;
use plydrape::planner::{Checkpoint, Progress, Tried};
use plydrape::scene::{PlanMethod, Scene};
use plydrape_io::rerun::is_better;
use plydrape_io::result::SceneEcho;
use plydrape_io::scene::{Measured, usual};
use plydrape_io::store::{input, json, shown};
use plydrape_io::text::foreseen::foreseen;
use plydrape_io::text::table;
use plydrape_io::{Folder, names, plan};
use serde::Serialize;
use std::path::Path;
use std::process::ExitCode;
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
    /// Plans that the sample refused in the search.
    refused: usize,
    /// Changes of the scene that were tried where no plan was found, what helps most first.
    #[serde(skip_serializing_if = "<[Tried]>::is_empty")]
    tried: &'a [Tried],
    motion: &'a Motion,
    /// Samples a second that the scene asks for and that motion.csv has (Hz).
    #[serde(skip)]
    rates: [f64; 2],
}

/// Plans, drapes, writes the files and judges.
pub fn run(arguments: &Arguments, quiet: bool) -> Done {
    let asked = &arguments.results;
    // first of all, so that even a long read ends in files
    let interrupt = Interrupt::listen();
    let time = arguments.time.as_deref().map(time).transpose()?;
    if let Some(threads) = arguments.threads {
        // the pool cannot be set a second time, and has not been set before
        let _ = rayon::ThreadPoolBuilder::new().num_threads(threads.into()).build_global();
    }
    if plydrape_io::scene::is_book(&asked.scene) {
        return book::plan(arguments, &interrupt, time, quiet);
    }
    let also = arguments.also.map(Into::into);
    let mut scene = plydrape_io::scene::read_for(&asked.scene, None, also)?;
    arguments.apply(&mut scene)?;
    warn(&scene.notices);
    warn(&mesh::warnings(scene.layup.mold.as_ref(), scene.mesh.as_ref()));
    let earlier = arguments.earlier.as_deref();
    let earlier = earlier.map(|dir| checkpoint(dir, &scene)).transpose()?;
    if arguments.compare {
        warn(&foreseen(&scene));
        return compare::run(asked, &scene, &interrupt, quiet);
    }
    let infeasible =
        with_spring_back(&scene, !arguments.without_errors, &|| interrupt.asked().is_break());
    if !infeasible.is_empty() {
        say_infeasible(&table::infeasible_limits(&infeasible), &infeasible, arguments, quiet)?;
        if !arguments.anyway {
            return Ok(ExitCode::from(1));
        }
    }
    let folder = Folder::claim(&asked.folder("plan"), "plan", &scene.files)?;
    folder.refuse_taken(&names(&scene, true))?;
    warn(&foreseen(&scene));
    if earlier.is_none() && folder.path().join(plan::RUNNING).exists() {
        let dir = shown::path(folder.path());
        warn(&[format!(
            "a search was cut off in {dir}, and this one begins anew; `--continue {dir}` goes on from there"
        )]);
    }

    let interrupt = interrupt.within(time.map(|time| time.mul_f64(WHOLE)));
    let search = Search::new(&scene, arguments.without_errors, time, &interrupt, quiet);
    let mut search = search.kept_in(&folder, &scene);
    let watch = &mut |progress: &Progress| search.watch(progress);
    let planned = arguments.planned(&scene, earlier.as_ref(), watch);
    let (took, ended) = search.finish();
    let found = arguments.judged(&scene, planned?, folder.stage(), &interrupt, quiet)?;
    let Found { result, checkpoint, motion, decisions, solving, .. } = &found;
    let interrupted = found.is_interrupted(ended, &interrupt);
    let (folder, kept) = results::place(folder, interrupted, |dir| is_better(result, dir))?;
    let files = plan::write_into(folder, result, checkpoint)?;
    if let Some(why) = plydrape_io::export::too_large(result) {
        warn(&[format!(
            "motion.csv is not written: {why}; see what limits its speed, give a lower `rate` in [plan], or `plydrape export RESULT --to csv --large` writes it"
        )]);
    }
    // what is beside is where the search goes on from
    kept.map_or(Ok(()), |kept| kept.remove(plan::RUNNING))?;
    let plan = result.plan.as_ref();
    let printed = Printed {
        drape: outcome::Printed::new(result, *solving),
        method: scene.plan.method,
        plan_time_s: took.as_secs_f64(),
        evaluations: plan.map_or(0, |plan| plan.evaluations),
        decisions: *decisions,
        refused: plan.and_then(|plan| plan.refused).unwrap_or(0),
        tried: plan.map_or(&[], |plan| &plan.tried),
        motion,
        rates: [scene.plan.rate, plan.map_or(scene.plan.rate, |plan| plan.rate)],
    };
    let mut text = asked.text(result, &text(&printed, ended, time));
    text += errors::left_out(result, found.broken_off, &interrupt);
    asked.print(quiet, &printed, &text, &files)?;
    Ok(found.code(interrupted))
}

/// Multiple of the time of a search after which what follows it ends too: all is over within twice that time, files included.
const WHOLE: f64 = 1.8;

/// Shortest and longest time of a search (s).
const TIMES: [f64; 2] = [1e-3, 1e7];

/// The time after which the search ends.
fn time(text: &str) -> Result<Duration, Failure> {
    let help = "expected a time of up to some 100 days, e.g. 5min, 90s or 1.5h";
    let seconds = argument::value("--time", text, Measured::Time, &usual::ANY, TIMES, help)?;
    Ok(Duration::from_secs_f64(seconds))
}

/// Largest plan.json that is read (bytes).
const LARGEST_CHECKPOINT: u64 = 1 << 30;

/// The checkpoint of an earlier search in its folder: of the one that was cut off there, or else of the one that has ended.
fn checkpoint(folder: &Path, scene: &Scene) -> Result<Checkpoint, Failure> {
    let cut_off = folder.join(plan::RUNNING).exists();
    let name = if cut_off { plan::RUNNING } else { plan::FILE };
    let refused = |reason: String, help: String| Failure::Refused {
        message: format!("there is no plan to go on from in `{}`: {reason}", folder.display()),
        help,
    };
    let text = input::text(&folder.join(name), LARGEST_CHECKPOINT).map_err(|error| {
        let help = "--continue takes the folder of an earlier `plydrape plan`, with its plan.json, or the search.json of one that was cut off";
        refused(format!("{name} cannot be read, {error}"), help.into())
    })?;
    plan::read(&text, &SceneEcho::new(scene, None)).map_err(|error| {
        let help = format!(
            "{name} is not as this version of plydrape writes it: plan anew, without --continue"
        );
        refused(error.to_string(), help)
    })
}

/// What `--json` prints of a scene with limits that no plan can keep, where none is looked for.
#[derive(Serialize)]
struct Infeasible<'a, T> {
    accepted: bool,
    infeasible_limits: &'a [T],
}

/// Says which limits no plan can keep, and that no plan is looked for unless that is asked for.
fn say_infeasible<T: Serialize>(
    text: &str,
    limits: &[T],
    arguments: &Arguments,
    quiet: bool,
) -> Result<(), Failure> {
    let said = match (arguments.results.json, arguments.anyway) {
        (true, true) => return Ok(()),
        (true, false) => json::to_text(&Infeasible { accepted: false, infeasible_limits: limits })?,
        _ if quiet => return Ok(()),
        (false, true) => format!("{text}\n"),
        (false, false) => format!(
            "{text}nothing is planned: change the scene or its limits, or see with --anyway how near a plan comes\n"
        ),
    };
    results::print(&said, &[])
}

/// What was found and how long that took, in two lines.
fn text(printed: &Printed, ended: Option<Ended>, time: Option<Duration>) -> String {
    // the method of the search, and how far it went
    let Printed { evaluations, decisions, .. } = printed;
    let tried = match printed.method {
        PlanMethod::Stepwise => format!("stepwise plan of {evaluations} steps"),
        PlanMethod::Path => {
            format!(
                "path plan after {evaluations} drapes, {decisions} of them to decide on a plan,"
            )
        }
    };

    // the file of a long motion has fewer samples a second than asked for
    let rate = match printed.rates {
        [asked, rate] if rate < asked => format!(
            "\nmotion.csv has {} samples a second: {} are too many for so long a motion",
            short(rate),
            short(asked)
        ),
        _ => String::new(),
    };

    // plans that the sample refused, and what ended the search
    let refused = match printed.refused {
        0 => String::new(),
        1 => ", in which the sample refused a plan".into(),
        refused => format!(", in which the sample refused {refused} plans"),
    };
    let ended = match (ended, time) {
        (Some(Ended::Interrupted), _) => ", interrupted: the best so far".into(),
        (Some(Ended::TimeOver), Some(time)) => {
            format!(", stopped after {}, as asked: the best so far", time_text(time))
        }
        _ => String::new(),
    };

    // the time of the search, and the motion that it found
    let Motion { duration_s, max_speed, max_acceleration, max_jerk, .. } = printed.motion;
    format!(
        "{tried} in {:.1} s{refused}{ended}\nmotion of {duration_s:.1} s, at most {} m/s, {} m/s², {} m/s³{rate}",
        printed.plan_time_s,
        short(*max_speed),
        short(*max_acceleration),
        short(*max_jerk),
    )
}
