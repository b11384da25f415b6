//! A result file, read back: the whole of it, unchanged, in this version of the format, or a refusal.
//!
//! Everything that is made of a result is made of these numbers, so a file that was cut short, edited or
//! written by another version is no basis. The check sum stands for all its bytes but white space at the end.

use super::folder;
use super::json::{CHECKSUM, checksum};
use crate::result::{FORMAT, ResultFile, VERSION};
use serde::Deserialize;
use serde_json::error::Category;
use std::path::{Path, PathBuf};

/// Why a file is no result that can be used, and what to do.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// The file system refused.
    #[error("`{}` cannot be read: {source}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// The file system's answer.
        source: std::io::Error,
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
    /// Something else, not written by plydrape.
    #[error("`{}` is not a result of plydrape: {reason}", path.display())]
    Foreign {
        /// The file.
        path: PathBuf,
        /// How that shows.
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
    /// What would help.
    #[must_use]
    pub fn remedy(&self) -> &'static str {
        match self {
            ReadError::Unreadable { .. } => "give the path of a result.json that you may read",
            ReadError::Truncated { .. } => {
                "copy it again, or run `plydrape simulate` or `plydrape plan` again"
            }
            ReadError::Foreign { .. } => {
                "give the result.json of `plydrape simulate` or `plydrape plan`"
            }
            ReadError::Newer { .. } => "update plydrape, or run the scene again with this version",
            ReadError::Mixed { .. } => "run the scene again into that folder",
            ReadError::Older { .. } => "run the scene again with this version",
            ReadError::Changed { .. } => {
                "put the file back as it was, or run `plydrape simulate` or `plydrape plan` again"
            }
        }
    }
}

/// What tells a result file before all of it is understood.
#[derive(Deserialize)]
struct Head {
    format: Option<serde_json::Value>,
    version: Option<u64>,
    program: Option<String>,
}

/// Reads a result file.
///
/// # Errors
/// [`ReadError`] if it cannot be read, or is not, to the last byte, what this version writes.
pub fn read(path: &Path) -> Result<ResultFile, ReadError> {
    let fault = |source| ReadError::Unreadable { path: path.into(), source };
    let bytes = std::fs::read(path).map_err(fault)?;
    let folder = path.parent().filter(|parent| *parent != Path::new("")).unwrap_or(Path::new("."));
    if !folder::is_sealed(folder) {
        return Err(ReadError::Mixed { path: folder.into() });
    }
    parse(&bytes, path)
}

/// The same from the bytes of a file; its path stands in messages.
///
/// # Errors
/// As [`read`].
pub fn parse(bytes: &[u8], path: &Path) -> Result<ResultFile, ReadError> {
    let path = path.to_path_buf();
    let Ok(text) = std::str::from_utf8(bytes) else {
        return Err(ReadError::Foreign { path, reason: "it is not text".into() });
    };
    let head: Head = match serde_json::from_str(text) {
        Ok(head) => head,
        Err(error) if error.classify() == Category::Eof && begins_as_ours(text) => {
            return Err(ReadError::Truncated { path, line: error.line(), column: error.column() });
        }
        Err(error) if begins_as_ours(text) => {
            return Err(ReadError::Changed { path, reason: format!(": {error}") });
        }
        Err(error) if error.classify() == Category::Data => {
            return Err(ReadError::Foreign {
                path,
                reason: format!("it has no `format` \"{FORMAT}\""),
            });
        }
        Err(error) => {
            return Err(ReadError::Foreign { path, reason: format!("it is not JSON, {error}") });
        }
    };
    let (version, program) = match head {
        Head { format: Some(format), version: Some(version), program } if format == FORMAT => {
            (version, program.unwrap_or_else(|| "an unknown program".into()))
        }
        _ => {
            let reason = format!("it has no `format` \"{FORMAT}\" with a `version`");
            return Err(ReadError::Foreign { path, reason });
        }
    };
    match version.cmp(&u64::from(VERSION)) {
        std::cmp::Ordering::Less => {
            return Err(ReadError::Older { path, found: version, program });
        }
        std::cmp::Ordering::Greater => {
            return Err(ReadError::Newer { path, found: version, program });
        }
        std::cmp::Ordering::Equal => {}
    }
    let result: ResultFile = serde_json::from_str(text)
        .map_err(|error| ReadError::Changed { path: path.clone(), reason: format!(": {error}") })?;
    if let Some(what) = gap(&result) {
        return Err(ReadError::Changed { path, reason: format!(": {what}") });
    }
    let value = format!("{CHECKSUM}\"{}\"", result.checksum);
    match text.split_once(&value) {
        Some((head, tail)) if checksum(head, tail) == result.checksum => Ok(result),
        _ => Err(ReadError::Changed {
            path,
            reason: ": its check sum does not match its contents".into(),
        }),
    }
}

/// What a result lacks for its own grid, in words; everything made of it relies on nothing being missing.
fn gap(result: &ResultFile) -> Option<String> {
    let grid = result.scene.grid;
    if grid.nu < 2 || grid.nv < 1 {
        return Some(format!("there is no ply of {} × {} grippers", grid.nu, grid.nv));
    }
    result.steps.iter().find_map(|step| {
        let counts = [
            ("grippers", step.grippers.len(), grid.grippers()),
            ("catenaries", step.catenaries.len(), grid.catenaries()),
            ("cells", step.cells.len(), grid.cells()),
        ];
        let (what, found, wanted) =
            counts.into_iter().find(|(_, found, wanted)| found != wanted)?;
        Some(format!("step {} has {found} {what}, not {wanted}", step.step))
    })
}

/// Whether a text that is no JSON begins as a result file does.
fn begins_as_ours(text: &str) -> bool {
    let start: String = text.chars().filter(|c| !c.is_whitespace()).take(64).collect();
    start.starts_with(&format!("{{\"format\":\"{FORMAT}\""))
}

#[cfg(test)]
#[path = "read_tests.rs"]
mod tests;
