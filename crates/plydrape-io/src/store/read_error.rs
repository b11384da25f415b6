//! Why a result, or the file of its sheet, cannot be read, and what to do.

use crate::store::file_kind;
use crate::store::format::{FILE, VERSION};
use crate::store::shown::name;
use crate::store::size::SizeError;
use std::io;
use std::path::{Path, PathBuf};

/// Why a file is no result that can be used, and what to do.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// The file system refused.
    #[error("`{}` {}", path.display(), unread(source))]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// The file system's answer.
        source: std::io::Error,
    },
    /// It would not fit the memory that is allowed.
    #[error("`{}`: {source}", path.display())]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// What is too large.
        source: SizeError,
    },
    /// The text breaks off.
    #[error("`{}` ends in the middle, at line {line}, column {column}: it was cut short", path.display())]
    Truncated {
        /// The file.
        path: PathBuf,
        /// Line of the end, from 1.
        line: usize,
        /// Column of the end, from 1.
        column: usize,
    },
    /// Something else, not a result that plydrape wrote.
    #[error("`{}` is {reason}", path.display())]
    Foreign {
        /// The file.
        path: PathBuf,
        /// What it is, or how it shows that it is none.
        reason: String,
    },
    /// Written in a later format.
    #[error("`{}` is a result in version {found} of the format, written by {program}; this is {} and reads version {VERSION}", path.display(), crate::PROGRAM)]
    Newer {
        /// The file.
        path: PathBuf,
        /// Version of the format.
        found: u64,
        /// The program that wrote it.
        program: String,
    },
    /// Written in an earlier format.
    #[error("`{}` is a result in version {found} of the format, written by {program}; this is {} and reads version {VERSION}", path.display(), crate::PROGRAM)]
    Older {
        /// The file.
        path: PathBuf,
        /// Version of the format.
        found: u64,
        /// The program that wrote it.
        program: String,
    },
    /// Beside files of another run: the last one was cut off while it replaced them.
    #[error("the files of `{}` are of two runs: the last one was cut off while it wrote them", path.display())]
    Mixed {
        /// The folder.
        path: PathBuf,
    },
    /// Changed since it was written.
    #[error("`{}` was changed since plydrape wrote it{}", path.display(), reason)]
    Changed {
        /// The file.
        path: PathBuf,
        /// How that shows, beginning with a colon; empty where only the check sum tells.
        reason: String,
    },
}

impl ReadError {
    /// What would help where the states of a result's sheet are the file.
    #[must_use]
    pub fn states_remedy(&self) -> String {
        match self {
            ReadError::Unreadable { .. } => {
                "put `sheet.npz` beside its result.json, or run the scene again".into()
            }
            _ => self.remedy(),
        }
    }

    /// What would help.
    #[must_use]
    pub fn remedy(&self) -> String {
        match self {
            ReadError::Unreadable { path, source } => match source.kind() {
                io::ErrorKind::NotFound => match file_kind::nearest_name(path) {
                    Some(near) => format!("did you mean `{}`?", name(&near)),
                    None => format!("give {GIVEN}"),
                },
                io::ErrorKind::IsADirectory => format!("give {GIVEN}"),
                _ => "give the path of a result.json that you may read".into(),
            },
            ReadError::TooLarge { source, .. } => source.remedy().into(),
            ReadError::Truncated { path, .. } => format!("copy it again, or {}", again(path)),
            ReadError::Foreign { .. } => format!("give {GIVEN}"),
            ReadError::Newer { path, .. } => format!("update plydrape, or {}", again(path)),
            ReadError::Mixed { path } => again(&path.join(FILE)),
            ReadError::Older { path, .. } => format!("{} with this version", again(path)),
            ReadError::Changed { path, .. } => {
                format!("put the file back as it was, or {}", again(path))
            }
        }
    }
}

/// How a file is not read.
fn unread(source: &io::Error) -> String {
    match source.kind() {
        io::ErrorKind::NotFound => "cannot be read: there is no such file".into(),
        io::ErrorKind::IsADirectory => format!("is a folder without a {FILE}"),
        _ => format!("cannot be read: {source}"),
    }
}

/// What is wanted.
const GIVEN: &str = "the result.json of `plydrape simulate` or `plydrape plan`, or its folder";

/// How to make a result anew: with its scene, where the folder's name says which one that is and how it was run.
fn again(path: &Path) -> String {
    let folder = path.parent().unwrap_or(Path::new(""));
    let command = match folder.extension().and_then(|extension| extension.to_str()) {
        Some("plan") => "plan",
        Some("results") => "simulate",
        _ => return "run `plydrape simulate` or `plydrape plan` again".into(),
    };
    let scene = folder.with_extension("toml");
    if scene.is_file() {
        return format!("run `plydrape {command} {}` again", name(&scene.to_string_lossy()));
    }
    format!("run `plydrape {command}` again with its scene")
}
