//! What the model that does not decide says, if it was asked.

use super::{WIDTH, model_name, significant, steps, unit};
use crate::result::sheet::ended;
use crate::result::{Also, ResultFile};
use crate::store::shown;
use plydrape::measure::Name;
use plydrape::outcome::Summary;

/// What is said of it in one line.
const NAMES: [Name; 4] = [Name::Shear, Name::Strain, Name::Tilt, Name::GripperLoad];

/// One line; empty where it was not asked.
pub(super) fn line(result: &ResultFile) -> String {
    let Some(Also { summary, .. }) = &result.also else { return String::new() };
    let said = ended(summary).unwrap_or_else(|| values(summary, &NAMES));
    let text = format!("{} beside, judging nothing: {said}", model_name(summary.model));
    shown::excerpt(&text, WIDTH) + "\n"
}

/// Steps and worst values; empty where it was not asked.
pub(super) fn details(result: &ResultFile) -> String {
    let Some(Also { summary, steps }) = &result.also else { return String::new() };
    let worst = summary.worst.iter().map(|(name, _)| format!("  {}\n", values(summary, &[name])));
    format!(
        "{} beside, judging nothing:\n{}{}",
        model_name(summary.model),
        steps::short(summary, steps),
        worst.collect::<String>()
    )
}

/// The worst values of some measures.
fn values(summary: &Summary, names: &[Name]) -> String {
    let value = |name: &Name| {
        let own = name.measure().unit();
        let value = significant(summary.worst.value(*name)? * own.factor);
        Some(format!("{} {value}{}", name.title(), unit(own.shown)))
    };
    names.iter().filter_map(value).collect::<Vec<_>>().join(", ")
}
