//! Limits as the page lists them: the closest first, in the words and units of their measures.

use crate::text::table::{closest_first, slack_in_words};
use plydrape::measure::{Name, Scope, Verdict};
use plydrape::outcome::Summary;
use serde::Serialize;

/// Ratio of a limit that is exceeded beyond measure.
const MOST_RATIO: f64 = 1e9;

/// A limit and how it was kept.
#[derive(Serialize)]
pub(super) struct Limit<'a> {
    /// Key of its measure.
    pub key: &'static str,
    name: String,
    /// The value in other units, where it is slack.
    note: Option<String>,
    value: f64,
    pub limit: f64,
    pub unit: &'a str,
    least: bool,
    ok: bool,
    /// The value as a multiple of its limit: beyond 1 it is exceeded.
    pub ratio: f64,
    /// Whether it is about the motion as a whole, and not about the ply of a step.
    motion: bool,
    step: Option<usize>,
    #[serde(rename = "where")]
    at: &'a str,
    place: Option<[f64; 3]>,
}

impl<'a> From<&'a Verdict> for Limit<'a> {
    fn from(verdict: &'a Verdict) -> Self {
        let measure = verdict.name.measure();
        Limit {
            key: measure.key(),
            name: match verdict.judged {
                true => verdict.name.title(),
                false => format!("{}, not judged", verdict.name.title()),
            },
            note: None,
            value: verdict.value,
            limit: verdict.limit,
            unit: &verdict.unit,
            least: verdict.is_least(),
            ok: verdict.ok,
            ratio: verdict.ratio().min(MOST_RATIO),
            motion: matches!(measure.scope(), Scope::Time | Scope::Motion | Scope::Whole),
            step: verdict.step,
            at: &verdict.at,
            place: verdict.place,
        }
    }
}

/// Every limit of an outcome, the closest first.
pub(super) fn limits(summary: &Summary) -> Vec<Limit<'_>> {
    let limits = closest_first(&summary.limits).into_iter().map(|verdict| {
        let note = (verdict.name == Name::SlackRatio).then(|| slack_in_words(summary));
        Limit { note: note.flatten(), ..verdict.into() }
    });
    limits.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample;
    use plydrape::measure::Worst;

    fn verdict(name: Name, value: f64, limit: f64) -> Verdict {
        Verdict::new(name, Worst { value, at: String::new(), place: None }, limit, None)
    }

    /// Of 39° of 40°, 6 N of 10 N, a distance of 60 mm where 50 mm is the least, and 0.6 % of 0.5 %, the last is exceeded and comes first.
    #[test]
    fn the_closest_limit_comes_first() {
        let mut summary = sample::draped(4, 2, 3).summary;
        summary.limits = vec![
            verdict(Name::GripperLoad, 6.0, 10.0),
            verdict(Name::Tilt, 39.0, 40.0),
            verdict(Name::GripperDistance, 60.0, 50.0),
            verdict(Name::Strain, 0.006, 0.005),
        ];
        let keys: Vec<&str> = limits(&summary).iter().map(|limit| limit.key).collect();
        let expected = [Name::Strain, Name::Tilt, Name::GripperDistance, Name::GripperLoad];
        assert_eq!(keys, expected.map(|name| name.measure().key()));
        assert!(limits(&summary).is_sorted_by(|a, b| a.ratio >= b.ratio));
    }
}
