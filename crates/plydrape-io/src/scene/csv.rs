//! Tables of gripper positions in CSV files, read so that a fault points at its field.
//!
//! The first line names the columns, each with its unit in round brackets, as in `x (mm)`; without
//! one a column is in SI units. Columns come in any order and others are ignored. Lines that are
//! empty or start with `#` are skipped. Fields may stand in double quotes but hold no commas.

use super::source::{Document, excerpt};
use super::units::{self, Dimension};
use crate::Error;
use std::ops::Range;

/// A column that a table must have.
#[derive(Debug, Clone, Copy)]
pub(super) struct Column {
    pub name: &'static str,
    pub dimension: Dimension,
}

/// A table whose header is read.
pub(super) struct Csv<'a> {
    document: &'a Document,
    /// Place of each expected column in a row, and the size of its unit.
    columns: Vec<(usize, f64)>,
    expected: &'a [Column],
    /// The header's bytes.
    pub header: Range<usize>,
}

/// One row: its bytes, and those of its fields.
pub(super) struct Row<'a> {
    csv: &'a Csv<'a>,
    pub span: Range<usize>,
    fields: Vec<Range<usize>>,
}

impl<'a> Csv<'a> {
    /// Reads the header.
    pub fn new(document: &'a Document, expected: &'a [Column]) -> Result<Self, Error> {
        let names: Vec<&str> = expected.iter().map(|column| column.name).collect();
        let help = format!("its first line names the columns {}", names.join(", "));
        let Some(header) = lines(&document.text).next() else {
            return Err(document.error_anywhere(format!("`{}` is empty", document.file), help));
        };
        let fields = fields(&document.text, &header);
        let mut columns = Vec::with_capacity(expected.len());
        for column in expected {
            let found = fields.iter().position(|field| {
                let title = &document.text[field.clone()];
                title.split('(').next().unwrap_or_default().trim() == column.name
            });
            let Some(index) = found else {
                let mut help = help.clone();
                if fields.len() == 1 && document.text[header.clone()].contains([';', '\t']) {
                    help.push_str(", separated by commas");
                }
                return Err(document.error(
                    header.clone(),
                    format!("the column `{}` is missing", column.name),
                    help,
                ));
            };
            columns.push((index, unit_size(document, fields[index].clone(), column.dimension)?));
        }
        Ok(Csv { document, columns, expected, header })
    }

    /// The rows below the header.
    pub fn rows(&self) -> impl Iterator<Item = Row<'_>> {
        lines(&self.document.text).skip(1).map(|span| Row {
            csv: self,
            fields: fields(&self.document.text, &span),
            span,
        })
    }
}

impl Row<'_> {
    /// The bytes of an expected column's field; the whole row where it has none.
    pub fn place(&self, column: usize) -> Range<usize> {
        let (index, _) = self.csv.columns[column];
        self.fields.get(index).unwrap_or(&self.span).clone()
    }

    /// The text in an expected column.
    pub fn text(&self, column: usize) -> Result<&str, Error> {
        let (index, _) = self.csv.columns[column];
        match self.fields.get(index) {
            Some(field) if !field.is_empty() => Ok(&self.csv.document.text[field.clone()]),
            _ => Err(self.csv.document.error(
                self.span.clone(),
                format!(
                    "this row has no value for the column `{}`",
                    self.csv.expected[column].name
                ),
                format!("every row has {} fields or more, separated by commas", index + 1),
            )),
        }
    }

    /// The number in an expected column, in SI units.
    pub fn number(&self, column: usize) -> Result<f64, Error> {
        let text = self.text(column)?;
        match text.parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value * self.csv.columns[column].1),
            _ => Err(self.fault(
                column,
                format!("{} is no finite number", self.csv.document.quoted(&self.place(column))),
                "write numbers as 0.098 or 9.8e-2; the unit belongs into the header, as in `x (mm)`",
            )),
        }
    }

    /// The whole number in an expected column.
    pub fn whole(&self, column: usize) -> Result<usize, Error> {
        let text = self.text(column)?;
        text.parse().map_err(|_| {
            self.fault(
                column,
                format!("{} is no whole number", self.csv.document.quoted(&self.place(column))),
                "gripper indices are whole numbers from 0",
            )
        })
    }

    /// An error at an expected column's field.
    pub fn fault(
        &self,
        column: usize,
        message: impl Into<String>,
        help: impl Into<String>,
    ) -> Error {
        self.csv.document.error(self.place(column), message, help)
    }
}

/// The unit in a column's title, `x (mm)`.
fn unit_size(document: &Document, title: Range<usize>, dimension: Dimension) -> Result<f64, Error> {
    let text = &document.text[title.clone()];
    let Some((_, tail)) = text.split_once('(') else {
        return Ok(1.0);
    };
    let written = tail.trim_end();
    let written = written.strip_suffix(')').unwrap_or(written);
    match units::unit(written) {
        Ok((size, found)) if found == dimension => Ok(size),
        Ok((_, found)) => Err(document.error(
            title,
            format!("`{}` is the unit of {found}", excerpt(written)),
            format!("{dimension} is wanted in this column"),
        )),
        Err(fault) => Err(document.error(
            title,
            format!("the unit in `{}` cannot be read: {}", excerpt(text), fault.message),
            fault.help,
        )),
    }
}

/// The bytes of every line that says something.
pub(super) fn lines(text: &str) -> impl Iterator<Item = Range<usize>> {
    let mut start = 0;
    text.split_inclusive('\n').filter_map(move |line| {
        let from = start;
        start += line.len();
        let text = line.trim_end();
        (!text.is_empty() && !text.starts_with('#')).then_some(from..from + text.len())
    })
}

/// The bytes of the fields of a line, without spaces and quotes around them.
fn fields(text: &str, line: &Range<usize>) -> Vec<Range<usize>> {
    let mut start = line.start;
    let mut found = Vec::new();
    for field in text[line.clone()].split(',') {
        let bare = field.trim().trim_matches('"').trim();
        let offset = field.find(bare).unwrap_or_default();
        found.push(start + offset..start + offset + bare.len());
        start += field.len() + 1;
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const COLUMNS: [Column; 2] = [
        Column { name: "t", dimension: Dimension::TIME },
        Column { name: "x", dimension: Dimension::LENGTH },
    ];

    #[test]
    fn columns_are_found_by_name_and_scaled_by_their_unit() {
        let document = Document::new("a.csv", "# note\nx (mm), q, \"t (ms)\"\r\n98, 0, 500\r\n\n");
        let csv = Csv::new(&document, &COLUMNS).unwrap();
        let rows: Vec<_> = csv.rows().collect();
        assert_eq!(rows.len(), 1);
        assert_eq!(rows[0].number(0).unwrap(), 0.5);
        assert!((rows[0].number(1).unwrap() - 0.098).abs() < 1e-15);
    }

    proptest! {
        /// No text makes the reader panic, be it random or nearly a table.
        #[test]
        fn any_text_is_read_or_refused(text in "\\PC*", near in "t ?\\(?[ms]{0,2}\\)?,x\\n([0-9.,e\" #°\\-]{0,9}\\r?\\n?){0,4}") {
            for text in [text, near] {
                let document = Document::new("a.csv", &text);
                if let Ok(csv) = Csv::new(&document, &COLUMNS) {
                    for row in csv.rows() {
                        prop_assert!(row.number(0).is_ok_and(f64::is_finite) || row.number(0).is_err());
                        prop_assert!(row.whole(1).is_ok() || row.whole(1).is_err());
                    }
                }
            }
        }
    }

    #[test]
    fn a_fault_points_at_its_field() {
        let document = Document::new("a.csv", "t,x (mm)\n0, 12mm\n");
        let csv = Csv::new(&document, &COLUMNS).unwrap();
        let row = csv.rows().next().unwrap();
        let error = row.number(1).unwrap_err();
        assert_eq!(error.diagnostic().unwrap().line_column(), Some((2, 4)));
        assert_eq!(&document.text[error.diagnostic().unwrap().span.clone().unwrap()], "12mm");
    }
}
