//! The state of a search while it runs: the best plan so far, which is reported to a watcher, and whether the search
//! shall end.

use crate::draping::Judged;
use crate::measure::Verdict;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// How far a search has come.
#[derive(Debug)]
pub struct Progress<'a> {
    /// Complete drapes tried; of the stepwise planner, steps.
    pub evaluations: usize,
    /// Most that the search may try.
    pub most: usize,
    /// Whether the search has ended and its best plan is finished; a break then leaves the drape of that plan incomplete.
    pub finishing: bool,
    /// Name of the present stage of the search.
    pub stage: &'static str,
    /// Limits of the best plan so far; empty before there is one.
    pub best: &'a [Verdict],
    /// Whether the best plan so far keeps them all.
    pub accepted: bool,
}

/// Receives the progress of a search; it breaks to end the search with the best plan so far.
pub type Watcher<'a> = &'a mut (dyn FnMut(&Progress) -> ControlFlow<()> + Send);

/// The state of a search, shared by all threads.
pub struct SearchState<'a> {
    stopped: AtomicBool,
    interrupted: AtomicBool,
    evaluations: AtomicUsize,
    most: usize,
    best: Mutex<Best<'a>>,
}

struct Best<'a> {
    watcher: Watcher<'a>,
    score: f64,
    limits: Vec<Verdict>,
    accepted: bool,
    decided: bool,
    finishing: bool,
    stage: &'static str,
}

impl<'a> SearchState<'a> {
    /// The state of a search of at most `most` complete drapes.
    pub fn new(most: usize, watcher: Watcher<'a>) -> Self {
        SearchState {
            stopped: AtomicBool::new(false),
            interrupted: AtomicBool::new(false),
            evaluations: AtomicUsize::new(0),
            most,
            best: Mutex::new(Best {
                watcher,
                score: f64::INFINITY,
                limits: Vec::new(),
                accepted: false,
                decided: false,
                finishing: false,
                stage: "",
            }),
        }
    }

    /// Complete drapes that have been tried.
    pub fn evaluations(&self) -> usize {
        self.evaluations.load(Ordering::Relaxed)
    }

    /// Sets the number of evaluations.
    pub fn set_evaluations(&self, done: usize) {
        self.evaluations.store(done, Ordering::Relaxed);
    }

    /// Whether the search shall end with the best that it has.
    pub fn is_stopped(&self) -> bool {
        self.stopped.load(Ordering::Relaxed)
    }

    /// Whether the watcher ended the search.
    pub fn is_interrupted(&self) -> bool {
        self.interrupted.load(Ordering::Relaxed)
    }

    /// Ends the search; its best plan is finished even if the search was stopped.
    pub fn finish(&self) {
        self.stopped.store(false, Ordering::Relaxed);
        let mut best = self.best.lock().unwrap_or_else(PoisonError::into_inner);
        best.finishing = true;
        best.stage = "finishing the best plan";
    }

    /// Begins a stage of the search.
    pub fn begin(&self, stage: &'static str) {
        self.best.lock().unwrap_or_else(PoisonError::into_inner).stage = stage;
        let _ = self.report();
    }

    /// Counts a complete drape and keeps it if it is the best; one that decides is better than all that rank.
    pub fn record(&self, drape: &Judged, score: f64, decides: bool) {
        self.evaluations.fetch_add(1, Ordering::Relaxed);
        let mut best = self.best.lock().unwrap_or_else(PoisonError::into_inner);
        if (decides && !best.decided) || (decides == best.decided && score < best.score) {
            best.score = score;
            best.limits.clone_from(&drape.limits);
            best.accepted = decides && drape.accepted;
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
        let Best { watcher, limits, accepted, finishing, stage, .. } = &mut *best;
        let progress = Progress {
            evaluations: self.evaluations(),
            most: self.most,
            finishing: *finishing,
            stage,
            best: limits,
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
