//! Tuning constants of the factorization. They change its time and not its result, apart from rounding.

/// Constants of the ordering and of the cost model that decides which supernodes are merged.
///
/// Costs are in units of one multiply-add on a tile of 12 × 4 numbers (about six cycles).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tuning {
    /// Sets of at most so many nodes are not divided further.
    pub leaf_nodes: usize,
    /// Cuts that are tried along each fabric coordinate.
    pub cut_trials: usize,
    /// Width of the range about the median, as a share of the nodes, in which cuts are tried.
    pub cut_spread: f64,
    /// Weight of the larger side in the score of a cut: separator nodes × (1 + balance × share of the larger side).
    pub balance: f64,
    /// Cost of a supernode apart from its arithmetic.
    pub supernode_cost: usize,
    /// Cost of a tile apart from its arithmetic.
    pub tile_cost: usize,
    /// Cost of adding one 3×3 block of a child to its parent.
    pub block_cost: usize,
}

impl Default for Tuning {
    fn default() -> Self {
        Self {
            leaf_nodes: 12,
            cut_trials: 5,
            cut_spread: 0.3,
            balance: 1.0,
            supernode_cost: 50,
            tile_cost: 6,
            block_cost: 2,
        }
    }
}
