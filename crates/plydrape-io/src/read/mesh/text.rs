//! Lines of a text file, with their numbers for messages.

use super::MeshFileError;

/// The lines of a file in turn.
pub(super) struct Lines<'a> {
    file: &'a str,
    rest: std::str::Lines<'a>,
    /// Number of the line read last, from 1.
    pub number: usize,
}

impl<'a> Lines<'a> {
    pub fn new(file: &'a str, bytes: &'a [u8]) -> Result<Self, MeshFileError> {
        let text = std::str::from_utf8(bytes).map_err(|fault| {
            let before = &bytes[..fault.valid_up_to()];
            let line = before.iter().filter(|byte| **byte == b'\n').count() + 1;
            MeshFileError::NotText { file: file.to_owned(), line }
        })?;
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        Ok(Lines { file, rest: text.lines(), number: 0 })
    }

    /// A fault of the line read last.
    pub fn fault(&self, found: &str, expected: impl Into<String>) -> MeshFileError {
        self.fault_at(self.number, found, expected)
    }

    /// A fault of a certain line.
    pub fn fault_at(&self, line: usize, found: &str, expected: impl Into<String>) -> MeshFileError {
        let mut found: String = found.trim().chars().take(60).collect();
        if found.is_empty() {
            found = "an empty line".to_owned();
        }
        MeshFileError::Line { file: self.file.to_owned(), line, found, expected: expected.into() }
    }

    /// The file ends where something else belongs.
    pub fn ends(&self, expected: impl Into<String>) -> MeshFileError {
        MeshFileError::Ends {
            file: self.file.to_owned(),
            line: self.number,
            expected: expected.into(),
        }
    }

    /// A finite number.
    pub fn number(&self, word: &str) -> Result<f64, MeshFileError> {
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
