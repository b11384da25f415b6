//! From bytes to a text, and from a text to the keys of a file.

use super::source::Document;
use super::{diagnostic, tree};
use crate::Error;
use crate::error::{Diagnostic, Fault};
use crate::store::file_kind::{self, FileKind};
use crate::store::{input, shown};
use serde::de::DeserializeOwned;
use std::io::ErrorKind;
use std::path::Path;

/// Largest TOML file that is read (bytes).
pub(super) const LARGEST_TOML: u64 = 16 << 20;
/// Largest CSV file that is read (bytes).
pub(super) const LARGEST_CSV: u64 = 1 << 30;

/// Characters of a path that a message repeats at most.
const LONGEST_PATH: usize = 400;

/// Reads a file, named `name` in messages.
pub(super) fn bytes(path: &Path, name: &str, largest: u64) -> Result<Vec<u8>, Error> {
    let nothing = Document::new(name, "");
    let name = shown::excerpt(name, LONGEST_PATH);
    if path.is_dir() {
        return Err(nothing
            .error_anywhere(format!("`{name}` is a folder, not a file"), "name a file inside it"));
    }
    input::bytes(path, largest).map_err(|error| match error.kind() {
        ErrorKind::FileTooLarge => nothing.error_anywhere(
            format!("`{name}` is larger than {} MiB", largest >> 20),
            "is it the right file? large tables of gripper positions belong into a CSV file",
        ),
        kind => {
            let Fault { message, help } = unreadable(path, &name, &error);
            Diagnostic { unread: Some((path.into(), kind)), ..nothing.fault(message, help) }.into()
        }
    })
}

/// Why a file, named `name`, cannot be read, and what to do; nothing where the message says all.
fn unreadable(path: &Path, name: &str, error: &std::io::Error) -> Fault {
    let help = not_found(path, error).or_else(|| not_readable(path, error)).or_else(|| {
        let written = path.to_string_lossy();
        (written != name).then(|| format!("looked for {}", short(&written)))
    });
    let message = format!("`{}` cannot be read: {}", short(name), reason(error));
    Fault::new(message, help.unwrap_or_default())
}

/// What helps with a file that a scene or a book names.
pub(super) fn beside(what: &str, help: &str) -> String {
    let relative = format!("paths are relative to the {what}'s folder");
    if help.is_empty() { relative } else { format!("{relative}; {help}") }
}

/// A path as messages show it.
fn short(name: &str) -> String {
    shown::name(&shown::excerpt(name, LONGEST_PATH))
}

/// What to do about a file that is not there, if that can be told.
fn not_found(path: &Path, error: &std::io::Error) -> Option<String> {
    if error.kind() != ErrorKind::NotFound {
        return None;
    }
    let written = path.to_string_lossy();
    if shown::control(&written).is_some() {
        return Some(format!("{BACKSLASHES} in single quotes, as in 'C:\\molds\\new.stl'"));
    }
    if cfg!(not(windows)) {
        if written.contains('\\') {
            return Some(format!(
                "this system separates folders by forward slashes: write `{}`",
                short(&written.replace('\\', "/"))
            ));
        }
        let drive = written.split('/').find(|part| {
            part.len() == 2
                && part.ends_with(':')
                && part.starts_with(|c: char| c.is_ascii_alphabetic())
        });
        if let Some(drive) = drive {
            return Some(format!(
                "`{drive}` is a drive of Windows, which this system does not have"
            ));
        }
    }
    file_kind::nearest_name(path).map(|near| format!("did you mean `{}`?", short(&near)))
}

/// What to do about a pipe or a device, of which nothing is read, and about a file that is closed to this user.
fn not_readable(path: &Path, error: &std::io::Error) -> Option<String> {
    match error.kind() {
        ErrorKind::InvalidInput if path.exists() => {
            Some("save what it gives as a file, and name that".into())
        }
        ErrorKind::PermissionDenied => Some("allow this user to read it".into()),
        _ => None,
    }
}

/// What a path of Windows in double quotes needs.
pub(super) const BACKSLASHES: &str =
    "in double quotes a backslash begins an escape: write a path with forward slashes, or";

/// Reads a text file, named `name` in messages.
pub(super) fn text(path: &Path, name: &str, largest: u64) -> Result<Document, Error> {
    decoded(bytes(path, name, largest)?, name)
}

/// Reads a table of a laboratory: where it is not UTF-8 it is taken for Latin-1, as spreadsheets of Western Europe save CSV files.
pub(super) fn lab_text(path: &Path, name: &str, largest: u64) -> Result<Document, Error> {
    let bytes = bytes(path, name, largest)?;
    let is_table = matches!(FileKind::of(&bytes), None | Some(FileKind::Table));
    let marked = [b"\xff\xfe", b"\xfe\xff"].iter().any(|mark| bytes.starts_with(*mark));
    if std::str::from_utf8(&bytes).is_err() && is_table && !marked && !bytes.contains(&0) {
        let text: String = bytes.iter().map(|byte| char::from(*byte)).collect();
        return Ok(Document::new(name, &text));
    }
    decoded(bytes, name)
}

/// A text from its bytes.
fn decoded(bytes: Vec<u8>, name: &str) -> Result<Document, Error> {
    match String::from_utf8(bytes) {
        // Spreadsheets and some editors put a byte order mark first.
        Ok(text) => Ok(Document::new(name, text.trim_start_matches('\u{feff}'))),
        Err(error) if [b"\xff\xfe", b"\xfe\xff"].iter().any(|mark| error.as_bytes().starts_with(*mark)) => {
            Err(Document::new(name, "").error_anywhere(
                format!("`{name}` is UTF-16 text"),
                "save the file with the encoding UTF-8, which Windows' Notepad and PowerShell offer too",
            ))
        }
        Err(error) if FileKind::of(error.as_bytes()).is_some_and(|kind| kind != FileKind::Scene) => {
            let kind = FileKind::of(error.as_bytes()).map_or("", FileKind::name);
            Err(Document::new(name, "").error_anywhere(
                format!("`{name}` is {kind}, not a text"),
                "save a table as CSV, with the encoding UTF-8",
            ))
        }
        Err(error) => {
            let at = error.utf8_error().valid_up_to();
            let byte = error.as_bytes().get(at).copied().unwrap_or_default();
            let lossy = Document::new(name, &String::from_utf8_lossy(error.as_bytes()));
            Err(lossy.error(
                at..at + char::REPLACEMENT_CHARACTER.len_utf8(),
                format!("`{name}` is not UTF-8 text: byte {at} is 0x{byte:02x}"),
                "save the file with the encoding UTF-8",
            ))
        }
    }
}

fn reason(error: &std::io::Error) -> String {
    match error.kind() {
        std::io::ErrorKind::NotFound => "there is no such file".into(),
        std::io::ErrorKind::PermissionDenied => "permission denied".into(),
        _ => error.to_string(),
    }
}

/// Reads the keys of a TOML text.
pub(super) fn keys<T: DeserializeOwned>(document: &Document) -> Result<T, Error> {
    tree::read(&document.text).map_err(|fault| diagnostic::scene_error(document, fault))
}
