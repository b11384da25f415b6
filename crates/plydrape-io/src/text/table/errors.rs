//! What drapes with errors say beside a verdict: the sample, its highest place, what a motion tolerates.

use super::{WIDTH, limiting, measure_text, significant, verdict_text};
use crate::result::ResultFile;
use crate::store::shown;
use plydrape::measure::Name;
use plydrape::outcome::{RateTolerance, SampleVerdict, Tolerance};
use plydrape::planner::{Near, Tried};
use plydrape::sheet::pitch;

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
    lines.extend(tolerances(result));
    lines.extend(tried(result));
    lines.iter().map(|line| shown::excerpt(line, WIDTH) + "\n").collect()
}

/// The sample, its heights and, of one that is refused, the limit that is exceeded furthest.
fn sample_lines(sample: &SampleVerdict) -> Vec<String> {
    let share = share(sample);
    let mut lines = vec![sample_in_words(sample)];
    let worst = limiting(&sample.limits).filter(|_| !sample.ok);
    // the limit of the height says how high they end too
    let other = worst.is_none_or(|worst| worst.name != Name::Height);
    if let Some(height) = sample.height_mm().filter(|_| other) {
        lines.push(format!("  {share} of the cells end at most {} mm high", significant(height)));
    }
    if let Some(worst) = worst {
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

/// What a motion tolerates, in lines; none where it was not asked for.
#[must_use]
pub(crate) fn tolerances(result: &ResultFile) -> Vec<String> {
    let summary = &result.summary;
    // where cells were draped, they say what is not tolerated
    let refused = summary.sample.as_ref().is_some_and(|sample| !sample.ok);
    let found = summary.tolerance.as_ref().filter(|tolerance| tolerance.tried > 0 || !refused);
    let own = found.map(|tolerance| tolerance_in_words(result, tolerance));
    let rate = summary.rate_tolerance.map(|tolerance| rate_in_words(result, tolerance));
    own.into_iter().flatten().chain(rate).collect()
}

/// Which changes of the scene help, of those that were tried where no plan was found, in lines; none where none were tried.
#[must_use]
pub(crate) fn tried(result: &ResultFile) -> Vec<String> {
    result.plan.as_ref().map_or_else(Vec::new, |plan| tried_in_words(&plan.tried))
}

/// The changes that help, what helps most first; where none does, the one that comes nearest.
fn tried_in_words(tried: &[Tried]) -> Vec<String> {
    let count = tried.len();
    let helping: Vec<&Tried> = tried.iter().filter(|tried| tried.helps).collect();
    let in_words = |n: usize, helping: &Tried| {
        let Tried { change, near, .. } = helping;
        let near = near_in_words(near);
        match n {
            0 => format!("of {count} changes tried, {change} helps most: {near}"),
            _ => format!("  {change} helps too: {near}"),
        }
    };
    if let ([], Some(Tried { change, near, .. })) = (helping.as_slice(), tried.first()) {
        let nearest = match near.limit.ok {
            // the scene as it is comes about as near, and is refused in other cells
            true => String::new(),
            false => format!("; {change} comes nearest: {}", near_in_words(near)),
        };
        return vec![format!("none of {count} changes tried helps{nearest}")];
    }
    helping.into_iter().enumerate().map(|(n, helping)| in_words(n, helping)).collect()
}

/// How near a scene comes to a plan.
fn near_in_words(near: &Near) -> String {
    let Near { limit, kept, cells, .. } = near;
    match (limit.ok, cells) {
        (true, 0) => "every limit is kept without errors".into(),
        (true, _) => format!("{kept} of {cells} cells keep every limit"),
        (false, _) => measure_text(limit),
    }
}

/// The errors of its grippers that a motion tolerates, and multiples of the shear stiffness and the mass of its ply.
fn tolerance_in_words(result: &ResultFile, tolerance: &Tolerance) -> Vec<String> {
    if tolerance.tried == 0 {
        return vec!["tolerates no errors: it is not accepted without any".into()];
    }
    let least = Tolerance::least_mm(pitch(&result.scene.ply));
    let (millimeters, most) = match tolerance.gripper_mm {
        0.0 => (least, "less than "),
        mm if tolerance.gripper_at_least => (mm, "at least "),
        mm => (mm, ""),
    };
    let mut lines = vec![format!(
        "tolerates errors of {most}{} mm (standard deviation of each gripper's position along each axis)",
        rounded(millimeters)
    )];
    let multiples = |[least, most]: [f64; 2]| {
        // the ends of what is tried
        let or_less = if 1.0 / least >= Tolerance::MOST { " (or less)" } else { "" };
        let or_more = if most >= Tolerance::MOST { " (or more)" } else { "" };
        format!("{}{or_less} to {}{or_more}", rounded(least), rounded(most))
    };
    let shear = tolerance.shear.map(|range| ("shear stiffness", range));
    for (name, range) in shear.into_iter().chain([("mass", tolerance.mass)]) {
        lines.push(format!("tolerates a {name} of {} times the ply's", multiples(range)));
    }
    lines
}

/// How fast, or how warm, a ply with resin may be draped, in one line.
fn rate_in_words(
    result: &ResultFile,
    RateTolerance { speed, temperature }: RateTolerance,
) -> String {
    let Some(speed) = speed else {
        let most = RateTolerance::MOST;
        return format!("the resin of the ply does not follow at 1/{most} of the speed either");
    };
    let slower = speed < 1.0;
    let times = if slower { format!("1/{}", speed.recip()) } else { speed.to_string() };
    let (verb, most) = match (slower, speed >= RateTolerance::MOST) {
        (true, _) => ("needs", ""),
        (false, true) => ("tolerates", "at least "),
        (false, false) => ("tolerates", ""),
    };
    let seconds =
        result.summary.last.value(Name::Duration).map(|duration| rounded(duration / speed));
    let seconds = seconds.map_or(String::new(), |seconds| format!(" ({seconds} s)"));
    let celsius = temperature.map(|celsius| format!(", or {celsius:.0} °C at its own speed"));
    format!(
        "the resin of the ply {verb} {most}{times} of the speed{seconds}{}",
        celsius.unwrap_or_default()
    )
}

/// Two digits: an error is known within 9 %.
fn rounded(value: f64) -> String {
    significant(shown::rounded(value, 2))
}

#[cfg(test)]
mod tests {
    use super::super::{Ink, screen, verdict};
    use super::*;
    use crate::sample;
    use plydrape::measure::{Verdict, Worst};
    use plydrape::outcome::Status;
    use plydrape::planner::Change;

    /// What was found at an end of what was tried is said to be no more than that; catenaries know no shear stiffness.
    #[test]
    fn what_a_motion_tolerates_is_said_with_the_ends_of_what_was_tried() {
        let result = sample::draped(4, 2, 3);
        let law = "(standard deviation of each gripper's position along each axis)";
        let found = Tolerance {
            gripper_mm: 0.41,
            gripper_at_least: false,
            shear: Some([0.2, 8.0]),
            mass: [0.125, 1.6],
            tried: 16,
        };
        let said = |tolerance: &Tolerance| tolerance_in_words(&result, tolerance);
        let wanted = [
            format!("tolerates errors of 0.41 mm {law}"),
            "tolerates a shear stiffness of 0.2 to 8 (or more) times the ply's".into(),
            "tolerates a mass of 0.12 (or less) to 1.6 times the ply's".into(),
        ];
        assert_eq!(said(&found), wanted);
        let most =
            Tolerance { gripper_mm: 1.6, gripper_at_least: true, shear: None, ..found.clone() };
        let wanted = [
            format!("tolerates errors of at least 1.6 mm {law}"),
            "tolerates a mass of 0.12 (or less) to 1.6 times the ply's".into(),
        ];
        assert_eq!(said(&most), wanted);
        // cells of 100 mm: the least that is tried is a 64th of 0.1 mm
        let least = Tolerance { gripper_mm: 0.0, ..found };
        assert_eq!(said(&least)[0], format!("tolerates errors of less than 0.0016 mm {law}"));
        let nothing = ["tolerates no errors: it is not accepted without any"];
        assert_eq!(said(&Tolerance::NOTHING), nothing);
    }

    /// What helps is said with how near it comes: by its cells with errors, or by the limit that is exceeded without any.
    #[test]
    fn of_changes_that_were_tried_those_that_help_are_said() {
        let near = |value: f64, kept, cells| {
            let worst = Worst { value, at: String::new(), place: None };
            Near { limit: Verdict::new(Name::Height, worst, 0.5, None), kept, cells }
        };
        let limper = |near| Tried { change: Change::ShearStiffness(0.5), near, helps: true };
        let other = Tried { change: Change::Grippers([4, 3]), near: near(0.4, 3, 4), helps: true };
        let both = [other.clone(), limper(near(0.61, 0, 0))];
        let wanted = [
            "of 2 changes tried, 4 × 3 grippers helps most: 3 of 4 cells keep every limit",
            "  0.5 times the shear stiffness helps too: height 0.61 mm against 0.5 mm",
        ];
        assert_eq!(tried_in_words(&both), wanted);
        let none = both.map(|tried| Tried { helps: false, near: near(0.61, 0, 0), ..tried });
        let wanted = "none of 2 changes tried helps; 4 × 3 grippers comes nearest: height 0.61 mm against 0.5 mm";
        assert_eq!(tried_in_words(&none), [wanted]);
        let as_near = none.map(|tried| Tried { near: near(0.4, 8, 8), ..tried });
        assert_eq!(tried_in_words(&as_near), ["none of 2 changes tried helps"]);
        assert_eq!(tried_in_words(&[]), [""; 0]);
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
                judged: true,
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
