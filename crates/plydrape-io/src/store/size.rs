//! How much memory work will take, estimated before it is begun, against a budget that a user can raise.
//!
//! Estimates are of the right order, not exact: they shall keep a small file from filling the memory of a machine. The bytes of
//! each kind of work were measured as the largest resident size of a release build, divided by the number of parts.

use crate::{Error, error};
use plydrape::ply::Ply;
use plydrape::scene::{PlanMethod, PlanSettings};
use std::env;

/// Environment variable that holds another budget, as in `16 GB`.
pub const VARIABLE: &str = "PLYDRAPE_MEMORY";

/// Budget (bytes) unless [`VARIABLE`] says another.
pub const BUDGET: f64 = 4e9;

/// Units of a budget (bytes).
const UNITS: [(&str, f64); 8] = [
    ("kB", 1e3),
    ("MB", 1e6),
    ("GB", 1e9),
    ("TB", 1e12),
    ("KiB", 1024.0),
    ("MiB", 1_048_576.0),
    ("GiB", 1_073_741_824.0),
    ("TiB", 1_099_511_627_776.0),
];

/// Memory that a catenary of a step of a result takes (bytes), in memory and while its files are made.
const CATENARY: f64 = 5e3;
/// Memory that a gripper of a step takes (bytes).
const GRIPPER: f64 = 1e3;
/// Memory that a node of a sheet takes while it is draped (bytes). The factors of the stiffness matrix take 3 to 10 kB of it,
/// from 120 to 160 000 nodes.
const NODE: f64 = 4e4;
/// Memory that a node of a state of a sheet takes (bytes).
const STATE: f64 = 60.0;
/// Memory that a plan takes, as a multiple of that of a drape with its steps.
const PLAN: f64 = 2.0;
/// Memory that a gripper takes in the program of a step of the stepwise planner (bytes): derivatives, matrices and factors;
/// 57 kB with 60 × 60 grippers.
const PROGRAM: f64 = 1e5;
/// Memory that a derivative of a catenary to a coordinate takes (bytes): those of force, slopes, run, rise and length, as
/// rows and as arrays.
const DERIVATIVE: f64 = 200.0;
/// Memory that a triangle of a mold takes while a mesh is built (bytes).
const TRIANGLE: f64 = 500.0;
/// Memory per byte of a result file that is read and made into something else.
const RESULT: f64 = 10.0;

/// A size as a user writes it, in bytes.
fn parse(text: &str) -> Option<f64> {
    let text = text.trim();
    let digits = text.find(|c: char| !(c.is_ascii_digit() || c == '.')).unwrap_or(text.len());
    let (number, unit) = (text[..digits].parse::<f64>().ok()?, text[digits..].trim());
    let size = match unit {
        "" | "B" => 1.0,
        unit => UNITS.iter().find(|(name, _)| name.eq_ignore_ascii_case(unit))?.1,
    };
    Some(number * size).filter(|bytes| *bytes > 0.0 && bytes.is_finite())
}

/// The budget (bytes).
///
/// # Errors
/// [`Error::NotPossible`] if [`VARIABLE`] is set and no size.
pub fn budget() -> Result<f64, Error> {
    match env::var_os(VARIABLE).filter(|text| !text.is_empty()) {
        None => Ok(BUDGET),
        Some(text) => {
            let text = text.to_string_lossy();
            parse(&text).ok_or_else(|| {
                Error::not_possible(
                    format!(
                        "the environment variable {VARIABLE} is {text:?}, which is no size above 0"
                    ),
                    "write a number and a unit, as in PLYDRAPE_MEMORY=\"16 GB\"",
                )
            })
        }
    }
}

/// Refuses work that would take this many bytes, if that is beyond the budget; `what` names it with its numbers.
///
/// # Errors
/// [`Error::TooLarge`] if it would, and as [`budget`].
pub fn check(estimate: f64, what: impl FnOnce() -> String) -> Result<(), Error> {
    let budget = budget()?;
    if estimate <= budget {
        return Ok(());
    }
    Err(Error::TooLarge { what: what(), estimate, budget })
}

/// Refuses a drape whose result would be too large.
///
/// # Errors
/// As [`check`].
pub fn drape(ply: &Ply, count: usize) -> Result<(), Error> {
    check(steps_bytes(ply, count), || steps_in_words("the result", ply, count))
}

/// The sheets of a plan.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlanSheets {
    /// Nodes of the sheet that decides.
    pub nodes: f64,
    /// Nodes of a sheet that ranks candidates; there is one on each core.
    pub coarse_nodes: f64,
    /// States that the one that decides keeps.
    pub keep: usize,
}

/// Refuses a plan that would be too large: the drapes that are tried, the program of a step, and the sheets where that is
/// the model.
///
/// # Errors
/// As [`check`].
pub fn plan(ply: &Ply, plan: &PlanSettings, sheets: Option<PlanSheets>) -> Result<(), Error> {
    let cores = std::thread::available_parallelism().map_or(1, usize::from) as f64;
    // a search of paths ranks candidates on all cores, the stepwise planner solves programs
    let (program, coarse_sheets) = match plan.method {
        PlanMethod::Path => (0.0, cores),
        PlanMethod::Stepwise => (PROGRAM * ply.grippers() as f64, 0.0),
    };
    let all_sheets = sheets.map_or(0.0, |PlanSheets { nodes, coarse_nodes, keep }| {
        sheet_bytes(nodes, keep.min(plan.steps)) + coarse_sheets * sheet_bytes(coarse_nodes, 0)
    });
    check(PLAN * steps_bytes(ply, plan.steps) + program + all_sheets, || {
        let steps = steps_in_words("a plan", ply, plan.steps);
        match sheets {
            Some(PlanSheets { nodes, .. }) => format!("{steps}, and a sheet of {nodes:.0} nodes,"),
            None => steps,
        }
    })
}

/// Refuses derivatives of all catenaries to all coordinates of the grippers, as one array.
///
/// # Errors
/// As [`check`].
pub fn derivatives(ply: &Ply) -> Result<(), Error> {
    let grippers = ply.grippers();
    let (rows, columns) = (ply.lines().catenaries(), 3 * grippers);
    check(DERIVATIVE * rows as f64 * columns as f64, || {
        format!("derivatives of {rows} catenaries to {columns} coordinates of {grippers} grippers")
    })
}

/// Memory that the steps of a result take (bytes).
fn steps_bytes(ply: &Ply, steps: usize) -> f64 {
    let (grippers, catenaries) = (ply.grippers() as f64, ply.lines().catenaries() as f64);
    (GRIPPER * grippers + CATENARY * catenaries) * steps as f64
}

fn steps_in_words(what: &str, ply: &Ply, steps: usize) -> String {
    let (grippers, catenaries) = (ply.grippers(), ply.lines().catenaries());
    let steps = match steps {
        1 => "a single step".to_owned(),
        steps => format!("{steps} steps"),
    };
    format!("{what} of {steps} with {grippers} grippers and {catenaries} catenaries")
}

/// Refuses a sheet of this many nodes whose drape keeps this many states.
///
/// # Errors
/// As [`check`].
pub fn sheet(nodes: f64, states: usize) -> Result<(), Error> {
    check(sheet_bytes(nodes, states), || {
        format!("a sheet of {nodes:.0} nodes that keeps {states} states")
    })
}

/// Memory that the drape of a sheet of this many nodes takes, which keeps this many states (bytes).
#[must_use]
pub fn sheet_bytes(nodes: f64, states: usize) -> f64 {
    (NODE + STATE * states as f64) * nodes
}

/// Refuses a mesh of this many triangles.
///
/// # Errors
/// As [`check`].
pub fn mesh(triangles: f64) -> Result<(), Error> {
    check(TRIANGLE * triangles, || format!("a mesh of {triangles:.0} triangles"))
}

/// Refuses a result file of this many bytes.
///
/// # Errors
/// As [`check`].
pub fn result(bytes: u64) -> Result<(), Error> {
    check(RESULT * bytes as f64, || format!("a result file of {}", error::bytes(bytes as f64)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By the meaning of the units.
    #[test]
    fn a_budget_is_a_number_with_a_unit() {
        for (text, bytes) in [
            ("16 GB", 16e9),
            ("16gb", 16e9),
            ("1.5 TB", 1.5e12),
            ("2 GiB", 2_147_483_648.0),
            ("4000000", 4e6),
            (" 5 B ", 5.0),
        ] {
            assert_eq!(parse(text), Some(bytes), "{text}");
        }
        for text in ["", "GB", "-1 GB", "0 GB", "16 parsecs", "1e9", "nan", "1..5 GB", "inf"] {
            assert_eq!(parse(text), None, "{text}");
        }
    }

    /// The message says what, how much, how much is allowed and how to allow more.
    #[test]
    fn what_is_too_large_is_refused_with_its_estimate_and_a_remedy() {
        assert!(check(BUDGET, || unreachable!()).is_ok());
        let refused = check(2.5 * BUDGET, || "a heap".into()).unwrap_err();
        assert_eq!(
            refused.to_string(),
            "a heap would take about 10 GB of memory; 4.0 GB are allowed"
        );
        assert!(refused.help().contains("PLYDRAPE_MEMORY=\"16 GB\""));
    }
}
