//! The list `.plydrape` of what plydrape wrote into a folder: checksum and length of each file.

use super::OutputError;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fs;
use std::io::ErrorKind;
use std::path::{Component, Path};

/// Name of the list in its folder.
pub(super) const NAME: &str = ".plydrape";

/// CRC-32 (IEEE) and length in bytes of one content.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
struct Stamp {
    crc32: u32,
    length: u64,
}

/// Contents that plydrape has written, by file name; more than one while files are being replaced.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub(super) struct Manifest {
    files: BTreeMap<String, Vec<Stamp>>,
}

impl Stamp {
    fn of(content: &[u8]) -> Self {
        Stamp { crc32: crc32fast::hash(content), length: content.len() as u64 }
    }
}

impl Manifest {
    /// The list of a folder; empty where there is none.
    pub(super) fn read(dir: &Path) -> Result<Self, OutputError> {
        let path = dir.join(NAME);
        let text = match fs::read(&path) {
            Ok(text) => text,
            Err(e) if e.kind() == ErrorKind::NotFound => return Ok(Self::default()),
            Err(e) => return Err(OutputError::io("read", &path, e)),
        };
        let list: Manifest = serde_json::from_slice(&text)
            .map_err(|_| OutputError::Foreign { path: path.clone() })?;
        // A name with a path in it could reach out of the folder.
        if list.names().all(Self::is_plain) { Ok(list) } else { Err(OutputError::Foreign { path }) }
    }

    /// The list of a set of files.
    pub(super) fn of(files: &[(&str, &[u8])]) -> Self {
        let stamps =
            files.iter().map(|(name, content)| ((*name).to_owned(), vec![Stamp::of(content)]));
        Manifest { files: stamps.collect() }
    }

    /// Both lists together.
    pub(super) fn with(&self, other: &Manifest) -> Manifest {
        let mut both = self.clone();
        for (name, stamps) in &other.files {
            let known = both.files.entry(name.clone()).or_default();
            known.retain(|stamp| !stamps.contains(stamp));
            known.extend(stamps);
        }
        both
    }

    /// The names listed.
    pub(super) fn names(&self) -> impl Iterator<Item = &str> {
        self.files.keys().map(String::as_str)
    }

    /// True if the file of that name is a plain file with a listed content.
    pub(super) fn holds(&self, dir: &Path, name: &str) -> bool {
        let path = dir.join(name);
        let Some(stamps) = self.files.get(name) else {
            return false;
        };
        fs::symlink_metadata(&path).is_ok_and(|found| found.is_file())
            && fs::read(&path).is_ok_and(|content| stamps.contains(&Stamp::of(&content)))
    }

    /// The list as JSON, one line.
    pub(super) fn text(&self) -> Result<String, OutputError> {
        Ok(super::json::of(self)?)
    }

    /// True for a file name without any path, other than the list's own.
    pub(super) fn is_plain(name: &str) -> bool {
        let mut parts = Path::new(name).components();
        name != NAME
            && matches!(
                (parts.next(), parts.next()),
                (Some(Component::Normal(part)), None) if part == name
            )
    }
}
