//! `plydrape plan --compare`: drapes a scene by every named strategy, and says which one lays the ply down and why the others
//! do not.

use crate::failure::Done;
use crate::results::{Results, place};
use crate::search::Search;
use crate::watch::Interrupt;
use plydrape::measure::Verdict;
use plydrape::planner::comparison::{StrategyName, compare};
use plydrape::planner::infeasible_limits::with_spring_back;
use plydrape_io::Folder;
use plydrape_io::scene::SceneFile;
use plydrape_io::text::strategy::Row;
use plydrape_io::text::table;
use plydrape_io::write::comparison::{self, NAME};
use serde::Serialize;
use std::process::ExitCode;

/// What `--json` prints.
#[derive(Serialize)]
struct Printed<'a> {
    strategies: &'a [Row],
    best: Option<StrategyName>,
    infeasible_limits: Vec<Verdict>,
    interrupted: bool,
    time_s: f64,
}

/// Drapes by all strategies, writes the table, and judges.
pub fn run(results: &Results, scene: &SceneFile, interrupt: &Interrupt, quiet: bool) -> Done {
    let folder = Folder::claim(&results.folder("compare"), "plan --compare", &scene.files)?;
    folder.refuse_taken(&[NAME])?;

    // the drapes; where not all were made, no strategy is the best
    let mut search = Search::counted(StrategyName::ALL.len(), "strategies", None, interrupt, quiet);
    let compared = compare(scene, &mut |progress| search.watch(progress));
    let (took, _) = search.finish();
    let compared = compared?;
    let interrupted = compared.interrupted;
    let best = compared.best().map(|(name, _)| name).filter(|_| !interrupted);

    // an interrupted table takes the place of no other
    let rows: Vec<Row> = compared.strategies.into_iter().map(Row::new).collect();
    let (folder, _kept) = place(folder, interrupted, |dir| !dir.join(NAME).exists())?;
    let files = comparison::write_into(folder, &rows)?;

    // the limits that no plan can keep, then the strategies side by side
    let found = with_spring_back(scene, false, &|| interrupt.asked().is_break());
    let mut text = format!("{}\n\n", scene.title);
    if !found.is_empty() {
        text += &format!("{}\n", table::infeasible_limits(&found));
    }
    text += &table::comparison(&rows, best);

    // accepted if one strategy is
    let accepted = rows.iter().any(|row| row.accepted);
    let time_s = took.as_secs_f64();
    let printed =
        Printed { strategies: &rows, best, infeasible_limits: found, interrupted, time_s };
    results.print(quiet, &printed, &text, &files)?;
    Ok(match (interrupted, accepted) {
        (true, _) => ExitCode::from(130),
        (false, true) => ExitCode::SUCCESS,
        (false, false) => ExitCode::from(1),
    })
}
