//! Limits as a table, the closest first.

use super::ink::{Ink, Tone};
use super::{aligned, errors, significant};
use plydrape::measure::Verdict;
use plydrape::outcome::SampleVerdict;
use std::fmt::Write;

/// From which share of a limit on it is close.
const CLOSE: f64 = 0.9;

/// The limits of a drape, those exceeded furthest and then those closest first, at most as many that hold as are asked for; of a sample with a column of what its
/// share of the cells keeps.
pub(super) fn limits(
    limits: &[Verdict],
    sample: Option<&SampleVerdict>,
    most: usize,
    ink: Ink,
) -> String {
    if limits.is_empty() {
        return String::new();
    }
    let sorted = closest_first(limits);
    let broken = sorted.iter().filter(|verdict| !verdict.ok).count();
    let shown = &sorted[..sorted.len().min(broken.max(most))];
    let rest = &sorted[shown.len()..];

    let mut rows = vec![titles(sample)];
    rows.extend(shown.iter().map(|verdict| row(verdict, sample)));
    let texts = [0, 3, 6].map(|n| if n > 0 && sample.is_some() { n + 1 } else { n });
    let table = aligned(&rows, &texts);
    let tone = |n: usize| n.checked_sub(1).and_then(|n| shown.get(n)).and_then(|v| tone(v));
    let mut text = ink.lines(&table, tone);
    if let Some(next) = rest.first() {
        let more = format!("{} more use {} or less", rest.len(), used(next));
        let _ = writeln!(text, "{}", ink.tinted(&more, Tone::Faint));
    }
    text
}

/// Limits by how much of them is used up, the most first.
pub(crate) fn closest_first(limits: &[Verdict]) -> Vec<&Verdict> {
    let mut sorted: Vec<&Verdict> = limits.iter().collect();
    sorted.sort_by(|a, b| b.ratio().total_cmp(&a.ratio()));
    sorted
}

fn titles(sample: Option<&SampleVerdict>) -> Vec<String> {
    let titles = ["limit", "worst", "allowed", "unit", "used", "step", "at"];
    let mut row = titles.map(str::to_owned).to_vec();
    row.splice(3..3, sample.map(errors::share));
    row
}

fn row(verdict: &Verdict, sample: Option<&SampleVerdict>) -> Vec<String> {
    let kept = |sample: &SampleVerdict| {
        let own = sample.limits.iter().find(|own| own.name == verdict.name);
        own.map_or_else(|| "–".into(), |own| significant(own.value))
    };
    let mut row = vec![
        verdict.name.title(),
        if verdict.judged { significant(verdict.value) } else { "–".into() },
        significant(verdict.limit),
        verdict.unit.to_string(),
        used(verdict),
        verdict.step.map_or_else(|| "–".into(), |step| step.to_string()),
        verdict.at.clone(),
    ];
    row.splice(3..3, sample.map(kept));
    row
}

/// How much of a limit is used up, as a share, in words where it does not hold.
fn used(verdict: &Verdict) -> String {
    let percent = 100.0 * verdict.ratio();
    match (verdict.ok, percent.is_finite() && verdict.limit != 0.0) {
        (true, _) => format!("{percent:.0} %"),
        (false, true) if percent < 1e6 => format!("FAIL {:.0} %", percent.max(101.0)),
        (false, _) => "FAIL".into(),
    }
}

fn tone(verdict: &Verdict) -> Option<Tone> {
    match (verdict.ok, verdict.ratio()) {
        (false, _) => Some(Tone::Bad),
        (true, ratio) if ratio >= CLOSE => Some(Tone::Close),
        (true, _) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use plydrape::measure::{Name, Worst};

    fn verdict(name: Name, value: f64, limit: f64) -> Verdict {
        let at = "gripper g0_0".to_owned();
        Verdict::new(name, Worst { value, at, place: None }, limit, Some(3))
    }

    /// Limits that are not kept come first, by how far they are exceeded; then as many of the others as fit.
    #[test]
    fn the_closest_limit_comes_first() {
        let all = [
            verdict(Name::Shear, 10.0, 40.0),
            verdict(Name::Tilt, 38.0, 40.0),
            verdict(Name::GripperLoad, 12.0, 10.0),
            verdict(Name::Height, 1.0, 0.5),
            verdict(Name::TiltRate, 1.0, 90.0),
        ];
        let text = limits(&all, None, 3, Ink::Plain);
        let rows: Vec<Vec<&str>> = text.lines().map(|l| l.split("  ").collect()).collect();
        let first: Vec<&str> = rows.iter().map(|row| row[0].trim()).collect();
        assert_eq!(first, ["limit", "height", "gripper load", "tilt", "2 more use 25 % or less"]);
        assert!(
            text.contains("FAIL 200 %") && text.contains("FAIL 120 %") && text.contains("95 %")
        );
        let few = limits(&all, None, 0, Ink::Plain);
        assert_eq!(few.matches("FAIL").count(), 2, "{few}");
    }

    /// A value that only just exceeds its limit does not say 100 %, and one of a limit of zero no share at all.
    #[test]
    fn a_limit_that_does_not_hold_never_looks_kept() {
        assert_eq!(used(&verdict(Name::Tilt, 40.0001, 40.0)), "FAIL 101 %");
        assert_eq!(used(&verdict(Name::Workspace, 3.0, 0.0)), "FAIL");
        assert_eq!(used(&verdict(Name::Height, f64::NAN, 0.5)), "FAIL");
        assert_eq!(used(&verdict(Name::Tilt, 40.0, 40.0)), "100 %");
    }

    /// Colors say how close a limit is, and take no room.
    #[test]
    fn colors_change_no_letter() {
        let all = [verdict(Name::Tilt, 38.0, 40.0), verdict(Name::Height, 1.0, 0.5)];
        let colored = limits(&all, None, 9, Ink::Colored);
        assert!(colored.contains("\x1b[31mheight") && colored.contains("\x1b[33mtilt"));
        let plain = colored.replace("\x1b[31m", "").replace("\x1b[33m", "").replace("\x1b[0m", "");
        assert_eq!(plain, limits(&all, None, 9, Ink::Plain));
    }
}
