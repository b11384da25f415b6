//! A symmetric matrix of 3×3 blocks over a fixed pattern.
//!
//! Of each pair of coupled nodes (i, j), i > j, only the block of row i and column j is stored. The diagonal blocks
//! come first, in the order of the nodes; the others follow, sorted by row and column.

use crate::error::Error;
use std::sync::Arc;

/// One 3×3 block, `block[row][column]`.
pub type Block = [[f64; 3]; 3];

/// Where a matrix stores the block of an ordered pair of nodes; [`BlockMatrix::slot`] finds it.
///
/// It holds for every matrix with the same pattern.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Slot {
    /// Index of the stored block.
    index: u32,
    /// The stored block is the transpose of the one asked for.
    transposed: bool,
}

/// A symmetric matrix of 3×3 blocks, one block row per node.
///
/// The numbers are sums: [`Self::clear`] sets all of them to zero, and blocks are added in any order. Its pattern stays; a clone
/// shares it.
#[derive(Debug, Clone, PartialEq)]
pub struct BlockMatrix {
    /// Number of nodes n.
    nodes: usize,
    /// Row and column, i > j, of each block below the diagonal, sorted.
    pairs: Arc<[[u32; 2]]>,
    /// For each node, where its row begins in `pairs`; n + 1 entries.
    starts: Arc<[u32]>,
    /// The n diagonal blocks, then those of `pairs`.
    blocks: Vec<Block>,
}

impl BlockMatrix {
    /// The zero matrix whose pattern is the diagonal and the given pairs of nodes, which are counted from 0.
    ///
    /// A pair may come in either order and more than once; a node paired with itself adds nothing.
    ///
    /// # Errors
    /// If a pair names a node outside of `0..nodes`, or if there are too many blocks.
    pub fn new(nodes: usize, pairs: impl IntoIterator<Item = [u32; 2]>) -> Result<Self, Error> {
        Self::from_pairs(nodes, pairs.into_iter().collect())
    }

    /// [`Self::new`], compiled once for all kinds of iterators.
    fn from_pairs(nodes: usize, mut pairs: Vec<[u32; 2]>) -> Result<Self, Error> {
        let beyond = |node: &u32| *node as usize >= nodes;
        if let Some(&node) = pairs.iter().flatten().find(|node| beyond(node)) {
            return Err(Error::NoSuchNode { node, nodes });
        }
        pairs.retain(|[i, j]| i != j);
        for [i, j] in &mut pairs {
            (*i, *j) = ((*i).max(*j), (*i).min(*j));
        }
        pairs.sort_unstable();
        pairs.dedup();
        let blocks = nodes.checked_add(pairs.len()).filter(|blocks| *blocks <= u32::MAX as usize);
        let blocks = blocks.ok_or(Error::TooManyBlocks)?;
        let mut starts = vec![0; nodes + 1];
        for &[i, _] in &pairs {
            starts[i as usize + 1] += 1;
        }
        for i in 0..nodes {
            starts[i + 1] += starts[i];
        }
        let blocks = vec![[[0.0; 3]; 3]; blocks];
        Ok(Self { nodes, pairs: pairs.into(), starts: starts.into(), blocks })
    }

    /// Number of nodes: the matrix has three times as many rows.
    #[must_use]
    pub fn nodes(&self) -> usize {
        self.nodes
    }

    /// The coupled pairs (i, j) with i > j, sorted.
    #[must_use]
    pub fn pairs(&self) -> &[[u32; 2]] {
        &self.pairs
    }

    /// The pattern below the diagonal, which a clone shares.
    pub(crate) fn pattern(&self) -> &Arc<[[u32; 2]]> {
        &self.pairs
    }

    /// All blocks: the diagonal, then those of [`Self::pairs`].
    pub(crate) fn blocks(&self) -> &[Block] {
        &self.blocks
    }

    /// Sets every block to zero.
    pub fn clear(&mut self) {
        self.blocks.fill([[0.0; 3]; 3]);
    }

    /// Where the block of row `i` and column `j` is stored; `None` if the pattern has no such block.
    #[inline]
    #[must_use]
    pub fn slot(&self, i: usize, j: usize) -> Option<Slot> {
        let (row, column) = (i.max(j), i.min(j));
        if row == column {
            return (row < self.nodes).then_some(Slot { index: row as u32, transposed: false });
        }
        let [from, to] = [*self.starts.get(row)?, *self.starts.get(row + 1)?].map(|k| k as usize);
        let place =
            self.pairs[from..to].binary_search_by_key(&(column as u32), |pair| pair[1]).ok()?;
        Some(Slot { index: (self.nodes + from + place) as u32, transposed: i < j })
    }

    /// Adds a block (i, j), and by symmetry its transpose to (j, i).
    ///
    /// A block of the diagonal must itself be symmetric.
    ///
    /// # Panics
    /// If the slot is one of another pattern, and beyond the blocks of this matrix.
    #[inline]
    pub fn add(&mut self, slot: Slot, block: &Block) {
        let stored = &mut self.blocks[slot.index as usize];
        for r in 0..3 {
            for c in 0..3 {
                stored[r][c] += if slot.transposed { block[c][r] } else { block[r][c] };
            }
        }
    }

    /// Adds a symmetric block to the diagonal at node `i`.
    ///
    /// # Panics
    /// If the matrix has no node `i`, as an index beyond a slice.
    #[inline]
    pub fn add_diagonal(&mut self, i: usize, block: &Block) {
        assert!(i < self.nodes, "the matrix has no node {i}");
        self.add(Slot { index: i as u32, transposed: false }, block);
    }

    /// Adds `s` times the identity to a block (i, j), and by symmetry to (j, i).
    ///
    /// # Panics
    /// If the slot is one of another pattern, and beyond the blocks of this matrix.
    #[inline]
    pub fn add_scalar(&mut self, slot: Slot, s: f64) {
        let stored = &mut self.blocks[slot.index as usize];
        for r in 0..3 {
            stored[r][r] += s;
        }
    }

    /// The product `y = A x`; both have three entries per node.
    ///
    /// # Errors
    /// If one of them has not.
    pub fn multiply(&self, x: &[f64], y: &mut [f64]) -> Result<(), Error> {
        check_length(x, self.nodes)?;
        check_length(y, self.nodes)?;
        let (x, y) = (x.as_chunks::<3>().0, y.as_chunks_mut::<3>().0);
        let (diagonal, others) = self.blocks.split_at(self.nodes);
        for i in 0..self.nodes {
            y[i] = diagonal[i].map(|row| row[0] * x[i][0] + row[1] * x[i][1] + row[2] * x[i][2]);
        }
        for (&[i, j], block) in self.pairs.iter().zip(others) {
            let (i, j) = (i as usize, j as usize);
            for r in 0..3 {
                for c in 0..3 {
                    y[i][r] += block[r][c] * x[j][c];
                    y[j][c] += block[r][c] * x[i][r];
                }
            }
        }
        Ok(())
    }
}

/// Refuses a vector that does not have three entries per node.
pub fn check_length(x: &[f64], nodes: usize) -> Result<(), Error> {
    let (length, expected) = (x.len(), 3 * nodes);
    if length == expected { Ok(()) } else { Err(Error::WrongLength { length, expected }) }
}
