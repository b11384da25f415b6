//! Tables of tests of a material: the CSV files of `plydrape fit`.
//!
//! They are read as testing machines and spreadsheets write them. Lines `# key = value` above them may state a measure of the
//! specimen, as in `# width = 100 mm`.

use super::lab_table::{LabColumn, lab_table};
use super::read;
use super::source::Document;
use super::units::{self, Dimension};
use crate::Error;
use std::path::Path;

/// What a table is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reading {
    /// Displacement and force of a machine: `displacement`, `force`.
    Pull,
    /// Overhangs, one specimen a row: `overhang`.
    Overhang,
    /// Points of a hanging strip: `x`, `z`.
    Points,
    /// A bending test: `curvature`, `moment`.
    Moment,
}

/// A table that was read.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// Its rows (SI); the second number is 0 where there is one column.
    pub rows: Vec<[f64; 2]>,
    /// Measures that comments above it state (SI).
    pub stated: Vec<(&'static str, f64)>,
}

impl Table {
    /// A measure that a comment states (SI).
    #[must_use]
    pub fn stated(&self, key: &str) -> Option<f64> {
        self.stated.iter().find(|(known, _)| *known == key).map(|(_, value)| *value)
    }
}

/// Measures that a comment may state.
const STATED: [(&str, Dimension); 5] = [
    ("width", Dimension::LENGTH),
    ("length", Dimension::LENGTH),
    ("side", Dimension::LENGTH),
    ("fabric", Dimension::LENGTH),
    ("mass", Dimension::AREAL_MASS),
];

impl Reading {
    fn columns(self) -> &'static [LabColumn] {
        const fn column(
            names: &'static [&'static str],
            dimension: Dimension,
            unit: &'static str,
        ) -> LabColumn {
            LabColumn { names, dimension, unit }
        }
        const DISPLACEMENT: &[&str] = &[
            "displacement",
            "extension",
            "crosshead",
            "stroke",
            "travel",
            "weg",
            "standardweg",
            "traversenweg",
        ];
        const FORCE: &[&str] = &["force", "load", "kraft", "standardkraft"];
        const PULL: [LabColumn; 2] =
            [column(DISPLACEMENT, Dimension::LENGTH, "mm"), column(FORCE, Dimension::FORCE, "N")];
        const OVERHANG: [LabColumn; 1] = [column(
            &["overhang", "overhang length", "überhang", "überhanglänge"],
            Dimension::LENGTH,
            "mm",
        )];
        const POINTS: [LabColumn; 2] =
            [column(&["x"], Dimension::LENGTH, "mm"), column(&["z"], Dimension::LENGTH, "mm")];
        const MOMENT: [LabColumn; 2] = [
            column(&["curvature", "krümmung"], Dimension::CURVATURE, "1/m"),
            column(
                &["moment", "bending moment", "moment per width", "biegemoment"],
                Dimension::FORCE,
                "N",
            ),
        ];
        match self {
            Reading::Pull => &PULL,
            Reading::Overhang => &OVERHANG,
            Reading::Points => &POINTS,
            Reading::Moment => &MOMENT,
        }
    }
}

/// Reads a table.
///
/// # Errors
/// The first fault found, with its place and a remedy.
pub fn read_fit(path: &Path, reading: Reading) -> Result<Table, Error> {
    let document = read::lab_text(path, &path.to_string_lossy(), read::LARGEST_CSV)?;
    table(&document, reading)
}

fn table(document: &Document, reading: Reading) -> Result<Table, Error> {
    let stated = stated(document)?;
    let (numbers, header) = lab_table(document, reading.columns())?;
    let mut rows = Vec::with_capacity(numbers.len());
    for row in numbers {
        let [(first, place), rest @ ..] = row.as_slice() else {
            continue;
        };
        if reading == Reading::Overhang && *first <= 0.0 {
            return Err(document.error(
                place.clone(),
                "an overhang is not above zero",
                "give the length of the strip beyond the edge, as in 62 in a column `overhang (mm)`",
            ));
        }
        rows.push([*first, rest.first().map_or(0.0, |(value, _)| *value)]);
    }
    if rows.is_empty() {
        return Err(document.error(
            header,
            format!("`{}` has no rows below its header", document.file),
            "give one row a point",
        ));
    }
    Ok(Table { rows, stated })
}

/// What the comments state.
fn stated(document: &Document) -> Result<Vec<(&'static str, f64)>, Error> {
    let mut found = Vec::new();
    let mut start = 0;
    for line in document.text.split_inclusive('\n') {
        let from = start;
        start += line.len();
        let Some((key, value)) = line.strip_prefix('#').and_then(|line| line.split_once('='))
        else {
            continue;
        };
        let Some((key, dimension)) = STATED.iter().find(|(known, _)| *known == key.trim()) else {
            continue;
        };
        let place = from..from + line.trim_end().len();
        let help = format!("{dimension} is wanted, as in `# {key} = {}`", example(*dimension));
        match units::quantity(value.trim().trim_matches('"')) {
            Ok((value, Some(unit))) if unit == *dimension && value.is_finite() => {
                found.push((*key, value));
            }
            Ok((_, Some(unit))) => {
                return Err(document.error(place, format!("`{key}` is {unit} here"), help));
            }
            Ok((_, None)) => {
                return Err(document.error(place, format!("`{key}` has no unit here"), help));
            }
            Err(fault) => {
                let message = format!("`{key}` cannot be read: {}", fault.message);
                return Err(document.error(place, message, help));
            }
        }
    }
    Ok(found)
}

fn example(dimension: Dimension) -> &'static str {
    if dimension == Dimension::LENGTH { "100 mm" } else { "314 g/m^2" }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(text: &str, reading: Reading) -> Result<Table, Error> {
        table(&Document::new("test.csv", text), reading)
    }

    #[test]
    fn columns_have_units_and_comments_state_measures() {
        let text = "# width = 100 mm\n# by hand\ndisplacement (mm),force (N)\n0,0\n2,0.5\n";
        let table = of(text, Reading::Pull).unwrap();
        assert_eq!(table.rows, [[0.0, 0.0], [0.002, 0.5]]);
        assert_eq!((table.stated("width"), table.stated("length")), (Some(0.1), None));
        let text = "curvature (1/mm),moment (N mm/mm)\n0.02,0.1\n";
        assert_eq!(of(text, Reading::Moment).unwrap().rows, [[20.0, 0.1]]);
    }

    #[test]
    fn faults_have_a_place_and_a_remedy() {
        for (text, reading, message) in [
            ("displacement (mm),force (mm)\n", Reading::Pull, "`mm` is the unit of a length"),
            ("displacement (mm)\n1\n", Reading::Pull, "the column `force` is missing"),
            ("x,z\n", Reading::Points, "`test.csv` has no rows below its header"),
            ("x,z\n0.1,oops\n", Reading::Points, "`oops` is no finite number"),
            ("overhang (mm)\n62\n-3\n", Reading::Overhang, "an overhang is not above zero"),
            ("# width = 100 N\nx,z\n0,0\n", Reading::Points, "`width` is a force here"),
            ("# width = 100\nx,z\n0,0\n", Reading::Points, "`width` has no unit here"),
        ] {
            let error = of(text, reading).unwrap_err();
            assert_eq!(error.message(), message);
            assert!(error.diagnostic().unwrap().span.is_some() && !error.help().is_empty());
        }
    }
}
