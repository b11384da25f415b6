//! Dense kernels on row panels, by `pulp`.
//!
//! A dense matrix is stored as panels of twelve rows (four nodes); a panel as its columns, twelve numbers each. A kernel
//! computes a tile of twelve rows and four columns in registers: with four numbers in a register, the tile takes twelve
//! registers, and one column of the left factor and one number of the right one the other four. Nothing is packed.

use pulp::{Simd, WithSimd};

/// Rows of a panel.
pub const ROWS: usize = 12;
/// Columns of a tile.
pub const COLUMNS: usize = 4;

/// One column of a row panel.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(C, align(32))]
pub struct Column(pub [f64; ROWS]);

impl Column {
    pub const ZERO: Self = Self([0.0; ROWS]);
}

/// Runs an operation with the widest instructions of the machine whose registers divide a panel.
#[inline(always)]
pub fn dispatch<Operation: WithSimd>(operation: Operation) -> Operation::Output {
    #[cfg(target_arch = "x86_64")]
    // not AVX-512: a register of eight numbers does not divide a panel into groups of three
    match pulp::x86::V3::try_new() {
        Some(simd) => Simd::vectorize(simd, operation),
        None => Simd::vectorize(pulp::Scalar::new(), operation),
    }
    #[cfg(not(target_arch = "x86_64"))]
    pulp::Arch::new().dispatch(operation)
}

/// Three registers of column `a`, from row `3 group × lanes` on.
#[inline(always)]
fn registers<S: Simd>(a: &Column, group: usize) -> [S::f64s; 3] {
    let (a, _) = S::as_simd_f64s(&a.0);
    [a[3 * group], a[3 * group + 1], a[3 * group + 2]]
}

/// Groups of three registers in a column.
#[inline(always)]
fn groups<S: Simd>() -> usize {
    const { assert!(ROWS.is_multiple_of(3 * S::F64_LANES)) };
    ROWS / (3 * S::F64_LANES)
}

/// The tile `c − Σ a_p b_pᵀ`, of which `b` gives the rows `FIRST..FIRST + 4`.
#[inline(always)]
fn difference<S: Simd, const FIRST: usize>(
    simd: S,
    c: &[Column; COLUMNS],
    a: &[Column],
    b: &[Column],
    group: usize,
) -> [[S::f64s; 3]; COLUMNS] {
    let mut sum = [[simd.splat_f64s(0.0); 3]; COLUMNS];
    for (a, b) in a.iter().zip(b) {
        let a = registers::<S>(a, group);
        for j in 0..COLUMNS {
            let b = simd.splat_f64s(b.0[FIRST + j]);
            for v in 0..3 {
                sum[j][v] = simd.mul_add_e_f64s(a[v], b, sum[j][v]);
            }
        }
    }
    for j in 0..COLUMNS {
        let c = registers::<S>(&c[j], group);
        for v in 0..3 {
            sum[j][v] = simd.sub_f64s(c[v], sum[j][v]);
        }
    }
    sum
}

#[inline(always)]
fn store<S: Simd>(c: &mut [Column; COLUMNS], group: usize, tile: [[S::f64s; 3]; COLUMNS]) {
    for j in 0..COLUMNS {
        let (c, _) = S::as_mut_simd_f64s(&mut c[j].0);
        for v in 0..3 {
            c[3 * group + v] = tile[j][v];
        }
    }
}

/// `c ← c − a bᵀ` for a tile.
#[inline(always)]
pub fn subtract_product<S: Simd, const FIRST: usize>(
    simd: S,
    c: &mut [Column; COLUMNS],
    a: &[Column],
    b: &[Column],
) {
    for group in 0..groups::<S>() {
        let tile = difference::<S, FIRST>(simd, c, a, b, group);
        store::<S>(c, group, tile);
    }
}

/// `c ← (c − a bᵀ) L⁻ᵀ` for a tile, L the lower triangle in the rows `FIRST..FIRST + 4` of `l`, which holds the
/// reciprocals of its diagonal.
#[inline(always)]
pub fn eliminate<S: Simd, const FIRST: usize>(
    simd: S,
    c: &mut [Column; COLUMNS],
    a: &[Column],
    b: &[Column],
    l: &[Column; COLUMNS],
) {
    for group in 0..groups::<S>() {
        let mut tile = difference::<S, FIRST>(simd, c, a, b, group);
        for j in 0..COLUMNS {
            let reciprocal = simd.splat_f64s(l[j].0[FIRST + j]);
            for v in 0..3 {
                tile[j][v] = simd.mul_f64s(tile[j][v], reciprocal);
            }
            for k in j + 1..COLUMNS {
                let factor = simd.splat_f64s(-l[j].0[FIRST + k]);
                for v in 0..3 {
                    tile[k][v] = simd.mul_add_e_f64s(tile[j][v], factor, tile[k][v]);
                }
            }
        }
        store::<S>(c, group, tile);
    }
}

/// The sum `Σ a_p x_p` of the columns of a panel; `x` has an entry for each column, twelve to a panel.
#[inline(always)]
pub fn combine<S: Simd>(simd: S, a: &[Column], x: &[Column]) -> Column {
    let mut out = Column::ZERO;
    for group in 0..groups::<S>() {
        let mut sum = [[simd.splat_f64s(0.0); 3]; COLUMNS];
        for (a, x) in a.chunks(ROWS).zip(x) {
            for (a, x) in a.as_chunks::<COLUMNS>().0.iter().zip(x.0.as_chunks::<COLUMNS>().0) {
                for p in 0..COLUMNS {
                    let a = registers::<S>(&a[p], group);
                    let x = simd.splat_f64s(x[p]);
                    for v in 0..3 {
                        sum[p][v] = simd.mul_add_e_f64s(a[v], x, sum[p][v]);
                    }
                }
            }
        }
        let (out, _) = S::as_mut_simd_f64s(&mut out.0);
        for v in 0..3 {
            let halves = [(0, 1), (2, 3)].map(|(p, q)| simd.add_f64s(sum[p][v], sum[q][v]));
            out[3 * group + v] = simd.add_f64s(halves[0], halves[1]);
        }
    }
    out
}

/// The products `a_pᵀ x` of four columns with the rows `x`, summed over panels that are `stride` columns apart.
#[inline(always)]
pub fn project<S: Simd>(simd: S, a: &[Column], stride: usize, x: &[Column]) -> [f64; COLUMNS] {
    let mut sum = [simd.splat_f64s(0.0); COLUMNS];
    for (a, x) in a.chunks(stride).zip(x) {
        let (x, _) = S::as_simd_f64s(&x.0);
        let a: &[Column; COLUMNS] = a[..COLUMNS].try_into().expect("four columns");
        for p in 0..COLUMNS {
            let (a, _) = S::as_simd_f64s(&a[p].0);
            for v in 0..ROWS / S::F64_LANES {
                sum[p] = simd.mul_add_e_f64s(a[v], x[v], sum[p]);
            }
        }
    }
    sum.map(|sum| simd.reduce_sum_f64s(sum))
}
