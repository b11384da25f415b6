//! The drapes with errors behind a finished drape, under someone's eyes.

use crate::search::SharedLines;
use crate::watch::{Interrupt, bar};
use indicatif::ProgressBar;
use plydrape::outcome::{Robustness, Watch};
use plydrape_io::ResultFile;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

/// Which of the drapes with errors somebody broke off.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BrokenOff {
    /// Those of the sample.
    Sample,
    /// Those by which the errors that it tolerates are found.
    Tolerance,
}

impl BrokenOff {
    /// What is printed below the verdict.
    pub fn text(self) -> &'static str {
        match self {
            BrokenOff::Sample => "interrupted before the cells with errors were draped\n",
            BrokenOff::Tolerance => "interrupted before it was known which errors it tolerates\n",
        }
    }
}

/// Judges a result with errors, on all cores, until somebody breaks it off. Someone at a terminal sees a bar, others a plain
/// line a minute on standard error; nothing is shown if `quiet`.
pub fn judge(
    result: &mut ResultFile,
    robustness: &Robustness,
    interrupt: &Interrupt,
    quiet: bool,
) -> Option<BrokenOff> {
    let samples = robustness.sampled().map_or(0, |errors| errors.samples);
    let template = "draping {pos} of {len} cells with errors {bar:40} {eta} left";
    let eyes = Eyes::new(interrupt, bar(samples, template, quiet), samples, quiet);
    if !eyes.judge_by(|watch| robustness.judge_sample(&mut result.summary, watch)) {
        return Some(BrokenOff::Sample);
    }
    let template = "looking for the errors that it tolerates, {elapsed}";
    let eyes = Eyes::new(interrupt, bar(0, template, quiet), 0, quiet);
    let found = eyes.judge_by(|watch| robustness.judge_stands(&mut result.summary, watch));
    (!found).then_some(BrokenOff::Tolerance)
}

/// Who looks on.
struct Eyes<'a> {
    interrupt: &'a Interrupt,
    bar: ProgressBar,
    lines: SharedLines,
    done: AtomicUsize,
    /// Drapes in all; 0 where nobody knows.
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
            0 => "looking for the errors that it tolerates".into(),
            most => format!("draping {done} of {most} cells with errors"),
        });
    }
}
