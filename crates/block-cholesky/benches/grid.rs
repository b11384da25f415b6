//! The matrix of the benchmarks: springs on a grid of `across × along` nodes, each joined to its eight neighbors and to two along
//! each line, and a small mass at each node; three unknowns per node.

use block_cholesky::{BlockMatrix, Error};
use faer::sparse::{SparseColMat, Triplet};

/// The pairs of nodes that springs join.
fn springs(across: u32, along: u32) -> Vec<[u32; 2]> {
    let mut pairs = Vec::new();
    for (i, j) in (0..along).flat_map(|j| (0..across).map(move |i| (i, j))) {
        for (di, dj) in [(1, 0), (0, 1), (1, 1), (-1, 1), (2, 0), (0, 2)] {
            if let Some(k) = i.checked_add_signed(di).filter(|&k| k < across)
                && j + dj < along
            {
                pairs.push([j * across + i, (j + dj) * across + k]);
            }
        }
    }
    pairs
}

/// Stiffness of the springs, and the mass.
const SPRING: f64 = 1.0;
const MASS: f64 = 0.1;

/// The matrix for this crate.
pub fn blocks(across: u32, along: u32) -> Result<BlockMatrix, Error> {
    let nodes = (across * along) as usize;
    let mut matrix = BlockMatrix::new(nodes, springs(across, along))?;
    let scaled = |s: f64| [[s, 0.0, 0.0], [0.0, s, 0.0], [0.0, 0.0, s]];
    for [i, j] in matrix.pairs().to_vec().iter().map(|pair| pair.map(|node| node as usize)) {
        let slot = matrix.slot(i, j).expect("the pattern has this pair");
        matrix.add_scalar(slot, -SPRING);
        matrix.add_diagonal(i, &scaled(SPRING));
        matrix.add_diagonal(j, &scaled(SPRING));
    }
    (0..nodes).for_each(|i| matrix.add_diagonal(i, &scaled(MASS)));
    Ok(matrix)
}

/// The lower triangle of the matrix for faer: the entries of all blocks, as the block matrix has them, zeros too.
pub fn columns(across: u32, along: u32) -> SparseColMat<usize, f64> {
    let nodes = (across * along) as usize;
    let pairs = springs(across, along);
    let mut diagonal = vec![MASS; nodes];
    for node in pairs.iter().flatten() {
        diagonal[*node as usize] += SPRING;
    }
    let mut entries = Vec::new();
    for (node, value) in diagonal.into_iter().enumerate() {
        for (r, c) in (0..3).flat_map(|r| (0..=r).map(move |c| (r, c))) {
            let value = if r == c { value } else { 0.0 };
            entries.push(Triplet::new(3 * node + r, 3 * node + c, value));
        }
    }
    for pair in pairs {
        let [i, j] = [pair[0].max(pair[1]), pair[0].min(pair[1])].map(|node| node as usize);
        for (r, c) in (0..3).flat_map(|r| (0..3).map(move |c| (r, c))) {
            let value = if r == c { -SPRING } else { 0.0 };
            entries.push(Triplet::new(3 * i + r, 3 * j + c, value));
        }
    }
    SparseColMat::try_new_from_triplets(3 * nodes, 3 * nodes, &entries).expect("a sparse matrix")
}
