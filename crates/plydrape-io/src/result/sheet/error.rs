//! Why the states of a sheet could not be written.

use crate::OutputError;
use std::io;

/// Why the states of a sheet could not be written.
#[derive(Debug, thiserror::Error)]
pub enum SheetError {
    /// An array has another length than the sheet.
    #[error("`{array}` of the sheet has {found} numbers, not {expected}")]
    Length {
        /// Name of the array.
        array: &'static str,
        /// Numbers that it must have.
        expected: usize,
        /// Numbers that it has.
        found: usize,
    },
    /// A number is not what it must be.
    #[error("`{array}[{index}]` of the sheet is {value}: {rule}")]
    Value {
        /// Name of the array.
        array: &'static str,
        /// Place of the number in the array of its state.
        index: usize,
        /// The number.
        value: f64,
        /// What is wanted.
        rule: &'static str,
    },
    /// There is no state.
    #[error("the sheet has no state")]
    Empty,
    /// The file system refused.
    #[error("the states of the sheet cannot be kept on the disk: {0}")]
    Io(#[from] io::Error),
}

impl From<SheetError> for OutputError {
    fn from(error: SheetError) -> Self {
        OutputError::Writer(error.into())
    }
}
