//! Why a command could not do its work, and how that is shown.

use miette::{
    Diagnostic, LabeledSpan, MietteError, MietteHandlerOpts, MietteSpanContents, ReportHandler,
    SourceCode, SourceSpan, SpanContents,
};
use plydrape::planner::PlanError;
use plydrape_io::result::sheet::model_remedy;
use plydrape_io::scene::SceneError;
use plydrape_io::store::shown;
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
    Scene(Box<Refused>),
    /// The value of an option was refused.
    #[error("{message}")]
    Argument {
        /// The option, its value, and what is wrong with it.
        message: String,
        /// What would be right.
        help: String,
    },
    /// One ply of a book could not be planned.
    #[error("ply {name}: {cause}")]
    Ply {
        /// Its name.
        name: String,
        /// Why.
        cause: Box<Failure>,
    },
    /// No plan could be looked for.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// A plan could not be corrected.
    #[error(transparent)]
    Replan(#[from] plydrape_io::replan::ReplanFault),
    /// The input is sound, but has no solution.
    #[error("{message}")]
    NoSolution {
        /// What was looked for.
        message: String,
        /// What may be the reason.
        help: String,
    },
    /// A file could not be written.
    #[error("`{file}` cannot be written: {reason}")]
    Output {
        /// The file.
        file: String,
        /// What the system says.
        reason: String,
        /// What to do.
        help: String,
    },
    /// The results could not be written.
    #[error(transparent)]
    Results(#[from] plydrape_io::OutputError),
    /// The scene cannot be draped by a model.
    #[error(transparent)]
    Drape(#[from] plydrape_io::result::sheet::SheetDrapeError),
    /// A result file was refused.
    #[error(transparent)]
    Read(#[from] plydrape_io::ReadError),
    /// Standard output could not be written; the files are.
    #[error("standard output cannot be written: {reason}")]
    Stdout {
        /// What kind of fault it is.
        kind: io::ErrorKind,
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
        Failure::Output { file: file.display().to_string(), reason, help: help.into() }
    }

    /// Standard output that could not be written, after these files were.
    pub fn stdout(error: &io::Error, files: &[PathBuf]) -> Self {
        let (kind, reason) = (error.kind(), error.to_string());
        Failure::Stdout { kind, reason, files: files.to_vec() }
    }

    /// Shows the failure on standard error and gives its exit code.
    pub fn report(&self) -> ExitCode {
        // A reader that has seen enough, such as `head`, is no failure.
        if matches!(self, Failure::Stdout { kind: io::ErrorKind::BrokenPipe, .. }) {
            return ExitCode::SUCCESS;
        }
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

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        Failure::stdout(&error, &[])
    }
}

impl From<SceneError> for Failure {
    fn from(error: SceneError) -> Self {
        let text = shown::blanked(&error.text).into();
        let file = shown::name(&error.file);
        Failure::Scene(Box::new(Refused(SceneError { text, file, ..error })))
    }
}

impl Diagnostic for Failure {
    fn help(&self) -> Option<Box<dyn fmt::Display + '_>> {
        match self {
            Failure::Scene(refused) if refused.0.help.is_empty() => None,
            Failure::Scene(refused) => Some(Box::new(&refused.0.help)),
            Failure::Ply { cause, .. } => cause.help(),
            Failure::Argument { help, .. }
            | Failure::NoSolution { help, .. }
            | Failure::Output { help, .. } => Some(Box::new(help)),
            Failure::Read(refused) => Some(Box::new(refused.remedy())),
            Failure::Replan(fault) => Some(Box::new(fault.remedy())),
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
            Failure::Drape(fault) => Some(Box::new(fault.remedy())),
            Failure::Results(plydrape_io::OutputError::States(fault)) => {
                Some(Box::new(fault.states_remedy()))
            }
            Failure::Plan(PlanError::Model(fault)) => Some(Box::new(model_remedy(fault))),
            Failure::Plan(_) | Failure::Results(_) => None,
        }
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        match self {
            Failure::Scene(refused) if refused.0.span.is_some() => Some(refused.as_ref()),
            _ => None,
        }
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let Failure::Scene(refused) = self else {
            return None;
        };
        let span = refused.first_line()?;
        Some(Box::new(std::iter::once(LabeledSpan::new_with_span(None, span))))
    }
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

impl Diagnostic for Shown<'_> {
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
pub struct Refused(SceneError);

/// Longest line shown whole (bytes); of a longer one only the surroundings of the fault.
const LONGEST_LINE: usize = 200;
/// Bytes shown before and after a fault in such a line.
const SURROUNDINGS: usize = 40;

impl Refused {
    /// The first line of the fault's span, a character at least where there is one.
    fn first_line(&self) -> Option<SourceSpan> {
        let span = self.0.span.clone()?;
        let text: &str = &self.0.text;
        // A fault at the very end is shown at the last character.
        let start = boundary(text, span.start.min(text.len().saturating_sub(1)));
        let fault = text.get(start..span.end.max(start))?;
        let length = fault.find(['\n', '\r']).unwrap_or(fault.len());
        Some((start, length.min(LONGEST_LINE)).into())
    }
}

impl SourceCode for Refused {
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
    let mut at = byte.min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}
