//! What can be wrong with a pattern, a matrix or a vector.

use std::fmt;

/// Why there is no matrix, factorization, product or solution.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Error {
    /// A pair of the pattern names a node that the matrix does not have.
    NoSuchNode {
        /// The node that the pair names.
        node: u32,
        /// Number of nodes of the matrix.
        nodes: usize,
    },
    /// The matrix has more blocks than can be counted with 32 bits.
    TooManyBlocks,
    /// A vector does not have three entries for each node.
    WrongLength {
        /// Number of entries that it has.
        length: usize,
        /// Number of entries that it must have.
        expected: usize,
    },
    /// The pattern of the matrix is not the one that was analyzed.
    OtherPattern,
    /// A pivot is not positive, or not finite.
    NotPositiveDefinite {
        /// Node at which the elimination ended.
        node: usize,
    },
    /// There is no factorization to solve with: none was made yet, the last one failed, or other nodes have been left out
    /// since.
    NotFactorized,
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::NoSuchNode { node, nodes } => {
                write!(
                    f,
                    "a pair names node {node}, but the matrix has {nodes} nodes, counted from 0"
                )
            }
            Self::TooManyBlocks => f.write_str("the matrix has more than 4 294 967 295 blocks"),
            Self::WrongLength { length, expected } => {
                write!(
                    f,
                    "the vector has {length} entries; it must have three per node, {expected}"
                )
            }
            Self::OtherPattern => {
                f.write_str("the matrix has another pattern than the one that was analyzed")
            }
            Self::NotPositiveDefinite { node } => {
                write!(
                    f,
                    "the matrix is not positive definite: a pivot of node {node} is not positive"
                )
            }
            Self::NotFactorized => {
                f.write_str("no matrix is factorized; factorize one before you solve")
            }
        }
    }
}

impl std::error::Error for Error {}
