//! The strategies of a comparison as plain text.

use super::{WIDTH, accepted_in, aligned, fixed, verdict_text};
use crate::store::shown;
use crate::text::strategy::Row;
use plydrape::measure::Name;
use plydrape::planner::comparison::StrategyName;
use plydrape::scene::World;

/// How many broken limits of a strategy are shown.
const MOST_BROKEN: usize = 2;

/// One row a strategy, with the limits that it breaks below it, the worst first; last the best strategy.
#[must_use]
pub fn comparison(rows: &[Row], best: Option<StrategyName>) -> String {
    // the cells of the table, a row for each strategy
    let titles = ["strategy", "height mm", "position mm", "tilt °", "time s", "verdict"];
    let mut cells = vec![titles.map(str::to_owned).to_vec()];
    cells.extend(rows.iter().map(|row| {
        let value = |name, digits| fixed(row.limit(name).map(|verdict| verdict.value), digits);
        vec![
            row.strategy.to_string(),
            value(Name::Height, 2),
            value(Name::Position, 2),
            value(Name::Tilt, 1),
            fixed(row.time_s, 1),
            verdict(row).into(),
        ]
    }));

    // below each row the limits that the strategy breaks, and its note
    let table = aligned(&cells, &[0, 5]);
    let mut lines = table.lines();
    let mut text = lines.next().map(|title| format!("{title}\n")).unwrap_or_default();
    for (row, line) in rows.iter().zip(lines) {
        text += &format!("{line}\n");
        let broken = row.broken.iter().take(MOST_BROKEN).map(verdict_text);
        for reason in broken.chain(row.note.clone()) {
            text += &shown::excerpt(&format!("  {reason}"), WIDTH);
            text.push('\n');
        }
    }

    // in which world the accepted ones were judged, and which strategy is the best
    let worlds: Vec<World> = rows.iter().filter(|row| row.accepted).map(|row| row.world).collect();
    text += &accepted_in(&worlds);
    let accepted = |best| rows.iter().any(|row| row.strategy == best && row.accepted);
    text += &match best {
        Some(best) if accepted(best) => format!("\nbest: {best}\n"),
        Some(best) => {
            format!("\nbest: {best}, but none is accepted; without --compare a plan is searched\n")
        }
        None => "\nnot all were draped, so that none is said to be the best\n".into(),
    };
    text
}

/// The verdict on a strategy in a word.
fn verdict(row: &Row) -> &'static str {
    match (row.not_draped, row.accepted) {
        (true, _) => "not draped",
        (false, true) => "accepted",
        (false, false) => "not accepted",
    }
}
