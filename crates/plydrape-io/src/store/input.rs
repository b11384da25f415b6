//! Files as they are read: regular ones, and no more of them than was allowed.
//!
//! A pipe may wait for ever, and a device such as `/dev/zero` never ends, so neither is opened.

use std::fs::{self, File};
use std::io::{self, ErrorKind, Read};
use std::path::Path;

/// Size of a regular file (bytes).
///
/// # Errors
/// If there is none, or the path leads to a folder, a pipe, a socket or a device.
pub fn size(path: &Path) -> io::Result<u64> {
    let found = fs::metadata(path)?;
    if found.is_dir() {
        return Err(io::Error::new(ErrorKind::IsADirectory, "it is a folder, not a file"));
    }
    if !found.is_file() {
        let what = "it is a pipe, a socket or a device, not a regular file";
        return Err(io::Error::new(ErrorKind::InvalidInput, what));
    }
    Ok(found.len())
}

/// Contents of a regular file of at most `largest` bytes.
///
/// # Errors
/// As [`size`], if the file is larger, or if the file system refuses.
pub fn bytes(path: &Path, largest: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    if size(path)? <= largest {
        // it may grow meanwhile
        File::open(path)?.take(largest.saturating_add(1)).read_to_end(&mut bytes)?;
        if bytes.len() as u64 <= largest {
            return Ok(bytes);
        }
    }
    let most = match largest >> 20 {
        0 => format!("{} KiB", largest >> 10),
        most => format!("{most} MiB"),
    };
    let what = format!("it is larger than {most}");
    Err(io::Error::new(ErrorKind::FileTooLarge, what))
}

/// Contents of a regular text file (UTF-8) of at most `largest` bytes.
///
/// # Errors
/// As [`bytes`], or if it is no text.
pub fn text(path: &Path, largest: u64) -> io::Result<String> {
    String::from_utf8(bytes(path, largest)?)
        .map_err(|_| io::Error::new(ErrorKind::InvalidData, "it is not UTF-8 text"))
}
