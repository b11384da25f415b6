//! The files of a comparison: `comparison.csv` with all limits of all strategies, and `comparison.svg` with how each one ends.

use crate::sheet::{self, SheetDrapeError, ended};
use crate::{Content, Folder, OutputError, ResultFile, csv, figure};
use ::csv::Writer;
use plydrape::measure::{Name, Verdict};
use plydrape::planner::comparison::{Compared, Comparison, StrategyName};
use plydrape::scene::Scene;
use serde::Serialize;
use std::path::{Path, PathBuf};

/// The names of its files.
pub const NAMES: [&str; 2] = ["comparison.csv", "comparison.svg"];

/// One strategy of a comparison, as it is printed and written.
#[derive(Debug, Clone, Serialize)]
pub struct Row {
    /// The strategy.
    pub strategy: StrategyName,
    /// Whether its drape keeps all limits.
    pub accepted: bool,
    /// The time of its motion (s); none without a drape.
    pub time_s: Option<f64>,
    /// Whether there is no drape.
    pub not_draped: bool,
    /// Why there is no drape, or why it ended early or without rest.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub note: Option<String>,
    /// The limits that decide.
    pub limits: Vec<Verdict>,
    /// The limits that it breaks, the one exceeded furthest first.
    #[serde(skip)]
    pub broken: Vec<Verdict>,
    /// Its drape.
    #[serde(skip)]
    pub result: Option<ResultFile>,
}

impl Row {
    /// The row of a strategy; the states of its sheet are kept in a hidden folder within `dir`.
    ///
    /// # Errors
    /// If the disk refuses.
    pub fn new(scene: &Scene, compared: Compared, dir: &Path) -> Result<Self, SheetDrapeError> {
        let strategy = compared.name;
        let draped = match compared.drape {
            Ok(draped) => draped,
            Err(reason) => {
                return Ok(Row {
                    strategy,
                    accepted: false,
                    time_s: None,
                    not_draped: true,
                    note: Some(reason.to_string()),
                    limits: Vec::new(),
                    broken: Vec::new(),
                    result: None,
                });
            }
        };
        let owned = |limits: Vec<&Verdict>| limits.into_iter().cloned().collect();
        let (limits, broken) = (owned(draped.limits()), owned(draped.broken()));
        let (accepted, time_s) = (draped.is_accepted(), Some(draped.time));
        let result = ResultFile::new(scene, None, sheet::keep(draped.drape, dir)?);
        let (note, result) = (ended(&result.summary), Some(result));
        Ok(Row { strategy, accepted, time_s, not_draped: false, note, limits, broken, result })
    }

    /// The verdict on one limit.
    #[must_use]
    pub fn limit(&self, name: Name) -> Option<&Verdict> {
        self.limits.iter().find(|verdict| verdict.name == name)
    }
}

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
