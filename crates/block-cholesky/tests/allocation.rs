//! Once a pattern is analyzed, the factorization asks for no memory.

use block_cholesky::{BlockMatrix, Cholesky};
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};
use std::alloc::System;

#[global_allocator]
static ALLOCATOR: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

/// Elimination, substitution and leaving out nodes use the storage that the analysis of the pattern made.
#[test]
fn a_factorization_and_its_solution_allocate_nothing() {
    let nodes = 300;
    let chain = (0..nodes as u32 - 20).flat_map(|i| [[i, i + 1], [i, i + 20]]);
    let mut matrix = BlockMatrix::new(nodes, chain).expect("the pairs are of nodes");
    for i in 0..nodes {
        matrix.add_diagonal(i, &[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    }
    let mut cholesky = Cholesky::new(&matrix);
    let mut x = vec![1.0; 3 * nodes];
    let region = Region::new(ALLOCATOR);
    cholesky.factorize(&matrix).expect("the identity is positive definite");
    cholesky.solve(&mut x).expect("it is factorized");
    cholesky.leave_out(|node| node % 7 == 0);
    cholesky.factorize(&matrix).expect("the identity is positive definite");
    cholesky.leave_out(|_| false);
    cholesky.factorize(&matrix).expect("the identity is positive definite");
    cholesky.solve(&mut x).expect("it is factorized");
    let change = region.change();
    assert!(x.iter().all(|&x| x == 1.0));
    assert_eq!((change.allocations, change.reallocations), (0, 0));
}
