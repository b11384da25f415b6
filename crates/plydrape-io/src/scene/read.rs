//! From bytes to a text, and from a text to the keys of a file.

use super::diagnostic;
use super::error::{Document, SceneError};
use crate::{input, shown};
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
pub(super) fn bytes(path: &Path, name: &str, largest: u64) -> Result<Vec<u8>, SceneError> {
    let nothing = Document::new(name, "");
    let name = shown::excerpt(name, LONGEST_PATH);
    if path.is_dir() {
        return Err(nothing.error_anywhere(
            format!("`{name}` is a folder, not a file"),
            "name the file inside it, e.g. scene.toml",
        ));
    }
    input::bytes(path, largest).map_err(|error| match error.kind() {
        ErrorKind::FileTooLarge => nothing.error_anywhere(
            format!("`{name}` is larger than {} MiB", largest >> 20),
            "is it the right file? large tables of gripper positions belong into a CSV file",
        ),
        _ => nothing.error_anywhere(
            format!("`{name}` cannot be read: {}", reason(&error)),
            format!("looked for {}", shown::excerpt(&path.to_string_lossy(), LONGEST_PATH)),
        ),
    })
}

/// Reads a text file, named `name` in messages.
pub(super) fn text(path: &Path, name: &str, largest: u64) -> Result<Document, SceneError> {
    match String::from_utf8(bytes(path, name, largest)?) {
        // Spreadsheets and some editors put a byte order mark first.
        Ok(text) => Ok(Document::new(name, text.trim_start_matches('\u{feff}'))),
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
pub(super) fn keys<T: DeserializeOwned>(document: &Document) -> Result<T, SceneError> {
    toml::from_str(&document.text).map_err(|error| diagnostic::scene_error(document, &error))
}
