//! The drapes with errors behind a finished drape, under someone's eyes.

use crate::search::SharedLines;
use crate::watch::{Interrupt, bar};
use indicatif::ProgressBar;
use plydrape::outcome::{Effort, Robustness, Watch};
use plydrape_io::ResultFile;
use plydrape_io::text::forecast;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

/// Judges a result with errors, on all cores, until somebody breaks it off; the drape without errors took a time. Someone at a terminal sees a bar, others a plain
/// line before it begins and one a minute on standard error; nothing is shown if `quiet`. Returns whether it was done to its end.
pub fn judge(
    result: &mut ResultFile,
    robustness: &Robustness,
    drape: Duration,
    interrupt: &Interrupt,
    quiet: bool,
) -> bool {
    // a planner has judged its plan by the sample, or was broken off
    let summary = &result.summary;
    let open = summary.sample.is_none() && !summary.interrupted();
    let sampled = robustness.sampled().filter(|_| open);
    let samples = sampled.map_or(0, |errors| errors.samples);
    let template =
        "draping {pos} of at most {len} cells with errors{msg} {bar:40} at most {eta} left";
    let eyes = Eyes::new(interrupt, bar(samples, template, quiet), samples, quiet);
    if let Some(report) = result.summary.sheet.as_ref().filter(|_| samples > 0) {
        let effort = Effort { nodes: report.nodes, solves: report.solves, time: drape };
        let forecast = robustness.forecast(effort);
        let takes = forecast::sample(&forecast, None, samples);
        eyes.bar.set_message(format!(", {takes}"));
        eyes.lines.begin(&format!("draping at most {samples} cells with errors, {takes}"));
    }
    if !eyes.judge_by(|watch| robustness.judge_sample(&mut result.summary, watch)) {
        return false;
    }
    let template = "looking for what it tolerates, {elapsed}";
    let eyes = Eyes::new(interrupt, bar(0, template, quiet), 0, quiet);
    eyes.judge_by(|watch| robustness.judge_tolerance(&mut result.summary, watch))
}

/// What is printed below a verdict after which somebody broke off; a drape that was broken off says so itself.
pub fn left_out(result: &ResultFile, broken_off: bool, interrupt: &Interrupt) -> &'static str {
    match (broken_off && !result.summary.interrupted(), interrupt.is_signaled()) {
        (false, _) => "",
        (true, true) => {
            "interrupted after the verdict was found: what comes after it is left out\n"
        }
        (true, false) => {
            "the time was over after the verdict was found: what comes after it is left out\n"
        }
    }
}

/// Who looks on.
struct Eyes<'a> {
    interrupt: &'a Interrupt,
    bar: ProgressBar,
    lines: SharedLines,
    done: AtomicUsize,
    /// Drapes at most; 0 where nobody knows.
    most: usize,
}

impl<'a> Eyes<'a> {
    fn new(interrupt: &'a Interrupt, bar: ProgressBar, most: usize, quiet: bool) -> Self {
        if !bar.is_hidden() {
            bar.enable_steady_tick(Duration::from_millis(500));
        }
        Eyes { interrupt, bar, lines: SharedLines::new(quiet), done: AtomicUsize::new(0), most }
    }

    /// What the drapes ask and tell.
    fn judge_by<T>(&self, judge: impl FnOnce(&Watch) -> T) -> T {
        let stop = || {
            self.line();
            self.interrupt.asked().is_break()
        };
        let done = |done: usize, _: usize| {
            self.done.store(done, Ordering::Relaxed);
            self.bar.set_position(done as u64);
        };
        let found = judge(&Watch { stop: &stop, done: &done });
        self.bar.finish_and_clear();
        found
    }

    /// Prints the line of this minute, if it is due.
    fn line(&self) {
        let done = self.done.load(Ordering::Relaxed);
        self.lines.say(|| match self.most {
            0 => "looking for what it tolerates".into(),
            most => format!("draping {done} of at most {most} cells with errors"),
        });
    }
}
