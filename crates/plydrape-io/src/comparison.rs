//! The files of a comparison: `comparison.csv` with all limits of all strategies, and `comparison.svg` with how each one ends.

use crate::sheet::SheetDrapeError;
use crate::strategy::Row;
use crate::{Content, Folder, OutputError, ResultFile, csv, figure};
use ::csv::Writer;
use plydrape::measure::Name;
use plydrape::planner::comparison::Comparison;
use plydrape::scene::Scene;
use std::path::{Path, PathBuf};

/// The names of its files.
pub const NAMES: [&str; 2] = ["comparison.csv", "comparison.svg"];

/// The rows of a comparison; the states of sheets are kept in hidden folders within `dir`.
///
/// # Errors
/// As [`Row::new`].
pub fn rows(
    scene: &Scene,
    comparison: Comparison,
    dir: &Path,
) -> Result<Vec<Row>, SheetDrapeError> {
    comparison.strategies.into_iter().map(|compared| Row::new(scene, compared, dir)).collect()
}

/// One row a strategy: whether it is accepted, time, and of every limit its worst value, the limit and where it is.
///
/// # Errors
/// If the table cannot be formed; memory apart there is no known case.
pub fn table(rows: &[Row]) -> Result<String, ::csv::Error> {
    let mut columns: Vec<(Name, &str)> = Vec::new();
    for verdict in rows.iter().flat_map(|row| &row.limits) {
        if !columns.iter().any(|(name, _)| *name == verdict.name) {
            columns.push((verdict.name, &verdict.unit));
        }
    }
    let mut table = Writer::from_writer(Vec::new());
    let mut header = ["strategy", "accepted", "t (s)", "note"].map(str::to_owned).to_vec();
    for (name, unit) in &columns {
        let label = name.measure().label();
        header.extend([
            format!("{label} ({unit})"),
            format!("{label} limit ({unit})"),
            format!("{label} step"),
            format!("{label} at"),
        ]);
    }
    table.write_record(&header)?;
    for row in rows {
        let time = row.time_s.map(csv::number).unwrap_or_default();
        let note = row.note.clone().unwrap_or_default();
        let mut cells = vec![row.strategy.to_string(), row.accepted.to_string(), time, note];
        for (name, _) in &columns {
            match row.limit(*name) {
                Some(v) => cells.extend([
                    csv::number(v.value),
                    csv::number(v.limit),
                    v.step.map(|step| step.to_string()).unwrap_or_default(),
                    v.at.clone(),
                ]),
                None => cells.extend([const { String::new() }; 4]),
            }
        }
        table.write_record(&cells)?;
    }
    csv::text(table)
}

/// Writes table and picture into a folder, all or none, and returns their paths; files that the run has `read` are not
/// removed.
///
/// # Errors
/// [`OutputError`] if the picture cannot be drawn, a file in the way is not plydrape's, or the disk refuses.
pub fn write_into(
    folder: Folder,
    title: &str,
    rows: &[Row],
    read: &[PathBuf],
) -> Result<Vec<PathBuf>, OutputError> {
    // first of all: no number that is not finite goes on
    rows.iter().filter_map(|row| row.result.as_ref()).try_for_each(ResultFile::check_finite)?;
    let table = table(rows)?;
    let picture = figure::comparison::svg(title, rows)?;
    let [table, picture] = [&table, &picture].map(|text| text.as_bytes());
    let files: [(&str, &dyn Content); 2] = [(NAMES[0], &table), (NAMES[1], &picture)];
    folder.write(&files, read)
}
