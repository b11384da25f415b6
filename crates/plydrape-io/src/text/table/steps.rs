//! Steps as a table: the worst values of the model that decides, as far as it has them.

use super::{aligned, fixed};
use crate::result::ResultFile;
use plydrape::equilibrium::Status;
use plydrape::measure::Name;
use plydrape::outcome::{Step, Summary};
use std::collections::BTreeSet;
use std::fmt::Write;

/// Most rows of steps that fit a screen.
const ROWS: usize = 10;

/// A column: a measure, its title and the digits after its point.
type Column = (Name, &'static str, usize);

/// Columns that fit a screen.
const SHORT: [Column; 8] = [
    (Name::Gap, "gap mm", 2),
    (Name::ContactShare, "contact %", 1),
    (Name::Slack, "slack mm", 2),
    (Name::Shear, "shear °", 2),
    (Name::Tilt, "tilt °", 2),
    (Name::GripperLoad, "load N", 2),
    (Name::GripperPull, "pull N", 2),
    (Name::Strain, "strain %", 3),
];

/// Columns of the second table of all steps.
const MORE: [Column; 5] = [
    (Name::SlackAngle, "slack °", 2),
    (Name::Wrinkle, "wrinkle mm", 2),
    (Name::Force, "force N", 3),
    (Name::TiltRate, "tilt °/s", 2),
    (Name::OutOfPlane, "out of plane °", 2),
];

/// All steps of the model that decides, one row each: time and worst values; what does not fit the width is in a second table. Steps that were
/// not solved are named below.
#[must_use]
pub fn steps_table(result: &ResultFile) -> String {
    let all = |columns: &[Column]| table(&result.steps, columns, |_| true);
    let more = known(&result.steps, &MORE).next().map(|_| all(&MORE));
    let tables: Vec<String> = [Some(all(&SHORT)), more].into_iter().flatten().collect();
    tables.join("\n") + &failed_solves(result)
}

/// At most ten steps: the first, the first with contact, the last, and some evenly between.
pub(super) fn short(summary: &Summary, steps: &[Step]) -> String {
    let shown = chosen(summary, steps);
    let mut text = table(steps, &SHORT, |n| shown.contains(&n));
    if shown.len() < steps.len() {
        let (some, all) = (shown.len(), steps.len());
        let _ = writeln!(text, "{some} of {all} steps; steps.csv has all");
    }
    text
}

/// The steps that a function picks by their place, with the columns that have a value in any step.
fn table(steps: &[Step], columns: &[Column], pick: impl Fn(usize) -> bool) -> String {
    let columns: Vec<&Column> = known(steps, columns).collect();
    let mut rows = vec![vec!["step".to_owned(), "time s".to_owned()]];
    rows[0].extend(columns.iter().map(|(_, title, _)| (*title).to_owned()));
    rows.extend(steps.iter().enumerate().filter(|(n, _)| pick(*n)).map(|(_, step)| {
        let mut row = vec![step.step.to_string(), fixed(Some(step.time), 2)];
        row.extend(columns.iter().map(|(name, _, digits)| {
            let factor = name.measure().unit().factor;
            fixed(step.measures.value(*name).map(|value| value * factor), *digits)
        }));
        row
    }));
    aligned(&rows, &[])
}

/// The columns that have a value in any step.
fn known<'a>(steps: &[Step], columns: &'a [Column]) -> impl Iterator<Item = &'a Column> {
    let has = |name: Name| steps.iter().any(|step| step.measures.get(name).is_some());
    columns.iter().filter(move |(name, ..)| has(*name))
}

/// Places of the steps to show.
fn chosen(summary: &Summary, steps: &[Step]) -> BTreeSet<usize> {
    let count = steps.len();
    if count <= ROWS {
        return (0..count).collect();
    }
    let contact = summary.first_contact_step();
    let contact = contact.and_then(|first| steps.iter().position(|step| step.step == first));
    // one row less where the first contact has its own
    let even = |parts: usize| (0..=parts).map(move |k| k * (count - 1) / parts);
    match contact.filter(|contact| !even(ROWS - 1).any(|n| n == *contact)) {
        Some(contact) => even(ROWS - 2).chain([contact]).collect(),
        None => even(ROWS - 1).collect(),
    }
}

/// A line for equilibria of catenaries that did not converge, if any.
fn failed_solves(result: &ResultFile) -> String {
    let solver = |step: &'_ Step| {
        let catenaries = step.catenaries.as_ref().filter(|_| !step.is_solved())?;
        Some((step.step, catenaries.solver.status, catenaries.solver.contact))
    };
    let failed: Vec<_> = result.steps.iter().filter_map(solver).collect();
    let Some((step, status, contact)) = failed.first() else { return String::new() };
    let status = match status {
        Status::Converged => contact.name(),
        status => status.name(),
    };
    match failed.len() {
        1 => format!("step {step} did not converge: {status}\n"),
        more => format!("{more} steps did not converge, the first in step {step}: {status}\n"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample;
    use plydrape::measure::Worst;

    /// Every step is there, in aligned columns, with every value: what does not fit the width is in a table below.
    #[test]
    fn the_whole_table_shows_every_step_and_every_column() {
        let mut result = sample::draped(4, 2, 30);
        for (name, ..) in SHORT.iter().chain(&MORE) {
            let worst = Worst { value: 123.456, at: String::new(), place: None };
            result.steps[3].measures.set(*name, Some(worst));
        }
        let text = steps_table(&result);
        let tables: Vec<&str> = text.split("\n\n").collect();
        assert_eq!(tables.len(), 2, "{text}");
        for table in tables {
            assert_eq!(table.lines().count(), 31);
            let widths: BTreeSet<usize> = table.lines().map(|l| l.chars().count()).collect();
            assert!(widths.len() == 1 && widths.last() < Some(&100), "{text}");
        }
        for (_, title, _) in SHORT.iter().chain(&MORE) {
            assert!(text.contains(title), "{title}");
        }
        assert_eq!(steps_table(&sample::sheet(4, 2, 3)).lines().count(), 4);
    }

    /// Of many steps ten at most, among them the first, the last and the first contact.
    #[test]
    fn a_screen_shows_the_steps_that_matter() {
        for steps in [1, 2, 9, 10, 11, 12, 90, 300] {
            let result = sample::draped(4, 2, steps);
            let text = short(&result.summary, &result.steps);
            let rows: Vec<&str> = text.lines().skip(1).collect();
            let told = usize::from(steps > ROWS);
            assert!(rows.len() <= ROWS + told && rows.len() >= steps.min(ROWS - 1), "{text}");
            for step in [1, steps].into_iter().chain(result.summary.first_contact_step()) {
                let begins = |row: &&str| row.split_whitespace().next() == Some(&step.to_string());
                assert!(rows.iter().any(begins), "step {step} in\n{text}");
            }
        }
    }

    /// A model has the columns that it measures and no empty ones.
    #[test]
    fn what_a_model_does_not_measure_has_no_column() {
        let of_catenaries = steps_table(&sample::draped(4, 2, 3));
        let of_sheet = steps_table(&sample::sheet(4, 2, 3));
        for (name, [catenaries, sheet]) in
            [("contact %", [true, false]), ("shear °", [true; 2]), ("load N", [false, true])]
        {
            assert_eq!(of_catenaries.contains(name), catenaries, "{name}\n{of_catenaries}");
            assert_eq!(of_sheet.contains(name), sheet, "{name}\n{of_sheet}");
        }
    }
}
