//! The state of a search while it runs: the best plan so far, which is reported to a watcher, and whether the search
//! shall end.

use crate::measure::Verdict;
use crate::outcome::{Forecast, Judged, Pace};
use crate::planner::tuning::TUNING;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// How far a search has come.
#[derive(Debug)]
pub struct Progress<'a> {
    /// Candidates draped; of the stepwise planner, steps.
    pub candidates: usize,
    /// Most candidates, or steps, that the search may try.
    pub most: usize,
    /// Drapes by which was decided: one more of each candidate that seemed good.
    pub decisions: usize,
    /// Whether the search has ended and its best plan is finished; a break then leaves the drape of that plan incomplete.
    pub finishing: bool,
    /// Name of the present stage of the search.
    pub stage: &'static str,
    /// How long the decision under way takes in all, as expected before it began; `None` while none is made.
    pub forecast: Option<Forecast>,
    /// Limits of the best plan so far; empty before there is one.
    pub best: &'a [Verdict],
    /// Whether on the best plan so far was decided; else these are the limits of its ranking.
    pub decided: bool,
    /// Whether the best plan so far keeps them all, as was decided.
    pub accepted: bool,
}

/// Receives the progress of a search; it breaks to end the search with the best plan so far.
pub type Watcher<'a> = &'a mut (dyn FnMut(&Progress) -> ControlFlow<()> + Send);

/// The state of a search, shared by all threads.
pub struct SearchState<'a> {
    stopped: AtomicBool,
    interrupted: AtomicBool,
    finishing: AtomicBool,
    candidates: AtomicUsize,
    decisions: AtomicUsize,
    most: usize,
    /// Cells with errors by which candidates are ranked.
    cells: Mutex<Vec<usize>>,
    best: Mutex<Best<'a>>,
}

struct Best<'a> {
    watcher: Watcher<'a>,
    score: f64,
    limits: Vec<Verdict>,
    accepted: bool,
    decided: bool,
    stage: &'static str,
    forecast: Option<Forecast>,
    pace: Pace,
}

impl<'a> SearchState<'a> {
    /// The state of a search of at most `most` candidates or steps.
    pub fn new(most: usize, watcher: Watcher<'a>) -> Self {
        SearchState {
            stopped: AtomicBool::new(false),
            interrupted: AtomicBool::new(false),
            finishing: AtomicBool::new(false),
            candidates: AtomicUsize::new(0),
            decisions: AtomicUsize::new(0),
            most,
            cells: Mutex::new((0..TUNING.cells).collect()),
            best: Mutex::new(Best {
                watcher,
                score: f64::INFINITY,
                limits: Vec::new(),
                accepted: false,
                decided: false,
                stage: "",
                forecast: None,
                pace: Pace::default(),
            }),
        }
    }

    /// Candidates that have been draped; of the stepwise planner, steps.
    pub fn candidates(&self) -> usize {
        self.candidates.load(Ordering::Relaxed)
    }

    /// Drapes by which was decided.
    pub fn decisions(&self) -> usize {
        self.decisions.load(Ordering::Relaxed)
    }

    /// Cells with errors by which candidates are ranked.
    pub fn cells(&self) -> Vec<usize> {
        self.cells.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// One more of them: a cell that refused a plan that was decided on.
    pub fn add_cell(&self, cell: usize) {
        let mut cells = self.cells.lock().unwrap_or_else(PoisonError::into_inner);
        if cells.len() < TUNING.most_cells && !cells.contains(&cell) {
            cells.push(cell);
        }
    }

    /// Sets the number of steps of the stepwise planner.
    pub fn set_steps(&self, done: usize) {
        self.candidates.store(done, Ordering::Relaxed);
    }

    /// Whether the search shall end with the best that it has.
    pub fn is_stopped(&self) -> bool {
        self.stopped.load(Ordering::Relaxed)
    }

    /// Whether the watcher ended the search.
    pub fn is_interrupted(&self) -> bool {
        self.interrupted.load(Ordering::Relaxed)
    }

    /// Whether this drape was broken off because the search shall end.
    pub fn is_cut_short(&self, drape: &Judged) -> bool {
        self.is_stopped() && drape.missing > 0.0
    }

    /// Whether the search has ended and its best plan is finished.
    pub fn is_finishing(&self) -> bool {
        self.finishing.load(Ordering::Relaxed)
    }

    /// Ends the search; its best plan is finished even if the search was stopped.
    pub fn finish(&self) {
        self.stopped.store(false, Ordering::Relaxed);
        self.finishing.store(true, Ordering::Relaxed);
        self.begin("finishing the best plan");
    }

    /// Begins a stage of the search; returns the one before.
    pub fn begin(&self, stage: &'static str) -> &'static str {
        let mut best = self.best.lock().unwrap_or_else(PoisonError::into_inner);
        let before = std::mem::replace(&mut best.stage, stage);
        drop(best);
        let _ = self.report();
        before
    }

    /// Says how long the decision that begins will take, or that it has ended.
    pub fn set_forecast(&self, forecast: Option<Forecast>) {
        self.best.lock().unwrap_or_else(PoisonError::into_inner).forecast = forecast;
        let _ = self.report();
    }

    /// How fast the sheets of this search were draped.
    pub fn pace(&self) -> Pace {
        self.best.lock().unwrap_or_else(PoisonError::into_inner).pace
    }

    /// Counts a complete drape and keeps it if it is the best; one that decides is better than all that rank, one that is
    /// accepted better than all that are not. One that was broken off because the search shall end does not count.
    pub fn record(&self, drape: &Judged, score: f64, decides: bool) {
        if self.is_cut_short(drape) {
            return;
        }
        let count = if decides { &self.decisions } else { &self.candidates };
        count.fetch_add(1, Ordering::Relaxed);
        let mut best = self.best.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(effort) = drape.effort {
            best.pace.add(effort);
        }
        let key = |decided: bool, accepted: bool, score: f64| (!decided, !accepted, score);
        let accepted = decides && drape.accepted();
        if key(decides, accepted, score) < key(best.decided, best.accepted, best.score) {
            best.score = score;
            best.limits.clone_from(&drape.limits);
            best.accepted = accepted;
            best.decided = decides;
        }
        drop(best);
        let _ = self.report();
    }

    /// Reports to the watcher; breaks once the watcher has asked to end. It never waits for another thread.
    pub fn report(&self) -> ControlFlow<()> {
        if self.is_stopped() {
            return ControlFlow::Break(());
        }
        let Ok(mut best) = self.best.try_lock() else { return ControlFlow::Continue(()) };
        let Best { watcher, limits, decided, accepted, stage, forecast, .. } = &mut *best;
        let progress = Progress {
            candidates: self.candidates(),
            most: self.most,
            decisions: self.decisions(),
            finishing: self.is_finishing(),
            stage,
            forecast: *forecast,
            best: limits,
            decided: *decided,
            accepted: *accepted,
        };
        let flow = watcher(&progress);
        if flow.is_break() {
            self.stopped.store(true, Ordering::Relaxed);
            self.interrupted.store(true, Ordering::Relaxed);
        }
        flow
    }
}
