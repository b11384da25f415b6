//! From bytes to a text, and from a text to the keys of a file.

use super::source::Document;
use super::{diagnostic, tree};
use crate::Error;
use crate::error::{Diagnostic, Fault};
use crate::store::file_kind::{self, FileKind};
use crate::store::{encoding, input, shown};
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
        let fault =
            nothing.fault(format!("`{name}` is a folder, not a file"), "name a file inside it");
        return Err(
            Diagnostic { unread: Some((path.into(), ErrorKind::IsADirectory)), ..fault }.into()
        );
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

/// What to do about a file that is not there, if anything helps.
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

/// What to do about a pipe or a device, which are never read, and about a file that this user may not read.
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
    let folder = path.parent().unwrap_or(Path::new(""));
    Ok(decoded(bytes(path, name, largest)?, name, Old::Refused)?.within(folder))
}

/// Reads a table, named `name` in messages: where it is not UTF-8 it is taken for Latin-1, as spreadsheets of Western Europe save CSV files.
pub(super) fn table(path: &Path, name: &str) -> Result<Document, Error> {
    decoded(bytes(path, name, LARGEST_CSV)?, name, Old::Latin1)
}

/// What a text may be that is no Unicode.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Old {
    /// Nothing.
    Refused,
    /// ISO 8859-1.
    Latin1,
}

/// A text from its bytes: UTF-8, UTF-16, or an old encoding where that may be. Line ends of old Macintoshes become those of today.
fn decoded(bytes: Vec<u8>, name: &str, old: Old) -> Result<Document, Error> {
    let shown = short(name);
    let refused =
        |message: String, help: &str| Err(Document::new(name, "").error_anywhere(message, help));
    if let Some(text) = encoding::wide(&bytes) {
        return match text {
            Some(text) => Ok(lines_ended(text, name)),
            None => refused(
                format!("`{shown}` is UTF-16 text, and damaged"),
                "save the file with the encoding UTF-8, which Windows' Notepad and PowerShell offer too",
            ),
        };
    }
    if let Some(kind) = FileKind::detect(&bytes)
        && !matches!(kind, FileKind::Scene | FileKind::Table)
        && (std::str::from_utf8(&bytes).is_err() || bytes.contains(&0))
    {
        return refused(
            format!("`{shown}` is {}, not a text", kind.name()),
            "save a table as CSV, with the encoding UTF-8",
        );
    }
    let nul = bytes.iter().position(|byte| *byte == 0);
    let text = match String::from_utf8(bytes) {
        Ok(text) => text,
        Err(error) => {
            let bytes = error.as_bytes();
            let at = error.utf8_error().valid_up_to();
            let strange = bytes.iter().position(|byte| (0x7f..0xa0).contains(byte) || *byte == 0);
            let (at, what) = match (old, strange) {
                (Old::Latin1, None) => {
                    let text = bytes.iter().map(|byte| char::from(*byte)).collect();
                    return Ok(lines_ended(text, name));
                }
                (Old::Latin1, Some(strange)) => (strange, "neither UTF-8 nor Latin-1 text"),
                (Old::Refused, _) => (at, "not UTF-8 text"),
            };
            let byte = bytes.get(at).copied().unwrap_or_default();
            // the lossy text has three bytes for each that is none
            let before = String::from_utf8_lossy(&bytes[..at]).len();
            let lossy = Document::new(name, &String::from_utf8_lossy(bytes));
            let width = lossy.text.get(before..).and_then(|tail| tail.chars().next());
            return Err(lossy.error(
                before..before + width.map_or(0, char::len_utf8),
                format!("`{shown}` is {what}: byte {at} is 0x{byte:02x}"),
                "save the file with the encoding UTF-8",
            ));
        }
    };
    // the mark of UTF-8, which spreadsheets and some editors put first
    let mark = text.len() - text.trim_start_matches('\u{feff}').len();
    if let Some(at) = nul {
        let document = Document::new(name, &text);
        return Err(document.error(
            at..at + 1,
            format!("`{shown}` is no plain text: byte {at} is a NUL byte"),
            "remove the NUL bytes, or save the file anew with the encoding UTF-8",
        ));
    }
    Ok(lines_ended(text[mark..].to_owned(), name))
}

/// A document whose lines end as those of Unix and Windows do.
fn lines_ended(text: String, name: &str) -> Document {
    Document::new(name, &encoding::line_feeds(text))
}

fn reason(error: &std::io::Error) -> String {
    match error.kind() {
        ErrorKind::NotFound => "there is no such file".into(),
        ErrorKind::PermissionDenied => "permission denied".into(),
        _ => error.to_string(),
    }
}

/// Reads the keys of a TOML text.
pub(super) fn keys<T: DeserializeOwned>(document: &Document) -> Result<T, Error> {
    tree::read(&document.text).map_err(|fault| diagnostic::scene_error(document, fault))
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "Weg (mm);Dehnung (µm)\n4;5\n";

    fn converted(bytes: &[u8], old: Old) -> Result<String, Error> {
        decoded(bytes.to_vec(), "a.csv", old).map(|document| document.text.to_string())
    }

    fn wide(text: &str, bytes: fn(u16) -> [u8; 2]) -> Vec<u8> {
        text.encode_utf16().flat_map(bytes).collect()
    }

    #[test]
    fn a_text_is_the_same_in_every_encoding() {
        let old: Vec<u8> = TEXT.chars().map(|c| u8::try_from(u32::from(c)).unwrap()).collect();
        let marked = format!("\u{feff}{TEXT}");
        for bytes in [
            TEXT.as_bytes().to_vec(),
            marked.as_bytes().to_vec(),
            wide(&marked, u16::to_le_bytes),
            wide(&marked, u16::to_be_bytes),
            TEXT.replace('\n', "\r").into_bytes(),
            old.clone(),
        ] {
            assert_eq!(converted(&bytes, Old::Latin1).unwrap(), TEXT, "{bytes:?}");
        }
        assert_eq!(converted(&wide("a = 1\n", u16::to_le_bytes), Old::Refused).unwrap(), "a = 1\n");
        let error = converted(&old, Old::Refused).unwrap_err();
        assert_eq!(error.message(), "`a.csv` is not UTF-8 text: byte 18 is 0xb5");
        assert_eq!(error.diagnostic().unwrap().line_column(), Some((1, 19)));
    }

    #[test]
    fn what_is_no_text_is_refused_at_its_byte() {
        for (bytes, message) in [
            (&b"x,y\n1,\0\n"[..], "`a.csv` is no plain text: byte 6 is a NUL byte"),
            (b"\xff\xfex\0,", "`a.csv` is UTF-16 text, and damaged"),
            (b"\xff\xfe\0\0x\0\0\0", "`a.csv` is UTF-16 text, and damaged"),
            (b"D\x82p (mm)\n1\n", "`a.csv` is neither UTF-8 nor Latin-1 text: byte 1 is 0x82"),
            (b"PK\x03\x04\0\xff", "`a.csv` is a ZIP archive or a spreadsheet, not a text"),
        ] {
            let error = converted(bytes, Old::Latin1).unwrap_err();
            assert_eq!(error.message(), message);
            assert!(error.help().contains("UTF-8"), "{}", error.help());
        }
    }
}
