//! How a drape came out: what `--json` prints of it, and the exit code.

use plydrape::draping::record::Summary;
use plydrape_io::ResultFile;
use serde::Serialize;
use std::process::ExitCode;
use std::time::Duration;

/// What `--json` prints of a drape: the summary of the result file, and how long an equilibrium took.
#[derive(Serialize)]
pub struct Printed<'a> {
    #[serde(flatten)]
    summary: &'a Summary,
    mean_equilibrium_us: f64,
}

impl<'a> Printed<'a> {
    /// Of a finished drape, whose equilibria took `solving`.
    pub fn of(result: &'a ResultFile, solving: Duration) -> Self {
        let summary = &result.summary;
        let mean_equilibrium_us = solving.as_secs_f64() * 1e6 / summary.equilibria.max(1) as f64;
        Printed { summary, mean_equilibrium_us }
    }
}

/// The exit code of a drape, `interrupted` or not.
pub fn exit_code(result: &ResultFile, interrupted: bool) -> ExitCode {
    let unsolved = result.steps.iter().any(|step| !step.solver.found());
    match (interrupted, unsolved, result.summary.accepted) {
        (true, _, _) => ExitCode::from(130),
        (_, true, _) => ExitCode::from(3),
        (_, _, true) => ExitCode::SUCCESS,
        (_, _, false) => ExitCode::from(1),
    }
}
