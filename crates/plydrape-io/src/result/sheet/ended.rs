//! Why the end of a drape does not count, as a sentence.

use plydrape::layup::Model;
use plydrape::measure::{Name, Verdict};
use plydrape::outcome::{Status, Summary};

/// Why the end of a drape does not count; `None` where it does.
pub(crate) fn ended(summary: &Summary) -> Option<String> {
    let (done, planned) = (summary.steps, summary.steps_planned);
    let ply = match summary.model {
        Model::Sheet => "sheet",
        Model::Catenaries => "ply",
    };
    match summary.status {
        Status::Converged => None,
        Status::NotAtRest => Some(format!("the {ply} is not at rest at the end")),
        Status::NotSolved => {
            Some(format!("no state of the {ply} was found after step {done} of {planned}"))
        }
        Status::Torn => {
            let why = summary.stopped.as_deref().unwrap_or("no ply would survive the next step");
            Some(format!("stopped: {why}"))
        }
        Status::Interrupted if done == planned => {
            Some("interrupted before all cells with the errors of the scene were draped".into())
        }
        Status::Interrupted => Some(format!("interrupted after step {done} of {planned}")),
    }
}

/// Why no further state of a ply was found whose yarns are strained too far, with the place, and what helps; a line each.
pub(crate) fn overstrained(summary: &Summary) -> Option<[String; 2]> {
    let mut limits = summary.limits.iter().filter(|_| summary.status == Status::NotSolved);
    let strain = limits.find(|verdict| verdict.name == Name::Strain && !verdict.ok)?;
    let Verdict { value, unit, at, .. } = strain;
    Some([
        format!("strained by {value:.1} {unit} at {at}: the ply sticks too early, or is too short"),
        "let it come down above its place, as `plydrape plan` does, or bring grippers closer"
            .into(),
    ])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample;
    use plydrape::measure::Worst;

    /// A drape that was not followed to its end says after which step, and where yarns are strained too far the place and what helps.
    #[test]
    fn a_sheet_that_is_strained_too_far_says_where_and_what_helps() {
        let mut summary = sample::sheet(3, 2, 3).summary;
        (summary.status, summary.steps, summary.steps_planned) = (Status::NotSolved, 28, 30);
        summary.limits.retain(|verdict| verdict.name != Name::Strain);
        let worst =
            |value| Worst { value, at: "fabric point (295.0, 100.0) mm".into(), place: None };
        for (strain, too_far) in [(0.004, false), (0.1149, true)] {
            let verdict = Verdict::new(Name::Strain, worst(strain), 0.005, Some(28));
            summary.limits.push(verdict);
            let after = "no state of the sheet was found after step 28 of 30";
            assert_eq!(ended(&summary).as_deref(), Some(after));
            assert_eq!(overstrained(&summary).is_some(), too_far);
            if let Some([why, remedy]) = overstrained(&summary) {
                assert!(
                    why.contains("strained by 11.5 % at fabric point (295.0, 100.0) mm"),
                    "{why}"
                );
                assert!(remedy.contains("plydrape plan") && why.len().max(remedy.len()) < 100);
            }
            summary.limits.pop();
        }
        let verdict = Verdict::new(Name::Strain, worst(0.1149), 0.005, Some(28));
        (summary.status, summary.limits) = (Status::Converged, vec![verdict]);
        assert_eq!(overstrained(&summary), None);
    }
}
