//! How a motion is planned.

use super::file::{MethodKey, PlanTable};
use super::located::{Count, Located, Seed, Whole};
use super::quantity::{read_given, read_or};
use super::source::Document;
use crate::Error;
use plydrape::motion::MOST_POSITIONS;
use plydrape::scene::{PlanMethod, PlanSettings};

/// Most steps of a plan: each is solved in every drape that the search tries.
const MOST_STEPS: usize = 10_000;
/// Most candidates that a search may drape.
const MOST_EVALUATIONS: usize = 1_000_000;

/// Checks the table `[plan]` of a scene with a number of grippers, whose pads give or not.
pub(super) fn plan(
    table: &PlanTable,
    grippers: usize,
    gives: bool,
    document: &Document,
) -> Result<PlanSettings, Error> {
    // the more grippers, the fewer steps a plan may have
    let default = PlanSettings::default();
    let most_steps = MOST_STEPS.min(MOST_POSITIONS / grippers);
    Ok(PlanSettings {
        method: match table.method {
            Some(MethodKey::Path) => PlanMethod::Path,
            Some(MethodKey::Stepwise) => PlanMethod::Stepwise,
            None => default.method,
        },
        steps: match &table.steps {
            Some(steps) => count(steps, [2, most_steps], "steps", document)?,
            None => default.steps.min(most_steps),
        },
        move_limit: read_given(&table.move_limit, document)?,
        seed: match &table.seed {
            Some(seed) => number(seed, document)?,
            None => default.seed,
        },
        // a search on mounts that give has a number of drapes of its own
        evaluations: match &table.evaluations {
            Some(most) => count(most, [1, MOST_EVALUATIONS], "drapes", document)?,
            None if gives => PlanSettings::evaluations_on_mounts(grippers),
            None => default.evaluations,
        },
        improve: table.improve.unwrap_or(default.improve),
        rate: read_or(&table.rate, default.rate, document)?,
    })
}

/// A count within bounds.
fn count(
    written: &Located<Count>,
    [least, most]: [usize; 2],
    what: &str,
    document: &Document,
) -> Result<usize, Error> {
    let Whole(value) = written.value;
    if let Ok(value) = usize::try_from(value)
        && (least..=most).contains(&value)
    {
        return Ok(value);
    }
    let fault = match value {
        1 => format!("1 {} is too few for a plan", what.trim_end_matches('s')),
        _ if value < 1 => format!("{value} {what} are too few for a plan"),
        _ => format!("{value} {what} are too many for a plan"),
    };
    let help = match what {
        "steps" => format!(
            "{least} to {most} steps are possible: step 1 is the start, the last one the target"
        ),
        _ => format!("{least} to {most} {what} are possible"),
    };
    Err(document.error(written.span.clone(), fault, help))
}

/// The seed of a search or of a sample.
pub(super) fn number(seed: &Located<Seed>, document: &Document) -> Result<u64, Error> {
    let Whole(value) = seed.value;
    u64::try_from(value).map_err(|_| {
        document.error(
            seed.span.clone(),
            format!("the seed {value} is negative"),
            "expected a whole number of zero or more, e.g. 0",
        )
    })
}
