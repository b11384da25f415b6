//! The factorization against dense references and residuals.

use crate::front::Shape;
use crate::kernel::{Column, InThirds};
use crate::{Block, BlockMatrix, Cholesky, CholeskyTuning, Error, Slot, assembly, front};
use proptest::prelude::*;

/// Numbers between −1 and 1, the same in every run.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        // Knuth's MMIX
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as f64 / f64::from(1u32 << 30) - 1.0
    }

    fn block(&mut self) -> Block {
        std::array::from_fn(|_| std::array::from_fn(|_| self.next()))
    }

    fn vector(&mut self, len: usize) -> Vec<f64> {
        (0..len).map(|_| self.next()).collect()
    }
}

/// The couplings of a grid of `across × along` nodes: eight neighbors, and two along each line.
fn grid(across: usize, along: usize) -> Vec<[u32; 2]> {
    let mut pairs = Vec::new();
    for j in 0..along {
        for i in 0..across {
            for (di, dj) in [(1, 0), (0, 1), (1, 1), (-1, 1), (2, 0), (0, 2)] {
                if let Some(k) = i.checked_add_signed(di).filter(|&k| k < across)
                    && j + dj < along
                {
                    pairs.push([(j * across + i) as u32, ((j + dj) * across + k) as u32]);
                }
            }
        }
    }
    pairs
}

/// A zero matrix of a pattern without errors.
fn zero(nodes: usize, pairs: impl IntoIterator<Item = [u32; 2]>) -> BlockMatrix {
    BlockMatrix::new(nodes, pairs).expect("all pairs are of nodes")
}

/// Where a block is that the pattern has.
fn slot(matrix: &BlockMatrix, i: usize, j: usize) -> Slot {
    matrix.slot(i, j).expect("the nodes are coupled")
}

/// Sums of `Bᵀ B` over the pairs and a small diagonal: positive definite, and far from diagonal dominance.
fn positive_definite(nodes: usize, pairs: &[[u32; 2]], random: &mut Random) -> BlockMatrix {
    let mut matrix = zero(nodes, pairs.iter().copied());
    let product = |a: &Block, b: &Block| -> Block {
        std::array::from_fn(|r| std::array::from_fn(|c| (0..3).map(|k| a[k][r] * b[k][c]).sum()))
    };
    for i in 0..nodes {
        matrix.add_scalar(slot(&matrix, i, i), 0.1);
    }
    for pair in pairs {
        let [i, j] = pair.map(|node| node as usize);
        let (a, b) = (random.block(), random.block());
        matrix.add_diagonal(i, &product(&a, &a));
        matrix.add_diagonal(j, &product(&b, &b));
        if i != j {
            matrix.add(slot(&matrix, i, j), &product(&a, &b));
        } else {
            let (ab, ba) = (product(&a, &b), product(&b, &a));
            matrix.add_diagonal(i, &ab);
            matrix.add_diagonal(i, &ba);
        }
    }
    matrix
}

/// The matrix column by column.
fn dense(matrix: &BlockMatrix) -> Vec<Vec<f64>> {
    let n = 3 * matrix.nodes();
    let columns = (0..n).map(|c| {
        let mut unit = vec![0.0; n];
        unit[c] = 1.0;
        let mut column = vec![0.0; n];
        matrix.multiply(&unit, &mut column).expect("three entries per node");
        column
    });
    columns.collect()
}

/// Solution by the textbook's dense factorization, or nothing if a pivot is not positive.
fn dense_solution(matrix: &BlockMatrix, b: &[f64]) -> Option<Vec<f64>> {
    let mut a = dense(matrix);
    let n = b.len();
    for j in 0..n {
        for k in 0..j {
            for i in j..n {
                a[j][i] -= a[k][i] * a[k][j];
            }
        }
        if a[j][j] <= 0.0 {
            return None;
        }
        let pivot = a[j][j].sqrt();
        a[j][j..].iter_mut().for_each(|x| *x /= pivot);
    }
    let mut x = b.to_vec();
    for j in 0..n {
        x[j] /= a[j][j];
        for i in j + 1..n {
            x[i] -= a[j][i] * x[j];
        }
    }
    for j in (0..n).rev() {
        for i in j + 1..n {
            x[j] -= a[j][i] * x[i];
        }
        x[j] /= a[j][j];
    }
    Some(x)
}

/// Largest residual of `A x = b` over ‖A‖∞ ‖x‖∞ + ‖b‖∞, the backward error.
fn backward_error(matrix: &BlockMatrix, x: &[f64], b: &[f64]) -> f64 {
    let largest = |v: &[f64]| v.iter().fold(0.0f64, |m, x| m.max(x.abs()));
    let mut product = vec![0.0; x.len()];
    matrix.multiply(x, &mut product).expect("three entries per node");
    let residual: Vec<f64> = product.iter().zip(b).map(|(p, b)| p - b).collect();
    // rows have at most some hundreds of entries of order one
    let size = matrix.blocks().iter().flatten().flatten().fold(0.0f64, |m, x| m.max(x.abs()));
    largest(&residual) / (size * largest(x) + largest(b))
}

/// Asserts that a matrix is solved with a residual of rounding errors only.
fn assert_solved(matrix: &BlockMatrix, random: &mut Random) {
    let mut cholesky = Cholesky::new(matrix);
    cholesky.factorize(matrix).expect("the matrix is positive definite");
    let b = random.vector(3 * matrix.nodes());
    let mut x = b.clone();
    cholesky.solve(&mut x).expect("it is factorized");
    let error = backward_error(matrix, &x, &b);
    assert!(error < 1e-13, "{} nodes: {error:e}", matrix.nodes());
}

/// Random pairs, repeated ones and nodes coupled to themselves among them.
fn graphs() -> impl Strategy<Value = (usize, Vec<[u32; 2]>)> {
    (1..40usize).prop_flat_map(|nodes| {
        let node = 0..nodes as u32;
        let pair = (node.clone(), node).prop_map(|(i, j)| [i, j]);
        (Just(nodes), prop::collection::vec(pair, 0..4 * nodes))
    })
}

proptest! {
    /// On any graph, with repeated pairs and nodes without couplings, the solution is the dense one. Condition numbers
    /// here are below 1e4.
    #[test]
    fn solutions_agree_with_dense_factorization((nodes, pairs) in graphs(), seed: u64) {
        let mut random = Random(seed);
        let matrix = positive_definite(nodes, &pairs, &mut random);
        let b = random.vector(3 * nodes);
        let expected = dense_solution(&matrix, &b).expect("positive definite");
        let mut x = b.clone();
        let mut cholesky = Cholesky::new(&matrix);
        prop_assert_eq!(cholesky.factorize(&matrix), Ok(()));
        cholesky.solve(&mut x).expect("it is factorized");
        prop_assert!(backward_error(&matrix, &x, &b) < 1e-13);
        let largest = expected.iter().fold(0.0f64, |m, x| m.max(x.abs()));
        for (x, expected) in x.iter().zip(&expected) {
            prop_assert!((x - expected).abs() <= 1e-9 * largest, "{} {}", x, expected);
        }
    }

    /// A matrix is refused exactly where the dense factorization meets a pivot that is not positive.
    #[test]
    fn indefinite_matrices_are_refused((nodes, pairs) in graphs(), seed: u64, shift in 0.0..4.0f64) {
        let mut random = Random(seed);
        let mut matrix = positive_definite(nodes, &pairs, &mut random);
        matrix.add_scalar(slot(&matrix, nodes / 2, nodes / 2), -shift);
        let b = vec![1.0; 3 * nodes];
        let result = Cholesky::new(&matrix).factorize(&matrix);
        prop_assert_eq!(result.is_ok(), dense_solution(&matrix, &b).is_some());
    }

    /// With nodes left out, the solution is that of the matrix without their rows and columns, and zero at them. It is that
    /// of the whole matrix again once none is left out.
    #[test]
    fn nodes_that_are_left_out_have_no_part((nodes, pairs) in graphs(), seed: u64, outs: [u64; 2]) {
        let mut random = Random(seed);
        let matrix = positive_definite(nodes, &pairs, &mut random);
        let b = random.vector(3 * nodes);
        let mut cholesky = Cholesky::new(&matrix);
        for out in outs.into_iter().chain([0]) {
            let is_out = |node: usize| out >> (node % 64) & 1 == 1;
            cholesky.leave_out(is_out);
            prop_assert_eq!(cholesky.factorize(&matrix), Ok(()));
            let mut x = b.clone();
            cholesky.solve(&mut x).expect("it is factorized");
            let mut product = vec![0.0; 3 * nodes];
            matrix.multiply(&x, &mut product).expect("three entries per node");
            for node in 0..nodes {
                for n in 3 * node..3 * node + 3 {
                    let error = if is_out(node) { x[n] } else { product[n] - b[n] };
                    prop_assert!(error.abs() < 1e-10, "node {}: {}", node, error);
                }
            }
        }
    }

    /// Merging more or fewer supernodes changes a solution by rounding only.
    #[test]
    fn tuning_does_not_change_solutions(
        (nodes, pairs) in graphs(), seed: u64,
        front_cost in 0..5000usize, tile_cost in 0..50usize, block_cost in 0..50usize,
    ) {
        let mut random = Random(seed);
        let matrix = positive_definite(nodes, &pairs, &mut random);
        let b = random.vector(3 * nodes);
        let mut x = b.clone();
        let tuning = CholeskyTuning { front_cost, tile_cost, block_cost, ..CholeskyTuning::default() };
        let mut cholesky = Cholesky::with_tuning(&matrix, &tuning);
        prop_assert_eq!(cholesky.factorize(&matrix), Ok(()));
        cholesky.solve(&mut x).expect("it is factorized");
        prop_assert!(backward_error(&matrix, &x, &b) < 1e-13);
    }
}

#[test]
fn grids_are_solved() {
    let mut random = Random(1);
    for (across, along) in [(1, 1), (2, 1), (1, 9), (3, 3), (7, 5), (31, 11), (12, 40), (31, 31)] {
        let matrix = positive_definite(across * along, &grid(across, along), &mut random);
        assert_solved(&matrix, &mut random);
    }
}

/// Parts of the grid of which each node is coupled to all others.
#[test]
fn cliques_of_tens_of_nodes_are_solved() {
    let mut random = Random(2);
    let (across, along) = (24, 13);
    let mut pairs = grid(across, along);
    for corner in [0, 10, 5 * across + 3, 6 * across + 17] {
        let clique: Vec<u32> =
            (0..6).flat_map(|j| (0..6).map(move |i| (corner + j * across + i) as u32)).collect();
        for (k, &i) in clique.iter().enumerate() {
            pairs.extend(clique[..k].iter().map(|&j| [i, j]));
        }
    }
    let matrix = positive_definite(across * along, &pairs, &mut random);
    assert_solved(&matrix, &mut random);
}

#[test]
fn nodes_without_couplings_are_solved_by_their_own_blocks() {
    let mut matrix = zero(9, [[2, 3]]);
    for i in 0..9 {
        matrix.add_scalar(slot(&matrix, i, i), 2.0 + i as f64);
    }
    let mut x = vec![1.0; 27];
    let mut cholesky = Cholesky::new(&matrix);
    cholesky.factorize(&matrix).unwrap();
    cholesky.solve(&mut x).expect("it is factorized");
    for (k, x) in x.iter().enumerate() {
        assert!((x * (2.0 + (k / 3) as f64) - 1.0).abs() < 1e-15);
    }
}

#[test]
fn an_empty_matrix_has_an_empty_solution() {
    let matrix = zero(0, []);
    let mut cholesky = Cholesky::new(&matrix);
    cholesky.factorize(&matrix).unwrap();
    cholesky.solve(&mut []).expect("it is factorized");
}

/// Both directions of a slot add to the same entries, and `multiply` is the product with the dense symmetric matrix.
#[test]
fn blocks_are_added_with_their_transposes() {
    let mut matrix = zero(3, [[0, 2], [2, 0], [1, 0], [1, 1]]);
    assert_eq!(matrix.pairs(), [[1, 0], [2, 0]]);
    assert_eq!(matrix.slot(1, 2), None);
    let block = [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, 9.0]];
    matrix.add(slot(&matrix, 0, 2), &block);
    matrix.add(slot(&matrix, 1, 0), &block);
    matrix.add_scalar(slot(&matrix, 0, 1), 0.5);
    let a = dense(&matrix);
    for r in 0..3 {
        for c in 0..3 {
            let identity = if r == c { 0.5 } else { 0.0 };
            assert_eq!([a[6 + c][r], a[r][6 + c]], [block[r][c]; 2]);
            assert_eq!([a[c][3 + r], a[3 + r][c]], [block[r][c] + identity; 2]);
        }
    }
}

/// A refused matrix, or another one, leaves no trace in what comes after.
#[test]
fn the_same_matrix_gives_the_same_bytes() {
    let mut random = Random(3);
    let pairs = grid(17, 12);
    let matrix = positive_definite(17 * 12, &pairs, &mut random);
    let other = positive_definite(17 * 12, &pairs, &mut random);
    let mut refused = other.clone();
    refused.add_scalar(slot(&refused, 100, 100), -1e3);
    let b = random.vector(3 * 17 * 12);
    let solution = |cholesky: &mut Cholesky| {
        cholesky.factorize(&matrix).unwrap();
        let mut x = b.clone();
        cholesky.solve(&mut x).expect("it is factorized");
        x.into_iter().map(f64::to_bits).collect::<Vec<_>>()
    };
    let mut cholesky = Cholesky::new(&matrix);
    let first = solution(&mut cholesky);
    cholesky.factorize(&other).unwrap();
    assert_eq!(cholesky.factorize(&refused), Err(Error::NotPositiveDefinite { node: 100 }));
    assert_eq!(first, solution(&mut cholesky));
    assert_eq!(first, solution(&mut Cholesky::new(&other)));
}

/// The threads of rayon give the same bytes as one.
#[test]
fn threads_do_not_change_a_solution() {
    let mut random = Random(6);
    let matrix = positive_definite(900, &grid(30, 30), &mut random);
    let b = random.vector(3 * 900);
    let [one, many] = [usize::MAX, 0].map(|thread_nodes| {
        let tuning = CholeskyTuning { thread_nodes, split_rows: 8, ..CholeskyTuning::default() };
        let mut cholesky = Cholesky::with_tuning(&matrix, &tuning);
        cholesky.factorize(&matrix).expect("the matrix is positive definite");
        let mut x = b.clone();
        cholesky.solve(&mut x).expect("it is factorized");
        x
    });
    assert_eq!(one, many);
}

/// A pair of a node that the matrix does not have is refused before anything is stored, and so is a matrix whose blocks have no
/// numbers of 32 bits.
#[test]
fn impossible_patterns_are_refused() {
    assert_eq!(BlockMatrix::new(3, [[0, 1], [3, 2]]), Err(Error::NoSuchNode { node: 3, nodes: 3 }));
    assert_eq!(BlockMatrix::new(0, [[0, 0]]), Err(Error::NoSuchNode { node: 0, nodes: 0 }));
    assert_eq!(BlockMatrix::new(1 << 33, []), Err(Error::TooManyBlocks));
    assert_eq!(zero(2, []).slot(2, 2), None);
}

/// Another pattern is refused also if it has as many nodes and blocks; the same pattern made anew is accepted.
#[test]
fn another_pattern_is_refused() {
    let identity = |pairs: [[u32; 2]; 1], nodes| {
        let mut matrix = zero(nodes, pairs);
        (0..nodes).for_each(|i| matrix.add_scalar(slot(&matrix, i, i), 1.0));
        matrix
    };
    let mut cholesky = Cholesky::new(&identity([[0, 1]], 3));
    assert_eq!(cholesky.factorize(&identity([[0, 2]], 3)), Err(Error::OtherPattern));
    assert_eq!(cholesky.factorize(&identity([[0, 1]], 4)), Err(Error::OtherPattern));
    assert_eq!(cholesky.factorize(&identity([[1, 0]], 3)), Ok(()));
}

/// Without a factorization of the present nodes a right-hand side stays as it is.
#[test]
fn nothing_is_solved_without_a_factorization() {
    let mut matrix = zero(2, [[0, 1]]);
    let mut cholesky = Cholesky::new(&matrix);
    let mut x = [1.0; 6];
    assert_eq!(cholesky.solve(&mut x), Err(Error::NotFactorized));
    for i in 0..2 {
        matrix.add_scalar(slot(&matrix, i, i), 4.0);
    }
    assert_eq!(cholesky.factorize(&matrix), Ok(()));
    cholesky.leave_out(|node| node == 0);
    assert_eq!(cholesky.solve(&mut x), Err(Error::NotFactorized));
    let mut indefinite = matrix.clone();
    indefinite.add_scalar(slot(&matrix, 1, 1), -5.0);
    let error = Error::NotPositiveDefinite { node: 1 };
    assert_eq!(cholesky.factorize(&indefinite), Err(error));
    assert_eq!(cholesky.solve(&mut x), Err(Error::NotFactorized));
    assert_eq!(x, [1.0; 6]);
    assert_eq!(cholesky.factorize(&matrix), Ok(()));
    assert_eq!(cholesky.solve(&mut x), Ok(()));
    // exact, because the root of 4 is
    assert_eq!(x, [0.0, 0.0, 0.0, 0.25, 0.25, 0.25]);
}

/// Vectors must have three entries per node, neither more nor less.
#[test]
fn vectors_of_another_length_are_refused() {
    let matrix = zero(2, []);
    for length in [5, 7] {
        let error = Err(Error::WrongLength { length, expected: 6 });
        assert_eq!(Cholesky::new(&matrix).solve(&mut vec![0.0; length]), error);
        assert_eq!(matrix.multiply(&vec![0.0; length], &mut [0.0; 6]), error);
        assert_eq!(matrix.multiply(&[0.0; 6], &mut vec![0.0; length]), error);
    }
}

/// A message has the numbers that its reader needs.
#[test]
fn messages_name_the_place() {
    let message = Error::NoSuchNode { node: 7, nodes: 4 }.to_string();
    assert_eq!(message, "a pair names node 7, but the matrix has 4 nodes, counted from 0");
    let message = Error::NotPositiveDefinite { node: 3 }.to_string();
    assert_eq!(message, "the matrix is not positive definite: a pivot of node 3 is not positive");
}

/// A number that is not finite is refused and does not come back as a solution.
#[test]
fn a_matrix_with_nan_is_refused() {
    for value in [f64::NAN, f64::INFINITY] {
        let mut matrix = positive_definite(25, &grid(5, 5), &mut Random(4));
        matrix.add_scalar(slot(&matrix, 7, 8), value);
        assert!(Cholesky::new(&matrix).factorize(&matrix).is_err());
    }
}

/// A front of 7 pivots and 9 rows, not yet eliminated.
fn assembled_front() -> (Shape, Vec<Column>, Vec<Column>) {
    let mut random = Random(5);
    let shape = Shape { pivots: 7, rows: 9 };
    let mut factor = vec![Column::ZERO; shape.factor_len()];
    let mut update = vec![Column::ZERO; shape.update_len()];
    assembly::clear(shape, &mut factor, &mut update);
    for (k, column) in factor.iter_mut().enumerate() {
        let (panel, c) = (k / shape.columns(), k % shape.columns());
        for (r, entry) in column.0.iter_mut().enumerate() {
            let row = 12 * panel + r;
            if c < 21 && !(21..24).contains(&row) {
                *entry = if row == c { 30.0 } else { random.next() };
            }
        }
    }
    (shape, factor, update)
}

/// What is left of that front by the instructions of `pulp`: its factor and then its update.
fn eliminated_by<S: pulp::Simd>(simd: S) -> Vec<Column> {
    let (shape, mut factor, mut update) = assembled_front();
    let (columns, panels) = (shape.columns(), 0..shape.update_panels());
    let (head, tail) = factor.split_at_mut(shape.pivot_panels() * columns);
    simd.vectorize(InThirds(front::Pivots { columns, head })).unwrap();
    simd.vectorize(InThirds(front::Below { columns, head, tail }));
    simd.vectorize(InThirds(front::Remainder { columns, tail, update: &mut update, panels }));
    factor.into_iter().chain(update).collect()
}

/// What is left of that front by the widest instructions of this machine.
fn eliminated() -> Vec<Column> {
    let (shape, mut factor, mut update) = assembled_front();
    front::eliminate(shape, &mut factor, &mut update, usize::MAX).unwrap();
    factor.into_iter().chain(update).collect()
}

/// Machines without vector instructions compute the same up to the rounding of fused multiply-adds.
#[test]
fn elimination_without_vector_instructions_agrees() {
    for (a, b) in eliminated().iter().zip(eliminated_by(pulp::Scalar::new())) {
        for r in 0..12 {
            assert!((a.0[r] - b.0[r]).abs() < 1e-14);
        }
    }
}

/// AVX-512 gives the bytes of AVX2, so that machines with it say the same of a plan.
#[test]
#[cfg(target_arch = "x86_64")]
fn wider_registers_do_not_change_a_byte() {
    match (pulp::x86::V4::try_new(), pulp::x86::V3::try_new()) {
        (Some(_), Some(narrow)) => assert!(eliminated() == eliminated_by(narrow)),
        _ => eprintln!("SKIPPED: this machine has no AVX-512"),
    }
}
