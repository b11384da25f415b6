//! Why this crate could not go on, what would help, and where in a file that is.

use plydrape::{Error as Cause, LayupError};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::fmt;
use std::io::{self, ErrorKind};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Why something could not be read, made or written.
///
/// The text says what is wrong and where; [`Error::help`] says what would help, where the text does not.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A scene, a file that it names, or a value as in a scene was refused.
    #[error("{0}")]
    Scene(Box<Diagnostic>),
    /// A file is not what it must be: a mesh, a drawing, a result, the states of a sheet, a plan.
    #[error("{message}")]
    File {
        /// The file.
        path: PathBuf,
        /// What is wrong with it, with its name and the line where there is one.
        message: String,
        /// What would help.
        help: String,
    },
    /// The file system refused to read or to write.
    #[error("{message}")]
    Io {
        /// The file or folder.
        path: PathBuf,
        /// What was tried, on which file, and why it failed.
        message: String,
        /// What would help; empty where the message says it.
        help: String,
        /// The file system's answer.
        source: io::Error,
    },
    /// Work would take more memory than the budget, see [`crate::store::size`].
    #[error("{what} would take about {} of memory; {} are allowed", bytes(*estimate), bytes(*budget))]
    TooLarge {
        /// What is too large, with its numbers.
        what: String,
        /// Memory that it would take (bytes).
        estimate: f64,
        /// Memory that it may take (bytes).
        budget: f64,
    },
    /// What was asked for cannot be made of this scene, result or test.
    #[error("{message}")]
    NotPossible {
        /// What is missing or does not fit.
        message: String,
        /// What would help; empty where the message says it.
        help: String,
    },
    /// A file is in the way that plydrape did not write, or that was changed since.
    #[error(
        "{} was not written by plydrape or was changed since, so it stays: choose another folder with -o, or move that file away",
        path.display()
    )]
    Foreign {
        /// The file.
        path: PathBuf,
    },
    /// Another run writes into the folder.
    #[error(
        "{} is being written by {owner}: wait until that has ended, or choose another folder with -o",
        path.display()
    )]
    Busy {
        /// The folder.
        path: PathBuf,
        /// Who writes.
        owner: String,
    },
    /// The run would replace what it has read.
    #[error("{} is read by this run, whose results would replace it: choose another folder with -o", path.display())]
    Input {
        /// The file.
        path: PathBuf,
    },
    /// The output path is, or runs through, a file.
    #[error("{} is not a folder: choose another one with -o", path.display())]
    NotAFolder {
        /// The path as given.
        path: PathBuf,
    },
    /// Writing failed in the middle and the earlier files could not be moved back.
    #[error(
        "{cause}; some earlier files of {} could not be put back: they are in {} under names beginning with old-",
        path.display(), kept.display()
    )]
    Torn {
        /// The output folder.
        path: PathBuf,
        /// The folder that keeps the earlier files.
        kept: PathBuf,
        /// What failed first.
        cause: Box<Error>,
    },
    /// A number that is NaN or infinite.
    #[error(
        "`{key}` is {value}, which a result file cannot hold; this is a fault of plydrape, please report it"
    )]
    NotFinite {
        /// Where it is, as in `steps[3].measures.slack_mm.value`.
        key: String,
        /// The number.
        value: f64,
    },
    /// Something else that cannot be, whatever the input: a fault of plydrape.
    #[error("{0}")]
    Internal(String),
}

/// What is wrong at a place of a text, and what would be right.
///
/// The text travels along, so that a front end can draw a caret under the value.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Diagnostic {
    /// The file at fault, as the user named it.
    pub file: String,
    /// Text; empty where it could not be read.
    pub text: Arc<str>,
    /// The bytes of `text` at fault, where there is a place to point at.
    pub span: Option<Range<usize>>,
    /// What is wrong.
    pub message: String,
    /// What would be right; empty where the message says all.
    pub help: String,
    /// The file that could not be read, where that is what is wrong: where it was looked for, and what the file system answers.
    #[serde(skip)]
    pub unread: Option<(PathBuf, ErrorKind)>,
}

impl Diagnostic {
    /// A fault of a file as a whole.
    pub fn new(
        file: impl Into<String>,
        message: impl Into<String>,
        help: impl Into<String>,
    ) -> Self {
        let (file, message, help) = (file.into(), message.into(), help.into());
        Diagnostic { file, text: "".into(), span: None, message, help, unread: None }
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

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.file)?;
        if let Some((line, column)) = self.line_column() {
            write!(f, ":{line}:{column}")?;
        }
        write!(f, ": {}", self.message)?;
        if self.help.is_empty() { Ok(()) } else { write!(f, "; {}", self.help) }
    }
}

impl Error {
    /// What is wrong, of a scene without the place and the help that its text has beside it.
    #[must_use]
    pub fn message(&self) -> Cow<'_, str> {
        match self {
            Error::Scene(diagnostic) => diagnostic.message.as_str().into(),
            other => other.to_string().into(),
        }
    }

    /// What would help; empty where the text of the error says it.
    #[must_use]
    pub fn help(&self) -> &str {
        match self {
            Error::Scene(diagnostic) => &diagnostic.help,
            Error::File { help, .. } | Error::Io { help, .. } | Error::NotPossible { help, .. } => {
                help
            }
            Error::TooLarge { .. } => {
                "make it smaller, or allow more with the environment variable PLYDRAPE_MEMORY, as in PLYDRAPE_MEMORY=\"16 GB\""
            }
            Error::Internal(_) => "this is a fault of plydrape, please report it",
            _ => "",
        }
    }

    /// The place in a scene or in a file that it names.
    #[must_use]
    pub fn diagnostic(&self) -> Option<&Diagnostic> {
        match self {
            Error::Scene(diagnostic) => Some(diagnostic),
            _ => None,
        }
    }

    pub(crate) fn into_diagnostic(self) -> Option<Box<Diagnostic>> {
        match self {
            Error::Scene(diagnostic) => Some(diagnostic),
            _ => None,
        }
    }

    /// The file or folder that the file system refused, and its answer.
    #[must_use]
    pub fn refused_path(&self) -> Option<(&Path, ErrorKind)> {
        match self {
            Error::Scene(diagnostic) => {
                diagnostic.unread.as_ref().map(|(path, kind)| (&**path, *kind))
            }
            Error::Io { path, source, .. } => Some((path, source.kind())),
            _ => None,
        }
    }

    /// A file that is not what it must be.
    pub(crate) fn file(
        path: impl Into<PathBuf>,
        message: impl Into<String>,
        help: impl Into<String>,
    ) -> Self {
        Error::File { path: path.into(), message: message.into(), help: help.into() }
    }

    /// What cannot be made of this scene, result or test.
    pub(crate) fn not_possible(message: impl Into<String>, help: impl Into<String>) -> Self {
        Error::NotPossible { message: message.into(), help: help.into() }
    }

    /// A refusal of [`crate::store::size`], with the name of the file that is too large.
    pub(crate) fn of_file(mut self, name: impl fmt::Display) -> Self {
        if let Error::TooLarge { what: text, .. } | Error::NotPossible { message: text, .. } =
            &mut self
        {
            *text = format!("{name}: {text}");
        }
        self
    }

    /// A mesh or a drawing that cannot be read.
    pub(crate) fn read(path: &Path, source: io::Error) -> Self {
        let message = format!("{}: cannot be read: {source}", path.display());
        let help = "check its name and its permissions".into();
        Error::Io { path: path.into(), message, help, source }
    }

    /// A value that has no JSON text.
    pub(crate) fn json(fault: impl fmt::Display) -> Self {
        Error::Internal(format!("the result cannot be written as JSON: {fault}"))
    }

    /// A file that cannot be written, with what fits the file system's answer.
    pub(crate) fn write(what: &str, path: &Path, source: io::Error) -> Self {
        let remedy = match source.kind() {
            ErrorKind::StorageFull | ErrorKind::QuotaExceeded => {
                "make room on the disk, or choose a folder on another one with -o"
            }
            ErrorKind::InvalidFilename => "choose a shorter path with -o",
            _ => "choose a folder that you may write to with -o",
        };
        let message = format!("cannot {what} {}: {source}; {remedy}", path.display());
        Error::Io { path: path.into(), message, help: String::new(), source }
    }
}

impl From<Diagnostic> for Error {
    fn from(diagnostic: Diagnostic) -> Self {
        Error::Scene(Box::new(diagnostic))
    }
}

impl From<Cause> for Error {
    fn from(cause: Cause) -> Self {
        // the remedy in words of scenes and of test records; other causes have one of their own
        let help = match cause {
            Cause::NoCatenaries => "drape it by the sheet: kind = \"sheet\" in [model]",
            Cause::CatenariesPickUp => "drape it by the sheet alone, or leave out [pick_up]",
            Cause::CatenariesMounts { .. } => {
                "take the sheet (kind = \"sheet\" in [model]) and its planner (method = \"path\" in [plan]) alone, or leave out `stiffness` in [grippers]"
            }
            Cause::SheetNoShear { .. }
            | Cause::SheetNoTension { .. }
            | Cause::SheetCoarse { .. }
            | Cause::SheetPadsOverlap { .. }
            | Cause::SheetPadsOverhang { .. }
            | Cause::SheetPadOff { .. }
            | Cause::SheetPadSmall { .. }
            | Cause::SheetPadPoint { .. }
            | Cause::SheetRange { .. }
            | Cause::SheetTensionTable { .. }
            | Cause::SheetMomentTable { .. }
            | Cause::SheetNoMotion { .. } => {
                "change the scene, or drape it by catenaries: kind = \"catenaries\" in [model]"
            }
            Cause::FitTooFew { .. } => "record more points, over a larger range of the test",
            Cause::FitPoint { fault, .. } => fault.remedy(),
            Cause::FitReach { .. } => {
                "let the displacement begin at zero where the loading begins; it may be the place of the crosshead: subtract the first one from all; see whether its sign, its unit and the sizes of the specimen are right"
            }
            Cause::FitNoRate => {
                "pull strips at two speeds or more, tenfold apart, and hold one of them where it is; the record of the hold belongs to its file"
            }
            Cause::FitRange { .. } => "see whether the units in the headers and options are right",
            Cause::FitNoStrip { .. } => {
                "x points away from the edge, z up, both are 0 at the edge; moments and curvatures that go together have one sign"
            }
            _ => cause.remedy(),
        };
        Error::not_possible(cause.to_string(), help)
    }
}

impl From<LayupError> for Error {
    fn from(cause: LayupError) -> Self {
        Cause::from(cause).into()
    }
}

impl From<csv::Error> for Error {
    fn from(fault: csv::Error) -> Self {
        Error::Internal(format!("cannot form a table: {fault}"))
    }
}

/// What is wrong with a text, and what would be right, before it is known of which file it is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Fault {
    /// What is wrong.
    pub message: String,
    /// What would be right.
    pub help: String,
}

impl Fault {
    pub fn new(message: impl Into<String>, help: impl Into<String>) -> Self {
        Fault { message: message.into(), help: help.into() }
    }
}

/// A size with two digits and its unit.
#[must_use]
pub fn bytes(size: f64) -> String {
    let units = [("TB", 1e12), ("GB", 1e9), ("MB", 1e6)];
    let (unit, bytes) = units.into_iter().find(|(_, bytes)| size >= *bytes).unwrap_or(("kB", 1e3));
    let value = size / bytes;
    if value < 10.0 { format!("{value:.1} {unit}") } else { format!("{value:.0} {unit}") }
}
