//! A text under reading, which knows its name in messages, and the places of faults in it.

use super::read;
use crate::Error;
use crate::error::Diagnostic;
use crate::store::shown;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A text under reading, with the name it goes by in messages.
#[derive(Debug, Clone)]
pub(super) struct Document {
    /// The file as the user named it.
    pub file: String,
    /// Whole text.
    pub text: Arc<str>,
    /// Folder of the files that it names.
    pub folder: PathBuf,
}

impl Document {
    pub fn new(file: impl Into<String>, text: &str) -> Self {
        Document { file: file.into(), text: text.into(), folder: PathBuf::new() }
    }

    /// This text, with the folder of the files that it names.
    pub fn within(self, folder: &Path) -> Self {
        Document { folder: folder.into(), ..self }
    }

    /// Where a file lies that this text names.
    pub fn path(&self, name: impl AsRef<Path>) -> PathBuf {
        self.folder.join(name)
    }

    /// An error at some bytes of this text.
    pub fn error(
        &self,
        span: Range<usize>,
        message: impl Into<String>,
        help: impl Into<String>,
    ) -> Error {
        Diagnostic { span: Some(span), ..self.fault(message, help) }.into()
    }

    /// An error of the text as a whole.
    pub fn error_anywhere(&self, message: impl Into<String>, help: impl Into<String>) -> Error {
        self.fault(message, help).into()
    }

    /// A fault of the text as a whole.
    pub fn fault(&self, message: impl Into<String>, help: impl Into<String>) -> Diagnostic {
        Diagnostic { text: Arc::clone(&self.text), ..Diagnostic::new(&*self.file, message, help) }
    }

    /// The error of a file that this text names at some bytes: at its own place if it has one, else there. `what` this text is of.
    pub fn error_of_named(&self, span: &Range<usize>, error: Error, what: &str) -> Error {
        match error {
            Error::Scene(fault) if fault.span.is_none() => {
                // where a file lies matters where it cannot be read
                let help = match fault.unread {
                    Some(_) => read::beside(what, &fault.help),
                    None => fault.help,
                };
                let (span, unread) = (Some(span.clone()), fault.unread);
                Diagnostic { span, unread, ..self.fault(fault.message, help) }.into()
            }
            other => other,
        }
    }

    /// A value as it is written in the file, for a message: a text in its quotes, others in ticks.
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
