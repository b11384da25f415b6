//! How long one analysis, one factorization and one solution take on one thread, beside faer on the same matrix in the same run.
//!
//! `cargo bench --manifest-path crates/block-cholesky/benches/Cargo.toml`

use block_cholesky::{Cholesky, CholeskyTuning};
use block_cholesky_benches::{blocks, columns};
use divan::{Bencher, black_box};
use dyn_stack::{MemBuffer, MemStack};
use faer::sparse::SparseColMat;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::{Conj, MatMut, Par, Side};

/// Nodes across and along.
const SIZES: [(u32, u32); 5] = [(19, 7), (31, 11), (31, 31), (31, 61), (56, 46)];

fn main() {
    for size in SIZES {
        agree(size);
    }
    divan::main();
}

/// A matrix and its analysis by this crate, on one thread.
fn own((across, along): (u32, u32)) -> (block_cholesky::BlockMatrix, Cholesky) {
    let matrix = blocks(across, along).expect("the springs join nodes of the grid");
    let tuning = CholeskyTuning { thread_nodes: usize::MAX, ..CholeskyTuning::default() };
    let cholesky = Cholesky::with_tuning(&matrix, &tuning);
    (matrix, cholesky)
}

/// A matrix, its analysis and its storage by faer: approximate minimum degree, supernodes.
struct Peer {
    matrix: SparseColMat<usize, f64>,
    symbolic: SymbolicCholesky<usize>,
    values: Vec<f64>,
    memory: MemBuffer,
}

impl Peer {
    fn new(matrix: SparseColMat<usize, f64>) -> Self {
        let params = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..Default::default()
        };
        let order = SymmetricOrdering::Amd;
        let symbolic = factorize_symbolic_cholesky(matrix.symbolic(), Side::Lower, order, params)
            .expect("a symbolic factor");
        let factorizing =
            symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default());
        let memory =
            MemBuffer::new(factorizing.or(symbolic.solve_in_place_scratch::<f64>(1, Par::Seq)));
        Self { values: vec![0.0; symbolic.len_val()], matrix, symbolic, memory }
    }

    fn factorize(&mut self) {
        let stack = MemStack::new(&mut self.memory);
        let (side, default) = (Side::Lower, Default::default());
        self.symbolic
            .factorize_numeric_llt(
                &mut self.values,
                self.matrix.as_ref(),
                side,
                default,
                Par::Seq,
                stack,
                Default::default(),
            )
            .expect("positive definite");
    }

    fn solve(&mut self, x: &mut [f64]) {
        let rows = x.len();
        let x = MatMut::from_column_major_slice_mut(x, rows, 1);
        let stack = MemStack::new(&mut self.memory);
        LltRef::new(&self.symbolic, &self.values).solve_in_place_with_conj(
            Conj::No,
            x,
            Par::Seq,
            stack,
        );
    }
}

/// The right-hand side; no two entries are equal.
fn right(size: (u32, u32)) -> Vec<f64> {
    (0..3 * size.0 * size.1).map(|n| f64::from(n).sin()).collect()
}

/// Panics where the two solutions differ by more than rounding; condition numbers are some hundreds.
fn agree(size: (u32, u32)) {
    let (matrix, mut cholesky) = own(size);
    cholesky.factorize(&matrix).expect("positive definite");
    let mut peer = Peer::new(columns(size.0, size.1));
    peer.factorize();
    let (mut a, mut b) = (right(size), right(size));
    cholesky.solve(&mut a).expect("it is factorized");
    peer.solve(&mut b);
    assert!(a.iter().zip(&b).all(|(a, b)| (a - b).abs() < 1e-11), "{size:?}: the solutions differ");
}

#[divan::bench(args = SIZES)]
fn analyze_block_cholesky(bencher: Bencher, (across, along): (u32, u32)) {
    let matrix = blocks(across, along).expect("the springs join nodes of the grid");
    bencher.bench_local(|| Cholesky::new(black_box(&matrix)));
}

#[divan::bench(args = SIZES)]
fn analyze_faer(bencher: Bencher, (across, along): (u32, u32)) {
    let matrix = columns(across, along);
    bencher.bench_local(|| Peer::new(black_box(matrix.clone())));
}

#[divan::bench(args = SIZES)]
fn factorize_block_cholesky(bencher: Bencher, size: (u32, u32)) {
    let (matrix, mut cholesky) = own(size);
    bencher.bench_local(|| cholesky.factorize(black_box(&matrix)).expect("positive definite"));
}

#[divan::bench(args = SIZES)]
fn factorize_faer(bencher: Bencher, size: (u32, u32)) {
    let mut peer = Peer::new(columns(size.0, size.1));
    bencher.bench_local(|| black_box(&mut peer).factorize());
}

#[divan::bench(args = SIZES)]
fn solve_block_cholesky(bencher: Bencher, size: (u32, u32)) {
    let (matrix, mut cholesky) = own(size);
    cholesky.factorize(&matrix).expect("positive definite");
    let mut x = right(size);
    bencher.bench_local(|| cholesky.solve(black_box(&mut x)).expect("it is factorized"));
}

#[divan::bench(args = SIZES)]
fn solve_faer(bencher: Bencher, size: (u32, u32)) {
    let mut peer = Peer::new(columns(size.0, size.1));
    peer.factorize();
    let mut x = right(size);
    bencher.bench_local(|| peer.solve(black_box(&mut x)));
}
