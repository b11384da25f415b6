//! Writing: all states of a sheet become one file, array by array.

use super::array::{OF_MESH, Values, arrays};
use super::{NAME, SheetMesh, SheetSeal, SheetState, check};
use crate::Error;
use crate::store::folder::Content;
use std::fs::{self, File};
use std::io::{self, BufReader, Cursor, Write};
use std::path::{Path, PathBuf};
use tempfile::TempDir;
use zip::result::ZipResult;
use zip::write::{SimpleFileOptions, ZipWriter};
use zip::{CompressionMethod, DateTime};

/// A file of states in a hidden folder, which goes into a folder of results under [`NAME`], or is gone when this is dropped.
#[derive(Debug)]
pub struct SheetFile {
    path: PathBuf,
    seal: SheetSeal,
    _dir: TempDir,
}

impl SheetFile {
    /// The file of a sheet's states, with the step in which each node landed (0 for never), in a hidden folder that is made in `dir`:
    /// that of the results has [`Folder::stage`](crate::Folder::stage) for it.
    ///
    /// # Errors
    /// [`Error::Internal`] if there is no state, if arrays do not fit the mesh, if a number is not finite (a height may be NaN), or if a
    /// state comes before the one before it; [`Error::Io`] if the disk refuses.
    pub fn new(
        dir: &Path,
        mesh: &SheetMesh,
        landing_step: &[u32],
        states: &[SheetState],
    ) -> Result<Self, Error> {
        let sizes = check::sizes(mesh, states.len());
        check::mesh(mesh, landing_step, &sizes).map_err(Error::Internal)?;
        let mut last = None;
        for state in states {
            check::state(state, &sizes, last).map_err(Error::Internal)?;
            last = Some((state.step, state.time));
        }
        if last.is_none() {
            return Err(Error::Internal("the sheet has no state".into()));
        }

        // in memory first: a file that breaks off is never an archive
        let length: u64 = arrays(mesh.releases).iter().filter_map(|array| array.data(&sizes)).sum();
        let room = usize::try_from(length).unwrap_or(0).saturating_add(HEADERS);
        let mut archive = ZipWriter::new(Cursor::new(Vec::with_capacity(room)));
        let of_mesh = mesh.values(landing_step);
        let added = arrays(mesh.releases).iter().enumerate().try_for_each(|(n, array)| {
            let header = array.header(&sizes);
            let length = array.data(&sizes).map(|data| data + header.len() as u64);
            start(&mut archive, array.name, length)?;
            archive.write_all(&header)?;
            match n.checked_sub(OF_MESH) {
                None => add(&mut archive, of_mesh[n]),
                Some(n) => {
                    let mut values = states.iter().filter_map(|state| state.values().nth(n));
                    values.try_for_each(|values| add(&mut archive, values))
                }
            }
        });
        added
            .and_then(|()| archive.finish())
            .map_err(io::Error::from)
            .and_then(|archive| SheetFile::of_bytes(archive.get_ref(), dir))
            .map_err(|source| {
                let message =
                    format!("the states of the sheet cannot be kept on the disk: {source}");
                let help =
                    "make room on the disk, or choose a folder on another one with -o".into();
                Error::Io { path: dir.into(), message, help, source }
            })
    }

    /// A file with these bytes, in a hidden folder that is made in `dir`.
    ///
    /// # Errors
    /// What the file system says.
    pub fn of_bytes(bytes: &[u8], dir: &Path) -> io::Result<Self> {
        let hidden = tempfile::Builder::new().prefix(".sheet-").tempdir_in(dir)?;
        let path = hidden.path().join(NAME);
        fs::write(&path, bytes)?;
        Ok(SheetFile { path, seal: SheetSeal::read(bytes)?, _dir: hidden })
    }

    /// What `result.json` has to say of it.
    #[must_use]
    pub fn seal(&self) -> &SheetSeal {
        &self.seal
    }

    /// Where it is.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }
}

/// Room for the headers of the archive and of its arrays (bytes).
const HEADERS: usize = 1 << 13;

/// Begins the file of an array in the archive: not compressed, of a fixed date.
fn start(archive: &mut Archive, name: &str, length: Option<u64>) -> ZipResult<()> {
    let large = length.is_none_or(|length| length >= u64::from(u32::MAX));
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Stored)
        .last_modified_time(DateTime::default())
        .unix_permissions(0o644)
        .large_file(large);
    archive.start_file(format!("{name}.npy"), options)
}

/// Adds numbers to the array that was begun.
fn add(archive: &mut Archive, values: Values) -> ZipResult<()> {
    Ok(archive.write_all(&values.bytes())?)
}

/// An archive in memory.
type Archive = ZipWriter<Cursor<Vec<u8>>>;

impl Content for SheetFile {
    fn write(&self, to: &mut dyn Write) -> io::Result<()> {
        io::copy(&mut BufReader::new(File::open(&self.path)?), to).map(drop)
    }
}
