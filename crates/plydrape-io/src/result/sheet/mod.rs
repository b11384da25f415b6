//! `sheet.npz`: the states of a sheet over its steps, as NumPy's arrays in a zip archive, beside `result.json`.
//!
//! `numpy.load` reads it; [`ARRAYS`] lists what it holds, little-endian and not compressed; the last of them is there only where
//! pads let go. [`SheetFile`] is written once the drape is done, from the states that it kept, and is read one state at a time by
//! [`SheetStates`]. Same states, same bytes.
//!
//! `result.json` names the file with its length and check sum ([`SheetSeal`]), so that no other one is taken for it.

mod array;
mod check;
mod cut_cell;
mod drape;
mod ended;
mod file;
mod kept;
mod read;
mod seal;
mod shown;

pub use array::{ARRAYS, Array, Extent, Scalar};
pub(crate) use cut_cell::CutCell;
pub use drape::{KeptDrape, SheetSize, drape, keep};
pub(crate) use ended::{ended, overstrained};
pub use file::SheetFile;
pub use kept::SheetKept;
pub use read::SheetStates;
pub use seal::SheetSeal;
pub use shown::SheetSides;
pub(crate) use shown::normal;

use std::borrow::Cow;

/// Name of the file in its folder.
pub const NAME: &str = "sheet.npz";

/// What is the same in all states of a sheet.
#[derive(Debug, Clone, PartialEq)]
pub struct SheetMesh<'a> {
    /// Fabric coordinates u, v of each node (m).
    pub places: Cow<'a, [[f64; 2]]>,
    /// Fabric area that belongs to each node (m²).
    pub areas: Cow<'a, [f64]>,
    /// Nodes at both ends of each yarn segment.
    pub segments: Cow<'a, [[u32; 2]]>,
    /// Nodes at the corners of each cell, in order around it.
    pub cells: Cow<'a, [[u32; 4]]>,
    /// How many grippers hold the sheet.
    pub grippers: usize,
    /// Whether pads let go of it, so that its states say which of them hold.
    pub releases: bool,
}

/// The sheet at one moment.
#[derive(Debug, Clone, PartialEq)]
pub struct SheetState<'a> {
    /// Step of the motion, from 1; a step may be kept more than once.
    pub step: u32,
    /// Time (s).
    pub time: f64,
    /// Position of each node (m).
    pub positions: Cow<'a, [[f64; 3]]>,
    /// Height of each node over the mold (m); NaN where there is none.
    pub height: Cow<'a, [f64]>,
    /// Whether each node touches the mold.
    pub contact: Cow<'a, [bool]>,
    /// Shear angle of each cell (rad).
    pub shear: Cow<'a, [f64]>,
    /// Tension per width of each segment (N/m).
    pub tension: Cow<'a, [f64]>,
    /// Position of each gripper (m).
    pub grippers: Cow<'a, [[f64; 3]]>,
    /// Force of the sheet on each pad (N).
    pub pad_forces: Cow<'a, [[f64; 3]]>,
    /// Rotation of each pad, as a quaternion x, y, z, w.
    pub pad_rotation: Cow<'a, [[f64; 4]]>,
    /// Whether each pad holds the sheet; `None` where all of them always do.
    pub pad_holds: Option<Cow<'a, [bool]>>,
}

#[cfg(test)]
mod tests;
