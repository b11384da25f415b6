//! Where the states of a result's sheet are.

use super::{NAME, SheetFile, SheetSeal, SheetStates};
use crate::Error;
use crate::store::folder::Content;
use std::fs::File;
use std::io::{self, BufReader, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The states of a result's sheet in their file, wherever that is by now.
///
/// The states of a drape are in a hidden folder as long as the result exists; those of a result that was read are beside it.
#[derive(Debug, Clone)]
pub struct SheetKept {
    seal: SheetSeal,
    place: Location,
}

#[derive(Debug, Clone)]
enum Location {
    Hidden(Arc<SheetFile>),
    Folder(PathBuf),
}

impl SheetKept {
    /// The states in a file that was just made.
    #[must_use]
    pub fn made(file: SheetFile) -> Self {
        SheetKept { seal: file.seal().clone(), place: Location::Hidden(Arc::new(file)) }
    }

    /// The states of a result that was read from a folder.
    #[must_use]
    pub(crate) fn read(seal: SheetSeal, folder: PathBuf) -> Self {
        SheetKept { seal, place: Location::Folder(folder) }
    }

    /// What the result says of its file.
    #[must_use]
    pub fn seal(&self) -> &SheetSeal {
        &self.seal
    }

    /// Opens the file, to read single states.
    ///
    /// # Errors
    /// [`Error`] if it cannot be read, or is not the one that the result was written with.
    pub fn open(&self) -> Result<SheetStates, Error> {
        SheetStates::open(self.folder(), &self.seal)
    }

    fn folder(&self) -> &Path {
        let folder = match &self.place {
            Location::Hidden(file) => file.path().parent(),
            Location::Folder(folder) => Some(folder.as_path()),
        };
        folder.unwrap_or(Path::new(""))
    }
}

/// The file itself, once more.
impl Content for SheetKept {
    fn write(&self, to: &mut dyn Write) -> io::Result<()> {
        if matches!(self.place, Location::Folder(_)) {
            // what was changed since is not passed on
            self.open().map_err(io::Error::other)?;
        }
        let file = File::open(self.folder().join(NAME))?;
        io::copy(&mut BufReader::new(file), to).map(drop)
    }
}
