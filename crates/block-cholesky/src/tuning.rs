//! Tuning constants of the factorization. They change its time, and its result only by rounding.

/// Constants of the cost model that decides which supernodes are merged.
///
/// The unit of cost is one multiply-add on a tile of 12 × 4 numbers, about six cycles. The defaults are the best of a
/// trial on grids of 133 to 2 576 nodes, each coupled to its eight neighbors and to two along each line. Half of any of them changes the
/// time by some percent, and twice the `tile_cost` by 10 %.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CholeskyTuning {
    /// Cost of a front apart from its arithmetic.
    pub front_cost: usize,
    /// Cost of a tile apart from its multiply-adds: it is read, divided and written.
    pub tile_cost: usize,
    /// Cost of adding one 3×3 block of an update to the parent's front.
    pub block_cost: usize,
    /// Nodes of a matrix from which on its fronts are eliminated on all threads of rayon. Smaller ones take a few
    /// milliseconds. `usize::MAX` means one thread for every matrix. The result does not depend on the threads.
    pub thread_nodes: usize,
    /// Update rows (nodes) of a front from which on they are shared by threads; fewer are eliminated on one.
    pub split_rows: usize,
}

impl Default for CholeskyTuning {
    fn default() -> Self {
        Self { front_cost: 50, tile_cost: 6, block_cost: 1, thread_nodes: 2000, split_rows: 32 }
    }
}
