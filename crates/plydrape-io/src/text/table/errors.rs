//! What drapes with errors say beside a verdict: the sample, its highest place, the errors that a plan tolerates.

use super::{WIDTH, limiting, significant, unit, verdict_text};
use crate::result::ResultFile;
use crate::store::shown;
use plydrape::errors::{Errors, Term};
use plydrape::outcome::{SampleVerdict, Stands};

/// The lines below a verdict; empty where nothing was draped with errors and nothing was to be.
pub(super) fn errors(result: &ResultFile) -> String {
    let summary = &result.summary;
    let drawn = result.scene.errors.as_ref().filter(|errors| errors.is_drawn());
    let mut lines: Vec<String> = Vec::new();
    match (&summary.sample, drawn) {
        (Some(sample), _) => lines.extend(sample_lines(sample)),
        (None, Some(_)) if summary.accepted() => {
            lines.push("the errors of the scene were left out".into());
        }
        (None, _) => {}
    }
    if let Some(stands) = &summary.stands {
        lines.push(stands_in_words(result, stands));
    }
    lines.iter().map(|line| shown::excerpt(line, WIDTH) + "\n").collect()
}

/// The sample, its heights and, of one that is refused, the limit that is exceeded furthest.
fn sample_lines(sample: &SampleVerdict) -> Vec<String> {
    let share = share(sample);
    let mut lines = vec![sample_in_words(sample)];
    if let Some(height) = sample.height_mm() {
        lines.push(format!("  {share} of the cells end at most {} mm high", significant(height)));
    }
    if let Some(worst) = limiting(&sample.limits).filter(|_| !sample.ok) {
        lines.push(format!("  {share} of the cells: {}", verdict_text(worst)));
    }
    if let Some(highest) = &sample.highest {
        lines.push(format!("  highest on the line {}, near {}", highest.line, highest.gripper));
    }
    lines
}

/// What a sample says of all cells, as in `59 of 59 cells with errors keep every limit: 95 % of all cells do, with 95.2 % confidence`.
pub(crate) fn sample_in_words(sample: &SampleVerdict) -> String {
    let (cells, share) = (sample.cells.len(), share(sample));
    let confidence = match 100.0 * sample.confidence {
        percent if percent > 99.9 => "more than 99.9 %".into(),
        percent => format!("{} %", significant((10.0 * percent).round() / 10.0)),
    };
    match (sample.ok, cells - sample.accepted()) {
        (true, failed) => format!(
            "{} of {cells} cells with errors keep every limit: {share} of all cells do, with {confidence} confidence",
            cells - failed
        ),
        (false, failed) => format!(
            "{failed} of {cells} cells with errors {}, so fewer than {share} keep the limits, with {confidence} confidence",
            if failed == 1 { "fails" } else { "fail" }
        ),
    }
}

/// The share of the cells that must keep the limits, as in `95 %`.
pub(crate) fn share(sample: &SampleVerdict) -> String {
    format!("{} %", significant(100.0 * sample.errors.share))
}

/// What a plan tolerates, as in `tolerates errors of 0.41 mm (standard deviation of each gripper's position along each axis)`.
#[must_use]
pub(crate) fn stands_in_words(result: &ResultFile, stands: &Stands) -> String {
    if stands.tried == 0 {
        return "tolerates no errors: it is not accepted without any".into();
    }
    let given = result.scene.errors.filter(Errors::is_drawn);
    let errors = given.unwrap_or_else(|| Errors::of_array(&result.scene.ply));
    let (times, most) = match stands.factor {
        0.0 => (Stands::LEAST, "less than "),
        factor if stands.at_least => (factor, "at least "),
        factor => (factor, ""),
    };
    let factor = rounded(times);
    if errors.gripper.position.is_zero() {
        return format!("tolerates {most}{factor} times the errors of the scene");
    }
    let (sign, law) = match errors.gripper.position {
        Term::Deviation(_) => ("", "standard deviation of each gripper's position along each axis"),
        Term::Bound(_) | Term::Factor(_) => ("± ", "of each gripper's position along each axis"),
    };
    let millimetres = rounded(1e3 * errors.gripper.position.scaled(times).value());
    let mut alone = errors;
    alone.gripper.position = Term::NONE;
    match alone.is_zero() {
        true => format!("tolerates errors of {most}{sign}{millimetres}{} ({law})", unit("mm")),
        false => format!(
            "tolerates {most}{factor} times the errors of the scene: {sign}{millimetres} mm ({law})"
        ),
    }
}

/// Two digits: a factor is known within 9 %.
fn rounded(value: f64) -> String {
    significant(format!("{value:.1e}").parse().unwrap_or(value))
}

#[cfg(test)]
mod tests {
    use super::super::{Ink, screen, verdict};
    use super::*;
    use crate::sample;
    use plydrape::measure::{Name, Verdict};
    use plydrape::outcome::Status;

    fn said(result: &ResultFile, factor: f64, at_least: bool) -> String {
        let position = Term::NONE;
        stands_in_words(result, &Stands { factor, at_least, position, tried: 16 })
    }

    /// The fabric between the grippers of the sample is 100 mm long: without errors of the scene a factor is one of 0.1 mm.
    #[test]
    fn what_a_plan_tolerates_is_said_of_its_own_errors() {
        let mut result = sample::draped(4, 2, 3);
        let law = "(standard deviation of each gripper's position along each axis)";
        assert_eq!(said(&result, 4.1, false), format!("tolerates errors of 0.41 mm {law}"));
        assert_eq!(said(&result, 16.0, true), format!("tolerates errors of at least 1.6 mm {law}"));
        let least = said(&result, 0.0, false);
        assert_eq!(least, format!("tolerates errors of less than 0.0016 mm {law}"));

        let mut errors = Errors::default();
        errors.gripper.position = Term::Bound(3e-4);
        result.scene.errors = Some(errors);
        let wanted = "tolerates errors of ± 0.42 mm (of each gripper's position along each axis)";
        assert_eq!(said(&result, 1.4, false), wanted);
        errors.frame.position = Term::Bound(1e-3);
        result.scene.errors = Some(errors);
        let wanted = "tolerates 1.4 times the errors of the scene: ± 0.42 mm";
        assert!(said(&result, 1.4, false).starts_with(wanted));
        errors.gripper.position = Term::NONE;
        result.scene.errors = Some(errors);
        assert_eq!(said(&result, 1.4, false), "tolerates 1.4 times the errors of the scene");
        let nothing = stands_in_words(&result, &Stands::nothing(&errors));
        assert_eq!(nothing, "tolerates no errors: it is not accepted without any");
    }

    /// A plan that is accepted only without errors is not accepted, and the table has a column of what the share keeps.
    #[test]
    fn a_sample_that_keeps_too_few_cells_refuses_the_verdict() {
        let mut result = sample::draped(4, 2, 3);
        let limit = |value: f64, ok: bool| {
            let (unit, at) = ("°".into(), "gripper g0_0".into());
            Verdict {
                name: Name::Tilt,
                value,
                limit: 40.0,
                unit,
                ok,
                step: Some(3),
                at,
                place: None,
            }
        };
        result.summary.limits = vec![limit(39.0, true)];
        let mut sample = sample::sample_verdict();
        sample.limits = vec![limit(41.5, false)];
        result.scene.errors = Some(sample.errors);
        result.summary.sample = Some(sample);
        let text = screen(&result, "", Ink::Plain);
        assert!(text.contains("allowed  75 %"), "{text}");
        assert!(text.contains("40   41.5") || text.contains("40  41.5"), "{text}");
        let wanted = "\
accepted only without errors by the catenaries
2 of 4 cells with errors fail, so fewer than 75 % keep the limits, with 73.8 % confidence
  75 % of the cells end at most 0.6 mm high
  75 % of the cells: tilt 41.5° against 40° in step 3, gripper g0_0
  highest on the line gripper g0_1 to gripper g3_1, near gripper g3_1
";
        assert_eq!(verdict(&result, Ink::Plain), wanted);

        // interrupted: nobody knows; left out: the verdict without errors counts
        result.summary.sample = None;
        result.summary.status = Status::Interrupted;
        let ended = "interrupted before all cells with the errors of the scene were draped\n";
        assert!(verdict(&result, Ink::Plain).ends_with(ended));
        result.summary.status = Status::Converged;
        let left_out = "accepted by the catenaries in an ideal cell, without errors\nthe errors of the scene were left out\n";
        assert_eq!(verdict(&result, Ink::Plain), left_out);
    }
}
