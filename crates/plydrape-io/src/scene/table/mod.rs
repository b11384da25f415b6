//! Tables as machines, spreadsheets and people write them: the one reader of all CSV files.
//!
//! Columns are separated by semicolons, tabs or commas, and numbers have a decimal point or a decimal comma. Lines above the header and other
//! columns are passed over; lines that are empty or start with `#` are skipped. A column is found by its names, see [`title`], its unit
//! follows the name or has a line of its own below the header; without one it is in SI units. Fields are those of the crate
//! `csv-core`, a line at a time, so that every fault has the place of its field. What could be read in two ways is refused, see [`mark`].

mod header;
mod mark;
pub(super) mod title;

use super::source::Document;
use super::units::Dimension;
use crate::Error;
use csv_core::{ReadFieldResult, Reader, ReaderBuilder};
use header::Header;
use std::cell::RefCell;
use std::ops::Range;

/// A column that a table must have.
#[derive(Debug, Clone, Copy)]
pub(super) struct Column {
    /// Titles that it may have, in small letters without accents; the first is that of messages.
    pub names: &'static [&'static str],
    /// Words that a title of it may end in, as in `tensile extension`.
    pub last_words: &'static [&'static str],
    /// What the last word of a title may end in, as in the German `Traversenweg`.
    pub endings: &'static [&'static str],
    /// What it measures; none for names and whole numbers.
    pub dimension: Dimension,
    /// Unit in examples.
    pub unit: &'static str,
    /// The option that names the column where its title is another one.
    pub option: Option<&'static str>,
    /// What its largest number is in practice, where a number without a unit is asked about.
    pub plain: Option<&'static Plain>,
}

/// What the largest number of a column is in practice (SI).
#[derive(Debug)]
pub(super) struct Plain {
    /// The smallest and the largest that is believed without a unit.
    pub believed: [f64; 2],
    /// That range as text.
    pub words: &'static str,
}

impl Column {
    /// A column that has one of these names and no other.
    pub const fn named(names: &'static [&'static str], dimension: Dimension) -> Self {
        Column {
            names,
            last_words: &[],
            endings: &[],
            dimension,
            unit: "mm",
            option: None,
            plain: None,
        }
    }

    fn name(&self) -> &'static str {
        self.names[0]
    }
}

/// What may separate columns.
const SEPARATORS: [u8; 3] = [b';', b'\t', b','];

/// A table whose header is read.
pub(super) struct Table<'a> {
    document: &'a Document,
    expected: &'a [Column],
    found: Header,
}

/// The title of a column.
pub(super) struct Title {
    /// The name as names are compared.
    pub name: String,
    /// Unit, where the title says one.
    pub unit: Option<String>,
    /// Bytes.
    pub place: Range<usize>,
}

/// One row: its bytes, and those of its fields.
pub(super) struct Row<'a> {
    table: &'a Table<'a>,
    pub span: Range<usize>,
    fields: Vec<Range<usize>>,
}

impl<'a> Table<'a> {
    /// Reads the header, and how numbers are written; `chosen` are the titles of columns that options name.
    ///
    /// # Errors
    /// The first fault found, with its place and a remedy.
    pub fn new(
        document: &'a Document,
        expected: &'a [Column],
        chosen: &[Option<&str>],
    ) -> Result<Self, Error> {
        let mut table =
            Table { document, expected, found: header::find(document, expected, chosen)? };
        let below = table.lines().next();
        if let Some(row) = below
            && header::units_below(document, expected, &mut table.found, &row)?
        {
            table.found.rows = row.end;
        }
        mark::check(&table)?;
        Ok(table)
    }

    /// The header's bytes.
    pub fn header(&self) -> Range<usize> {
        self.found.span.clone()
    }

    /// The title of each column.
    pub fn titles(&self) -> Vec<Title> {
        let text = &self.document.text;
        let fields = fields(self.found.separator, text, &self.found.span);
        let title_of = |place: Range<usize>| {
            let (name, unit) = title::title(&text[place.clone()]);
            Title { name, unit: unit.map(str::to_owned), place }
        };
        fields.into_iter().map(title_of).collect()
    }

    /// The lines of rows that say something.
    fn lines(&self) -> impl Iterator<Item = Range<usize>> {
        let (text, separator) = (&self.document.text, char::from(self.found.separator));
        lines(text)
            .skip_while(|line| line.start < self.found.rows)
            .filter(move |line| !text[line.clone()].chars().all(|c| c == separator || c == ' '))
    }

    /// The rows below the header.
    pub fn rows(&self) -> impl Iterator<Item = Row<'_>> {
        self.lines().map(move |span| Row {
            table: self,
            fields: fields(self.found.separator, &self.document.text, &span),
            span,
        })
    }

    /// Whether the unit of an expected column is said.
    pub fn has_unit(&self, column: usize) -> bool {
        self.found.columns[column].1.is_some()
    }

    /// Refuses numbers without a unit whose largest is not what is found in practice.
    ///
    /// # Errors
    /// At the largest number of such a column.
    pub fn check_plain(&self) -> Result<(), Error> {
        for (n, column) in self.expected.iter().enumerate() {
            // the largest number of a column that has no unit
            let (Some(plain), None) = (column.plain, self.found.columns[n].1) else { continue };
            let mut largest: Option<(f64, Range<usize>)> = None;
            for row in self.rows() {
                let value = row.number(n)?.abs();
                if largest.as_ref().is_none_or(|(most, _)| value > *most) {
                    largest = Some((value, row.place(n)));
                }
            }
            // where it is not found in practice, another unit was probably meant
            let [least, most] = plain.believed;
            if let Some((value, place)) = largest
                && (value > most || (value < least && value > 0.0))
            {
                let name = column.name();
                let (number, unit) = (self.document.quoted(&place), si(column.dimension));
                let written = self.document.excerpt(&place).replace(',', ".");
                return Err(self.document.error(
                    place,
                    format!(
                        "the column `{name}` has no unit, and {number} would be {} {unit}",
                        written.trim_start_matches('+')
                    ),
                    format!(
                        "name the unit in the header, as in `{name} ({})`; {}",
                        column.unit, plain.words
                    ),
                ));
            }
        }
        Ok(())
    }
}

impl Row<'_> {
    /// The bytes of an expected column's field; the whole row where it has none.
    pub fn place(&self, column: usize) -> Range<usize> {
        let (index, _) = self.table.found.columns[column];
        self.fields.get(index).unwrap_or(&self.span).clone()
    }

    /// The text in any column.
    pub fn field(&self, index: usize) -> &str {
        self.fields.get(index).map_or("", |field| &self.table.document.text[field.clone()])
    }

    /// The number in any column, in the unit of that.
    pub fn value(&self, index: usize) -> Option<f64> {
        mark::number(self.field(index))
    }

    /// The text in an expected column.
    pub fn text(&self, column: usize) -> Result<&str, Error> {
        // a row with more fields than the header: perhaps decimal commas cut its numbers in two
        let Header { columns, fields, separator, .. } = &self.table.found;
        let filled = self.fields.iter().rposition(|field| !field.is_empty());
        if let Some(last) = filled
            && last >= *fields
        {
            return Err(self.table.document.error(
                self.span.clone(),
                format!("this row has {} fields and the header {fields}", last + 1),
                "where numbers have a decimal comma, separate the columns by semicolons, or write numbers with a decimal point",
            ));
        }

        // the field of the column, which every row must fill
        let (index, _) = columns[column];
        let text = self.field(index);
        if !text.is_empty() {
            return Ok(text);
        }
        let between = match separator {
            b';' => "semicolons",
            b'\t' => "tabs",
            _ => "commas",
        };
        Err(self.table.document.error(
            self.span.clone(),
            format!(
                "this row has no value for the column `{}`",
                self.table.expected[column].name()
            ),
            format!("every row has {} fields or more, separated by {between}", index + 1),
        ))
    }

    /// The number in an expected column, in SI units.
    pub fn number(&self, column: usize) -> Result<f64, Error> {
        let text = self.text(column)?;
        let (_, size) = self.table.found.columns[column];
        if text.contains(',') && text.contains('.') {
            let what = "has a separator of thousands";
            return Err(self.refused(column, what, &mark::without_thousands(text)));
        }
        match mark::number(text) {
            Some(value) => Ok(value * size.unwrap_or(1.0)),
            None => Err(self.refused(
                column,
                "is no finite number",
                "write numbers as 0.098 or 9.8e-2; the unit belongs into the header, as in `x (mm)`",
            )),
        }
    }

    /// The whole number in an expected column.
    pub fn whole(&self, column: usize) -> Result<usize, Error> {
        let text = self.text(column)?;
        text.parse().map_err(|_| {
            self.refused(column, "is no whole number", "gripper indices are whole numbers from 0")
        })
    }

    fn refused(&self, column: usize, what: &str, help: &str) -> Error {
        let written = self.table.document.quoted(&self.place(column));
        self.fault(column, format!("{written} {what}"), help)
    }

    /// An error at an expected column's field.
    pub fn fault(
        &self,
        column: usize,
        message: impl Into<String>,
        help: impl Into<String>,
    ) -> Error {
        self.table.document.error(self.place(column), message, help)
    }
}

/// The SI unit of a column in messages.
fn si(dimension: Dimension) -> &'static str {
    match dimension {
        Dimension::LENGTH => "m",
        Dimension::FORCE => "N",
        Dimension::CURVATURE => "1/m",
        _ => "in SI units",
    }
}

/// The bytes of every line that says something.
pub(super) fn lines(text: &str) -> impl Iterator<Item = Range<usize>> {
    let mut start = 0;
    text.split_inclusive('\n').filter_map(move |line| {
        let from = start;
        start += line.len();
        let text = line.trim_end_matches(['\n', '\r', ' ']);
        let said = text.trim();
        let comment = said.trim_start_matches('"').starts_with('#');
        (!said.is_empty() && !comment).then_some(from..from + text.len())
    })
}

thread_local! {
    /// A reader of each of [`SEPARATORS`]: to build one takes much longer than to read a line, and a header is looked for with many.
    static READERS: RefCell<[Reader; 3]> =
        RefCell::new(SEPARATORS.map(|byte| ReaderBuilder::new().delimiter(byte).build()));
}

/// The bytes of the fields of a line, without spaces and quotes around them; within quotes nothing separates.
fn fields(separator: u8, text: &str, line: &Range<usize>) -> Vec<Range<usize>> {
    READERS.with_borrow_mut(|[semicolon, tab, comma]| {
        let reader = match separator {
            b';' => semicolon,
            b'\t' => tab,
            _ => comma,
        };
        read_fields(reader, text, line)
    })
}

fn read_fields(reader: &mut Reader, text: &str, line: &Range<usize>) -> Vec<Range<usize>> {
    let bytes = &text.as_bytes()[line.clone()];
    let mut found = Vec::new();
    let (mut start, mut at) = (0, 0);
    // what a field says is read from the text itself
    let mut said = [0; 256];
    reader.reset();
    loop {
        let (result, read, _) = reader.read_field(&bytes[at..], &mut said);
        at += read;
        match result {
            ReadFieldResult::Field { record_end } => {
                // the separator was read with the field before it
                let end = if record_end { at } else { at - 1 };
                let field = text.get(line.start + start..line.start + end).unwrap_or_default();
                let inner = field.trim().trim_matches('"').trim();
                let offset = line.start + start + field.find(inner).unwrap_or_default();
                found.push(offset..offset + inner.len());
                start = at;
                if record_end {
                    return found;
                }
            }
            ReadFieldResult::End => return found,
            ReadFieldResult::InputEmpty | ReadFieldResult::OutputFull => {}
        }
    }
}

#[cfg(test)]
mod tests;
