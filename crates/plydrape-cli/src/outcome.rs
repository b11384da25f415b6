//! How a drape came out: what `--json` prints of it, and the exit code.

use plydrape::outcome::{Status, Summary, Unjudged};
use plydrape_io::ResultFile;
use plydrape_io::store::shown;
use serde::Serialize;
use std::borrow::Cow;
use std::io::{self, Write};
use std::process::ExitCode;
use std::time::Duration;

/// Prints what is possible but hardly meant to standard error, each in a line.
pub fn warn(warnings: &[String]) {
    for warning in warnings {
        // standard error that cannot be written is no fault of the scene
        let _ = writeln!(io::stderr(), "warning: {}", shown::escaped(warning));
    }
}

/// What `--json` prints of a drape: the summary of the model that decides, `accepted` in front, how long that model took, and the summary
/// of the other one if it was asked.
#[derive(Serialize)]
pub struct Printed<'a> {
    #[serde(flatten)]
    summary: &'a Summary,
    time_s: f64,
    /// Of catenaries.
    #[serde(skip_serializing_if = "Option::is_none")]
    mean_equilibrium_us: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    also: Option<Unjudged<'a>>,
}

impl<'a> Printed<'a> {
    /// Of a finished drape whose model took a time.
    pub fn new(result: &'a ResultFile, took: Duration) -> Self {
        let summary = &result.summary;
        let mean = |equilibria: usize| took.as_secs_f64() * 1e6 / equilibria.max(1) as f64;
        Printed {
            summary,
            time_s: took.as_secs_f64(),
            mean_equilibrium_us: summary.catenaries.as_ref().map(|report| mean(report.equilibria)),
            also: result.also.as_ref().map(|also| Unjudged(Cow::Borrowed(&also.summary))),
        }
    }
}

/// Whether the drape that decides has a step without a solution, or no rest at its end.
pub fn is_unsolved(result: &ResultFile) -> bool {
    let unsolved = matches!(result.summary.status, Status::NotSolved | Status::NotAtRest);
    unsolved || result.steps.iter().any(|step| !step.is_solved())
}

/// The exit code of a drape, `interrupted` or not.
pub fn exit_code(result: &ResultFile, interrupted: bool) -> ExitCode {
    let interrupted = interrupted || result.summary.interrupted();
    code(interrupted, is_unsolved(result), result.summary.accepted())
}

/// The exit code of one or more drapes: whether they were interrupted, whether one has no solution, whether all are accepted.
pub fn code(interrupted: bool, unsolved: bool, accepted: bool) -> ExitCode {
    match (interrupted, unsolved, accepted) {
        (true, _, _) => ExitCode::from(130),
        (_, true, _) => ExitCode::from(3),
        (_, _, true) => ExitCode::SUCCESS,
        (_, _, false) => ExitCode::from(1),
    }
}
