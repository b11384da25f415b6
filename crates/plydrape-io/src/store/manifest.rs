//! The list `.plydrape` of what plydrape wrote into a folder: by which command, checksum and length of each file.

use crate::Error;
use crate::store::input;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fs;
use std::io::{self, ErrorKind, Write};
use std::path::{Component, Path};

/// Name of the list in its folder.
pub(crate) const NAME: &str = ".plydrape";

/// Largest list that is read (bytes).
const LARGEST: u64 = 1 << 24;

/// CRC-32 (IEEE) and length in bytes of one content.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Stamp {
    pub crc32: u32,
    pub length: u64,
}

/// What plydrape has written under one name.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    /// The command that wrote it.
    by: String,
    /// Contents; more than one while files are being replaced.
    contents: Vec<Stamp>,
}

/// What plydrape has written into a folder, by file name.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Manifest {
    /// All files are of finished runs: false while they are being replaced.
    sealed: bool,
    files: BTreeMap<String, Entry>,
}

impl Default for Manifest {
    fn default() -> Self {
        Manifest { sealed: true, files: BTreeMap::new() }
    }
}

impl Stamp {
    /// The stamp of all that is left to read.
    pub(crate) fn read(mut content: impl io::Read) -> io::Result<Self> {
        let mut stamping = Stamping::new(io::sink());
        io::copy(&mut content, &mut stamping)?;
        Ok(stamping.stamp())
    }
}

/// Passes on what is written and takes its stamp.
pub(crate) struct Stamping<W> {
    to: W,
    sum: crc32fast::Hasher,
    length: u64,
}

impl<W: Write> Stamping<W> {
    pub(crate) fn new(to: W) -> Self {
        Stamping { to, sum: crc32fast::Hasher::new(), length: 0 }
    }

    pub(crate) fn stamp(self) -> Stamp {
        Stamp { crc32: self.sum.finalize(), length: self.length }
    }
}

impl<W: Write> Write for Stamping<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = self.to.write(bytes)?;
        self.sum.update(&bytes[..count]);
        self.length += count as u64;
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.to.flush()
    }
}

impl Manifest {
    /// The list of a folder; empty where there is none.
    pub(crate) fn read(dir: &Path) -> Result<Self, Error> {
        let path = dir.join(NAME);
        let text = match input::bytes(&path, LARGEST) {
            Ok(text) => text,
            Err(e) if e.kind() == ErrorKind::NotFound => return Ok(Self::default()),
            Err(e) => return Err(Error::write("read", &path, e)),
        };
        let list = serde_json::from_slice(&text)
            .or_else(|_| serde_json::from_slice(&text).map(Self::earlier))
            .map_err(|_| Error::Foreign { path: path.clone() })?;
        // A name with a path in it could reach out of the folder.
        if list.names().all(Self::is_plain) { Ok(list) } else { Err(Error::Foreign { path }) }
    }

    /// The list as it was before it named commands.
    fn earlier(files: BTreeMap<String, Vec<Stamp>>) -> Self {
        let entry = |contents| Entry { by: String::new(), contents };
        let files = files.into_iter().map(|(name, contents)| (name, entry(contents)));
        Manifest { sealed: true, files: files.collect() }
    }

    /// The list of a set of files that a command writes.
    pub(crate) fn new(by: &str, files: impl IntoIterator<Item = (String, Stamp)>) -> Self {
        let entry = |stamp| Entry { by: by.into(), contents: vec![stamp] };
        let files = files.into_iter().map(|(name, stamp)| (name, entry(stamp)));
        Manifest { sealed: true, files: files.collect() }
    }

    /// Both lists together, without a seal: while files of one are replaced by those of the other.
    pub(crate) fn with(&self, other: &Manifest) -> Manifest {
        let mut both = Manifest { sealed: false, ..self.clone() };
        for (name, entry) in &other.files {
            let known = both.files.entry(name.clone()).or_insert_with(|| entry.clone());
            known.by.clone_from(&entry.by);
            known.contents.retain(|stamp| !entry.contents.contains(stamp));
            known.contents.extend(&entry.contents);
        }
        both
    }

    /// The list without some names.
    pub(crate) fn without(mut self, names: &[String]) -> Manifest {
        self.files.retain(|name, _| !names.contains(name));
        self
    }

    /// The list without the names of another one.
    pub(crate) fn without_those_of(&self, other: &Manifest) -> Manifest {
        let names: Vec<String> = other.names().map(str::to_owned).collect();
        self.clone().without(&names)
    }

    /// Whether every file of the list is in the folder with the one content that the list has of it, whatever a run that was killed has left
    /// of others.
    pub(crate) fn is_whole(&self, dir: &Path) -> bool {
        let single = self.files.values().all(|entry| entry.contents.len() == 1);
        single && self.names().all(|name| self.holds(dir, name))
    }

    /// The list once files of another one have come in their places, with or without a seal.
    pub(crate) fn replaced_by(mut self, other: &Manifest, sealed: bool) -> Manifest {
        self.files.extend(other.files.clone());
        self.sealed = sealed;
        self
    }

    /// Whether all files are of finished runs.
    pub(crate) fn is_sealed(&self) -> bool {
        self.sealed
    }

    /// The names that a command has written.
    pub(crate) fn names_of<'a>(&'a self, by: &'a str) -> impl Iterator<Item = &'a str> {
        let own = move |(name, entry): (&'a String, &'a Entry)| (entry.by == by).then_some(&**name);
        self.files.iter().filter_map(own)
    }

    /// The names listed.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        self.files.keys().map(String::as_str)
    }

    /// True if the file of that name is a plain file with a listed content.
    pub(crate) fn holds(&self, dir: &Path, name: &str) -> bool {
        let path = dir.join(name);
        let Some(Entry { contents, .. }) = self.files.get(name) else {
            return false;
        };
        fs::symlink_metadata(&path).is_ok_and(|found| found.is_file())
            && fs::File::open(&path)
                .and_then(Stamp::read)
                .is_ok_and(|stamp| contents.contains(&stamp))
    }

    /// The list as JSON, one line.
    pub(crate) fn text(&self) -> Result<String, Error> {
        crate::store::json::to_text(self)
    }

    /// True for a file name without any path, other than the list's own.
    pub(crate) fn is_plain(name: &str) -> bool {
        let mut parts = Path::new(name).components();
        name != NAME
            && matches!(
                (parts.next(), parts.next()),
                (Some(Component::Normal(part)), None) if part == name
            )
    }
}
