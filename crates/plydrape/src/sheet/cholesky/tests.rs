use super::*;

/// A grid of nodes, 8 neighbours and two along each line.
pub fn grid(columns: usize, rows: usize) -> (Vec<[u32; 2]>, Vec<[f64; 2]>) {
    let mut pairs = Vec::new();
    let node = |i: usize, j: usize| (j * columns + i) as u32;
    for j in 0..rows {
        for i in 0..columns {
            for (di, dj) in [(1, 0), (0, 1), (1, 1), (-1i64, 1), (2, 0), (0, 2)] {
                let (k, l) = (i as i64 + di, j as i64 + dj);
                if (0..columns as i64).contains(&k) && (l as usize) < rows {
                    pairs.push([node(i, j), node(k as usize, l as usize)]);
                }
            }
        }
    }
    let places = (0..rows).flat_map(|j| (0..columns).map(move |i| [i as f64, j as f64])).collect();
    (pairs, places)
}

/// A matrix with diagonally dominant random blocks.
pub fn dominant(nodes: usize, pairs: &[[u32; 2]], seed: u64) -> BlockMatrix {
    let mut state = seed;
    let mut random = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 33) as f64 / f64::from(1u32 << 31) * 2.0 - 1.0
    };
    let mut matrix = BlockMatrix::new(nodes, pairs.iter().copied());
    for i in 0..nodes {
        matrix.add_scalar(matrix.slot(i, i), 0.01);
    }
    for [i, j] in matrix.pairs().to_vec() {
        let (i, j) = (i as usize, j as usize);
        let block: Block = std::array::from_fn(|_| std::array::from_fn(|_| random()));
        matrix.add(matrix.slot(i, j), &block);
        for r in 0..3 {
            let [mut a, mut b] = [[[0.0; 3]; 3]; 2];
            a[r][r] = block[r].iter().map(|x| x.abs()).sum();
            b[r][r] = block.iter().map(|x| x[r].abs()).sum();
            matrix.add_diagonal(i, &a);
            matrix.add_diagonal(j, &b);
        }
    }
    matrix
}

/// The largest residual of a solution of A x = b, b random, over the largest entry of b.
fn residual(matrix: &BlockMatrix, cholesky: &mut Cholesky) -> f64 {
    let b: Vec<f64> =
        (0..3 * matrix.nodes()).map(|k| ((k * 37 + 11) % 101) as f64 / 50.0 - 1.0).collect();
    let mut x = b.clone();
    cholesky.solve(&mut x);
    let mut y = vec![0.0; b.len()];
    matrix.multiply(&x, &mut y);
    y.iter().zip(&b).map(|(y, b)| (y - b).abs()).fold(0.0, f64::max)
}

#[test]
fn solutions_on_grids_leave_no_residual() {
    for (columns, rows) in [(1, 1), (2, 1), (3, 3), (7, 5), (31, 11), (12, 40)] {
        let (pairs, places) = grid(columns, rows);
        let matrix = dominant(places.len(), &pairs, 7);
        let mut cholesky = Cholesky::new(&matrix, &places);
        cholesky.factorize(&matrix).unwrap();
        let residual = residual(&matrix, &mut cholesky);
        assert!(residual < 1e-10, "{columns} {rows}: {residual}");
    }
}

#[test]
#[ignore]
fn timing() {
    for (columns, rows) in [(19, 7), (31, 11), (31, 31), (31, 61), (56, 46)] {
        let (pairs, places) = grid(columns, rows);
        let matrix = dominant(places.len(), &pairs, 7);
        let start = std::time::Instant::now();
        let mut cholesky = Cholesky::new(&matrix, &places);
        let analysis = start.elapsed();
        let mut x = vec![1.0; 3 * places.len()];
        let [mut f, mut s] = [f64::INFINITY; 2];
        for _ in 0..30 {
            let start = std::time::Instant::now();
            cholesky.factorize(&matrix).unwrap();
            f = f.min(start.elapsed().as_secs_f64());
            let start = std::time::Instant::now();
            cholesky.solve(&mut x);
            s = s.min(start.elapsed().as_secs_f64());
        }
        println!(
            "{} unknowns: analysis {:.2} ms, factorize {:.3} ms, solve {:.3} ms, {} kB, {} fronts, residual {:.1e}",
            3 * places.len(),
            analysis.as_secs_f64() * 1e3,
            f * 1e3,
            s * 1e3,
            cholesky.memory() / 1000,
            cholesky.fronts.len(),
            residual(&matrix, &mut cholesky)
        );
    }
}
