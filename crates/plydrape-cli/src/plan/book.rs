//! `plydrape plan` of a plybook: all plies of a part, each on those that it lies on.
//!
//! The layers beneath a ply are those of the ideal drapes, which are known before anything is planned. So no plan waits for
//! another one: as many are looked for at once as there are threads, and each comes out as it would alone.

use super::arguments::Arguments;
use super::found::Found;
use crate::failure::{Done, Failure};
use crate::mesh;
use crate::outcome;
use crate::search::{Ended, Search, SharedLines};
use crate::watch::{Interrupt, bar};
use indicatif::ProgressBar;
use plydrape::planner::infeasible_limits::infeasible_limits;
use plydrape::planner::{self, Progress};
use plydrape_io::scene::{Book, read_book};
use plydrape_io::store::folder::write_together;
use plydrape_io::text::table;
use plydrape_io::write::book::{self, NAMES, PlyRecord};
use plydrape_io::{Folder, Staged, plan};
use serde::Serialize;
use std::io::{self, Write};
use std::ops::ControlFlow;
use std::path::PathBuf;
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

/// A planned ply whose files stand ready.
struct Ready {
    record: PlyRecord,
    staged: Staged,
    interrupted: bool,
    unsolved: bool,
}

/// Plans all plies of a book, writes their files and the report over them, and judges.
pub fn plan(
    arguments: &Arguments,
    interrupt: &Interrupt,
    time: Option<Duration>,
    quiet: bool,
) -> Done {
    if let Some(option) = arguments.of_one_ply() {
        return Err(Failure::Refused {
            message: format!("{option} is for a single ply, and this is a plybook"),
            help: format!(
                "plan the book without {option}; a ply that has a scene file of its own can be planned alone once that has a [mold]"
            ),
        });
    }
    let results = arguments.results();
    let mut book = read_book(&results.scene)?;
    for ply in &mut book.plies {
        arguments.apply(&mut ply.scene).map_err(|cause| of_ply(&ply.name, cause))?;
    }
    outcome::warn(&mesh::warnings(Some(&book.mold), book.mesh.as_ref()));
    let dir = results.folder("plan");
    let folder = Folder::claim(&dir, "plan")?;
    folder.refuse_inputs(&NAMES, &book.files)?;
    let folders: Vec<Mutex<Option<Folder>>> = {
        let claimed = book.plies.iter().enumerate().map(|(n, ply)| {
            let folder = Folder::claim(&dir.join(ply.folder(n)), "plan")?;
            folder.refuse_inputs(&plydrape_io::NAMES, &book.files)?;
            Ok(Mutex::new(Some(folder)))
        });
        claimed.collect::<Result<_, Failure>>()?
    };
    let verbose = !quiet && !results.json;
    if verbose {
        announce(&book)?;
    }

    let began = Instant::now();
    let eyes = Eyes::new(interrupt, book.plies.len(), quiet);
    let count = book.plies.len();
    let done: Vec<Mutex<Option<Result<Ready, Failure>>>> =
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
                    let found = one(arguments, &book, n, folder, &eyes, time)
                        .map_err(|cause| of_ply(&book.plies[n].name, cause));
                    eyes.finished(found.is_err());
                    if let Ok(mut place) = done[n].lock() {
                        *place = Some(found);
                    }
                }
            });
        }
    });
    eyes.bar.finish_and_clear();

    let (mut records, mut staged) = (Vec::new(), Vec::new());
    let (mut interrupted, mut unsolved) = (false, false);
    for place in done {
        let Some(found) = place.into_inner().unwrap_or_default() else { continue };
        let ready = found?;
        interrupted |= ready.interrupted;
        unsolved |= ready.unsolved;
        records.push(ready.record);
        staged.push(ready.staged);
    }
    staged.push(book::stage_into(folder, &book, &records, interrupted, &book.files)?);
    let mut files = write_together(staged)?.pop().unwrap_or_default();
    files.extend(records.iter().map(|ply| dir.join(&ply.folder)).collect::<Vec<PathBuf>>());

    let accepted = records.iter().all(|ply| ply.accepted);
    let time_s = began.elapsed().as_secs_f64();
    let printed = Printed { title: &book.title, accepted, interrupted, plies: &records, time_s };
    results.print(quiet, &printed, &text(&records, interrupted, time_s), &files)?;
    Ok(outcome::code(interrupted, unsolved, accepted))
}

fn of_ply(name: &str, cause: Failure) -> Failure {
    match cause {
        // names its ply itself, and has a place to show
        cause @ Failure::Scene(_) => cause,
        cause => Failure::Ply { name: name.into(), cause: Box::new(cause) },
    }
}

/// What is said before the plans are looked for.
fn announce(book: &Book) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    writeln!(out, "{}\n", book.title)?;
    for ply in &book.plies {
        let found = infeasible_limits(&ply.scene);
        if !found.is_empty() {
            writeln!(out, "ply {}: {}", ply.name, table::infeasible_limits(&found))?;
        }
    }
    out.flush()?;
    Ok(())
}

/// Plans one ply and stages its files.
fn one(
    arguments: &Arguments,
    book: &Book,
    index: usize,
    folder: Folder,
    eyes: &Eyes,
    time: Option<Duration>,
) -> Result<Ready, Failure> {
    let scene = &book.plies[index].scene;
    let mut search = Search::new(scene, arguments.without_errors, time, eyes.interrupt, true);
    let watch = &mut |progress: &Progress| eyes.watch(&mut search, progress);
    let planned = planner::plan_without_errors(scene, None, watch);
    let (_, ended) = search.finish();
    let found = arguments.judged(scene, planned?, folder.stage(), eyes.interrupt, true)?;
    let Found { result, checkpoint, interrupted, .. } = &found;
    let record = PlyRecord::of(book, index, result);
    let interrupted = ended == Some(Ended::Interrupted) || *interrupted;
    let unsolved = outcome::is_unsolved(result);
    let staged = plan::stage_into(folder, result, checkpoint, &book.files)?;
    Ok(Ready { record, staged, interrupted, unsolved })
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
struct Eyes<'a> {
    interrupt: &'a Interrupt,
    bar: ProgressBar,
    lines: SharedLines,
    done: AtomicUsize,
    most: usize,
    /// One ply could not be planned: the others need not be.
    failed: AtomicBool,
}

impl<'a> Eyes<'a> {
    fn new(interrupt: &'a Interrupt, most: usize, quiet: bool) -> Self {
        let bar = bar(most, "planning plies {bar:40} {pos} of {len} planned, {elapsed}", quiet);
        if !bar.is_hidden() {
            bar.enable_steady_tick(Duration::from_millis(500));
        }
        let (lines, done) = (SharedLines::new(quiet), AtomicUsize::new(0));
        Eyes { interrupt, bar, lines, done, most, failed: AtomicBool::new(false) }
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
