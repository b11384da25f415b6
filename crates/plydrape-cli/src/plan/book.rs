//! `plydrape plan` of a plybook: all plies of a part, each on those that it lies on.
//!
//! The layers beneath a ply are those of the ideal drapes, which are known before anything is planned. So no plan waits for
//! another one: as many are looked for at once as there are threads, and each comes out as it would alone.

use super::arguments::Arguments;
use super::found::Found;
use super::{WHOLE, checkpoint, say_infeasible};
use crate::failure::{Done, Failure};
use crate::mesh;
use crate::outcome;
use crate::results::{place, print};
use crate::search::{Search, SharedLines};
use crate::watch::{Interrupt, bar};
use indicatif::ProgressBar;
use plydrape::measure::Verdict;
use plydrape::planner::Progress;
use plydrape::planner::infeasible_limits::with_spring_back;
use plydrape_io::scene::{Book, BookPly, read_book};
use plydrape_io::store::folder::write_together;
use plydrape_io::text::foreseen::foreseen;
use plydrape_io::text::table;
use plydrape_io::write::book::{self, NAMES, PlyRecord};
use plydrape_io::{Folder, Staged, names, plan};
use serde::Serialize;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread;
use std::time::{Duration, Instant};

/// What `--json` prints.
#[derive(Serialize)]
struct Printed<'a> {
    title: &'a str,
    accepted: bool,
    interrupted: bool,
    plies: &'a [PlyRecord],
    time_s: f64,
}

/// A planned ply whose files are written and not yet in place.
struct Ready {
    record: PlyRecord,
    staged: Staged,
    interrupted: bool,
    /// It is accepted, and nothing is missing.
    done: bool,
    unsolved: bool,
}

/// Plans all plies of a book, writes their files and the report over them, and judges.
pub fn plan(
    arguments: &Arguments,
    interrupt: &Interrupt,
    time: Option<Duration>,
    quiet: bool,
) -> Done {
    // options of a single ply have no meaning for a book
    if let Some(option) = arguments.option_of_one_ply() {
        return Err(Failure::Refused {
            message: format!("{option} is for a single ply, and this is a plybook"),
            help: format!(
                "plan the book without {option}; a ply that has a scene file of its own can be planned alone once that has a [mold]"
            ),
        });
    }

    // the book, with what the command line changes in the scene of each ply
    let results = &arguments.results;
    let mut book = read_book(&results.scene)?;
    for ply in &mut book.plies {
        arguments.apply(&mut ply.scene).map_err(|cause| failure_of(&ply.name, cause))?;
    }

    // notices and warnings come before the long work
    for ply in &book.plies {
        let with_name = |notice: String| format!("ply {}: {notice}", ply.name);
        let notices = ply.scene.notices.iter().cloned().chain(foreseen(&ply.scene));
        outcome::warn(&notices.map(with_name).collect::<Vec<_>>());
    }
    outcome::warn(&mesh::warnings(Some(&book.mold), book.mesh.as_ref()));

    // limits that no motion can keep end the run, unless it is to plan anyway
    let infeasible = |ply| Infeasible::new(ply, !arguments.without_errors);
    let found: Vec<Infeasible> = book.plies.iter().filter_map(infeasible).collect();
    if !found.is_empty() {
        let lines = found.iter().map(|ply| format!("ply {}: {}", ply.ply, ply.text()));
        say_infeasible(&lines.collect::<String>(), &found, arguments, quiet)?;
        if !arguments.anyway {
            return Ok(ExitCode::from(1));
        }
    }

    // a run that goes on from an earlier one needs a plan of at least one ply
    if let Some(dir) = &arguments.earlier
        && !(0..book.plies.len()).any(|n| has_plan(&dir.join(book.plies[n].folder(n))))
    {
        return Err(Failure::Refused {
            message: format!("there is no plan to go on from in `{}`", dir.display()),
            help: "--continue takes the folder of an earlier `plydrape plan` of this book".into(),
        });
    }

    // all folders are claimed at once, so that no run finds one taken after its long work
    let dir = results.folder("plan");
    let folder = Folder::claim(&dir, "plan", &book.files)?;
    folder.refuse_taken(&NAMES)?;
    let folders: Vec<Mutex<Option<Folder>>> = {
        let claimed = book.plies.iter().enumerate().map(|(n, ply)| {
            let claimed = Folder::claim(&dir.join(ply.folder(n)), "plan", &book.files);
            let free = claimed
                .and_then(|folder| folder.refuse_taken(&names(&ply.scene, true)).map(|()| folder));
            let folder = free.map_err(|cause| failure_of(&ply.name, cause.into()))?;
            Ok(Mutex::new(Some(folder)))
        });
        claimed.collect::<Result<_, Failure>>()?
    };

    if !quiet && !results.json {
        print(&format!("{}\n\n", book.title), &[])?;
    }

    // the plies are planned in parallel: every worker takes the next one until none is left
    let began = Instant::now();
    let eyes = BookEyes::new(interrupt, book.plies.len(), quiet);
    let count = book.plies.len();
    let planned: Vec<Mutex<Option<Result<Ready, Failure>>>> =
        (0..count).map(|_| Mutex::new(None)).collect();
    let next = AtomicUsize::new(0);
    let workers = rayon::current_num_threads().clamp(1, count);
    thread::scope(|scope| {
        for _ in 0..workers {
            scope.spawn(|| {
                loop {
                    let n = next.fetch_add(1, Ordering::Relaxed);
                    let Some(slot) = folders.get(n) else { break };
                    let claimed = slot.lock().ok().and_then(|mut folder| folder.take());
                    let Some(folder) = claimed else { break };
                    let found = plan_ply(arguments, &book, n, folder, &eyes, time)
                        .map_err(|cause| failure_of(&book.plies[n].name, cause));
                    eyes.finished(found.is_err());
                    if let Ok(mut place) = planned[n].lock() {
                        *place = Some(found);
                    }
                }
            });
        }
    });
    eyes.bar.finish_and_clear();

    // the first failure in the order of the book ends the run; else the results are collected
    let (mut records, mut staged) = (Vec::new(), Vec::new());
    let (mut interrupted, mut unsolved, mut done) = (false, false, true);
    for place in planned {
        let Some(found) = place.into_inner().unwrap_or_default() else { continue };
        let ready = found?;
        interrupted |= ready.interrupted;
        unsolved |= ready.unsolved;
        done &= ready.done;
        records.push(ready.record);
        staged.push(ready.staged);
    }

    // a better earlier book is kept after an interruption, and the new one moves beside it
    let (folder, kept) = place(folder, interrupted, |dir| book::is_better(&records, dir))?;
    let dir = folder.path().to_path_buf();
    if kept.is_some() {
        let moved = staged.into_iter().zip(&records).map(|(staged, ply)| {
            staged.moved_to(Folder::claim(&dir.join(&ply.folder), "plan", &book.files)?)
        });
        staged = moved.collect::<Result<_, _>>()?;
    }

    // all files come into place together, or none does
    staged.push(book::stage_into(folder, &book, &records, interrupted)?);
    let mut files = write_together(staged)?.pop().unwrap_or_default();
    files.extend(records.iter().map(|ply| dir.join(&ply.folder)).collect::<Vec<PathBuf>>());

    // the report on standard output, and the exit code
    let accepted = records.iter().all(|ply| ply.accepted);
    let time_s = began.elapsed().as_secs_f64();
    let printed = Printed { title: &book.title, accepted, interrupted, plies: &records, time_s };
    results.print(quiet, &printed, &text(&records, interrupted, time_s), &files)?;
    Ok(outcome::code(interrupted && !(accepted && done), unsolved, accepted))
}

/// The failure of a ply, with the name of the ply.
fn failure_of(name: &str, cause: Failure) -> Failure {
    match cause {
        // a fault of the scene names its ply itself, and has a place to show
        cause @ Failure::Scene(_) => cause,
        cause => Failure::Ply { name: name.into(), cause: Box::new(cause) },
    }
}

/// Whether a search of one ply can go on from its folder.
fn has_plan(dir: &Path) -> bool {
    [plan::FILE, plan::RUNNING].iter().any(|file| dir.join(file).exists())
}

/// The limits of a ply that no plan can keep.
#[derive(Serialize)]
struct Infeasible<'a> {
    ply: &'a str,
    limits: Vec<Verdict>,
}

impl<'a> Infeasible<'a> {
    fn new(ply: &'a BookPly, sampled: bool) -> Option<Self> {
        let limits = with_spring_back(&ply.scene, sampled, &|| false);
        (!limits.is_empty()).then_some(Infeasible { ply: &ply.name, limits })
    }

    fn text(&self) -> String {
        table::infeasible_limits(&self.limits)
    }
}

/// Plans one ply and stages its files.
fn plan_ply(
    arguments: &Arguments,
    book: &Book,
    index: usize,
    folder: Folder,
    eyes: &BookEyes,
    time: Option<Duration>,
) -> Result<Ready, Failure> {
    let scene = &book.plies[index].scene;
    let earlier = arguments.earlier.as_deref().map(|dir| dir.join(book.plies[index].folder(index)));
    // a ply of which nothing is there yet is planned anew
    let earlier = earlier.filter(|dir| has_plan(dir));
    let earlier = earlier.map(|dir| checkpoint(&dir, scene)).transpose()?;
    let interrupt = eyes.interrupt.within(time.map(|time| time.mul_f64(WHOLE)));
    let search = Search::new(scene, arguments.without_errors, time, &interrupt, true);
    let mut search = search.kept_in(&folder, scene);
    let watch = &mut |progress: &Progress| eyes.watch(&mut search, progress);
    let planned = arguments.planned(scene, earlier.as_ref(), watch);
    let (_, ended) = search.finish();
    let found = arguments.judged(scene, planned?, folder.stage(), &interrupt, true)?;
    let Found { result, checkpoint, .. } = &found;
    let record = PlyRecord::new(book, index, result);
    let interrupted = found.is_interrupted(ended, &interrupt);
    let done = found.is_done();
    let unsolved = outcome::is_unsolved(result);
    let staged = plan::stage_into(folder, result, checkpoint)?;
    Ok(Ready { record, staged, interrupted, done, unsolved })
}

/// What is printed for people.
fn text(plies: &[PlyRecord], interrupted: bool, time_s: f64) -> String {
    let accepted = plies.iter().filter(|ply| ply.accepted).count();
    let ended = if interrupted { ", interrupted: the best so far" } else { "" };
    let verdict = match accepted == plies.len() {
        true => format!("all {accepted} plies accepted"),
        false => format!("{accepted} of {} plies accepted", plies.len()),
    };
    format!("{}\n{verdict}, planned in {time_s:.1} s{ended}\n", book::table(plies))
}

/// Who looks on: someone at a terminal sees a bar, others a plain line a minute.
struct BookEyes<'a> {
    interrupt: &'a Interrupt,
    bar: ProgressBar,
    lines: SharedLines,
    done: AtomicUsize,
    most: usize,
    /// One ply could not be planned: the others need not be.
    failed: AtomicBool,
}

impl<'a> BookEyes<'a> {
    fn new(interrupt: &'a Interrupt, most: usize, quiet: bool) -> Self {
        let bar = bar(most, "planning plies {bar:40} {pos} of {len} planned, {elapsed}", quiet);
        if !bar.is_hidden() {
            bar.enable_steady_tick(Duration::from_millis(500));
        }
        let (lines, done) = (SharedLines::new(quiet), AtomicUsize::new(0));
        BookEyes { interrupt, bar, lines, done, most, failed: AtomicBool::new(false) }
    }

    /// Whether the search of one ply goes on.
    fn watch(&self, search: &mut Search, progress: &Progress) -> ControlFlow<()> {
        self.line();
        if self.failed.load(Ordering::Relaxed) {
            return ControlFlow::Break(());
        }
        search.watch(progress)
    }

    fn finished(&self, failed: bool) {
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        self.bar.set_position(done as u64);
        self.failed.fetch_or(failed, Ordering::Relaxed);
    }

    /// Prints the line of this minute, if it is due.
    fn line(&self) {
        let done = self.done.load(Ordering::Relaxed);
        self.lines.say(|| format!("{done} of {} plies planned", self.most));
    }
}
