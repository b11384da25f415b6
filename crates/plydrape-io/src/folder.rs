//! A folder of results, written whole or not at all, and never over a file of the user's.
//!
//! plydrape keeps a small list `.plydrape` in the folder: the checksum and length of each file it put
//! there. A file may be replaced only if it is still what the list says. New files are staged in a
//! hidden folder beside their place, brought to the disk, and moved in by renaming; if that fails in
//! the middle, the earlier files come back. The list names old and new contents while files are moved,
//! so that a power cut leaves files that the next run still knows as its own.

use super::OutputError;
use super::manifest::{Manifest, NAME as MANIFEST};
use std::fs::{self, File};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// Writes a set of files (plain name and content) into a folder, all of them or none.
///
/// The folder is made if it is missing. Files of an earlier run that are listed, unchanged and not
/// written now are removed. Returns the paths written, in the order given.
///
/// # Errors
/// [`OutputError::Foreign`] if a file in the way was not written by plydrape or was changed since;
/// the other variants where the folder or the disk refuses.
pub fn write(dir: &Path, files: &[(&str, &[u8])]) -> Result<Vec<PathBuf>, OutputError> {
    put(dir, files, true)
}

/// The same, but files of an earlier run that are not written now stay.
///
/// # Errors
/// As [`write()`].
pub fn add(dir: &Path, files: &[(&str, &[u8])]) -> Result<Vec<PathBuf>, OutputError> {
    put(dir, files, false)
}

fn put(dir: &Path, files: &[(&str, &[u8])], alone: bool) -> Result<Vec<PathBuf>, OutputError> {
    let made = make(dir)?;
    let written = replace(dir, files, alone);
    if made && written.is_err() {
        // Only an empty folder goes, and only the one made here.
        let _ = fs::remove_dir(dir);
    }
    written
}

/// Makes the folder; true if it was not there before.
fn make(dir: &Path) -> Result<bool, OutputError> {
    match fs::metadata(dir) {
        Ok(found) if found.is_dir() => Ok(false),
        Ok(_) => Err(OutputError::NotAFolder { path: dir.into() }),
        Err(_) => match fs::create_dir_all(dir) {
            Ok(()) => Ok(true),
            Err(e) if matches!(e.kind(), ErrorKind::NotADirectory | ErrorKind::AlreadyExists) => {
                Err(OutputError::NotAFolder { path: dir.into() })
            }
            Err(e) => Err(OutputError::io("make the folder", dir, e)),
        },
    }
}

fn replace(dir: &Path, files: &[(&str, &[u8])], alone: bool) -> Result<Vec<PathBuf>, OutputError> {
    // Nothing is touched before every name is known to be free or our own.
    let earlier = Manifest::read(dir)?;
    for (name, _) in files {
        let path = dir.join(name);
        if !Manifest::is_plain(name) {
            return Err(OutputError::Foreign { path });
        }
        if fs::symlink_metadata(&path).is_ok() && !earlier.holds(dir, name) {
            return Err(OutputError::Foreign { path });
        }
    }
    let stale: Vec<String> = earlier
        .names()
        .filter(|name| {
            alone && files.iter().all(|(new, _)| new != name) && earlier.holds(dir, name)
        })
        .map(str::to_owned)
        .collect();

    // Stage everything on the disk, beside its place.
    let stage = tempfile::Builder::new()
        .prefix(".plydrape-")
        .tempdir_in(dir)
        .map_err(|e| OutputError::io("write into", dir, e))?;
    let new = Manifest::of(files);
    let (both, own) = (earlier.with(&new).text()?, new.text()?);
    for (name, content) in files {
        stage_file(&stage, dir, name, content)?;
    }
    stage_file(&stage, dir, "both", both.as_bytes())?;
    stage_file(&stage, dir, "alone", own.as_bytes())?;

    // Move in, the list first: a cut in power from here on leaves only files that it knows.
    let mut moves = Moves::new(dir, stage);
    let moved = moves.put("both", MANIFEST).and_then(|()| {
        for (name, _) in files {
            moves.put(name, name)?;
        }
        stale.iter().try_for_each(|name| moves.take(name))
    });
    if let Err(fault) = moved {
        return Err(moves.undo(fault));
    }
    if alone {
        // The list with old names too is valid, so a failure to shorten it loses nothing.
        let _ = moves.put("alone", MANIFEST);
    }
    let _ = File::open(dir).and_then(|folder| folder.sync_all());
    Ok(files.iter().map(|(name, _)| dir.join(name)).collect())
}

fn stage_file(stage: &TempDir, dir: &Path, name: &str, content: &[u8]) -> Result<(), OutputError> {
    File::create_new(stage.path().join(format!("new-{name}")))
        .and_then(|mut file| {
            file.write_all(content)?;
            file.sync_all()
        })
        .map_err(|e| OutputError::io("write", &dir.join(name), e))
}

/// Files moved into the folder so far, and what was there before each.
struct Moves<'a> {
    dir: &'a Path,
    stage: TempDir,
    /// Name, and whether an earlier file of that name is kept in the stage.
    done: Vec<(String, bool)>,
}

impl<'a> Moves<'a> {
    fn new(dir: &'a Path, stage: TempDir) -> Self {
        Moves { dir, stage, done: Vec::new() }
    }

    /// Renames a staged file to its place; the earlier file, if any, stays kept in the stage.
    fn put(&mut self, staged: &str, name: &str) -> Result<(), OutputError> {
        let place = self.dir.join(name);
        let fault = |e| OutputError::io("write", &place, e);
        let kept = self.keep(name).map_err(fault)?;
        fs::rename(self.stage.path().join(format!("new-{staged}")), &place).map_err(fault)?;
        self.done.push((name.to_owned(), kept));
        Ok(())
    }

    /// Removes a stale file, keeping it in the stage.
    fn take(&mut self, name: &str) -> Result<(), OutputError> {
        let place = self.dir.join(name);
        let fault = |e| OutputError::io("remove", &place, e);
        let kept = self.keep(name).map_err(fault)?;
        fs::remove_file(&place).map_err(fault)?;
        self.done.push((name.to_owned(), kept));
        Ok(())
    }

    /// Keeps a file under a second name, by link or, where the disk has no links, by copy.
    fn keep(&self, name: &str) -> io::Result<bool> {
        let (place, old) = (self.dir.join(name), self.stage.path().join(format!("old-{name}")));
        if !place.is_file() || old.exists() {
            return Ok(false);
        }
        fs::hard_link(&place, &old).or_else(|_| fs::copy(&place, &old).map(drop))?;
        Ok(true)
    }

    /// Brings the earlier files back; if even that fails, they stay in the stage, which the error names.
    fn undo(self, fault: OutputError) -> OutputError {
        let mut failed = false;
        for (name, kept) in self.done.iter().rev() {
            let place = self.dir.join(name);
            let back = if *kept {
                fs::rename(self.stage.path().join(format!("old-{name}")), &place)
            } else {
                fs::remove_file(&place)
            };
            failed |= back.is_err();
        }
        if failed {
            OutputError::Torn {
                path: self.dir.into(),
                kept: self.stage.keep(),
                cause: Box::new(fault),
            }
        } else {
            fault
        }
    }
}

#[cfg(test)]
#[path = "folder_tests.rs"]
mod tests;
