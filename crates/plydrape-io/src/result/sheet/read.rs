//! Reading: the file that a result names, unchanged, one state at a time.

use super::array::{ARRAYS, BEFORE, MAGIC, OF_MESH, Sizes, arrays};
use super::{SheetMesh, SheetSeal, SheetState, check};
use crate::Error;
use crate::result::refusal;
use crate::store::{input, size};
use std::borrow::Cow;
use std::fs::File;
use std::io::{self, BufReader, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};
use zip::{CompressionMethod, ZipArchive};

/// The states of a sheet in their file.
#[derive(Debug)]
pub struct SheetStates {
    file: BufReader<File>,
    path: PathBuf,
    sizes: Sizes,
    /// Where the numbers of each of [`ARRAYS`] begin.
    starts: Vec<u64>,
    mesh: SheetMesh<'static>,
    landing_step: Vec<u32>,
}

impl SheetStates {
    /// Opens the file that a result names: `folder` is that of the result, `seal` what it says of the file.
    ///
    /// # Errors
    /// [`Error`] if it cannot be read, or is not the one that the result was written with, or holds what no sheet has.
    pub fn open(folder: &Path, seal: &SheetSeal) -> Result<Self, Error> {
        let path = folder.join(&seal.file);
        let unreadable = |source| unreadable(&path, source);
        let changed = |what: String| refusal::changed(&path, &what);
        if Path::new(&seal.file).file_name().is_none_or(|name| *name != *seal.file) {
            return Err(changed("its name is not that of a file beside its result".into()));
        }

        // the one that was written with the result
        input::size(&path).map_err(unreadable)?;
        let file = File::open(&path).map_err(unreadable)?;
        let found =
            SheetSeal::read((&file).take(seal.length.saturating_add(1))).map_err(unreadable)?;
        if (found.length, &found.checksum) != (seal.length, &seal.checksum) {
            return Err(changed("its check sum is not the one of its result".into()));
        }

        // what it holds
        let archive = ZipArchive::new(BufReader::new(file)).map_err(|e| changed(e.to_string()))?;
        let (file, sizes, starts) = layout(archive, seal.length).map_err(changed)?;
        let memory: f64 = arrays(sizes.releases)
            .iter()
            .map(|a| (a.count(&sizes) * a.scalar.bytes()) as f64)
            .sum();
        size::check(memory, || format!("a state of a sheet of {} nodes", sizes.nodes))
            .map_err(|error| error.of_file(format_args!("`{}`", path.display())))?;
        let empty = SheetMesh {
            places: Cow::default(),
            areas: Cow::default(),
            segments: Cow::default(),
            cells: Cow::default(),
            grippers: sizes.grippers,
            releases: sizes.releases,
        };
        let mut states = SheetStates {
            file,
            path: path.clone(),
            sizes,
            starts,
            mesh: empty,
            landing_step: vec![],
        };
        states.read_mesh().map_err(unreadable)?;
        check::mesh(&states.mesh, &states.landing_step, &sizes).map_err(changed)?;
        Ok(states)
    }

    /// How many states there are.
    #[must_use]
    pub fn states(&self) -> usize {
        self.sizes.states
    }

    /// What is the same in all of them.
    #[must_use]
    pub fn mesh(&self) -> &SheetMesh<'static> {
        &self.mesh
    }

    /// Step in which each node landed for good, 0 for never.
    #[must_use]
    pub fn landing_step(&self) -> &[u32] {
        &self.landing_step
    }

    /// A state by its number from 0; `None` beyond the last.
    ///
    /// # Errors
    /// [`Error`] if it cannot be read, or holds what no state has.
    pub fn state(&mut self, n: usize) -> Result<Option<SheetState<'static>>, Error> {
        if n >= self.sizes.states {
            return Ok(None);
        }
        let state = self.read_state(n).map_err(|source| unreadable(&self.path, source))?;
        check::state(&state, &self.sizes, None)
            .map_err(|fault| refusal::changed(&self.path, &format!("in state {n}, {fault}")))?;
        Ok(Some(state))
    }

    fn read_mesh(&mut self) -> io::Result<()> {
        self.mesh.places = groups(self.reals(0, 0)?);
        self.mesh.areas = self.reals(1, 0)?.into();
        self.mesh.segments = groups(self.indices(2, 0)?);
        self.mesh.cells = groups(self.indices(3, 0)?);
        self.landing_step = self.indices(4, 0)?;
        Ok(())
    }

    fn read_state(&mut self, n: usize) -> io::Result<SheetState<'static>> {
        Ok(SheetState {
            step: self.indices(OF_MESH, n)?[0],
            time: self.reals(OF_MESH + 1, n)?[0],
            positions: groups(self.reals(OF_MESH + 2, n)?),
            height: self.reals(OF_MESH + 3, n)?.into(),
            contact: self.flags(OF_MESH + 4, n)?.into(),
            shear: self.reals(OF_MESH + 5, n)?.into(),
            tension: self.reals(OF_MESH + 6, n)?.into(),
            grippers: groups(self.reals(OF_MESH + 7, n)?),
            pad_forces: groups(self.reals(OF_MESH + 8, n)?),
            pad_rotation: groups(self.reals(OF_MESH + 9, n)?),
            pad_holds: match self.sizes.releases {
                true => Some(self.flags(OF_MESH + 10, n)?.into()),
                false => None,
            },
        })
    }

    /// The bytes of one of [`ARRAYS`] in a state.
    fn bytes(&mut self, array: usize, state: usize) -> io::Result<Vec<u8>> {
        let length = ARRAYS[array].count(&self.sizes) * ARRAYS[array].scalar.bytes();
        self.file.seek(SeekFrom::Start(self.starts[array] + (length * state) as u64))?;
        let mut bytes = vec![0; length];
        self.file.read_exact(&mut bytes)?;
        Ok(bytes)
    }

    fn reals(&mut self, array: usize, state: usize) -> io::Result<Vec<f64>> {
        let bytes = self.bytes(array, state)?;
        Ok(bytes.as_chunks().0.iter().map(|number| f64::from_le_bytes(*number)).collect())
    }

    fn indices(&mut self, array: usize, state: usize) -> io::Result<Vec<u32>> {
        let bytes = self.bytes(array, state)?;
        Ok(bytes.as_chunks().0.iter().map(|number| u32::from_le_bytes(*number)).collect())
    }

    fn flags(&mut self, array: usize, state: usize) -> io::Result<Vec<bool>> {
        Ok(self.bytes(array, state)?.iter().map(|byte| *byte != 0).collect())
    }
}

/// The file cannot be read.
fn unreadable(path: &Path, source: io::Error) -> Error {
    match refusal::unreadable(path, source) {
        Error::Io { path, message, source, .. } => {
            let help = "put `sheet.npz` beside its result.json, or run the scene again".into();
            Error::Io { path, message, help, source }
        }
        other => other,
    }
}

/// Numbers in groups of N.
fn groups<T: Copy, const N: usize>(numbers: Vec<T>) -> Cow<'static, [[T; N]]> {
    numbers.as_chunks().0.to_vec().into()
}

/// How many there are of everything, and where each of [`ARRAYS`] begins in a file of this many bytes; else what is wrong.
fn layout(
    mut archive: ZipArchive<BufReader<File>>,
    bytes: u64,
) -> Result<(BufReader<File>, Sizes, Vec<u64>), String> {
    // a sheet whose pads let go has one more array, which says which of them hold
    let releases = archive.len() == ARRAYS.len();
    let arrays = arrays(releases);
    if archive.len() != arrays.len() {
        let found = archive.len();
        return Err(format!("it holds {found} arrays, not {}", arrays.len()));
    }

    let mut sizes = Sizes { releases, ..Sizes::default() };
    let mut starts = Vec::with_capacity(arrays.len());
    let mut headers = Vec::with_capacity(arrays.len());
    for (n, array) in arrays.iter().enumerate() {
        // arrays lie in a fixed order and uncompressed, so that states can be read in place
        let other = |what: &str| format!("its array {n} {what}");
        let mut entry = archive.by_index(n).map_err(|fault| other(&fault.to_string()))?;
        if !entry.name().is_ok_and(|name| name == format!("{}.npy", array.name)) {
            return Err(other(&format!("is not `{}`", array.name)));
        }
        if entry.compression() != CompressionMethod::Stored || entry.encrypted() {
            return Err(other("is compressed"));
        }

        // the numbers of an array begin behind its header
        let start = entry.data_start().ok_or_else(|| other("has no place"))?;
        let mut header = vec![0; BEFORE];
        entry.read_exact(&mut header).map_err(|_| other("has no header"))?;
        let length = u16::from_le_bytes([header[BEFORE - 2], header[BEFORE - 1]]);
        header.resize(BEFORE + usize::from(length), 0);
        entry.read_exact(&mut header[BEFORE..]).map_err(|_| other("has no header"))?;

        // the shapes of some arrays say how many nodes, cells and states there are
        let shape = shape(&header).ok_or_else(|| other("has no header"))?;
        match (array.name, shape.as_slice()) {
            ("places", [nodes, _]) => sizes.nodes = *nodes,
            ("segments", [segments, _]) => sizes.segments = *segments,
            ("cells", [cells, _]) => sizes.cells = *cells,
            ("step", [states]) => sizes.states = *states,
            ("grippers", [_, grippers, _]) => sizes.grippers = *grippers,
            _ => {}
        }

        // no array reaches beyond the end of the file
        starts.push(start + header.len() as u64);
        if start.checked_add(entry.size()).is_none_or(|end| end > bytes) {
            return Err(other("ends beyond the file"));
        }
        headers.push((header, entry.size()));
    }

    // all other arrays must have the type and the shape that follow from that
    for (array, (header, size)) in arrays.iter().zip(headers) {
        let length = array.data(&sizes).and_then(|data| data.checked_add(header.len() as u64));
        if header != array.header(&sizes) || length != Some(size) {
            return Err(format!("its array `{}` has another type or shape", array.name));
        }
    }

    if sizes.states == 0 {
        return Err("it has no state".into());
    }

    Ok((archive.into_inner(), sizes, starts))
}

/// The shape that the header of an array names.
fn shape(header: &[u8]) -> Option<Vec<usize>> {
    let dict = std::str::from_utf8(header.strip_prefix(MAGIC)?.get(2..)?).ok()?;
    let (_, tail) = dict.split_once("'shape': (")?;
    let (numbers, _) = tail.split_once(')')?;
    let numbers = numbers.split(',').map(str::trim).filter(|number| !number.is_empty());
    numbers.map(|number| number.parse().ok()).collect()
}
