//! What is known of a search while it runs: the best plan so far, told to whoever watches, and whether the
//! search shall end.

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
    /// What is being done.
    pub stage: &'static str,
    /// Limits of the best plan so far; empty before there is one.
    pub best: &'a [Verdict],
    /// Whether the best plan so far keeps them all.
    pub accepted: bool,
}

/// Who watches a plan being made: breaks to have the best so far.
pub type Watcher<'a> = &'a mut (dyn FnMut(&Progress) -> ControlFlow<()> + Send);

/// The state of a search, shared by all threads.
pub struct Board<'a> {
    stopped: AtomicBool,
    evaluations: AtomicUsize,
    most: usize,
    best: Mutex<Best<'a>>,
}

struct Best<'a> {
    watcher: Watcher<'a>,
    score: f64,
    limits: Vec<Verdict>,
    accepted: bool,
    stage: &'static str,
}

impl<'a> Board<'a> {
    /// A board for a search of at most `most` complete drapes.
    pub fn new(most: usize, watcher: Watcher<'a>) -> Self {
        Board {
            stopped: AtomicBool::new(false),
            evaluations: AtomicUsize::new(0),
            most,
            best: Mutex::new(Best {
                watcher,
                score: f64::INFINITY,
                limits: Vec::new(),
                accepted: false,
                stage: "",
            }),
        }
    }

    /// Complete drapes that have been tried.
    pub fn evaluations(&self) -> usize {
        self.evaluations.load(Ordering::Relaxed)
    }

    /// Sets how much has been done.
    pub fn count(&self, done: usize) {
        self.evaluations.store(done, Ordering::Relaxed);
    }

    /// Whether the search shall end with the best that it has.
    pub fn is_stopped(&self) -> bool {
        self.stopped.load(Ordering::Relaxed)
    }

    /// Names what is done from now on.
    pub fn enter(&self, stage: &'static str) {
        self.best.lock().unwrap_or_else(PoisonError::into_inner).stage = stage;
        let _ = self.tick();
    }

    /// Counts a complete drape and keeps it if it is the best.
    pub fn add(&self, judged: &Judged, score: f64) {
        self.evaluations.fetch_add(1, Ordering::Relaxed);
        let mut best = self.best.lock().unwrap_or_else(PoisonError::into_inner);
        if score < best.score {
            best.score = score;
            best.limits.clone_from(&judged.limits);
            best.accepted = judged.accepted;
        }
        drop(best);
        let _ = self.tick();
    }

    /// Tells the watcher; breaks once it has asked to end. Never waits for another thread.
    pub fn tick(&self) -> ControlFlow<()> {
        if self.is_stopped() {
            return ControlFlow::Break(());
        }
        let Ok(mut best) = self.best.try_lock() else { return ControlFlow::Continue(()) };
        let Best { watcher, limits, accepted, stage, .. } = &mut *best;
        let progress = Progress {
            evaluations: self.evaluations(),
            most: self.most,
            stage,
            best: limits,
            accepted: *accepted,
        };
        let flow = watcher(&progress);
        if flow.is_break() {
            self.stopped.store(true, Ordering::Relaxed);
        }
        flow
    }
}
