//! How a drape came out: what `--json` prints of it, and the exit code.

use plydrape::draping::record::Summary;
use plydrape::sheet;
use plydrape_io::ResultFile;
use serde::Serialize;
use std::process::ExitCode;
use std::time::Duration;

/// What `--json` prints of a drape: the summary of the result file, how long an equilibrium took, and the summary of the
/// sheet with the time that it took.
#[derive(Serialize)]
pub struct Printed<'a> {
    #[serde(flatten)]
    summary: Summary,
    mean_equilibrium_us: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    sheet: Option<PrintedSheet<'a>>,
}

/// What it prints of the sheet.
#[derive(Serialize)]
struct PrintedSheet<'a> {
    #[serde(flatten)]
    summary: &'a sheet::measure::Summary,
    time_s: f64,
}

impl<'a> Printed<'a> {
    /// Of a finished drape, whose equilibria took `solving` and whose sheet, if any, took `sheet`.
    pub fn of(result: &'a ResultFile, solving: Duration, sheet: Option<Duration>) -> Self {
        let summary = Summary { sheet: None, ..result.summary.clone() };
        let mean_equilibrium_us = solving.as_secs_f64() * 1e6 / summary.equilibria.max(1) as f64;
        let sheet = result.summary.sheet.as_ref().zip(sheet);
        let sheet =
            sheet.map(|(summary, took)| PrintedSheet { summary, time_s: took.as_secs_f64() });
        Printed { summary, mean_equilibrium_us, sheet }
    }
}

/// Whether a drape has a step without a solution.
pub fn is_unsolved(result: &ResultFile) -> bool {
    match &result.summary.sheet {
        Some(sheet) => !sheet.converged,
        None => result.steps.iter().any(|step| !step.solver.found()),
    }
}

/// The exit code of a drape, `interrupted` or not.
pub fn exit_code(result: &ResultFile, interrupted: bool) -> ExitCode {
    code(interrupted, is_unsolved(result), result.summary.accepted)
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
