//! A folder of results: one run at a time, written whole or not at all, and never over a file of the user's.
//!
//! plydrape keeps a small list `.plydrape` in the folder: who wrote each file, with its checksum and length. A file
//! may be replaced only if it is still what the list says. New files are staged in a hidden folder beside their
//! place, brought to the disk, and moved in by renaming; if that fails in the middle, the earlier files come back.
//! While files are moved, the list names old and new contents and has no seal: a power cut leaves files that the next
//! run still knows as its own, and a list that says that they are mixed. The sealed list comes last.
//!
//! A run claims the folder with a lock of the operating system, which ends with the process, however it ends. What
//! runs that were killed have left is cleared by the next one.

use crate::Error;
use crate::store::input;
use crate::store::manifest::{Manifest, NAME as MANIFEST, Stamp, Stamping};
use std::fs::{self, DirEntry, File, TryLockError};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// How the names of hidden folders begin in which files are staged.
const STAGE: &str = ".plydrape-";

/// The file of a stage that says whose it is.
const OWNER: &str = "owner";

/// Largest text of an owner that is read (bytes).
const LARGEST_OWNER: u64 = 1 << 10;

/// Files by plain name, with their contents.
pub type Files = Vec<(String, Vec<u8>)>;

/// What a file will hold: bytes, or something that writes itself piece by piece.
pub trait Content {
    /// Writes all of it.
    ///
    /// # Errors
    /// If the writer refuses, or there is something that cannot be written.
    fn write(&self, to: &mut dyn Write) -> io::Result<()>;
}

impl Content for &[u8] {
    fn write(&self, to: &mut dyn Write) -> io::Result<()> {
        to.write_all(self)
    }
}

impl Content for &dyn Content {
    fn write(&self, to: &mut dyn Write) -> io::Result<()> {
        (**self).write(to)
    }
}

/// A folder that one run has claimed.
#[derive(Debug)]
pub struct Folder {
    dir: PathBuf,
    /// The command that writes, such as `simulate`.
    by: &'static str,
    /// Files that the run reads.
    read: Vec<PathBuf>,
    /// The folder was made for this run.
    made: bool,
    stage: Option<Stage>,
    /// Held as long as the claim.
    _lock: File,
}

impl Folder {
    /// Claims a folder for files that a command writes; it is made if it is missing. None of the files that the run has `read` is
    /// replaced or removed, see [`Folder::refuse_taken`].
    ///
    /// # Errors
    /// [`Error::Busy`] if another run has claimed it, the other variants where the folder or the disk refuses.
    pub fn claim(dir: &Path, by: &'static str, read: &[PathBuf]) -> Result<Folder, Error> {
        let made = make(dir)?;
        let unreadable = |e| Error::write("open the folder", dir, e);
        let lock = File::open(dir).map_err(unreadable)?;
        match lock.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                return Err(Error::Busy { path: dir.into(), owner: owner(dir) });
            }
            // a disk without locks: two runs at a time are then not noticed
            Err(TryLockError::Error(_)) => {}
        }
        for stage in hidden(dir) {
            // left by a run that was killed: whoever staged it would hold the lock
            if stage.join(OWNER).is_file() {
                clear(&stage);
            } else {
                // empty if it was killed before it had an owner, or after; any other one is not of such a run, and stays
                let _ = fs::remove_dir(stage);
            }
        }
        let stage = tempfile::Builder::new().prefix(STAGE).tempdir_in(dir).map(Stage);
        let owner = format!("`plydrape {by}`, process {}", std::process::id());
        let noted =
            stage.and_then(|stage| fs::write(stage.path().join(OWNER), owner).map(|()| stage));
        if noted.is_err() && made {
            let _ = fs::remove_dir(dir);
        }
        let stage = noted.map_err(|e| Error::write("write into", dir, e))?;
        let (dir, read) = (dir.into(), read.to_vec());
        Ok(Folder { dir, by, read, made, stage: Some(stage), _lock: lock })
    }

    /// A hidden folder on the same disk for files of this run that are no results yet; it is gone when the claim ends.
    #[must_use]
    pub fn stage(&self) -> &Path {
        self.stage.as_ref().map_or(&self.dir, Stage::path)
    }

    /// The folder.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.dir
    }

    /// Claims the folder beside this one whose name has one more ending, for the same run.
    ///
    /// # Errors
    /// As [`Folder::claim`].
    pub fn claim_beside(&self, ending: &str) -> Result<Folder, Error> {
        // `.` and `out/..` have no name of their own
        let dir = fs::canonicalize(&self.dir).map_err(|e| Error::write("find", &self.dir, e))?;
        let named = if self.dir.file_name().is_some() { &self.dir } else { &dir };
        let mut name = named.file_name().unwrap_or_default().to_os_string();
        name.push(ending);
        Folder::claim(&named.with_file_name(name), self.by, &self.read)
    }

    /// Refuses to replace a file that the run reads, by whatever path, or one that is not of plydrape: `names` are those that it will write.
    /// Every write asks this; a run that takes long asks it before it begins, too, so that nothing is lost.
    ///
    /// # Errors
    /// [`Error::Input`] or [`Error::Foreign`] with the first such file.
    pub fn refuse_taken(&self, names: &[&str]) -> Result<(), Error> {
        let (dir, earlier) = (&self.dir, Manifest::read(&self.dir)?);
        for name in names {
            let path = dir.join(name);
            if self.reads(name) {
                return Err(Error::Input { path });
            }
            let is_there = fs::symlink_metadata(&path).is_ok();
            if !Manifest::is_plain(name) || is_there && !earlier.holds(dir, name) {
                return Err(Error::Foreign { path });
            }
        }
        Ok(())
    }

    /// Whether the run reads the file of that name in this folder.
    fn reads(&self, name: &str) -> bool {
        let place = fs::canonicalize(self.dir.join(name)).ok();
        place.is_some() && self.read.iter().any(|file| fs::canonicalize(file).ok() == place)
    }

    /// Writes a set of files (plain name and content), all of them or none, and returns their paths in the order
    /// given.
    ///
    /// Files that the same command has left here before, that are unchanged, not written now and not among those
    /// that this run reads, are removed.
    ///
    /// # Errors
    /// [`Error::Foreign`] if a file in the way was not written by plydrape or was changed since, [`Error::Input`] if this run reads it;
    /// the other variants where the folder or the disk refuses.
    pub fn write<C: Content>(self, files: &[(&str, C)]) -> Result<Vec<PathBuf>, Error> {
        self.stage_files(files)?.write()
    }

    /// Puts one file into the folder while the run goes on, whole, in place of the one before. It goes when the run writes its files, and stays
    /// for the next one if that never comes.
    ///
    /// # Errors
    /// As [`Folder::write`].
    pub fn put_by<C: Content>(&self, name: &str, content: &C) -> Result<(), Error> {
        self.refuse_taken(&[name])?;
        let (dir, earlier) = (&self.dir, Manifest::read(&self.dir)?);
        let stamp = stage_file(self.stage(), dir, name, content)?;
        let new = Manifest::new(self.by, [(name.to_owned(), stamp)]);
        let sealed = earlier.is_sealed();
        // the list first knows both contents, so that a cut in power leaves one that it knows
        self.list(&earlier.with(&new).replaced_by(&Manifest::default(), sealed))?;
        let (from, to) = (self.stage().join(format!("new-{name}")), dir.join(name));
        fs::rename(from, &to).map_err(|e| Error::write("write", &to, e))?;
        self.list(&earlier.replaced_by(&new, sealed))
    }

    /// Removes a file that was put by.
    ///
    /// # Errors
    /// Where the disk refuses.
    pub fn remove(&self, name: &str) -> Result<(), Error> {
        let earlier = Manifest::read(&self.dir)?;
        let path = self.dir.join(name);
        if !earlier.holds(&self.dir, name) {
            return Ok(());
        }
        fs::remove_file(&path).map_err(|e| Error::write("remove", &path, e))?;
        self.list(&earlier.without(&[name.to_owned()]))
    }

    /// Puts a list in place of the one before.
    fn list(&self, list: &Manifest) -> Result<(), Error> {
        stage_file(self.stage(), &self.dir, MANIFEST, &list.text()?.as_bytes())?;
        let to = self.dir.join(MANIFEST);
        let from = self.stage().join(format!("new-{MANIFEST}"));
        fs::rename(from, &to).map_err(|e| Error::write("write", &to, e))
    }

    /// Stages a set of files as [`Folder::write`] would write them; they come in with [`Staged::write`], or with those of other
    /// folders in [`write_together`].
    ///
    /// # Errors
    /// As [`Folder::write`].
    pub fn stage_files<C: Content>(self, files: &[(&str, C)]) -> Result<Staged, Error> {
        self.put(files, true)
    }

    /// Writes files; those of an earlier run that are not written now stay.
    ///
    /// # Errors
    /// As [`Folder::write`].
    pub fn write_more<C: Content>(self, files: &[(&str, C)]) -> Result<Vec<PathBuf>, Error> {
        self.put(files, false)?.write()
    }

    /// Stages files; what the same command left before goes if these are `all` of its files.
    fn put<C: Content>(self, files: &[(&str, C)], all: bool) -> Result<Staged, Error> {
        // Nothing is touched before every name is known to be free or our own.
        self.refuse_taken(&files.iter().map(|(name, _)| *name).collect::<Vec<_>>())?;

        // Stage everything on the disk, beside its place.
        let mut stamps = Vec::with_capacity(files.len());
        for (name, content) in files {
            let stamp = stage_file(self.stage(), &self.dir, name, content)?;
            stamps.push(((*name).to_owned(), stamp));
        }
        self.staged(stamps, all)
    }

    /// The files in the stage with these stamps, ready to come in with the lists of them.
    fn staged(self, stamps: Vec<(String, Stamp)>, all: bool) -> Result<Staged, Error> {
        let (stage, dir) = (self.stage(), self.dir.clone());
        let earlier = Manifest::read(&dir)?;
        let stale: Vec<String> = earlier
            .names_of(self.by)
            .filter(|name| all && stamps.iter().all(|(new, _)| new != name))
            .filter(|name| earlier.holds(&dir, name) && !self.reads(name))
            .map(str::to_owned)
            .collect();
        let new = Manifest::new(self.by, stamps.clone());
        let both = earlier.with(&new);
        // files that went were ours, and files that came are: what stays is listed as it was
        let rest = earlier.without_those_of(&new);
        let sealed = all || earlier.is_sealed() || rest.is_whole(&dir);
        let own = earlier.without(&stale).replaced_by(&new, sealed);
        stage_file(stage, &dir, "both", &both.text()?.as_bytes())?;
        stage_file(stage, &dir, "sealed", &own.text()?.as_bytes())?;

        Ok(Staged { folder: self, stamps, stale })
    }
}

/// Files on the disk beside their places, ready to come in.
#[derive(Debug)]
pub struct Staged {
    folder: Folder,
    stamps: Vec<(String, Stamp)>,
    /// Files of an earlier run that go.
    stale: Vec<String>,
}

impl Staged {
    /// Moves the files in and returns their paths, in the order given.
    ///
    /// # Errors
    /// Where the disk refuses; the folder is then as it was.
    pub fn write(self) -> Result<Vec<PathBuf>, Error> {
        let mut paths = write_together(vec![self])?;
        Ok(paths.pop().unwrap_or_default())
    }

    /// Moves the staged files to another folder, into which they are then ready to come.
    ///
    /// # Errors
    /// As [`Folder::write`].
    pub fn moved_to(self, other: Folder) -> Result<Staged, Error> {
        let names: Vec<&str> = self.stamps.iter().map(|(name, _)| name.as_str()).collect();
        other.refuse_taken(&names)?;
        for (name, _) in &self.stamps {
            let [from, to] = [&self.folder, &other].map(|f| f.stage().join(format!("new-{name}")));
            fs::rename(from, to).map_err(|e| Error::write("write", &other.dir.join(name), e))?;
        }
        other.staged(self.stamps, true)
    }

    /// Moves in, the list first: a cut in power from here on leaves only files that it knows.
    fn move_in(&mut self) -> Result<Option<Moves>, Error> {
        let Some(stage) = self.folder.stage.take() else { return Ok(None) };
        let mut moves = Moves::new(&self.folder.dir, stage);
        let moved = moves.put("both", MANIFEST).and_then(|()| {
            for (name, _) in &self.stamps {
                moves.put(name, name)?;
            }
            self.stale.iter().try_for_each(|name| moves.take(name))?;
            moves.put("sealed", MANIFEST)
        });
        match moved {
            Ok(()) => Ok(Some(moves)),
            Err(fault) => Err(moves.undo(fault)),
        }
    }
}

/// Moves in the staged files of several folders, all or none, and returns their paths, folder by folder in the order given. A folder
/// within another one comes before it.
///
/// # Errors
/// Where the disk refuses; all folders are then as they were.
pub fn write_together(mut staged: Vec<Staged>) -> Result<Vec<Vec<PathBuf>>, Error> {
    let mut done = Vec::with_capacity(staged.len());
    for one in &mut staged {
        match one.move_in() {
            Ok(moves) => done.extend(moves),
            Err(fault) => {
                return Err(done.into_iter().rev().fold(fault, |fault, moves| moves.undo(fault)));
            }
        }
    }
    let mut paths = Vec::with_capacity(staged.len());
    for one in &mut staged {
        one.folder.made = false;
        let dir = &one.folder.dir;
        let _ = File::open(dir).and_then(|folder| folder.sync_all());
        paths.push(one.stamps.iter().map(|(name, _)| dir.join(name)).collect());
    }
    Ok(paths)
}

impl Drop for Folder {
    fn drop(&mut self) {
        drop(self.stage.take());
        if self.made {
            // Only an empty folder goes, and only the one made for this run.
            let _ = fs::remove_dir(&self.dir);
        }
    }
}

/// Claims a folder and writes a set of files into it, see [`Folder::write`]; the run has `read` files.
///
/// # Errors
/// As [`Folder::claim`] and [`Folder::write`].
pub fn write(
    dir: &Path,
    by: &'static str,
    files: &[(&str, &[u8])],
    read: &[PathBuf],
) -> Result<Vec<PathBuf>, Error> {
    Folder::claim(dir, by, read)?.write(files)
}

/// Claims a folder and adds a set of files to it, see [`Folder::write_more`]; the run has `read` files.
///
/// # Errors
/// As [`Folder::claim`] and [`Folder::write_more`].
pub fn add(
    dir: &Path,
    by: &'static str,
    files: &[(&str, &[u8])],
    read: &[PathBuf],
) -> Result<Vec<PathBuf>, Error> {
    Folder::claim(dir, by, read)?.write_more(files)
}

/// Whether the files of a folder belong together: false where a run was cut off while it replaced them.
#[must_use]
pub fn is_sealed(dir: &Path) -> bool {
    Manifest::read(dir).map_or(true, |list| list.is_sealed())
}

/// A hidden folder in which files are staged. Its owner goes last, so that what a run leaves that is killed while it goes is known as its.
#[derive(Debug)]
struct Stage(TempDir);

impl Stage {
    fn path(&self) -> &Path {
        self.0.path()
    }

    /// Lets it stay, without its owner: no later run takes it for one that may be cleared.
    fn keep(mut self) -> PathBuf {
        self.0.disable_cleanup(true);
        let path = self.path().to_path_buf();
        let _ = fs::remove_file(path.join(OWNER));
        std::mem::forget(self);
        path
    }
}

impl Drop for Stage {
    fn drop(&mut self) {
        if self.path().join(OWNER).is_file() {
            clear(self.path());
        }
    }
}

/// Removes a stage, its owner last.
fn clear(stage: &Path) {
    let Ok(entries) = fs::read_dir(stage) else { return };
    for path in entries.filter_map(|entry| Some(entry.ok()?.path())) {
        let _ = match path.is_dir() {
            true => fs::remove_dir_all(path),
            false if path.ends_with(OWNER) => Ok(()),
            false => fs::remove_file(path),
        };
    }
    let _ = fs::remove_file(stage.join(OWNER));
    let _ = fs::remove_dir(stage);
}

/// Hidden folders of a folder with the name of a stage.
fn hidden(dir: &Path) -> Vec<PathBuf> {
    let Ok(entries) = fs::read_dir(dir) else { return Vec::new() };
    // a link with such a name may lead to a folder of the user's
    let is_stage = |entry: &DirEntry| {
        entry.file_name().to_string_lossy().starts_with(STAGE)
            && entry.file_type().is_ok_and(|kind| kind.is_dir())
    };
    entries.filter_map(Result::ok).filter(is_stage).map(|entry| entry.path()).collect()
}

/// Who writes into a folder, as far as that is known.
fn owner(dir: &Path) -> String {
    let read = |stage: &PathBuf| input::text(&stage.join(OWNER), LARGEST_OWNER).ok();
    hidden(dir).iter().find_map(read).unwrap_or_else(|| "another run".into())
}

/// Makes the folder; true if it was not there before.
fn make(dir: &Path) -> Result<bool, Error> {
    match fs::metadata(dir) {
        Ok(found) if found.is_dir() => Ok(false),
        Ok(_) => Err(Error::NotAFolder { path: dir.into() }),
        Err(_) => match fs::create_dir_all(dir) {
            Ok(()) => Ok(true),
            Err(e) if matches!(e.kind(), ErrorKind::NotADirectory | ErrorKind::AlreadyExists) => {
                Err(Error::NotAFolder { path: dir.into() })
            }
            Err(e) => Err(Error::write("make the folder", dir, e)),
        },
    }
}

fn stage_file<C: Content>(
    stage: &Path,
    dir: &Path,
    name: &str,
    content: &C,
) -> Result<Stamp, Error> {
    let write = |file: File| {
        let mut to = Stamping::new(BufWriter::new(&file));
        content.write(&mut to)?;
        to.flush()?;
        let stamp = to.stamp();
        file.sync_all()?;
        Ok(stamp)
    };
    File::create_new(stage.join(format!("new-{name}")))
        .and_then(write)
        .map_err(|e| Error::write("write", &dir.join(name), e))
}

/// Files moved into the folder so far, and what was there before each.
struct Moves {
    dir: PathBuf,
    stage: Stage,
    /// Name, and whether an earlier file of that name is kept in the stage.
    done: Vec<(String, bool)>,
}

impl Moves {
    fn new(dir: &Path, stage: Stage) -> Self {
        Moves { dir: dir.into(), stage, done: Vec::new() }
    }

    /// Renames a staged file to its place; the earlier file, if any, stays kept in the stage.
    fn put(&mut self, staged: &str, name: &str) -> Result<(), Error> {
        let place = self.dir.join(name);
        let fault = |e| Error::write("write", &place, e);
        let kept = self.keep(name).map_err(fault)?;
        fs::rename(self.stage.path().join(format!("new-{staged}")), &place).map_err(fault)?;
        self.done.push((name.to_owned(), kept));
        Ok(())
    }

    /// Removes a stale file, keeping it in the stage.
    fn take(&mut self, name: &str) -> Result<(), Error> {
        let place = self.dir.join(name);
        let fault = |e| Error::write("remove", &place, e);
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
    fn undo(self, fault: Error) -> Error {
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
            let kept = self.stage.keep();
            Error::Torn { path: self.dir, kept, cause: Box::new(fault) }
        } else {
            fault
        }
    }
}

#[cfg(test)]
#[path = "folder_tests.rs"]
mod tests;
