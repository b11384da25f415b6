//! Text for a terminal: control characters, which would move the cursor or change its colours, are shown by their number.

use std::fmt::Write;
use std::path::Path;

/// Whether a text holds a control character, a line feed included.
#[must_use]
pub fn control(text: &str) -> Option<char> {
    text.chars().find(|c| c.is_control())
}

/// A text whose control characters, but line feeds and tabs, are written as in `\\u{1b}`.
#[must_use]
pub fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '\n' | '\t' => out.push(c),
            c if c.is_control() => {
                let _ = write!(out, "{}", c.escape_unicode());
            }
            c => out.push(c),
        }
    }
    out
}

/// A name on one line: also line feeds and tabs are escaped.
#[must_use]
pub fn name(text: &str) -> String {
    escaped(text).replace('\n', "\\n").replace('\t', "\\t")
}

/// A path on one line.
#[must_use]
pub fn path(path: &Path) -> String {
    name(&path.to_string_lossy())
}

/// A text of the same length in bytes without control characters but line ends and tabs, for a source that is shown with
/// places in it.
#[must_use]
pub fn blanked(text: &str) -> String {
    let plain = |c: char| match c {
        '\n' | '\r' | '\t' => c,
        c if c.is_control() && c.len_utf8() == 1 => '?',
        // the other control characters take two bytes, as this sign does
        c if c.is_control() => '¿',
        c => c,
    };
    text.chars().map(plain).collect()
}
