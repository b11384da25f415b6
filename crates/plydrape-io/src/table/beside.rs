//! What the model that does not decide says, if it was asked.

use super::{WIDTH, limits, model_name, steps};
use crate::result::{Also, ResultFile};
use crate::sheet::ended;
use crate::shown;
use plydrape::measure::Name;

/// What is said of it in one line.
const NAMES: [Name; 4] = [Name::Shear, Name::Strain, Name::Tilt, Name::GripperLoad];

/// One line; empty where it was not asked.
pub(super) fn line(result: &ResultFile) -> String {
    let Some(Also { summary, .. }) = &result.also else { return String::new() };
    let said = ended(summary).unwrap_or_else(|| limits::values(&summary.limits, &NAMES));
    let text = format!("{} beside, judging nothing: {said}", model_name(summary.model));
    shown::excerpt(&text, WIDTH) + "\n"
}

/// Its steps and its values beside the limits of the scene; empty where it was not asked.
pub(super) fn details(result: &ResultFile) -> String {
    let Some(Also { summary, steps }) = &result.also else { return String::new() };
    let values = summary.limits.iter().map(|own| {
        let value = limits::values(&summary.limits, &[own.name]);
        shown::excerpt(&format!("  {value} in step {}, {}", own.step.unwrap_or(0), own.at), WIDTH)
            + "\n"
    });
    format!(
        "{} beside, judging nothing:\n{}{}",
        model_name(summary.model),
        steps::short(summary, steps),
        values.collect::<String>()
    )
}
