//! The file of a comparison: `comparison.csv` with all limits of all strategies.

use crate::store::json::finite;
use crate::text::strategy::Row;
use crate::write::csv;
use crate::{Content, Error, Folder};
use ::csv::Writer;
use plydrape::measure::Name;
use std::path::PathBuf;

/// The name of its file.
pub const NAME: &str = "comparison.csv";

/// One row a strategy: whether it is accepted, time, and of every limit its worst value, the limit and where it is.
///
/// # Errors
/// If the table cannot be formed; memory apart there is no known case.
pub fn table(rows: &[Row]) -> Result<String, Error> {
    // the limits of all strategies, each once
    let mut columns: Vec<(Name, &str)> = Vec::new();
    for verdict in rows.iter().flat_map(|row| &row.limits) {
        if !columns.iter().any(|(name, _)| *name == verdict.name) {
            columns.push((verdict.name, &verdict.unit));
        }
    }

    // the header, with four columns for each limit
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

    // a row for each strategy; cells of a limit that it has not are empty
    for row in rows {
        let time = row.time_s.map(csv::number).unwrap_or_default();
        let note = csv::cell(row.note.as_deref().unwrap_or_default());
        let mut cells = vec![row.strategy.to_string(), row.accepted.to_string(), time, note];
        for (name, _) in &columns {
            match row.limit(*name) {
                Some(v) => cells.extend([
                    csv::number(v.value),
                    csv::number(v.limit),
                    v.step.map(|step| step.to_string()).unwrap_or_default(),
                    csv::cell(&v.at),
                ]),
                None => cells.extend([const { String::new() }; 4]),
            }
        }
        table.write_record(&cells)?;
    }
    csv::text(table)
}

/// Writes the table into a folder and returns its path.
///
/// # Errors
/// [`Error`] if a number is not finite, a file in the way is not plydrape's, or the disk refuses.
pub fn write_into(folder: Folder, rows: &[Row]) -> Result<Vec<PathBuf>, Error> {
    finite::check(rows)?;
    let table = table(rows)?;
    let table = table.as_bytes();
    folder.write(&[(NAME, &table as &dyn Content)])
}
