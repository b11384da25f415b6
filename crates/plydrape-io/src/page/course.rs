//! Measures over the steps: what the charts draw. Which there are, their words and their units are those of the measures.

use crate::text::table::closest_first;
use plydrape::measure::{Name, Sense, Unit, Verdict, Worst};
use plydrape::outcome::Step;
use serde::Serialize;

/// A measure over the steps of the page.
#[derive(Serialize)]
pub(super) struct MeasureCourse<'a> {
    pub key: &'static str,
    label: &'static str,
    pub unit: &'static str,
    pub values: Vec<Option<f64>>,
    #[serde(rename = "where")]
    at: Vec<Option<&'a str>>,
    places: Vec<Option<[f64; 3]>>,
    pub limit: Option<f64>,
    least: bool,
}

impl<'a> MeasureCourse<'a> {
    /// A measure over `count` steps, of which a model has done `steps`, the first ones.
    fn new(name: Name, steps: &[&'a Step], count: usize, judged: &[Verdict]) -> Self {
        let (measure, unit) = (name.measure(), name.measure().unit());
        let worst: Vec<Option<&Worst>> =
            (0..count).map(|k| steps.get(k)?.measures.get(name)).collect();
        let judged = judged.iter().find(|verdict| verdict.name == name);
        MeasureCourse {
            key: measure.key(),
            label: measure.label(),
            // as in the table of limits
            unit: unit.shown,
            values: worst.iter().map(|w| w.map(|w| as_shown(w.value, unit))).collect(),
            at: worst.iter().map(|w| w.map(|w| w.at.as_str())).collect(),
            places: worst.iter().map(|w| w.and_then(|w| w.place)).collect(),
            limit: judged.map(|verdict| verdict.limit),
            least: measure.sense() == Sense::AtLeast,
        }
    }
}

/// Every measure that has a value in some of the steps: first those that are judged, the closest to its limit first, then the others in
/// the order of [`Name::ALL`].
pub(super) fn courses<'a>(
    steps: &[&'a Step],
    count: usize,
    judged: &[Verdict],
) -> Vec<MeasureCourse<'a>> {
    let mut names: Vec<Name> = closest_first(judged).iter().map(|verdict| verdict.name).collect();
    let others = Name::ALL.iter().copied().filter(|name| !names.contains(name));
    names.extend(others.collect::<Vec<_>>());
    names.retain(|name| steps.iter().any(|step| step.measures.get(*name).is_some()));
    names.into_iter().map(|name| MeasureCourse::new(name, steps, count, judged)).collect()
}

/// A recorded value in the unit that it is shown in; one in the same unit keeps its digits.
fn as_shown(value: f64, unit: Unit) -> f64 {
    if unit.factor == 1.0 { value } else { value * unit.factor }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample;

    /// Shares are shown in percent, and a value that is shown as it is recorded keeps its digits.
    #[test]
    fn values_have_the_unit_of_the_limits() {
        assert_eq!(as_shown(0.25, Unit::SHARE), 25.0);
        assert_eq!(as_shown(0.1 + 0.2, Unit::DEGREE), 0.1 + 0.2);
    }

    /// Every measure with a value has a course over all steps of the page, the judged ones before the others; a step that a model has not
    /// done has no value.
    #[test]
    fn every_measure_with_a_value_has_a_course() {
        let result = sample::draped(4, 2, 3);
        let steps: Vec<&Step> = result.steps.iter().take(2).collect();
        let courses = courses(&steps, 3, &result.summary.limits);
        let measured = |name: &&Name| steps.iter().any(|s| s.measures.get(**name).is_some());
        assert_eq!(courses.len(), Name::ALL.iter().filter(measured).count());
        assert!(courses.is_sorted_by_key(|course| course.limit.is_none()));
        for course in &courses {
            assert_eq!((course.values.len(), course.values[2]), (3, None));
        }
    }
}
