//! Tables as testing machines and spreadsheets write them.
//!
//! Columns stand between semicolons, tabs or commas, and numbers have a decimal point or a decimal comma. Lines above the header
//! are passed over. A column is found by the names that machines give it in English and German, whatever their capitals. Its unit
//! stands behind the name, as in `Force (N)`, `Kraft [N]`, `force / N` and `force_N`, or in a line of its own below the header.

use super::csv::lines;
use super::source::{Document, excerpt};
use super::units::{self, Dimension};
use crate::Error;
use std::ops::Range;

/// A column that a table must have.
#[derive(Debug, Clone, Copy)]
pub(super) struct LabColumn {
    /// What it may be called, in small letters; the first name is that of messages.
    pub names: &'static [&'static str],
    /// What it measures.
    pub dimension: Dimension,
    /// Its unit in examples.
    pub unit: &'static str,
}

/// A number of a table (SI) and where it stands.
pub(super) type Number = (f64, Range<usize>);

/// What may stand between columns. A line that is a header by one of the first two is none by commas.
const SEPARATORS: [char; 3] = [';', '\t', ','];
/// Most lines that are looked at for the header.
const HEAD: usize = 1000;
/// Largest length that is believed without a unit (m).
const LARGEST_PLAIN: f64 = 2.0;

/// Where the columns of a table stand.
struct Header {
    separator: char,
    /// Bytes of its line.
    span: Range<usize>,
    /// Number of its fields.
    fields: usize,
    /// Place of each column in a row, and the size of its unit where one is said.
    columns: Vec<(usize, Option<f64>)>,
}

/// Reads the columns of a table: for each row one number a column, and the bytes of the header.
///
/// # Errors
/// The first fault found, with its place and a remedy.
pub(super) fn lab_table(
    document: &Document,
    wanted: &[LabColumn],
) -> Result<(Vec<Vec<Number>>, Range<usize>), Error> {
    let mut header = header(document, wanted)?;
    let below = header.span.end;
    let mut rows = lines(&document.text)
        .skip_while(|line| line.start < below)
        .filter(|line| !document.text[line.clone()].chars().all(|c| SEPARATORS.contains(&c)))
        .peekable();
    if let Some(row) = rows.peek()
        && units_below(document, wanted, &mut header, row)?
    {
        rows.next();
    }
    let mut mark = None;
    let mut table = Vec::new();
    for row in rows {
        table.push(numbers(document, wanted, &header, &row, &mut mark)?);
    }
    Ok((table, header.span))
}

/// The first line that names all columns.
fn header(document: &Document, wanted: &[LabColumn]) -> Result<Header, Error> {
    // the line that names most of them, and those that it does not name
    let mut nearest: Option<(Range<usize>, Vec<&LabColumn>)> = None;
    for line in lines(&document.text).take(HEAD) {
        for separator in SEPARATORS {
            let fields = fields(&document.text, &line, separator);
            let titles: Vec<_> =
                fields.iter().map(|field| title(&document.text[field.clone()])).collect();
            let place = |column: &LabColumn| {
                let at = |name: &&str| titles.iter().position(|(title, _)| title == name);
                column.names.iter().find_map(at)
            };
            let missing: Vec<_> = wanted.iter().filter(|column| place(column).is_none()).collect();
            if missing.is_empty() {
                let mut columns = Vec::with_capacity(wanted.len());
                for column in wanted {
                    let index = place(column).unwrap_or_default();
                    let size = match titles[index].1 {
                        Some(unit) => {
                            Some(size(document, fields[index].clone(), unit, column.dimension)?)
                        }
                        None => None,
                    };
                    columns.push((index, size));
                }
                return Ok(Header { separator, span: line, fields: fields.len(), columns });
            }
            if nearest.as_ref().is_none_or(|(_, least)| missing.len() < least.len()) {
                nearest = Some((line.clone(), missing));
            }
        }
    }
    let example: Vec<String> =
        wanted.iter().map(|column| format!("`{} ({})`", column.names[0], column.unit)).collect();
    let mut help =
        format!("the line above the numbers names the columns, as in {}", example.join(" and "));
    let Some((line, missing)) = nearest else {
        return Err(document.error_anywhere(format!("`{}` is empty", document.file), help));
    };
    for column in &missing {
        if let [name, others @ ..] = column.names
            && !others.is_empty()
        {
            help.push_str(&format!("; `{name}` may also be called {}", others.join(", ")));
        }
    }
    let message = format!("the column `{}` is missing", missing[0].names[0]);
    Err(document.error(line, message, help))
}

/// Takes the units from a line below the header that has no numbers; whether it is one.
fn units_below(
    document: &Document,
    wanted: &[LabColumn],
    header: &mut Header,
    row: &Range<usize>,
) -> Result<bool, Error> {
    let fields = fields(&document.text, row, header.separator);
    let said: Vec<Option<&Range<usize>>> = header
        .columns
        .iter()
        .map(|(index, _)| fields.get(*index).filter(|field| !field.is_empty()))
        .collect();
    let unit = |field: &Range<usize>| bare(&document.text[field.clone()]).to_owned();
    // the second line of a table of numbers, or of one that is broken
    if said.iter().flatten().any(|field| units::unit(&unit(field)).is_err()) {
        return Ok(false);
    }
    if said.iter().flatten().count() == 0 {
        return Ok(false);
    }
    for ((column, (_, known)), field) in wanted.iter().zip(&mut header.columns).zip(said) {
        if let (None, Some(field)) = (*known, field) {
            *known = Some(size(document, field.clone(), &unit(field), column.dimension)?);
        }
    }
    Ok(true)
}

/// The numbers of a row.
fn numbers(
    document: &Document,
    wanted: &[LabColumn],
    header: &Header,
    row: &Range<usize>,
    mark: &mut Option<char>,
) -> Result<Vec<Number>, Error> {
    let fields = fields(&document.text, row, header.separator);
    let filled = fields.iter().rposition(|field| !field.is_empty()).map_or(0, |last| last + 1);
    if filled > header.fields {
        return Err(document.error(
            row.clone(),
            format!("this row has {filled} fields and the header {}", header.fields),
            "where numbers have a decimal comma, separate the columns by semicolons, or write numbers with a decimal point",
        ));
    }
    let mut found = Vec::with_capacity(wanted.len());
    for (column, (index, size)) in wanted.iter().zip(&header.columns) {
        let Some(field) = fields.get(*index).filter(|field| !field.is_empty()) else {
            return Err(document.error(
                row.clone(),
                format!("this row has no value for the column `{}`", column.names[0]),
                format!("it is field {} of each row", index + 1),
            ));
        };
        let value = number(document, field, header.separator, mark)?;
        if size.is_none() && column.dimension == Dimension::LENGTH && value.abs() > LARGEST_PLAIN {
            let name = column.names[0];
            return Err(document.error(
                field.clone(),
                format!(
                    "the column `{name}` has no unit, and {} would be {value} m",
                    document.quoted(field)
                ),
                format!("name the unit in the header, as in `{name} (mm)`"),
            ));
        }
        found.push((value * size.unwrap_or(1.0), field.clone()));
    }
    Ok(found)
}

/// A number with a decimal point or a decimal comma; all of a table have the same mark.
fn number(
    document: &Document,
    field: &Range<usize>,
    separator: char,
    mark: &mut Option<char>,
) -> Result<f64, Error> {
    let text = &document.text[field.clone()];
    let refuse = |what: &str, help: &str| {
        document.error(field.clone(), format!("{} {what}", document.quoted(field)), help)
    };
    let plain = "write numbers with one decimal point or one decimal comma, as in 1088.5";
    let own = match (text.contains('.'), text.contains(',')) {
        (true, true) => return Err(refuse("has a separator of thousands", plain)),
        (true, false) => Some('.'),
        (false, true) => Some(','),
        (false, false) => None,
    };
    let number = text.replace(',', ".").parse::<f64>().ok().filter(|value| value.is_finite());
    let Some(number) = number else {
        return Err(refuse(
            "is no finite number",
            "write numbers as 0.098 or 9.8e-2; a unit belongs into the header, as in `x (mm)`",
        ));
    };
    // between commas a comma within quotes may separate thousands, as in "1,088"
    if own == Some(',') && separator == ',' {
        let (whole, part) = text.split_once(',').unwrap_or_default();
        if part.len() == 3 && !whole.trim_start_matches(['-', '+']).starts_with('0') {
            return Err(refuse("may have a decimal comma or a separator of thousands", plain));
        }
    }
    match (own, *mark) {
        (Some(own), Some(other)) if own != other => {
            let name = |mark| if mark == ',' { "comma" } else { "point" };
            let what =
                format!("has a decimal {} where other numbers have a {}", name(own), name(other));
            return Err(refuse(&what, plain));
        }
        (Some(own), None) => *mark = Some(own),
        _ => {}
    }
    Ok(number)
}

/// The size of a unit that stands in a field.
fn size(
    document: &Document,
    field: Range<usize>,
    written: &str,
    dimension: Dimension,
) -> Result<f64, Error> {
    match units::unit(written) {
        Ok((size, found)) if found == dimension => Ok(size),
        Ok((_, found)) => Err(document.error(
            field,
            format!("`{}` is the unit of {found}", excerpt(written)),
            format!("{dimension} is wanted in this column"),
        )),
        Err(fault) => {
            let title = document.excerpt(&field);
            let message = format!("the unit in `{title}` cannot be read: {}", fault.message);
            Err(document.error(field, message, fault.help))
        }
    }
}

/// The name of a column in small letters, and its unit where the title says one.
fn title(text: &str) -> (String, Option<&str>) {
    let text = text.trim();
    let brackets = [('(', ')'), ('[', ']')].into_iter().find_map(|(open, close)| {
        let (name, unit) = text.strip_suffix(close)?.split_once(open)?;
        is_balanced(unit, [open, close]).then_some((name, unit))
    });
    let found = brackets
        .or_else(|| text.split_once('/'))
        .or_else(|| text.split_once(" in "))
        .or_else(|| text.rsplit_once('_').filter(|(_, unit)| units::unit(unit).is_ok()));
    let (name, unit) = match found {
        Some((name, unit)) => (name, Some(bare(unit))),
        None => (text, None),
    };
    let words: Vec<String> = name.split_whitespace().map(str::to_lowercase).collect();
    (words.join(" "), unit)
}

/// Whether each bracket in a text closes behind the one that opens it, as in `N/(m rad)`.
fn is_balanced(text: &str, [open, close]: [char; 2]) -> bool {
    let mut depth = 0;
    text.chars().all(|letter| {
        depth += i32::from(letter == open) - i32::from(letter == close);
        depth >= 0
    }) && depth == 0
}

/// A unit without brackets around it.
fn bare(text: &str) -> &str {
    let text = text.trim();
    let inner = [('(', ')'), ('[', ']')].into_iter().find_map(|(open, close)| {
        let inner = text.strip_prefix(open)?.strip_suffix(close)?;
        is_balanced(inner, [open, close]).then_some(inner)
    });
    inner.map_or(text, bare)
}

/// The bytes of the fields of a line, without spaces and quotes around them; within quotes nothing separates.
fn fields(text: &str, line: &Range<usize>, separator: char) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    let (mut start, mut quoted) = (line.start, false);
    let ends = text[line.clone()].char_indices().filter(|(_, c)| {
        quoted ^= *c == '"';
        *c == separator && !quoted
    });
    for end in ends.map(|(at, _)| line.start + at).chain([line.end]) {
        let field = text.get(start..end).unwrap_or_default();
        let inner = field.trim().trim_matches('"').trim();
        let offset = field.find(inner).unwrap_or_default();
        found.push(start + offset..start + offset + inner.len());
        start = end + 1;
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const PULL: [LabColumn; 2] = [
        LabColumn { names: &["displacement", "weg"], dimension: Dimension::LENGTH, unit: "mm" },
        LabColumn { names: &["force", "kraft"], dimension: Dimension::FORCE, unit: "N" },
    ];

    fn of(text: &str) -> Result<Vec<Vec<f64>>, Error> {
        let (rows, _) = lab_table(&Document::new("test.csv", text), &PULL)?;
        Ok(rows.into_iter().map(|row| row.into_iter().map(|(value, _)| value).collect()).collect())
    }

    /// The same two points, written by hand, by spreadsheets of two countries, and by testing machines.
    #[test]
    fn a_table_reads_the_same_whoever_wrote_it() {
        for text in [
            "displacement (mm),force (N)\n4,0.088\n8,0.191\n",
            "displacement (mm);force (N)\r\n4,0;0,088\r\n8,0;0,191\r\n",
            "Displacement [mm]\tForce [mN]\n4.0\t88\n8.0\t191\n",
            "sep=;\nWeg;Kraft\nmm;N\n4,0;0,088\n8,0;0,191\n;;\n",
            "Operator: J. Smith, 3 pm\nTime,Displacement,Force\n(s),(mm),(N)\n0,4,0.088\n1,8,0.191\n",
            "\"Time\",\"Weg\",\"Kraft\"\n\"s\",\"mm\",\"N\"\n\"0\",\"4,0\",\"0,088\"\n\"1\",\"8,0\",\"0,191\"\n",
            "displacement / mm,force / N,\n4,0.088,\n8,0.191,\n",
            "force_N;displacement_mm;note\n0.088;4;\n0.191;8;slip\n",
            "Kraft in N;Weg in mm\n0,088;4\n0,191;8\n",
        ] {
            let rows = of(text).unwrap_or_else(|error| panic!("{text}: {error}"));
            let expected = [[0.004, 0.088], [0.008, 0.191]];
            assert_eq!(rows.len(), 2, "{text}");
            for (row, expected) in rows.iter().zip(expected) {
                for (value, expected) in row.iter().zip(expected) {
                    assert!((value - expected).abs() < 1e-15, "{text}: {rows:?}");
                }
            }
        }
    }

    /// What could be read in two ways, or not at all, has its place and a remedy.
    #[test]
    fn a_number_that_may_be_another_one_is_refused() {
        for (text, message) in [
            ("displacement (mm),force (N)\n4,0,0,088\n", "this row has 4 fields and the header 2"),
            (
                "displacement (mm),force (N)\n4,\"1,088.5\"\n",
                "`1,088.5` has a separator of thousands",
            ),
            (
                "displacement (mm),force (N)\n4,\"1,088\"\n",
                "`1,088` may have a decimal comma or a separator of thousands",
            ),
            (
                "displacement (mm);force (N)\n4,5;1.088\n",
                "`1.088` has a decimal point where other numbers have a comma",
            ),
            (
                "displacement;force\n4;1\n",
                "the column `displacement` has no unit, and `4` would be 4 m",
            ),
            ("Weg;Kraft\nmm;mm\n4;1\n", "`mm` is the unit of a length"),
            (
                "Weg (furlong);Kraft (N)\n4;1\n",
                "the unit in `Weg (furlong)` cannot be read: `furlong` is no unit known here",
            ),
            ("a;b\nWeg;b\n4;1\n", "the column `force` is missing"),
            ("Weg (mm);Kraft (N)\n4;\n", "this row has no value for the column `force`"),
        ] {
            let error = of(text).unwrap_err();
            assert_eq!(error.message(), message, "{text}");
            assert!(
                error.diagnostic().unwrap().span.is_some() && !error.help().is_empty(),
                "{text}"
            );
        }
        let error = of("a;b\nWeg;b\n4;1\n").unwrap_err();
        assert_eq!(error.diagnostic().unwrap().line_column(), Some((2, 1)));
        assert!(error.help().ends_with("`force` may also be called kraft"), "{}", error.help());
    }

    proptest! {
        /// No text makes the reader panic, be it random or nearly a table.
        #[test]
        fn any_text_is_read_or_refused(text in "\\PC*", near in "weg[;,\t]kraft\\n([0-9.,;\"e #°\\-]{0,9}\\r?\\n?){0,4}") {
            let _ = of(&text);
            let _ = of(&near);
        }
    }
}
