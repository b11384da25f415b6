//! Why results could not be written, and what to do about it.

use crate::store::json::JsonError;
use crate::store::read_error::ReadError;
use plydrape::motion::MotionError;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

/// Why results could not be written.
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
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
    /// The boundary at the end is that of the sheet, and the result has none, or not to its end.
    #[error(
        "the result has no sheet whose boundary could be written: drape the scene with kind = \"sheet\" in [model]"
    )]
    NoSheet,
    /// The file system refused.
    #[error("cannot {what} {}: {source}; {remedy}", path.display())]
    Io {
        /// What was tried.
        what: &'static str,
        /// On which path.
        path: PathBuf,
        /// What would help.
        remedy: &'static str,
        /// The file system's answer.
        source: io::Error,
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
        cause: Box<OutputError>,
    },
    /// The result has no JSON text.
    #[error(transparent)]
    Json(#[from] JsonError),
    /// A table could not be formed.
    #[error("cannot form a table: {0}")]
    Csv(#[from] csv::Error),
    /// A motion cannot be sampled as asked for.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// The writer of a file cannot show the result: it has no ROS 2 messages, no program or no input deck.
    #[error(transparent)]
    Writer(Box<dyn std::error::Error + Send + Sync>),
    /// The states of a sheet cannot be read.
    #[error(transparent)]
    States(#[from] ReadError),
}

impl OutputError {
    /// The file system's answer, with the remedy that fits it.
    pub(crate) fn io(what: &'static str, path: &Path, source: io::Error) -> Self {
        let remedy = match source.kind() {
            ErrorKind::StorageFull | ErrorKind::QuotaExceeded => {
                "make room on the disk, or choose a folder on another one with -o"
            }
            ErrorKind::InvalidFilename => "choose a shorter path with -o",
            _ => "choose a folder that you may write to with -o",
        };
        OutputError::Io { what, path: path.into(), remedy, source }
    }
}
