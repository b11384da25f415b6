//! A result on one screen, and the rest of it.

use super::ink::{Ink, Tone};
use super::{
    WIDTH, beside, errors, limited_by, limiting, limits, model_name, report, significant, steps,
    steps_table, tool, verdict_text,
};
use crate::result::ResultFile;
use crate::result::sheet::{ended, overstrained};
use crate::store::shown;
use plydrape::layup::Model;
use plydrape::measure::Name;
use plydrape::ply::Grid;
use std::time::Duration;

/// Most limits that hold on a screen.
const LIMITS: usize = 12;

/// A result on one screen of at most forty lines: title and size; `found`, two lines or less that say what was found and how long that
/// took, as [`draped`] does of a simulated drape; at most ten steps; the limits, the closest first; the verdict and its margins. More lines are
/// there only where more than twelve limits do not hold.
#[must_use]
pub fn screen(result: &ResultFile, found: &str, ink: Ink) -> String {
    let summary = &result.summary;
    let steps = steps::short(summary, &result.steps);
    let limits = limits::limits(&summary.limits, summary.sample.as_ref(), LIMITS, ink);
    let parts =
        [heading(result) + "\n" + found.trim_end() + "\n", steps, limits, verdict(result, ink)];
    parts.iter().filter(|part| !part.is_empty()).cloned().collect::<Vec<_>>().join("\n")
}

/// What does not fit a screen: all steps, all limits, what limits the time of a planned motion, what the model says beside its measures, and
/// what the other model says if it was asked.
#[must_use]
pub fn details(result: &ResultFile) -> String {
    let summary = &result.summary;
    let parts = [
        steps_table(result),
        limits::limits(&summary.limits, summary.sample.as_ref(), usize::MAX, Ink::Plain),
        limited_by(result),
        report::report(result),
        beside::details(result),
    ];
    parts.iter().filter(|part| !part.is_empty()).cloned().collect::<Vec<_>>().join("\n")
}

/// Title and size in one line, as in `Dome: 4 × 4 grippers, 90 steps, a sheet of 2601 nodes`.
#[must_use]
pub fn heading(result: &ResultFile) -> String {
    let ply = &result.scene.ply;
    let grippers = match ply.grid {
        Grid::NONE => format!("{} grippers", ply.grippers()),
        Grid { nu, nv } => format!("{nu} × {nv} grippers"),
    };
    let steps = match result.summary.steps_planned {
        1 => "1 step".to_owned(),
        steps => format!("{steps} steps"),
    };
    let model = match (&result.summary.sheet, result.model()) {
        (Some(report), _) => format!("a sheet of {} nodes", report.nodes),
        (None, Model::Sheet) => "a sheet".into(),
        (None, Model::Catenaries) => match ply.lines().catenaries() {
            1 => "1 catenary".into(),
            catenaries => format!("{catenaries} catenaries"),
        },
    };
    let size = format!("{grippers}, {steps}, {model}");
    let room = WIDTH.saturating_sub(size.chars().count() + 2);
    format!("{}: {size}", shown::excerpt(&result.scene.title, room))
}

/// What a simulated drape was and how long it took, in two lines.
#[must_use]
pub fn draped(result: &ResultFile, took: Duration) -> String {
    let (seconds, model) = (took.as_secs_f64(), model_name(result.model()));
    let duration = result.steps.last().map_or(0.0, |step| step.time);
    format!("draped by {model} in {seconds:.1} s\nmotion of {duration:.1} s")
}

/// The verdict and its world in a line, why, and its margins: the errors that the motion tolerates, the largest load and pull of grippers with their limits; last
/// a line of the model that does not decide, if it was asked.
#[must_use]
pub fn verdict(result: &ResultFile, ink: Ink) -> String {
    let summary = &result.summary;
    let model = model_name(summary.model);
    let (word, world, tone) = match (summary.accepted_without_errors(), summary.accepted()) {
        (true, true) => ("accepted", summary.world.words(), Tone::Good),
        (true, false) => ("accepted only without errors", "", Tone::Bad),
        (false, _) => ("not accepted", "", Tone::Bad),
    };
    let worst = limiting(&summary.limits).map(verdict_text);
    // what causes the rest comes first
    let need = worst.as_ref().and_then(|_| tool::need(result));
    let causes: Vec<String> = need.into_iter().chain(worst).collect();
    let colon = if causes.is_empty() { "" } else { ": " };
    let line = format!("{word} by {model}{world}{colon}{}", causes.join("; "));
    let mut text = ink.tinted(&shown::excerpt(&line, WIDTH), tone) + "\n";
    let unseen = result.unseen().filter(|_| summary.accepted());
    let why =
        unseen.into_iter().chain(ended(summary)).chain(overstrained(summary).into_iter().flatten());
    for line in why.chain([forces(result), tool::arm(result)]).filter(|line| !line.is_empty()) {
        text += &(shown::excerpt(&line, WIDTH) + "\n");
    }
    text + &errors::errors(result) + &beside::line(result)
}

/// The largest loads of cups beside what they hold, or where that is not known the largest load and the largest pull of grippers with their
/// limits; empty where the model knows none.
fn forces(result: &ResultFile) -> String {
    // loads of cups beside what these hold, where that is known
    let summary = &result.summary;
    let pad = &result.scene.settings.pad;
    let held = |name: Name, direction: &str, holds: Option<f64>| {
        let verdict = summary.limits.iter().find(|verdict| verdict.name == name)?;
        let [value, holds] = [verdict.value, holds?].map(significant);
        let at = verdict.at.trim_start_matches("gripper ");
        Some(format!("{value} of {holds} N {direction} ({at})"))
    };
    let cups = [
        held(Name::Slip, "along the ply", pad.slip_force),
        held(Name::Holding, "across it", pad.holding_force),
    ];
    let cups: Vec<String> = cups.into_iter().flatten().collect();
    if !cups.is_empty() {
        return format!("largest load of a cup {}", cups.join(", "));
    }

    // else the largest load and the largest pull of grippers
    let force = |name: Name, words: &str| {
        let value = significant(summary.worst.value(name)?);
        let limit = summary.limits.iter().find(|verdict| verdict.name == name);
        Some(match limit {
            Some(limit) => format!("{words} {value} N (limit {} N)", significant(limit.limit)),
            None => format!("{words} {value} N (no limit)"),
        })
    };
    let both = [
        force(Name::GripperLoad, "largest load of a gripper"),
        force(Name::GripperPull, "largest pull"),
    ];
    both.into_iter().flatten().collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample;
    use plydrape::measure::{Verdict, Worst};
    use plydrape::outcome::Status;

    fn verdict_of(name: Name, value: f64, limit: f64) -> Verdict {
        let at = "very far away ".repeat(20);
        Verdict::new(name, Worst { value, at, place: None }, limit, Some(90))
    }

    fn widest(text: &str) -> usize {
        text.lines().map(|line| line.chars().count()).max().unwrap_or(0)
    }

    /// Ninety steps and a verdict on every limit that there is are forty lines of a hundred letters, with room for the folder.
    #[test]
    fn a_result_fits_a_screen() {
        let mut result = sample::sheet(4, 4, 90);
        result.scene.title = "A long name ".repeat(20);
        let all = Name::ALL.iter().map(|name| verdict_of(*name, 0.1, 1.0));
        result.summary.limits = all.filter(|verdict| verdict.ok).collect();
        assert!(result.summary.limits.len() > 30);
        let text = screen(&result, "path plan\nmotion of 3 s", Ink::Plain);
        assert!(text.lines().count() < 40, "{} lines\n{text}", text.lines().count());
        assert!(widest(&text) <= 100, "{text}");
        assert!(
            text.contains("4 × 4 grippers, 90 steps, a sheet of 9 nodes\npath plan\n"),
            "{text}"
        );
        let rest = details(&result);
        assert!(rest.lines().count() > 90 + result.summary.limits.len() && widest(&rest) <= 100);
    }

    /// Load and pull are shown beside their limits, or as having none.
    #[test]
    fn margins_say_which_force_has_no_limit() {
        let mut result = sample::sheet(4, 2, 3);
        result.summary.limits = vec![verdict_of(Name::GripperLoad, 0.5, 10.0)];
        let text = verdict(&result, Ink::Plain);
        let wanted = "accepted by the sheet in an ideal cell, without errors\n\
            largest load of a gripper 0.5 N (limit 10 N), largest pull 0.4 N (no limit)\n";
        assert_eq!(text, wanted);
    }

    /// What a cup bears is shown beside what it holds, which is more than its limit by the safety.
    #[test]
    fn margins_say_what_a_cup_holds() {
        let mut result = sample::sheet(4, 2, 3);
        result.scene.settings.pad.slip_force = Some(10.0);
        let at = "gripper g3_1".to_owned();
        let worst = Worst { value: 4.4, at, place: None };
        result.summary.limits = vec![Verdict::new(Name::Slip, worst, 10.0 / 1.5, Some(2))];
        let text = verdict(&result, Ink::Plain);
        let wanted = "accepted by the sheet in an ideal cell, without errors\n\
            largest load of a cup 4.4 of 10 N along the ply (g3_1)\n";
        assert_eq!(text, wanted);
    }

    /// A sheet that is not at rest keeps its limits in vain, and says so.
    #[test]
    fn a_drape_without_an_end_says_how_it_ended() {
        let mut result = sample::sheet(4, 2, 3);
        result.summary.status = Status::NotAtRest;
        let text = verdict(&result, Ink::Plain);
        let wanted = "not accepted by the sheet\nthe sheet is not at rest at the end\n";
        assert!(text.starts_with(wanted), "{text}");
        result.summary.limits = vec![verdict_of(Name::Height, 1.2, 0.5)];
        let text = verdict(&result, Ink::Plain);
        assert!(
            text.starts_with("not accepted by the sheet: height 1.2 mm against 0.5 mm in"),
            "{text}"
        );
        assert!(widest(&text) <= 100);
    }
}
