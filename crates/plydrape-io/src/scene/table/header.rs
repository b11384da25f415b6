//! The header of a table: the first line that names all columns, and the units below it.

use super::title::{bare, title, words};
use super::{Column, SEPARATORS, fields, lines, mark};
use crate::Error;
use crate::scene::source::{Document, excerpt};
use crate::scene::units::{self, Dimension};
use std::ops::Range;

/// Most lines that are looked at for the header.
const HEAD: usize = 1000;
/// Lines of nothing but numbers above a header that are a table of their own.
const BLOCK: usize = 3;

/// Positions of the columns of a table.
pub(super) struct Header {
    pub separator: u8,
    /// Bytes of its line.
    pub span: Range<usize>,
    /// Where the rows begin.
    pub rows: usize,
    /// Number of its fields.
    pub fields: usize,
    /// Place of each expected column in a row, and the size of its unit where one is said.
    pub columns: Vec<(usize, Option<f64>)>,
}

/// A line as a header.
struct Titles<'a> {
    document: &'a Document,
    fields: Vec<Range<usize>>,
    titles: Vec<(String, Option<&'a str>)>,
}

impl<'a> Titles<'a> {
    fn new(document: &'a Document, line: &Range<usize>, separator: u8) -> Self {
        let fields = fields(separator, &document.text, line);
        let titles = fields.iter().map(|field| title(&document.text[field.clone()])).collect();
        Titles { document, fields, titles }
    }

    /// The fields that are one column.
    fn places(&self, column: &Column, chosen: Option<&str>) -> Vec<usize> {
        let is = |n: &usize| match chosen {
            Some(chosen) => {
                let written = &self.document.text[self.fields[*n].clone()];
                words(written) == words(chosen) || self.titles[*n].0 == title(chosen).0
            }
            None => column.is_called(&self.titles[*n].0),
        };
        let found: Vec<usize> = (0..self.titles.len()).filter(is).collect();
        // of an extension in mm and one in % one is a length
        let fits = |n: &usize| {
            let unit = self.titles[*n].1.and_then(|unit| units::unit(unit).ok());
            unit.is_some_and(|(_, dimension)| dimension == column.dimension)
        };
        match found.iter().filter(|n| fits(n)).count() {
            1 if chosen.is_none() => found.into_iter().filter(fits).collect(),
            _ => found,
        }
    }
}

/// The first line that names all columns; `chosen` are the titles of columns that options name.
pub(super) fn find(
    document: &Document,
    expected: &[Column],
    chosen: &[Option<&str>],
) -> Result<Header, Error> {
    let chosen = |n: usize| chosen.get(n).copied().flatten();
    // the line that names most columns, and those that it does not name
    let mut nearest: Option<(Range<usize>, u8, Vec<usize>)> = None;
    let mut block: Vec<Range<usize>> = Vec::new();
    for line in lines(&document.text).take(HEAD) {
        for separator in separators(document, &line) {
            let titles = Titles::new(document, &line, separator);
            let places: Vec<Vec<usize>> = expected
                .iter()
                .enumerate()
                .map(|(n, column)| titles.places(column, chosen(n)))
                .collect();
            let missing: Vec<usize> =
                (0..expected.len()).filter(|n| places[*n].is_empty()).collect();
            if missing.is_empty() {
                if block.len() >= BLOCK {
                    return Err(document.error(
                        block[0].clone(),
                        "there are numbers above the header, and it is not known what they are",
                        "give each table a file of its own",
                    ));
                }
                let mut columns = Vec::with_capacity(expected.len());
                for (n, (column, places)) in expected.iter().zip(&places).enumerate() {
                    columns.push(column_place(&titles, column, places, chosen(n))?);
                }
                let fields = titles.fields.len();
                return Ok(Header { separator, rows: line.end, span: line, fields, columns });
            }
            if nearest.as_ref().is_none_or(|(_, _, least)| missing.len() < least.len()) {
                nearest = Some((line.clone(), separator, missing));
            }
        }
        let numbers = |separator: u8| {
            let fields = fields(separator, &document.text, &line);
            let number =
                |field: &Range<usize>| mark::number(&document.text[field.clone()]).is_some();
            fields.len() > 1 && fields.iter().all(number)
        };
        if SEPARATORS.into_iter().any(numbers) {
            block.push(line);
        } else {
            block.clear();
        }
    }
    let Some((line, separator, missing)) = nearest else {
        let message = format!("`{}` is empty", document.file);
        return Err(document.error_anywhere(message, named(expected)));
    };
    let titles = Titles::new(document, &line, separator);
    if let Some(title) = missing.iter().find_map(|n| chosen(*n)) {
        let all: Vec<String> = titles
            .fields
            .iter()
            .filter(|field| !field.is_empty())
            .map(|field| format!("`{}`", document.excerpt(field)))
            .collect();
        return Err(document.error(
            line,
            format!("no column is called `{}`", excerpt(title)),
            format!("give the title of a column as it is written in the file: {}", all.join(", ")),
        ));
    }
    let mut help = named(expected);
    for column in missing.iter().map(|n| &expected[*n]) {
        let others: Vec<&str> =
            column.names.iter().skip(1).chain(column.last_words).copied().collect();
        if !others.is_empty() {
            let name = column.name();
            help.push_str(&format!("; `{name}` may also be called {}", others.join(", ")));
        }
        if let Some(option) = column.option {
            help.push_str(&format!("; or name it, as in {option} \"title of the column\""));
        }
    }
    let message = format!("the column `{}` is missing", expected[missing[0]].name());
    Err(document.error(line, message, help))
}

/// What may separate the fields of a line: commas where there are no semicolons and no tabs, and any where there is one field.
fn separators(document: &Document, line: &Range<usize>) -> Vec<u8> {
    let many = |separator: &u8| fields(*separator, &document.text, line).len() > 1;
    let [semicolon, tab, comma] = SEPARATORS;
    let found: Vec<u8> = [semicolon, tab].into_iter().filter(many).collect();
    match found.is_empty() {
        false => found,
        true if many(&comma) => vec![comma],
        true => vec![semicolon],
    }
}

/// What the header names.
fn named(expected: &[Column]) -> String {
    if expected.iter().all(|column| column.option.is_none()) {
        let names: Vec<&str> = expected.iter().map(Column::name).collect();
        return format!("its first line names the columns {}", names.join(", "));
    }
    let example: Vec<String> =
        expected.iter().map(|column| format!("`{} ({})`", column.name(), column.unit)).collect();
    format!("the line above the numbers names the columns, as in {}", example.join(" and "))
}

/// The place of a column, and the size of its unit; refuses two columns of one name.
fn column_place(
    titles: &Titles,
    column: &Column,
    places: &[usize],
    chosen: Option<&str>,
) -> Result<(usize, Option<f64>), Error> {
    // where two titles fit the column, nobody guesses which one is meant
    let document = titles.document;
    let index = places[0];
    let place = titles.fields[index].clone();
    if let Some(second) = places.get(1).map(|n| titles.fields[*n].clone()) {
        let name = column.name();
        let (first, other) = (document.excerpt(&place), document.excerpt(&second));
        let help = match column.option {
            Some(option) if first != other => format!(
                "name the right one, as in {option} \"{first}\"; give each specimen a file of its own"
            ),
            Some(_) => "give each specimen a file of its own".into(),
            None => "give each table one column of a name".into(),
        };
        let message = match first == other {
            true => format!("two columns are called `{first}`"),
            false => {
                format!("the columns `{first}` and `{other}` may both be the column `{name}`")
            }
        };
        return Err(document.error(second, message, help));
    }

    // the unit is in the header, or in the title that the option names
    let unit = titles.titles[index].1;
    let said = chosen.and_then(|chosen| title(chosen).1);
    let size = match unit.or(said) {
        Some(unit) => Some(size(document, place, unit, column.dimension)?),
        None => None,
    };
    Ok((index, size))
}

/// Takes the units from a line below the header that has no numbers; whether it is one.
pub(super) fn units_below(
    document: &Document,
    expected: &[Column],
    header: &mut Header,
    row: &Range<usize>,
) -> Result<bool, Error> {
    let fields = fields(header.separator, &document.text, row);
    let said: Vec<Option<&Range<usize>>> = header
        .columns
        .iter()
        .map(|(index, _)| fields.get(*index).filter(|field| !field.is_empty()))
        .collect();
    let unit = |field: &Range<usize>| bare(&document.text[field.clone()]).to_owned();
    // the second line of a table of numbers, or of one that is broken
    let known = |field: &Range<usize>| units::unit(&unit(field)).is_ok();
    if said.iter().flatten().count() == 0 || !said.iter().flatten().all(|field| known(field)) {
        return Ok(false);
    }
    for ((column, (_, size_of)), field) in expected.iter().zip(&mut header.columns).zip(said) {
        if let (None, Some(field)) = (*size_of, field) {
            *size_of = Some(size(document, field.clone(), &unit(field), column.dimension)?);
        }
    }
    Ok(true)
}

/// The size of a unit in a field.
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
            format!("expected {dimension} in this column"),
        )),
        Err(fault) => {
            let title = document.excerpt(&field);
            let message = format!("the unit in `{title}` cannot be read: {}", fault.message);
            Err(document.error(field, message, fault.help))
        }
    }
}
