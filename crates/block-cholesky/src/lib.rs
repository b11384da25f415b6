#![doc = include_str!("../README.md")]
//!
//! # Stages
//!
//! A file is a stage or a noun of the multifrontal method (Duff and Reid 1983; Liu 1992, "The multifrontal method for sparse
//! matrix solution: theory and practice"). Each uses only those above it:
//!
//! 1. `block_matrix`: the matrix over a fixed pattern, one block row per node;
//! 2. `graph`: which nodes are coupled, and an order of elimination by approximate minimum degree;
//! 3. `kernel`: dense operations on panels of twelve rows, with vector instructions;
//! 4. `supernode`: nodes that are eliminated together, and the fronts that they form;
//! 5. `front`: dense elimination of the pivots of a front;
//! 6. `assembly`: a front is the sum of blocks of the matrix and of the updates of its children;
//! 7. `analysis`: where everything is stored;
//! 8. `restriction`: the fronts that remain without some of the nodes;
//! 9. `substitution`: solutions, front by front;
//! 10. `cholesky`: all of these together.
//!
//! Order and fronts depend on the pattern only and are found once.

mod analysis;
mod assembly;
mod block_matrix;
mod cholesky;
mod error;
mod front;
mod graph;
mod kernel;
mod restriction;
mod substitution;
mod supernode;
mod tuning;

#[cfg(test)]
mod tests;

pub use block_matrix::{Block, BlockMatrix, Slot};
pub use cholesky::Cholesky;
pub use error::Error;
pub use tuning::CholeskyTuning;
