//! Marks in numbers: a decimal point or a decimal comma, one for the whole table, and no separator of thousands.
//!
//! `1,012` may be a little more than one, or a thousand and twelve. Of a number with one to three digits before the mark and three behind
//! it that cannot be told from itself. Another number of the table tells it that can have a decimal mark alone, as `0,5` and `12,25`. Where
//! there is none, such a number is refused if its mark is not the usual decimal one between these separators (a comma between commas, a
//! point between semicolons), or if its column has whole numbers too: a program that writes 998 and 1,012 means thousands.

use super::{Row, Table};
use crate::Error;
use crate::scene::units::Dimension;
use std::ops::Range;

/// A number with either mark; `None` for what is no finite one.
pub(super) fn number(text: &str) -> Option<f64> {
    let value = match text.contains(',') {
        true => text.replace(',', ".").parse::<f64>(),
        false => text.parse::<f64>(),
    };
    value.ok().filter(|value| value.is_finite())
}

/// The remedy for a separator of thousands.
pub(super) fn without_thousands(text: &str) -> String {
    // the last mark is the decimal one
    let last = text.rfind([',', '.']).unwrap_or(text.len());
    let (whole, part) = text.split_at(last);
    format!(
        "write numbers with one decimal point or one decimal comma, as in {}.{}",
        whole.replace([',', '.'], ""),
        &part[1..]
    )
}

/// What is known of the numbers of one column.
#[derive(Clone, Default)]
struct Seen {
    /// The first that may have a separator of thousands.
    doubtful: Option<Range<usize>>,
    /// Whether there are whole ones without a mark, 0 apart.
    whole: bool,
}

/// Refuses numbers that may be others.
pub(super) fn check(table: &Table) -> Result<(), Error> {
    let mut seen = vec![Seen::default(); table.expected.len()];
    let (mut mark, mut decimal) = (None, false);
    for row in table.rows() {
        for (n, seen) in seen.iter_mut().enumerate() {
            if table.expected[n].dimension == Dimension::NONE {
                continue;
            }
            let text = row.field(table.found.columns[n].0);
            let own = match (text.contains('.'), text.contains(',')) {
                (true, false) => '.',
                (false, true) => ',',
                (false, false) => {
                    seen.whole |= number(text).is_some_and(|value| value != 0.0);
                    continue;
                }
                // refused where it is read
                (true, true) => continue,
            };
            if number(text).is_none() {
                continue;
            }
            if *mark.get_or_insert(own) != own {
                return Err(other_mark(&row, n, own));
            }
            if !may_be_thousands(text, own) {
                decimal = true;
            } else if seen.doubtful.is_none() {
                seen.doubtful = Some(row.place(n));
            }
        }
    }
    let unusual = matches!(
        (mark, table.found.separator),
        (Some(','), b',') | (Some('.'), b';') if table.found.fields > 1
    );
    let doubtful = seen.into_iter().filter(|seen| unusual || seen.whole);
    match doubtful.filter_map(|seen| seen.doubtful).min_by_key(|place| place.start) {
        Some(place) if !decimal => Err(refused(table, place)),
        _ => Ok(()),
    }
}

/// Whether a number may have a separator of thousands, by itself.
fn may_be_thousands(text: &str, mark: char) -> bool {
    let Some((whole, part)) = text.split_once(mark) else { return false };
    let whole = whole.trim_start_matches(['-', '+']);
    let digits = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    (1..=3).contains(&whole.len())
        && !whole.starts_with('0')
        && digits(whole)
        && part.len() == 3
        && digits(part)
}

fn other_mark(row: &Row, column: usize, mark: char) -> Error {
    let name = |mark| if mark == ',' { "comma" } else { "point" };
    let other = if mark == ',' { '.' } else { ',' };
    let what = format!("has a decimal {} where other numbers have a {}", name(mark), name(other));
    row.refused(column, &what, "write all numbers of a table with one decimal mark, and none with a separator of thousands")
}

fn refused(table: &Table, place: Range<usize>) -> Error {
    let document = table.document;
    let text = &document.text[place.clone()];
    let help = format!(
        "write {} where the mark separates thousands; where it is the decimal one, write a number of the table with more or fewer digits behind it, as in {text}0",
        text.replace([',', '.'], "")
    );
    let name = if text.contains(',') { "comma" } else { "point" };
    let message = format!(
        "{} may have a decimal {name} or a separator of thousands",
        document.quoted(&place)
    );
    document.error(place, message, help)
}
