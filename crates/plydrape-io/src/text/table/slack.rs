//! The slack at the end as what an engineer sees of it: an angle of the fibers and the height of a wrinkle.

use super::significant;
use plydrape::measure::{Name, Verdict, angle_of_slack};
use plydrape::outcome::Summary;

/// The worst slack of the catenaries at the end in words, as an angle and as a height. Of these one that has a limit of its own is left
/// out, because the limits have a row of it. None without slack, or where slack is not judged.
#[must_use]
pub(crate) fn slack_in_words(summary: &Summary) -> Option<String> {
    let judged = |name: Name| summary.limits.iter().find(|verdict| verdict.name == name);
    let value = |name: Name| summary.last.value(name).filter(|value| *value > 0.0);
    let ratio = judged(Name::SlackRatio)?;
    let mut said = Vec::new();
    if let (None, Some(angle)) = (judged(Name::SlackAngle), value(Name::SlackAngle)) {
        let (angle, limit) = (significant(angle), significant(limit_as_angle(ratio)));
        said.push(format!("a fiber angle of {angle}° (allowed {limit}°)"));
    }
    if let (None, Some(height)) = (judged(Name::Wrinkle), value(Name::Wrinkle)) {
        said.push(format!("a wrinkle {} mm high", significant(height)));
    }
    (!said.is_empty()).then(|| said.join(", "))
}

/// The limit of a slack ratio as a fiber angle (°).
fn limit_as_angle(ratio: &Verdict) -> f64 {
    angle_of_slack(ratio.limit / Name::SlackRatio.measure().unit().factor).to_degrees()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample;
    use plydrape::measure::Worst;

    /// 2√0.005 is 8.1°, 2√0.0005 2.6°; what has a row of its own in the table of limits is not said twice.
    #[test]
    fn angle_and_height_of_slack_are_said_once() {
        let mut summary = sample::draped(4, 2, 3).summary;
        let verdict = |name: Name, value: f64, limit: f64| {
            Verdict::new(name, Worst { value, at: String::new(), place: None }, limit, None)
        };
        assert_eq!(slack_in_words(&summary), None);
        summary.limits.push(verdict(Name::SlackRatio, 0.005, 0.0005));
        assert_eq!(slack_in_words(&summary), None);
        let last = [(Name::SlackAngle, Some(8.10285)), (Name::Wrinkle, Some(2.7))];
        summary.last = last.into_iter().collect();
        assert_eq!(
            slack_in_words(&summary).as_deref(),
            Some("a fiber angle of 8.103° (allowed 2.562°), a wrinkle 2.7 mm high")
        );
        summary.limits.push(verdict(Name::SlackAngle, 8.10285, 3.0));
        assert_eq!(slack_in_words(&summary).as_deref(), Some("a wrinkle 2.7 mm high"));
        summary.limits.push(verdict(Name::Wrinkle, 2.7, 0.5));
        assert_eq!(slack_in_words(&summary), None);
    }
}
