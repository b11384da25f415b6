//! A symmetric matrix of 3×3 blocks over a fixed pattern.
//!
//! Of each pair of coupled nodes (i, j), i > j, only the block of row i and column j is stored. The diagonal blocks
//! come first, in the order of the nodes; the others follow, sorted by row and column.

/// One 3×3 block, `block[row][column]`.
pub type Block = [[f64; 3]; 3];

/// Where the block of an ordered pair of nodes is stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Slot {
    /// Index of the stored block.
    index: u32,
    /// The stored block is the transpose of the one asked for.
    transposed: bool,
}

/// A symmetric matrix of 3×3 blocks, one block row per node.
#[derive(Debug, Clone, PartialEq)]
pub struct BlockMatrix {
    /// Number of nodes n.
    nodes: usize,
    /// Row and column, i > j, of each block below the diagonal, sorted.
    pairs: Vec<[u32; 2]>,
    /// For each node, where its row begins in `pairs`; n + 1 entries.
    starts: Vec<u32>,
    /// The n diagonal blocks, then those of `pairs`.
    blocks: Vec<Block>,
}

impl BlockMatrix {
    /// The zero matrix whose pattern is the diagonal and the given pairs of nodes.
    ///
    /// A pair may come in either order and more than once; a node paired with itself adds nothing.
    ///
    /// # Panics
    /// If a pair names a node outside of `0..nodes`.
    #[must_use]
    pub fn new(nodes: usize, pairs: impl IntoIterator<Item = [u32; 2]>) -> Self {
        let mut pairs: Vec<[u32; 2]> =
            pairs.into_iter().filter(|[i, j]| i != j).map(|[i, j]| [i.max(j), i.min(j)]).collect();
        pairs.sort_unstable();
        pairs.dedup();
        let mut starts = vec![0; nodes + 1];
        for &[i, _] in &pairs {
            assert!((i as usize) < nodes, "a pair names node {i} of {nodes}");
            starts[i as usize + 1] += 1;
        }
        for i in 0..nodes {
            starts[i + 1] += starts[i];
        }
        let blocks = vec![[[0.0; 3]; 3]; nodes + pairs.len()];
        Self { nodes, pairs, starts, blocks }
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

    /// All blocks: the diagonal, then those of [`Self::pairs`].
    pub(super) fn blocks(&self) -> &[Block] {
        &self.blocks
    }

    /// Sets every block to zero.
    pub fn clear(&mut self) {
        self.blocks.fill([[0.0; 3]; 3]);
    }

    /// Where the block of row `i` and column `j` is stored, or nothing if the pattern has no such block.
    #[must_use]
    pub fn find(&self, i: usize, j: usize) -> Option<Slot> {
        let (row, column) = (i.max(j), i.min(j));
        if row == column {
            return (row < self.nodes).then_some(Slot { index: row as u32, transposed: false });
        }
        let [from, to] = [*self.starts.get(row)?, *self.starts.get(row + 1)?].map(|k| k as usize);
        let place =
            self.pairs[from..to].binary_search_by_key(&(column as u32), |pair| pair[1]).ok()?;
        Some(Slot { index: (self.nodes + from + place) as u32, transposed: i < j })
    }

    /// Where the block of row `i` and column `j` is stored.
    ///
    /// # Panics
    /// If the pattern has no such block.
    #[must_use]
    pub fn slot(&self, i: usize, j: usize) -> Slot {
        self.find(i, j).unwrap_or_else(|| panic!("nodes {i} and {j} are not coupled"))
    }

    /// Adds a block (i, j), and by symmetry its transpose to (j, i).
    ///
    /// A block of the diagonal must itself be symmetric.
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
    #[inline]
    pub fn add_diagonal(&mut self, i: usize, block: &Block) {
        debug_assert!(i < self.nodes);
        self.add(Slot { index: i as u32, transposed: false }, block);
    }

    /// Adds `s` times the identity to a block (i, j), and by symmetry to (j, i).
    #[inline]
    pub fn add_scalar(&mut self, slot: Slot, s: f64) {
        let stored = &mut self.blocks[slot.index as usize];
        for r in 0..3 {
            stored[r][r] += s;
        }
    }

    /// The product `y = A x`; both have three entries per node.
    pub fn multiply(&self, x: &[f64], y: &mut [f64]) {
        let (x, x_rest) = x.as_chunks::<3>();
        let (y, y_rest) = y.as_chunks_mut::<3>();
        assert!(x.len() == self.nodes && y.len() == self.nodes);
        assert!(x_rest.is_empty() && y_rest.is_empty());
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
    }
}
