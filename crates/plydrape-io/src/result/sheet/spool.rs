//! Writing: states come one at a time, each array into a file of its own; at the end they become one file.

use super::array::{OF_MESH, Sizes, arrays};
use super::latch::Latch;
use super::{NAME, SheetMesh, SheetSeal, SheetState, check};
use crate::Error;
use crate::store::folder::Content;
use std::fs::{self, File};
use std::io::{self, BufReader, BufWriter, Seek, Write};
use std::path::{Path, PathBuf};
use tempfile::TempDir;
use zip::write::{SimpleFileOptions, ZipWriter};
use zip::{CompressionMethod, DateTime};

/// States of a sheet on their way into a file.
///
/// Its files are in a hidden folder that is gone when this is dropped, finished or not.
#[derive(Debug)]
pub struct SheetSpool {
    dir: TempDir,
    mesh: SheetMesh<'static>,
    sizes: Sizes,
    /// The files of the arrays of states, in the order of [`ARRAYS`](super::ARRAYS).
    files: Vec<BufWriter<File>>,
    /// Step and time of the state before.
    last: Option<(u32, f64)>,
}

impl SheetSpool {
    /// Begins a file for a sheet in a hidden folder within `dir`: that of the results has
    /// [`Folder::stage`](crate::Folder::stage) for it.
    ///
    /// # Errors
    /// [`Error`] if the arrays of the mesh do not fit each other, or the disk refuses.
    pub fn new(dir: &Path, mesh: SheetMesh<'static>) -> Result<Self, Error> {
        let sizes = check::sizes(&mesh);
        check::mesh(&mesh, &vec![0; sizes.nodes], &sizes).map_err(Error::Internal)?;
        let dir = tempfile::Builder::new()
            .prefix(".sheet-")
            .tempdir_in(dir)
            .map_err(|source| refused(dir, source))?;
        let spool = |name: &str| File::create_new(dir.path().join(name)).map(BufWriter::new);
        let files = arrays(mesh.releases)[OF_MESH..]
            .iter()
            .map(|array| spool(array.name))
            .collect::<io::Result<_>>()
            .map_err(|source| refused(dir.path(), source))?;
        Ok(SheetSpool { dir, mesh, sizes, files, last: None })
    }

    /// How many states there are by now.
    #[must_use]
    pub fn states(&self) -> usize {
        self.sizes.states
    }

    /// Adds a state.
    ///
    /// # Errors
    /// [`Error`] if its arrays have other lengths than the mesh says, if a number is not finite (a height may be NaN), if
    /// it comes before the one before it, or if the disk refuses.
    pub fn push(&mut self, state: &SheetState) -> Result<(), Error> {
        check::state(state, &self.sizes, self.last).map_err(Error::Internal)?;
        for (file, values) in self.files.iter_mut().zip(state.values()) {
            values.write(file).map_err(|source| refused(self.dir.path(), source))?;
        }
        self.sizes.states += 1;
        self.last = Some((state.step, state.time));
        Ok(())
    }

    /// Puts all states into one file, with the step in which each node landed (0 for never).
    ///
    /// # Errors
    /// [`Error`] if there is no state, if there are not as many steps as nodes, or if the disk refuses.
    pub fn finish(self, landing_step: &[u32]) -> Result<SheetFile, Error> {
        let SheetSpool { dir, mesh, sizes, files, .. } = self;
        if sizes.states == 0 {
            return Err(Error::Internal("the sheet has no state".into()));
        }
        check::mesh(&mesh, landing_step, &sizes).map_err(Error::Internal)?;
        let file = assemble(dir.path(), &mesh, &sizes, files, landing_step)
            .map_err(|source| refused(dir.path(), source))?;
        let path = dir.path().join(NAME);
        let seal = SheetSeal::of(file).map_err(|source| refused(&path, source))?;
        Ok(SheetFile { path, seal, _dir: dir })
    }
}

/// The states cannot be kept on the disk.
fn refused(path: &Path, source: io::Error) -> Error {
    let message = format!("the states of the sheet cannot be kept on the disk: {source}");
    let help = "make room on the disk, or choose a folder on another one with -o".into();
    Error::Io { path: path.into(), message, help, source }
}

/// Puts the spools of a folder into one file.
fn assemble(
    dir: &Path,
    mesh: &SheetMesh,
    sizes: &Sizes,
    files: Vec<BufWriter<File>>,
    landing_step: &[u32],
) -> io::Result<File> {
    for file in files {
        file.into_inner().map_err(io::IntoInnerError::into_error)?;
    }
    let path = dir.join(NAME);
    let mut archive = ZipWriter::new(Latch::new(BufWriter::new(File::create_new(&path)?)));
    let values = mesh.values(landing_step).map(Some).into_iter();
    for (array, values) in arrays(mesh.releases).iter().zip(values.chain(std::iter::repeat(None))) {
        let header = array.header(sizes);
        let length = array.data(sizes).map(|data| data + header.len() as u64);
        start(&mut archive, array.name, length)?;
        archive.write_all(&header)?;
        match values {
            Some(values) => values.write(&mut archive)?,
            None => {
                // on the disk twice for a moment only
                let spool = dir.join(array.name);
                io::copy(&mut File::open(&spool)?, &mut archive)?;
                fs::remove_file(&spool)?;
            }
        }
    }
    archive.finish().map_err(io::Error::from)?.done()?;
    File::open(&path)
}

/// Begins the file of an array in the archive: not compressed, of a fixed date.
fn start<W: Write + Seek>(
    archive: &mut ZipWriter<W>,
    name: &str,
    length: Option<u64>,
) -> io::Result<()> {
    let large = length.is_none_or(|length| length >= u64::from(u32::MAX));
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Stored)
        .last_modified_time(DateTime::default())
        .unix_permissions(0o644)
        .large_file(large);
    archive.start_file(format!("{name}.npy"), options).map_err(io::Error::from)
}

/// A finished file, which goes into a folder of results under [`NAME`], or is gone when this is dropped.
#[derive(Debug)]
pub struct SheetFile {
    path: PathBuf,
    seal: SheetSeal,
    _dir: TempDir,
}

impl SheetFile {
    /// A file with these bytes, in a hidden folder that is made in `dir`.
    ///
    /// # Errors
    /// What the file system says.
    pub fn of_bytes(bytes: &[u8], dir: &Path) -> io::Result<Self> {
        let hidden = tempfile::Builder::new().prefix(".sheet-").tempdir_in(dir)?;
        let path = hidden.path().join(NAME);
        fs::write(&path, bytes)?;
        Ok(SheetFile { path, seal: SheetSeal::of(bytes)?, _dir: hidden })
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

impl Content for SheetFile {
    fn write(&self, to: &mut dyn Write) -> io::Result<()> {
        io::copy(&mut BufReader::new(File::open(&self.path)?), to).map(drop)
    }
}
