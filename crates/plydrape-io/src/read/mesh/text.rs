//! Lines of a text file, with their numbers for messages.

use crate::Error;

/// What to do about a file that is shorter or longer than it should be.
pub(super) const INCOMPLETE: &str = "is the file complete? copy or export it once more";

/// What to do about most faults.
pub(super) const CORRECT: &str = "correct the file, or export the mold's surface anew";

/// A file that is refused at a line.
pub(super) fn refused(
    file: &str,
    line: usize,
    message: impl std::fmt::Display,
    help: impl Into<String>,
) -> Error {
    Error::file(file, format!("{file}, line {line}: {message}"), help)
}

/// The lines of a file in turn.
pub(super) struct Lines<'a> {
    file: &'a str,
    rest: std::str::Lines<'a>,
    /// Number of the line read last, from 1.
    pub number: usize,
}

impl<'a> Lines<'a> {
    pub fn new(file: &'a str, bytes: &'a [u8]) -> Result<Self, Error> {
        let text = std::str::from_utf8(bytes).map_err(|fault| {
            let before = &bytes[..fault.valid_up_to()];
            let line = before.iter().filter(|byte| **byte == b'\n').count() + 1;
            refused(file, line, "bytes that are no text", "save the file as plain text (UTF-8)")
        })?;
        if let Some(at) = text.find('\0') {
            let line = text[..at].matches('\n').count() + 1;
            let help = "remove the NUL bytes, or save the file anew as plain text (UTF-8)";
            return Err(refused(file, line, "a NUL byte, which no text has", help));
        }
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        Ok(Lines { file, rest: text.lines(), number: 0 })
    }

    /// A fault of the line read last.
    pub fn fault(&self, found: &str, expected: impl Into<String>) -> Error {
        let mut found: String = found.trim().chars().take(60).collect();
        if found.is_empty() {
            found = "an empty line".to_owned();
        }
        let message = format!("found `{found}`, expected {}", expected.into());
        refused(self.file, self.number, message, CORRECT)
    }

    /// The file ends where something else belongs.
    pub fn ends(&self, expected: impl Into<String>) -> Error {
        let (file, line, expected) = (self.file, self.number, expected.into());
        let message = format!("{file}: the file ends at line {line}, expected {expected}");
        Error::file(file, message, INCOMPLETE)
    }

    /// A finite number.
    pub fn number(&self, word: &str) -> Result<f64, Error> {
        let plain = word.parse::<f64>().ok();
        // 1.5D-3 as Fortran writes it
        let value = plain.or_else(|| word.replace(['d', 'D'], "e").parse().ok());
        value.filter(|x| x.is_finite()).ok_or_else(|| self.fault(word, "a finite number"))
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = &'a str;

    fn next(&mut self) -> Option<&'a str> {
        let line = self.rest.next()?;
        self.number += 1;
        Some(line.trim())
    }
}
