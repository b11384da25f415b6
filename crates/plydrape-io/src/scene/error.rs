//! Why a scene was refused: the place in its file, what is wrong there, and what would be right.

use crate::store::shown;
use std::fmt;
use std::io::ErrorKind;
use std::ops::Range;
use std::path::PathBuf;
use std::sync::Arc;

/// A refused scene, or a file it names.
///
/// The text of the file travels along, so that a front end can draw a caret under the value.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub struct SceneError {
    /// The file at fault, as the user named it.
    pub file: String,
    /// Its text; empty where it could not be read.
    pub text: Arc<str>,
    /// The bytes of `text` at fault, where there is a place to point at.
    pub span: Option<Range<usize>>,
    /// What is wrong.
    pub message: String,
    /// What would be right; empty where the message says all.
    pub help: String,
    /// The file that could not be read, where that is what is wrong.
    pub unread: Option<Box<Unread>>,
}

/// A file that could not be read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Unread {
    /// Where it was looked for.
    pub path: PathBuf,
    /// What the file system answers.
    pub kind: ErrorKind,
}

impl SceneError {
    /// The same about a file that could not be read.
    #[must_use]
    pub(super) fn of_file(self, unread: Option<Box<Unread>>) -> Self {
        SceneError { unread, ..self }
    }

    /// Line and column of the fault, both counted from 1, the column in characters.
    #[must_use]
    pub fn line_column(&self) -> Option<(usize, usize)> {
        let start = self.span.as_ref()?.start;
        let before = self.text.get(..start)?;
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        let line = before.matches('\n').count() + 1;
        Some((line, before[line_start..].chars().count() + 1))
    }
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.file)?;
        if let Some((line, column)) = self.line_column() {
            write!(f, ":{line}:{column}")?;
        }
        write!(f, ": {}", self.message)?;
        if self.help.is_empty() { Ok(()) } else { write!(f, "; {}", self.help) }
    }
}

/// A text under reading, with the name it goes by in messages.
#[derive(Debug, Clone)]
pub(super) struct Document {
    /// The file as the user named it.
    pub file: String,
    /// Its whole text.
    pub text: Arc<str>,
}

impl Document {
    pub fn new(file: impl Into<String>, text: &str) -> Self {
        Document { file: file.into(), text: text.into() }
    }

    /// An error at some bytes of this text.
    pub fn error(
        &self,
        span: Range<usize>,
        message: impl Into<String>,
        help: impl Into<String>,
    ) -> SceneError {
        SceneError { span: Some(span), ..self.error_anywhere(message, help) }
    }

    /// An error of the text as a whole.
    pub fn error_anywhere(
        &self,
        message: impl Into<String>,
        help: impl Into<String>,
    ) -> SceneError {
        SceneError {
            file: self.file.clone(),
            text: Arc::clone(&self.text),
            span: None,
            message: message.into(),
            help: help.into(),
            unread: None,
        }
    }

    /// A value as it stands in the file, for a message: a text in its quotes, others in ticks.
    pub fn quoted(&self, span: &Range<usize>) -> String {
        let value = self.excerpt(span);
        if value.starts_with(['"', '\'']) {
            return value;
        }
        format!("`{value}`")
    }

    /// The text at a span, shortened for a message.
    pub fn excerpt(&self, span: &Range<usize>) -> String {
        excerpt(self.text.get(span.clone()).unwrap_or_default())
    }
}

/// A text as a message quotes it.
pub(super) fn excerpt(text: &str) -> String {
    shown::excerpt(text, EXCERPT)
}

/// Characters of a value that a message quotes at most.
const EXCERPT: usize = 40;
