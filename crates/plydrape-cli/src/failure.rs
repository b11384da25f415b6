//! Why a command could not do its work, and how that is shown.

use miette::{
    LabeledSpan, MietteError, MietteHandlerOpts, MietteSpanContents, ReportHandler, SourceCode,
    SourceSpan, SpanContents,
};
use plydrape_io::store::shown;
use plydrape_io::{Diagnostic, Error};
use std::fmt;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// What a subcommand returns: an exit code, or why it could not go on.
pub type Done = Result<ExitCode, Failure>;

/// Why a command could not do its work.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// The scene, or a file it names, was refused.
    #[error("{}", .0.0.message)]
    Scene(Box<Source>),
    /// Something else cannot be used or written: the value of an option, a file, a folder.
    #[error("{message}")]
    Refused {
        /// What is wrong with it.
        message: String,
        /// What would be right; empty where the message says it.
        help: String,
    },
    /// One ply of a book could not be planned.
    #[error("ply {name}: {cause}")]
    Ply {
        /// Name.
        name: String,
        /// Why.
        cause: Box<Failure>,
    },
    /// The input is sound, but has no solution.
    #[error("{message}")]
    NoSolution {
        /// What was looked for.
        message: String,
        /// What may be the reason.
        help: String,
    },
    /// Standard output could not be written; the files are.
    #[error("standard output cannot be written: {reason}")]
    Stdout {
        /// What the system says.
        reason: String,
        /// The files that were written before.
        files: Vec<PathBuf>,
    },
}

impl Failure {
    /// A file that could not be written.
    pub fn output(file: &Path, error: &io::Error) -> Self {
        let (reason, help) = match error.kind() {
            io::ErrorKind::AlreadyExists => {
                ("it exists".into(), "choose another name, or move it away first")
            }
            io::ErrorKind::PermissionDenied => {
                ("permission denied".into(), "choose a folder that you may write to")
            }
            _ => (error.to_string(), "choose another place"),
        };
        let message = format!("`{}` cannot be written: {reason}", file.display());
        Failure::Refused { message, help: help.into() }
    }

    /// Standard output that could not be written, after these files were.
    pub fn stdout(error: &io::Error, files: &[PathBuf]) -> Self {
        Failure::Stdout { reason: error.to_string(), files: files.to_vec() }
    }

    /// Shows the failure on standard error and gives its exit code.
    pub fn report(&self) -> ExitCode {
        // where standard error cannot be written either, the exit code is all that can be said
        let _ = write!(io::stderr(), "{}", Rendered(&Shown(self)));
        let cause = match self {
            Failure::Ply { cause, .. } => cause,
            cause => cause,
        };
        ExitCode::from(match cause {
            Failure::NoSolution { .. } => 3,
            Failure::Stdout { .. } => 4,
            _ => 2,
        })
    }
}

impl From<Diagnostic> for Failure {
    fn from(fault: Diagnostic) -> Self {
        let text = shown::blanked(&fault.text).into();
        let file = shown::name(&fault.file);
        Failure::Scene(Box::new(Source(Diagnostic { text, file, ..fault })))
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        match error {
            Error::Scene(fault) => Failure::from(*fault),
            other => Failure::Refused { message: other.to_string(), help: other.help().into() },
        }
    }
}

impl From<plydrape::Error> for Failure {
    fn from(cause: plydrape::Error) -> Self {
        Error::from(cause).into()
    }
}

impl miette::Diagnostic for Failure {
    fn help(&self) -> Option<Box<dyn fmt::Display + '_>> {
        match self {
            Failure::Scene(source) => given(&source.0.help),
            Failure::Ply { cause, .. } => cause.help(),
            Failure::Refused { help, .. } | Failure::NoSolution { help, .. } => given(help),
            Failure::Stdout { files, .. } => Some(Box::new(match files[..] {
                [] => "give it a place with room, as in > FILE; no file was written".to_owned(),
                [ref file] => format!("`{}` is written and complete", file.display()),
                [ref first, ..] => {
                    let names = files.iter().filter_map(|file| file.file_name());
                    let names: Vec<_> = names.map(|name| name.to_string_lossy()).collect();
                    let folder = first.parent().unwrap_or(Path::new("")).display();
                    format!(
                        "the result files are written and complete: {} in `{folder}`",
                        names.join(", ")
                    )
                }
            })),
        }
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        match self {
            Failure::Scene(source) if source.0.span.is_some() => Some(source.as_ref()),
            _ => None,
        }
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let Failure::Scene(source) = self else {
            return None;
        };
        let span = source.first_line()?;
        Some(Box::new(std::iter::once(LabeledSpan::new_with_span(None, span))))
    }
}

/// A help that is not empty.
fn given(help: &String) -> Option<Box<dyn fmt::Display + '_>> {
    if help.is_empty() { None } else { Some(Box::new(help)) }
}

/// A failure whose text holds no control characters, whatever names of files are in them.
#[derive(Debug)]
struct Shown<'a>(&'a Failure);

impl fmt::Display for Shown<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&shown::escaped(&self.0.to_string()))
    }
}

// Every message says its cause itself: as a source it would be printed once more below it.
impl std::error::Error for Shown<'_> {}

impl miette::Diagnostic for Shown<'_> {
    fn help(&self) -> Option<Box<dyn fmt::Display + '_>> {
        let help = self.0.help()?.to_string();
        Some(Box::new(shown::escaped(&help)))
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.0.source_code()
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        self.0.labels()
    }
}

/// A failure drawn by miette, with colors only on a terminal that wants them.
struct Rendered<'a>(&'a Shown<'a>);

impl fmt::Display for Rendered<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let handler = MietteHandlerOpts::new().terminal_links(false).build();
        handler.debug(self.0, f)
    }
}

/// A refused scene as a source for miette.
#[derive(Debug)]
pub struct Source(Diagnostic);

/// Longest line shown whole (bytes); of a longer one only the surroundings of the fault.
const LONGEST_LINE: usize = 200;
/// Bytes shown before and after a fault in such a line.
const SURROUNDINGS: usize = 40;

impl Source {
    /// The first line of the fault's span, a character at least where there is one.
    fn first_line(&self) -> Option<SourceSpan> {
        let span = self.0.span.clone()?;
        let text: &str = &self.0.text;
        // A fault at the very end is shown at the last character.
        let start = boundary(text, span.start.min(text.len().saturating_sub(1)));
        let fault = text.get(start..span.end.max(start))?;
        let length = fault.find(['\n', '\r']).unwrap_or(fault.len());
        Some((start, boundary(fault, length.min(LONGEST_LINE))).into())
    }
}

impl SourceCode for Source {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        before: usize,
        after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        let text: &str = &self.0.text;
        let contents = text.read_span(span, before, after)?;
        let lines = contents.data().split(|byte| *byte == b'\n');
        if lines.clone().all(|line| line.len() <= LONGEST_LINE) {
            return Ok(Box::new(MietteSpanContents::new_named(
                self.0.file.clone(),
                contents.data(),
                *contents.span(),
                contents.line(),
                contents.column(),
                contents.line_count(),
            )));
        }
        // A window of its line around the fault, cut between characters.
        let (start, end) = (span.offset(), span.offset() + span.len());
        let line_start = text[..start].rfind('\n').map_or(0, |newline| newline + 1);
        let line_end = text[end..].find('\n').map_or(text.len(), |length| end + length);
        let from = boundary(text, start.saturating_sub(SURROUNDINGS)).max(line_start);
        let to = boundary(text, end + SURROUNDINGS).min(line_end);
        let line = text[..start].matches('\n').count();
        Ok(Box::new(MietteSpanContents::new_named(
            self.0.file.clone(),
            &text.as_bytes()[from..to],
            (from, to - from).into(),
            line,
            start - line_start,
            1,
        )))
    }
}

/// The last boundary between characters at or before a byte.
fn boundary(text: &str, byte: usize) -> usize {
    let mut boundary = byte.min(text.len());
    while !text.is_char_boundary(boundary) {
        boundary -= 1;
    }
    boundary
}
