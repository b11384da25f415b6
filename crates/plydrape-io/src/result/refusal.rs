//! Why a result, or the file of its sheet, cannot be used, and what to do.

use crate::Error;
use crate::store::file_kind;
use crate::store::format::{FILE, VERSION};
use crate::store::shown::name;
use std::io::{self, ErrorKind};
use std::path::Path;

/// What to give in place of what is no result.
const GIVEN: &str = "give the result.json of `plydrape simulate` or `plydrape plan`, or its folder";

/// The file system refused.
pub(super) fn unreadable(path: &Path, source: io::Error) -> Error {
    let (reason, help) = match source.kind() {
        ErrorKind::NotFound => (
            "cannot be read: there is no such file".into(),
            match file_kind::nearest_name(path) {
                Some(near) => format!("did you mean `{}`?", name(&near)),
                None => GIVEN.into(),
            },
        ),
        ErrorKind::IsADirectory => (format!("is a folder without a {FILE}"), GIVEN.into()),
        _ => (
            format!("cannot be read: {source}"),
            "give the path of a result.json that you may read".into(),
        ),
    };
    Error::Io { path: path.into(), message: format!("`{}` {reason}", path.display()), help, source }
}

/// A file that is not what a result must be.
fn refused(path: &Path, reason: &str, help: String) -> Error {
    Error::file(path, format!("`{}` {reason}", path.display()), help)
}

/// The text breaks off.
pub(super) fn truncated(path: &Path, line: usize, column: usize) -> Error {
    let reason = format!("ends in the middle, at line {line}, column {column}: it was cut short");
    refused(path, &reason, format!("copy it again, or {}", again(path)))
}

/// Something else, not a result that plydrape wrote: `reason` says what it is, or how it shows that it is none.
pub(super) fn foreign(path: &Path, reason: &str) -> Error {
    refused(path, &format!("is {reason}"), GIVEN.into())
}

/// Written in another version of the format.
pub(super) fn other_version(path: &Path, found: u64, program: &str) -> Error {
    let reason = format!(
        "is a result in version {found} of the format, written by {program}; this is {} and reads version {VERSION}",
        crate::PROGRAM
    );
    let help = match found > u64::from(VERSION) {
        true => format!("update plydrape, or {}", again(path)),
        false => format!("{} with this version", again(path)),
    };
    refused(path, &reason, help)
}

/// A folder of files of two runs: the last one was cut off while it replaced them.
pub(super) fn mixed(folder: &Path) -> Error {
    let message = format!(
        "the files of `{}` are of two runs: the last one was cut off while it wrote them",
        folder.display()
    );
    Error::file(folder, message, again(&folder.join(FILE)))
}

/// Changed since it was written: `what` says how that shows.
pub(super) fn changed(path: &Path, what: &str) -> Error {
    let reason = format!("was changed since plydrape wrote it: {what}");
    refused(path, &reason, format!("put the file back as it was, or {}", again(path)))
}

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
