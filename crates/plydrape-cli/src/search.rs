//! A search for a plan under someone's eyes: when it ends, and how far it is.

use crate::outcome::warn;
use crate::watch::{Interrupt, bar};
use indicatif::ProgressBar;
use plydrape::planner::path::most_candidates;
use plydrape::planner::{Progress, TRYING};
use plydrape::scene::{PlanMethod, Scene};
use plydrape_io::result::SceneEcho;
use plydrape_io::text::{forecast, table};
use plydrape_io::{Error, Folder, plan};
use std::io::{self, IsTerminal, Write};
use std::ops::ControlFlow;
use std::sync::Mutex;
use std::time::{Duration, Instant};

/// Why a search was ended from outside.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ended {
    /// By Ctrl-C or SIGTERM.
    Interrupted,
    /// By the end of its time.
    TimeOver,
}

/// A search under way, as the command watches it.
pub struct Search<'a> {
    interrupt: &'a Interrupt,
    /// The time after which it ends.
    time: Option<Duration>,
    began: Instant,
    ended: Option<Ended>,
    /// What a search counts.
    unit: &'static str,
    /// Cells with errors of the sample that judges a plan.
    cells: usize,
    bar: ProgressBar,
    lines: Option<Lines>,
    kept: Option<Kept<'a>>,
}

/// Where the state of a search is kept, and since when.
struct Kept<'a> {
    folder: &'a Folder,
    scene: SceneEcho,
    /// Time of the search at which the state is written next.
    due: Duration,
    /// Drapes that the state had when it was last written.
    drapes: usize,
}

/// Shortest and longest time from one writing of the state to the next (s): the first one is soon, and no crash loses more than half a
/// minute.
const KEPT: [f64; 2] = [1.0, 20.0];

impl Kept<'_> {
    /// Writes the state of the search, if that is due and the state is another one.
    fn put_by(&mut self, progress: &Progress, elapsed: Duration) -> Result<(), Error> {
        let drapes = progress.candidates + progress.decisions;
        // a search that goes on does not judge again what follows the search, so all of the state is written before that
        let due = elapsed >= self.due || progress.finishing;
        if !due || drapes == self.drapes {
            return Ok(());
        }
        let Some(checkpoint) = (progress.checkpoint)() else { return Ok(()) };
        let seconds = elapsed.as_secs_f64();
        self.due = Duration::from_secs_f64(seconds + seconds.clamp(KEPT[0], KEPT[1]));
        self.drapes = drapes;
        let text = plan::text(&checkpoint, &self.scene)?;
        self.folder.put_by(plan::RUNNING, &text.as_bytes())
    }
}

impl<'a> Search<'a> {
    /// A search that begins now, and ends by `interrupt` or after `time`. Someone at a terminal sees a bar, others a plain line
    /// a minute and one before a decision on standard error; nothing is shown if `quiet`.
    pub fn new(
        scene: &Scene,
        without_errors: bool,
        time: Option<Duration>,
        interrupt: &'a Interrupt,
        quiet: bool,
    ) -> Self {
        let (most, unit) = match scene.plan.method {
            PlanMethod::Path => (most_candidates(scene), "candidates"),
            PlanMethod::Stepwise => (scene.plan.steps, "steps"),
        };
        let errors = scene.errors.filter(|errors| errors.is_drawn() && !without_errors);
        let cells = errors.map_or(0, |errors| errors.samples);
        Search { cells, ..Self::counted(most, unit, time, interrupt, quiet) }
    }

    /// Watches work of at most `most` pieces, counted in a `unit`.
    pub fn counted(
        most: usize,
        unit: &'static str,
        time: Option<Duration>,
        interrupt: &'a Interrupt,
        quiet: bool,
    ) -> Self {
        let template = format!(
            "planning {{bar:40}} {{pos}} of at most {{len}} {unit}, {{elapsed}}\n{{wide_msg}}"
        );
        let bar = bar(most, &template, quiet);
        if !bar.is_hidden() {
            bar.enable_steady_tick(Duration::from_millis(500));
        }
        let lines = (!quiet && !io::stderr().is_terminal()).then(Lines::default);
        let began = Instant::now();
        let (ended, cells, kept) = (None, 0, None);
        Search { interrupt, time, began, ended, unit, cells, bar, lines, kept }
    }

    /// Writes the state of the search to a folder now and then.
    pub fn kept_in(self, folder: &'a Folder, scene: &Scene) -> Self {
        let due = Duration::from_secs_f64(KEPT[0]);
        let scene = SceneEcho::new(scene, None);
        Search { kept: Some(Kept { folder, scene, due, drapes: 0 }), ..self }
    }

    /// Shows how far the search is, and says whether it goes on. A plan that is being finished is let go on after the first
    /// request to end, not after the second, nor beyond the time of the interrupt.
    pub fn watch(&mut self, progress: &Progress) -> ControlFlow<()> {
        let elapsed = self.began.elapsed();
        self.show(progress, elapsed);
        if let Some(Err(fault)) = self.kept.as_mut().map(|kept| kept.put_by(progress, elapsed)) {
            // the search is no worse; what it finds is written where this disk lets it
            warn(&[format!("the state of the search is not kept: {fault}")]);
            self.kept = None;
        }
        let ended = if progress.finishing {
            let late = self.interrupt.is_late().then_some(Ended::TimeOver);
            // a drape is finished after the first signal, a sample is not, and no change is tried
            let signaled = match progress.sample.is_some() || progress.stage == TRYING {
                true => self.interrupt.is_signaled(),
                false => self.interrupt.is_signaled_again(),
            };
            if signaled { Some(Ended::Interrupted) } else { late }
        } else if self.interrupt.is_signaled() {
            Some(Ended::Interrupted)
        } else {
            self.time.filter(|time| elapsed >= *time).map(|_| Ended::TimeOver)
        };
        self.ended = ended.or(self.ended);
        match ended {
            Some(_) => ControlFlow::Break(()),
            None => ControlFlow::Continue(()),
        }
    }

    /// Takes the bar away. Returns the time that the search took, and why it was ended if it did not end by itself.
    pub fn finish(self) -> (Duration, Option<Ended>) {
        self.bar.finish_and_clear();
        (self.began.elapsed(), self.ended)
    }

    fn show(&mut self, progress: &Progress, elapsed: Duration) {
        if !self.bar.is_hidden() {
            self.bar.set_position(progress.candidates as u64);
            self.bar.set_message(state(progress, self.cells, true));
        }
        // a sample takes as long as many decisions
        let work = match progress.sample {
            Some(_) => Some(Duration::MAX),
            None => progress.forecast.map(|forecast| forecast.decision()),
        };
        if self.lines.as_mut().is_some_and(|lines| lines.is_due(elapsed, work)) {
            // where standard error cannot be written, the search is no worse
            let _ = writeln!(io::stderr(), "{}", line(progress, self.unit, self.cells, elapsed));
        }
    }
}

/// The plain lines of a search: one a minute, none within the first; and one before the first decision, and before each decision or sample
/// that takes longer than a minute.
#[derive(Debug, Default)]
struct Lines {
    minutes: u64,
    deciding: bool,
    decided: bool,
}

impl Lines {
    /// Whether the next line is due; `decision` is how long the decision under way takes.
    fn is_due(&mut self, elapsed: Duration, decision: Option<Duration>) -> bool {
        let minutes = elapsed.as_secs() / 60;
        let begins = decision.filter(|_| !self.deciding);
        let due = minutes > self.minutes
            || begins.is_some_and(|time| !self.decided || time > Duration::from_secs(60));
        self.minutes = minutes;
        self.deciding = decision.is_some();
        self.decided |= self.deciding;
        due
    }
}

/// The plain lines of work on several threads, on standard error where nobody sees a bar.
pub struct SharedLines {
    lines: Option<Mutex<Lines>>,
    began: Instant,
}

impl SharedLines {
    /// From now on.
    pub fn new(quiet: bool) -> Self {
        let lines = (!quiet && !io::stderr().is_terminal()).then(Mutex::default);
        SharedLines { lines, began: Instant::now() }
    }

    /// Prints the line of this minute, if it is due: the time, and what is being done.
    pub fn say(&self, what: impl FnOnce() -> String) {
        let elapsed = self.began.elapsed();
        let due = self.lines.as_ref().and_then(|lines| lines.try_lock().ok());
        if due.is_some_and(|mut lines| lines.is_due(elapsed, None)) {
            let minutes = time_text(Duration::from_secs(elapsed.as_secs() / 60 * 60));
            // where standard error cannot be written, the work is no worse
            let _ = writeln!(io::stderr(), "plydrape: {minutes}, {}", what());
        }
    }

    /// Prints a line about work that begins.
    pub fn begin(&self, what: &str) {
        if self.lines.is_some() {
            let _ = writeln!(io::stderr(), "plydrape: {what}");
        }
    }
}

/// A plain line about a search.
fn line(progress: &Progress, unit: &str, cells: usize, elapsed: Duration) -> String {
    let seconds = elapsed.as_secs();
    let shown = Duration::from_secs(if seconds < 60 { seconds } else { seconds / 60 * 60 });
    let Progress { candidates, most, .. } = progress;
    let state = state(progress, cells, false);
    format!("plydrape: {}, {candidates} {unit} of at most {most}, {state}", time_text(shown))
}

/// What is being done, and how good the best plan so far is.
fn state(progress: &Progress, cells: usize, at_terminal: bool) -> String {
    let again = match progress.sample {
        None if at_terminal && progress.finishing => " (Ctrl-C twice ends that too)",
        _ => "",
    };
    let step = match (progress.step, progress.sample) {
        (Some([done, of]), Some(_)) => Some(format!(", {done} of at most {of}")),
        (None, Some(cells)) => Some(format!(", at most {cells}")),
        (step, None) => step.map(|[done, of]| format!(", step {done} of {of}")),
    };
    let left = progress.left.filter(|_| progress.step.is_some());
    let takes = progress.forecast.map(|takes| match progress.sample {
        Some(cells) => format!(": {}", forecast::sample(&takes, left, cells)),
        None => format!(": {}", forecast::decision(&takes, left, cells)),
    });
    let [step, takes] = [step, takes].map(Option::unwrap_or_default);
    let done = format!("{}{step}{again}{takes}", progress.stage);
    let decided = match (progress.decided, progress.decisions) {
        (false, _) => ", by its ranking".into(),
        (true, 1) => String::new(),
        (true, decisions) => format!(" of {decisions} decided on"),
    };
    let best = match (table::limiting(progress.best), table::closest(progress.best)) {
        _ if progress.best.is_empty() => return done,
        (Some(worst), _) => table::measure_text(worst),
        (None, _) if !progress.accepted => "all limits are kept".into(),
        // a sample of them judges
        (None, _) if cells > 0 => "all limits are kept without errors".into(),
        (None, Some(closest)) => format!("accepted, {}", table::measure_text(closest)),
        (None, None) => "accepted".into(),
    };
    format!("{done}; best so far{decided}: {best}")
}

/// A time in hours, minutes and seconds, without what is zero.
pub fn time_text(time: Duration) -> String {
    let (minutes, hours) = (time.as_secs() / 60 % 60, time.as_secs() / 3600);
    let seconds = time.as_secs_f64() - (time.as_secs() / 60 * 60) as f64;
    let mut parts = Vec::new();
    if hours > 0 {
        parts.push(format!("{hours} h"));
    }
    if minutes > 0 {
        parts.push(format!("{minutes} min"));
    }
    if seconds > 0.0 || parts.is_empty() {
        parts.push(format!("{} s", crate::numbers::short(seconds)));
    }
    parts.join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use plydrape::measure::{Name, Verdict, Worst};
    use plydrape::outcome::Forecast;

    fn seconds(seconds: u64) -> Duration {
        Duration::from_secs(seconds)
    }

    fn height(value: f64) -> Verdict {
        Verdict::new(Name::Height, Worst { value, at: String::new(), place: None }, 0.5, Some(30))
    }

    fn progress(best: &[Verdict], accepted: bool) -> Progress<'_> {
        Progress {
            candidates: 34,
            most: 60,
            decisions: 3,
            finishing: false,
            stage: "deciding",
            forecast: None,
            sample: None,
            step: None,
            left: None,
            best,
            decided: true,
            accepted,
            checkpoint: &|| None,
        }
    }

    /// Reports may come seldom: a minute without one has no line.
    #[test]
    fn a_line_is_due_once_a_minute_and_not_in_the_first() {
        let mut lines = Lines::default();
        let due =
            [0, 59, 60, 61, 119, 120, 121, 290, 299, 300].map(|s| lines.is_due(seconds(s), None));
        assert_eq!(due, [false, false, true, false, false, true, false, true, false, true]);
    }

    /// Within the first minute too, before what is decided first; later ones only where they take long.
    #[test]
    fn a_line_is_due_before_the_first_decision_and_before_long_ones() {
        let mut lines = Lines::default();
        let mut due = |decision: Option<u64>| lines.is_due(seconds(30), decision.map(seconds));
        let decisions = [None, Some(2), Some(2), None, Some(3), None, Some(61), Some(61)];
        let shown = decisions.map(&mut due);
        assert_eq!(shown, [false, true, false, false, false, false, true, false]);
    }

    #[test]
    fn a_line_says_how_long_the_decision_takes() {
        let forecast =
            Forecast { nodes: 961, drape: seconds(30), cells: 0, cell: 1.25, threads: 2 };
        let deciding = Progress { forecast: Some(forecast), decisions: 0, ..progress(&[], false) };
        let shown = line(&deciding, "candidates", 0, seconds(9));
        assert_eq!(
            shown,
            "plydrape: 9 s, 34 candidates of at most 60, deciding: 961 nodes, about 40 s"
        );
        let shown = line(&deciding, "candidates", 64, seconds(9));
        assert!(shown.ends_with(", then at most 64 cells with errors, about 20 min"), "{shown}");
        let sampled = Progress { sample: Some(64), decisions: 1, ..deciding };
        let shown = line(&sampled, "candidates", 64, seconds(21));
        assert!(shown.ends_with("deciding, at most 64: about 20 min"), "{shown}");
        let half = Progress {
            step: Some([30, 64]),
            left: Some(Duration::from_secs(600)),
            sample: Some(64),
            ..deciding
        };
        let shown = line(&half, "candidates", 64, seconds(21));
        assert!(shown.ends_with("deciding, 30 of at most 64: about 10 min left"), "{shown}");
        let under_way =
            Progress { step: Some([34, 90]), left: Some(Duration::from_secs(25)), ..deciding };
        let shown = line(&under_way, "candidates", 0, seconds(24));
        assert!(
            shown.ends_with(", deciding, step 34 of 90: 961 nodes, about 25 s left"),
            "{shown}"
        );
    }

    #[test]
    fn a_line_says_what_is_done_and_which_limit_is_exceeded() {
        let best = [height(0.7)];
        let shown = line(&progress(&best, false), "candidates", 0, seconds(125));
        let wanted = "plydrape: 2 min, 34 candidates of at most 60, deciding; \
                      best so far of 3 decided on: height 0.7 mm against 0.5 mm";
        assert_eq!(shown, wanted);
        let ranked = Progress { decided: false, decisions: 0, ..progress(&best, false) };
        let shown = line(&ranked, "candidates", 0, seconds(125));
        assert!(shown.ends_with("; best so far, by its ranking: height 0.7 mm against 0.5 mm"));
        let nothing = line(&progress(&[], false), "steps", 0, seconds(3700));
        assert_eq!(nothing, "plydrape: 1 h 1 min, 34 steps of at most 60, deciding");
    }

    /// What is improved where all limits are kept: the one that is nearest to not being kept.
    #[test]
    fn a_plan_is_called_accepted_only_once_it_was_decided_on() {
        let best = [height(0.4)];
        let shown = line(&progress(&best, true), "candidates", 0, seconds(60));
        assert!(shown.ends_with(": accepted, height 0.4 mm against 0.5 mm"), "{shown}");
        let shown = line(&progress(&best, true), "candidates", 64, seconds(60));
        assert!(shown.ends_with(": all limits are kept without errors"), "{shown}");
        let ranked = Progress { decided: false, ..progress(&best, false) };
        let shown = line(&ranked, "candidates", 0, seconds(60));
        assert!(shown.ends_with(", by its ranking: all limits are kept"), "{shown}");
    }

    #[test]
    fn times_are_shown_without_what_is_zero() {
        let shown = [0.0, 0.5, 90.0, 300.0, 3600.0, 5430.0].map(Duration::from_secs_f64);
        let wanted = ["0 s", "0.5 s", "1 min 30 s", "5 min", "1 h", "1 h 30 min 30 s"];
        assert_eq!(shown.map(time_text), wanted);
    }
}
