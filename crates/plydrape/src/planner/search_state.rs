//! The state of a search while it runs: the best plan so far, which is reported to a watcher, and whether the search
//! shall end.

use super::checkpoint::Checkpoint;
use super::journal::{Journal, Known};
use super::path::Strategy;
use crate::geometry::Point;
use crate::measure::Verdict;
use crate::outcome::{Forecast, Judged, Pace};
use crate::planner::evaluation::Drapes;
use crate::planner::tuning::TUNING;
use crate::scene::Scene;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// How far a search has come.
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
    /// How long the decision under way takes in all, as expected before it began, or each drape of a sample; `None` while none is made.
    pub forecast: Option<Forecast>,
    /// Cells of the sample under way at most; `None` while none is draped.
    pub sample: Option<usize>,
    /// The step up to which the drape that decides is done, and how many it has, or so the cells of the sample; `None` while none is made.
    pub step: Option<[usize; 2]>,
    /// How long that still takes, by the forecast and by what is done.
    pub left: Option<Duration>,
    /// Limits of the best plan so far; empty before there is one.
    pub best: &'a [Verdict],
    /// Whether on the best plan so far was decided; else these are the limits of its ranking.
    pub decided: bool,
    /// Whether the best plan so far keeps them all, as was decided, with those of its motion and of the tool, and no sample of cells with
    /// errors has refused it.
    pub accepted: bool,
    /// Makes the checkpoint from which a search that is cut off now goes on to the same end; `None` before there is a plan.
    pub checkpoint: &'a dyn Fn() -> Option<Checkpoint>,
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
    refusals: AtomicUsize,
    most: usize,
    /// Cells with errors by which candidates are ranked.
    cells: Mutex<Vec<usize>>,
    /// How many of them there are before a plan was refused.
    first_cells: usize,
    /// Cells with errors in which fronts race; none in a search without errors.
    race: Vec<usize>,
    /// By how many cells a plan is proven that is decided on, and how many of them may break a limit.
    proof: Mutex<Proof>,
    best: Mutex<Best<'a>>,
    /// What is searched, and the checkpoint from which that goes on.
    origin: Option<(&'a Scene, Option<&'a Checkpoint>)>,
    journal: Mutex<Journal>,
    /// All that was judged so far was in the journal. The watcher is not asked then: that takes no time to speak of, and a search that is
    /// ended within it would lose what the one before had.
    repeats: AtomicBool,
}

/// By how many cells with errors a plan is proven, and how many of them may break a limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Proof {
    /// Cells.
    pub cells: usize,
    /// Cells that may break a limit.
    pub spare: usize,
}

/// Positions of all grippers (m), step by step, and the strategy behind them.
type BestPlan = (Option<Strategy>, Vec<Vec<Point>>);

struct Best<'a> {
    watcher: Watcher<'a>,
    score: f64,
    limits: Vec<Verdict>,
    accepted: bool,
    decided: bool,
    stage: &'static str,
    /// The plan itself.
    plan: Option<BestPlan>,
    forecast: Option<Forecast>,
    sample: Option<usize>,
    /// When the decision under way began.
    began: Instant,
    step: Option<[usize; 2]>,
    pace: Pace,
}

impl<'a> SearchState<'a> {
    /// The state of a search of at most `most` candidates or steps.
    pub fn new(most: usize, watcher: Watcher<'a>) -> Self {
        SearchState {
            // the search has not ended, and nothing is draped yet
            stopped: AtomicBool::new(false),
            interrupted: AtomicBool::new(false),
            finishing: AtomicBool::new(false),
            candidates: AtomicUsize::new(0),
            decisions: AtomicUsize::new(0),
            refusals: AtomicUsize::new(0),
            most,
            // cells as for rigid grippers, until the scene is known
            cells: Mutex::new((0..TUNING.cells[0]).collect()),
            first_cells: TUNING.cells[0],
            race: (0..super::path::tuning::TUNING.race.all_cells()).collect(),
            proof: Mutex::new(Proof { cells: TUNING.proving[0], spare: TUNING.spare[0] }),
            // any plan is better than none
            best: Mutex::new(Best {
                watcher,
                score: f64::INFINITY,
                limits: Vec::new(),
                accepted: false,
                decided: false,
                stage: "",
                plan: None,
                forecast: None,
                sample: None,
                began: Instant::now(),
                step: None,
                pace: Pace::default(),
            }),
            // nothing to go on from
            origin: None,
            journal: Mutex::default(),
            repeats: AtomicBool::new(false),
        }
    }

    /// The state of a search that goes on `from` a checkpoint, and knows what a search before has judged.
    #[must_use]
    pub fn going_on(
        self,
        scene: &'a Scene,
        from: Option<&'a Checkpoint>,
        journal: Journal,
    ) -> Self {
        let repeats = AtomicBool::new(!journal.is_empty());
        let on_mounts = usize::from(scene.layup.settings.pad.gives());
        let first_cells = TUNING.cells[on_mounts];
        let cells = Mutex::new((0..first_cells).collect());
        let proof = Proof { cells: TUNING.proving[on_mounts], spare: TUNING.spare[on_mounts] };
        let (origin, journal) = (Some((scene, from)), Mutex::new(journal));
        let proof = Mutex::new(proof);
        SearchState { origin, journal, repeats, cells, first_cells, proof, ..self }
    }

    /// This state for a search in which no cell with errors is draped.
    #[must_use]
    pub fn without_cells(self) -> Self {
        let proof = Mutex::new(Proof { cells: 0, spare: 0 });
        SearchState { cells: Mutex::default(), first_cells: 0, race: Vec::new(), proof, ..self }
    }

    /// What was judged.
    pub fn into_journal(self) -> Journal {
        self.journal.into_inner().unwrap_or_else(PoisonError::into_inner)
    }

    /// The drapes that ranked a candidate: those in the journal, or else the ones that `drape` makes.
    ///
    /// # Errors
    /// The errors of `drape`.
    pub fn ranked<E>(
        &self,
        key: u64,
        drape: impl FnOnce() -> Result<Drapes, E>,
    ) -> Result<Drapes, E> {
        let known = lock(&self.journal).ranked(key);
        if let Some(known) = known {
            return Ok(known);
        }
        self.repeats.store(false, Ordering::Relaxed);
        let drapes = drape()?;
        if !self.is_stopped() {
            lock(&self.journal).rank(key, &drapes);
        }
        Ok(drapes)
    }

    /// The score of a candidate, if the journal has nothing else; it is counted then.
    pub fn scored(&self, key: u64) -> Option<f64> {
        let score = lock(&self.journal).score(key)?;
        self.candidates.fetch_add(1, Ordering::Relaxed);
        Some(score)
    }

    /// Keeps of a candidate its score alone.
    pub fn keep_score(&self, key: u64, score: f64) {
        lock(&self.journal).keep_score(key, score);
    }

    /// How a plan was decided on, if the journal has it.
    pub fn decided(&self, key: u64) -> Option<Known> {
        let known = lock(&self.journal).decided(key);
        if known.is_none() {
            self.repeats.store(false, Ordering::Relaxed);
        }
        known
    }

    /// Keeps how a plan was decided on.
    pub fn keep_decision(&self, key: u64, known: &Known) {
        if !self.is_stopped() {
            lock(&self.journal).decide(key, known);
        }
    }

    /// The checkpoint of the search as it is, with all that was judged.
    fn checkpoint_of(&self, (strategy, positions): &BestPlan) -> Option<Checkpoint> {
        let (scene, from) = self.origin?;
        let before = from.map_or(0, |checkpoint| checkpoint.evaluations);
        let evaluations = before + self.candidates() + self.decisions();
        let checkpoint = Checkpoint::new(scene, evaluations, *strategy, positions.clone());
        Some(checkpoint.cut_off(scene, from, lock(&self.journal).clone()))
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
        lock(&self.cells).clone()
    }

    /// The cells in which fronts race, and those that refused a plan.
    pub fn race_cells(&self) -> Vec<usize> {
        let others = self.cells().into_iter().filter(|cell| *cell >= self.race.len());
        self.race.iter().copied().chain(others).collect()
    }

    /// One more of them: a cell that refused a plan that was decided on.
    pub fn add_cell(&self, cell: usize) {
        let mut cells = lock(&self.cells);
        if cells.len() < self.first_cells + TUNING.added_cells && !cells.contains(&cell) {
            cells.push(cell);
        }
    }

    /// By how many cells a plan is proven that is decided on.
    pub fn proof(&self) -> Proof {
        *lock(&self.proof)
    }

    /// Plans that a sample has refused.
    pub fn refusals(&self) -> usize {
        self.refusals.load(Ordering::Relaxed)
    }

    /// A sample has refused the best plan, although the cells of the planner had proven it: these are its limits now, and the plans that
    /// follow are proven by more cells.
    pub fn refuse(&self, proof: Proof, limits: &[Verdict], score: f64) {
        self.refusals.fetch_add(1, Ordering::Relaxed);
        *lock(&self.proof) = proof;
        let mut best = lock(&self.best);
        best.limits = limits.to_vec();
        (best.accepted, best.score) = (false, score);
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
        self.repeats.store(false, Ordering::Relaxed);
        self.finishing.store(true, Ordering::Relaxed);
        self.begin("finishing the best plan");
    }

    /// Does what belongs to a finished plan, and is not broken off by the time of the search, before the search may go on.
    pub fn while_finishing<T>(&self, work: impl FnOnce() -> T) -> T {
        self.repeats.store(false, Ordering::Relaxed);
        let before = self.finishing.swap(true, Ordering::Relaxed);
        let done = work();
        self.finishing.store(before, Ordering::Relaxed);
        done
    }

    /// Begins a stage of the search; returns the one before.
    pub fn begin(&self, stage: &'static str) -> &'static str {
        let mut best = lock(&self.best);
        let before = std::mem::replace(&mut best.stage, stage);
        drop(best);
        let _ = self.report();
        before
    }

    /// Says how long the decision that begins will take, or that it has ended.
    pub fn set_forecast(&self, forecast: Option<Forecast>) {
        self.set_work(forecast, None);
    }

    /// Says how long a sample of a number of cells that begins will take.
    pub fn set_sample(&self, forecast: Option<Forecast>, cells: usize) {
        self.set_work(forecast, Some(cells));
    }

    fn set_work(&self, forecast: Option<Forecast>, sample: Option<usize>) {
        let mut best = lock(&self.best);
        (best.forecast, best.sample, best.step) = (forecast, sample, None);
        best.began = Instant::now();
        drop(best);
        let _ = self.report();
    }

    /// Says up to which of this many steps the drape that decides is done, or cells of a sample.
    pub fn set_step(&self, done: usize, of: usize) {
        if let Ok(mut best) = self.best.try_lock() {
            best.step = best.forecast.and(Some([done, of]));
        }
    }

    /// How fast the sheets of this search were draped.
    pub fn pace(&self) -> Pace {
        lock(&self.best).pace
    }

    /// Counts a complete drape and keeps it if it is the best; one that decides is better than all that rank, one that is
    /// accepted better than all that are not. One that was broken off because the search shall end does not count. `plan` is what was draped;
    /// `None` of a plan that is draped once more.
    pub fn record(
        &self,
        drape: &Judged,
        score: f64,
        decides: bool,
        plan: Option<(Option<Strategy>, &[Vec<Point>])>,
    ) {
        if self.is_cut_short(drape) {
            return;
        }
        let count = if decides { &self.decisions } else { &self.candidates };
        count.fetch_add(1, Ordering::Relaxed);
        let mut best = lock(&self.best);
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
            let plan = plan.map(|(strategy, positions)| (strategy, positions.to_vec()));
            best.plan = plan.or(best.plan.take());
        }
        drop(best);
        let _ = self.report();
    }

    /// Reports to the watcher; breaks once the watcher has asked to end. It never waits for another thread.
    pub fn report(&self) -> ControlFlow<()> {
        if self.is_stopped() {
            return ControlFlow::Break(());
        }
        if self.repeats.load(Ordering::Relaxed) {
            return ControlFlow::Continue(());
        }
        // another thread that reports now says the same
        let Ok(mut best) = self.best.try_lock() else { return ControlFlow::Continue(()) };
        let (sample, step, elapsed) = (best.sample, best.step, best.began.elapsed());
        let Best { watcher, limits, decided, accepted, stage, plan, forecast, .. } = &mut *best;
        // made only where the watcher asks for it, because it copies a motion
        let checkpoint = || self.checkpoint_of(plan.as_ref()?);
        let left = forecast.map(|forecast| forecast.left(sample, elapsed, step));
        let progress = Progress {
            candidates: self.candidates(),
            most: self.most,
            decisions: self.decisions(),
            finishing: self.is_finishing(),
            stage,
            forecast: *forecast,
            sample,
            step,
            left,
            best: limits,
            decided: *decided,
            accepted: *accepted,
            checkpoint: &checkpoint,
        };
        let flow = watcher(&progress);
        if flow.is_break() {
            self.stopped.store(true, Ordering::Relaxed);
            self.interrupted.store(true, Ordering::Relaxed);
        }
        flow
    }
}

/// Locks a mutex, also one whose holder has panicked.
pub fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
