//! The arrays of the file, and the header of each in NumPy's format.
//!
//! The format is that of NEP 1 (`numpy.lib.format`), version 1.0: a magic text, the length of a Python dict as text, the dict,
//! spaces up to a multiple of 64 bytes, and the numbers, last index fastest.

use super::{SheetMesh, SheetState};

/// What a dimension of an array counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// States that were kept.
    States,
    /// Nodes.
    Nodes,
    /// Yarn segments.
    Segments,
    /// Cells between four nodes.
    Cells,
    /// Grippers.
    Grippers,
    /// A fixed number.
    Of(usize),
}

/// What one number of an array is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scalar {
    /// A real number of 64 bits.
    Real,
    /// A whole number of 32 bits.
    Index,
    /// True or false.
    Flag,
}

/// An array of the file.
#[derive(Debug, Clone, Copy)]
pub struct Array {
    /// Name.
    pub name: &'static str,
    /// What its numbers are.
    pub scalar: Scalar,
    /// Dimensions.
    pub shape: &'static [Extent],
}

use Extent::{Cells, Grippers, Nodes, Of, Segments, States};
use Scalar::{Flag, Index, Real};

/// All arrays, in the order of the file: those of the mesh first. The last one is left out of a sheet whose pads all hold to the end.
pub const ARRAYS: [Array; 16] = [
    Array { name: "places", scalar: Real, shape: &[Nodes, Of(2)] },
    Array { name: "areas", scalar: Real, shape: &[Nodes] },
    Array { name: "segments", scalar: Index, shape: &[Segments, Of(2)] },
    Array { name: "cells", scalar: Index, shape: &[Cells, Of(4)] },
    Array { name: "landing_step", scalar: Index, shape: &[Nodes] },
    Array { name: "step", scalar: Index, shape: &[States] },
    Array { name: "time", scalar: Real, shape: &[States] },
    Array { name: "positions", scalar: Real, shape: &[States, Nodes, Of(3)] },
    Array { name: "height", scalar: Real, shape: &[States, Nodes] },
    Array { name: "contact", scalar: Flag, shape: &[States, Nodes] },
    Array { name: "shear", scalar: Real, shape: &[States, Cells] },
    Array { name: "tension", scalar: Real, shape: &[States, Segments] },
    Array { name: "grippers", scalar: Real, shape: &[States, Grippers, Of(3)] },
    Array { name: "pad_forces", scalar: Real, shape: &[States, Grippers, Of(3)] },
    Array { name: "pad_rotation", scalar: Real, shape: &[States, Grippers, Of(4)] },
    Array { name: "pad_holds", scalar: Flag, shape: &[States, Grippers] },
];

/// How many of [`ARRAYS`] belong to the mesh.
pub(super) const OF_MESH: usize = 5;

/// The arrays of a sheet, whose states say which pads hold (`releases`) or need not.
pub(super) fn arrays(releases: bool) -> &'static [Array] {
    &ARRAYS[..ARRAYS.len() - usize::from(!releases)]
}

/// How many there are of everything.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct Sizes {
    pub states: usize,
    pub nodes: usize,
    pub segments: usize,
    pub cells: usize,
    pub grippers: usize,
    /// Whether states say which pads hold.
    pub releases: bool,
}

impl Sizes {
    pub(super) fn count(&self, extent: Extent) -> usize {
        match extent {
            States => self.states,
            Nodes => self.nodes,
            Segments => self.segments,
            Cells => self.cells,
            Grippers => self.grippers,
            Of(count) => count,
        }
    }
}

impl Scalar {
    /// Bytes of one number.
    pub(super) fn bytes(self) -> usize {
        match self {
            Real => 8,
            Index => 4,
            Flag => 1,
        }
    }

    /// NumPy's name of it.
    fn descr(self) -> &'static str {
        match self {
            Real => "<f8",
            Index => "<i4",
            Flag => "|b1",
        }
    }
}

/// First bytes of an array's file: magic text and version.
pub(super) const MAGIC: &[u8; 8] = b"\x93NUMPY\x01\x00";
/// Bytes before the dict: magic text, version and the dict's length.
pub(super) const BEFORE: usize = 10;

impl Array {
    /// Extents in numbers.
    pub(super) fn lengths(&self, sizes: &Sizes) -> Vec<usize> {
        self.shape.iter().map(|extent| sizes.count(*extent)).collect()
    }

    /// Bytes of its numbers; `None` beyond all range.
    pub(super) fn data(&self, sizes: &Sizes) -> Option<u64> {
        self.lengths(sizes)
            .iter()
            .try_fold(self.scalar.bytes() as u64, |bytes, length| bytes.checked_mul(*length as u64))
    }

    /// Numbers of one state, or of the whole array if it belongs to the mesh.
    pub(super) fn count(&self, sizes: &Sizes) -> usize {
        self.lengths(&Sizes { states: 1, ..*sizes }).iter().product()
    }

    /// The header of its file.
    pub(super) fn header(&self, sizes: &Sizes) -> Vec<u8> {
        let lengths = self.lengths(sizes);
        let shape: Vec<String> = lengths.iter().map(usize::to_string).collect();
        // a tuple of one has a comma behind it in Python
        let comma = if shape.len() == 1 { "," } else { "" };
        let mut dict = format!(
            "{{'descr': '{}', 'fortran_order': False, 'shape': ({}{comma}), }}",
            self.scalar.descr(),
            shape.join(", ")
        );
        let length = (BEFORE + dict.len() + 1).next_multiple_of(64) - BEFORE;
        dict.push_str(&" ".repeat(length - dict.len() - 1));
        dict.push('\n');
        [&MAGIC[..], &(length as u16).to_le_bytes(), dict.as_bytes()].concat()
    }
}

/// Numbers to be written.
#[derive(Debug, Clone, Copy)]
pub(super) enum Values<'a> {
    Real(&'a [f64]),
    Index(&'a [u32]),
    Flag(&'a [bool]),
}

impl Values<'_> {
    pub(super) fn len(&self) -> usize {
        match self {
            Values::Real(values) => values.len(),
            Values::Index(values) => values.len(),
            Values::Flag(values) => values.len(),
        }
    }

    pub(super) fn bytes(&self) -> Vec<u8> {
        match self {
            Values::Real(values) => values.iter().flat_map(|value| value.to_le_bytes()).collect(),
            Values::Index(values) => values.iter().flat_map(|value| value.to_le_bytes()).collect(),
            Values::Flag(values) => values.iter().map(|value| u8::from(*value)).collect(),
        }
    }
}

impl SheetMesh<'_> {
    /// Numbers and where nodes landed, in the order of [`ARRAYS`].
    pub(super) fn values<'a>(&'a self, landing_step: &'a [u32]) -> [Values<'a>; OF_MESH] {
        [
            Values::Real(self.places.as_flattened()),
            Values::Real(&self.areas),
            Values::Index(self.segments.as_flattened()),
            Values::Index(self.cells.as_flattened()),
            Values::Index(landing_step),
        ]
    }
}

impl SheetState<'_> {
    /// Numbers, in the order of [`ARRAYS`].
    pub(super) fn values(&self) -> impl Iterator<Item = Values<'_>> {
        let always = [
            Values::Index(std::slice::from_ref(&self.step)),
            Values::Real(std::slice::from_ref(&self.time)),
            Values::Real(self.positions.as_flattened()),
            Values::Real(&self.height),
            Values::Flag(&self.contact),
            Values::Real(&self.shear),
            Values::Real(&self.tension),
            Values::Real(self.grippers.as_flattened()),
            Values::Real(self.pad_forces.as_flattened()),
            Values::Real(self.pad_rotation.as_flattened()),
        ];
        always.into_iter().chain(self.pad_holds.as_deref().map(Values::Flag))
    }
}
