//! Dense kernels on row panels, by `pulp`.
//!
//! A dense matrix is stored as panels of twelve rows (four nodes); a panel as its columns, twelve numbers each. A kernel
//! computes a tile of twelve rows and four columns in registers, or of twelve columns where there are registers for it.
//! Nothing is packed. Every number of a tile is the same sum in the same order with all instructions, to the last bit.

use pulp::{NullaryFnOnce, Simd, WithSimd};

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

/// Instructions that compute tiles.
pub trait Registers: Copy {
    /// Registers that hold rows of one column.
    type Rows: Copy;

    /// How many of these make a column.
    const GROUPS: usize;

    fn zero(self) -> Self::Rows;
    fn load(self, column: &Column, group: usize) -> Self::Rows;
    fn store(self, column: &mut Column, group: usize, rows: Self::Rows);
    /// `c + a b`.
    fn add_product(self, a: Self::Rows, b: f64, c: Self::Rows) -> Self::Rows;
    fn subtract(self, a: Self::Rows, b: Self::Rows) -> Self::Rows;
    fn scale(self, a: Self::Rows, b: f64) -> Self::Rows;

    /// `c ← c − a bᵀ` for all twelve rows of `b`.
    #[inline(always)]
    fn subtract_panel(self, c: &mut [Column; ROWS], a: &[Column], b: &[Column]) {
        let (c, _) = c.as_chunks_mut::<COLUMNS>();
        subtract_product::<Self, 0, COLUMNS>(self, &mut c[0], a, b);
        subtract_product::<Self, 4, COLUMNS>(self, &mut c[1], a, b);
        subtract_product::<Self, 8, COLUMNS>(self, &mut c[2], a, b);
    }
}

/// What is done with tiles, by the instructions that the machine has.
pub trait TileOperation {
    type Output;

    fn run<R: Registers>(self, registers: R) -> Self::Output;
}

/// An operation and the instructions that it runs with.
struct Run<Operation, R>(Operation, R);

impl<Operation: TileOperation, R: Registers> NullaryFnOnce for Run<Operation, R> {
    type Output = Operation::Output;

    #[inline(always)]
    fn call(self) -> Self::Output {
        self.0.run(self.1)
    }
}

/// A tile operation by the instructions that `pulp` gives.
pub struct InThirds<Operation>(pub Operation);

impl<Operation: TileOperation> WithSimd for InThirds<Operation> {
    type Output = Operation::Output;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        self.0.run(Thirds(simd))
    }
}

/// Runs a tile operation with the widest instructions of the machine.
#[inline(always)]
pub fn dispatch_tiles<Operation: TileOperation>(operation: Operation) -> Operation::Output {
    #[cfg(target_arch = "x86_64")]
    if let Some(simd) = pulp::x86::V4::try_new() {
        return simd.vectorize(Run(operation, simd));
    }
    dispatch(InThirds(operation))
}

/// Runs an operation with the widest instructions of the machine whose registers divide a panel.
#[inline(always)]
pub fn dispatch<Operation: WithSimd>(operation: Operation) -> Operation::Output {
    #[cfg(target_arch = "x86_64")]
    match pulp::x86::V3::try_new() {
        Some(simd) => Simd::vectorize(simd, operation),
        None => Simd::vectorize(pulp::Scalar::new(), operation),
    }
    #[cfg(not(target_arch = "x86_64"))]
    pulp::Arch::new().dispatch(operation)
}

/// Rows in three registers each: with four numbers in a register a tile takes twelve of sixteen, and one column of the left
/// factor and one number of the right one the other four.
#[derive(Clone, Copy)]
struct Thirds<S>(S);

impl<S: Simd> Registers for Thirds<S> {
    type Rows = [S::f64s; 3];

    const GROUPS: usize = {
        assert!(ROWS.is_multiple_of(3 * S::F64_LANES));
        ROWS / (3 * S::F64_LANES)
    };

    #[inline(always)]
    fn zero(self) -> Self::Rows {
        [self.0.splat_f64s(0.0); 3]
    }

    #[inline(always)]
    fn load(self, column: &Column, group: usize) -> Self::Rows {
        registers::<S>(column, group)
    }

    #[inline(always)]
    fn store(self, column: &mut Column, group: usize, rows: Self::Rows) {
        let (column, _) = S::as_mut_simd_f64s(&mut column.0);
        column[3 * group..3 * group + 3].copy_from_slice(&rows);
    }

    #[inline(always)]
    fn add_product(self, a: Self::Rows, b: f64, c: Self::Rows) -> Self::Rows {
        let b = self.0.splat_f64s(b);
        [0, 1, 2].map(|v| self.0.mul_add_e_f64s(a[v], b, c[v]))
    }

    #[inline(always)]
    fn subtract(self, a: Self::Rows, b: Self::Rows) -> Self::Rows {
        [0, 1, 2].map(|v| self.0.sub_f64s(a[v], b[v]))
    }

    #[inline(always)]
    fn scale(self, a: Self::Rows, b: f64) -> Self::Rows {
        let b = self.0.splat_f64s(b);
        a.map(|a| self.0.mul_f64s(a, b))
    }
}

/// AVX-512: a column is one register of eight numbers and one of four, and twelve columns are a tile, of 24 of 32 registers.
#[cfg(target_arch = "x86_64")]
impl Registers for pulp::x86::V4 {
    type Rows = (pulp::f64x8, pulp::f64x4);

    const GROUPS: usize = 1;

    #[inline(always)]
    fn zero(self) -> Self::Rows {
        (self.splat_f64x8(0.0), self.splat_f64x4(0.0))
    }

    #[inline(always)]
    fn load(self, column: &Column, _: usize) -> Self::Rows {
        let (first, last) = column.0.split_at(8);
        let first: &[f64; 8] = first.first_chunk().expect("twelve rows");
        let last: &[f64; 4] = last.first_chunk().expect("twelve rows");
        (pulp::cast(*first), pulp::cast(*last))
    }

    #[inline(always)]
    fn store(self, column: &mut Column, _: usize, (first, last): Self::Rows) {
        column.0[..8].copy_from_slice(&pulp::cast::<_, [f64; 8]>(first));
        column.0[8..].copy_from_slice(&pulp::cast::<_, [f64; 4]>(last));
    }

    #[inline(always)]
    fn add_product(self, a: Self::Rows, b: f64, c: Self::Rows) -> Self::Rows {
        let first = self.mul_add_f64x8(a.0, self.splat_f64x8(b), c.0);
        (first, self.mul_add_f64x4(a.1, self.splat_f64x4(b), c.1))
    }

    #[inline(always)]
    fn subtract(self, a: Self::Rows, b: Self::Rows) -> Self::Rows {
        (self.sub_f64x8(a.0, b.0), self.sub_f64x4(a.1, b.1))
    }

    #[inline(always)]
    fn scale(self, a: Self::Rows, b: f64) -> Self::Rows {
        let first = self.mul_f64x8(a.0, self.splat_f64x8(b));
        (first, self.mul_f64x4(a.1, self.splat_f64x4(b)))
    }

    #[inline(always)]
    fn subtract_panel(self, c: &mut [Column; ROWS], a: &[Column], b: &[Column]) {
        subtract_product::<Self, 0, ROWS>(self, c, a, b);
    }
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
    <Thirds<S> as Registers>::GROUPS
}

/// The tile `c − Σ a_p b_pᵀ`, of which `b` gives the rows from `FIRST` on.
#[inline(always)]
fn difference<R: Registers, const FIRST: usize, const WIDTH: usize>(
    registers: R,
    c: &[Column; WIDTH],
    a: &[Column],
    b: &[Column],
    group: usize,
) -> [R::Rows; WIDTH] {
    let mut sum = [registers.zero(); WIDTH];
    for (a, b) in a.iter().zip(b) {
        let a = registers.load(a, group);
        for j in 0..WIDTH {
            sum[j] = registers.add_product(a, b.0[FIRST + j], sum[j]);
        }
    }
    for j in 0..WIDTH {
        sum[j] = registers.subtract(registers.load(&c[j], group), sum[j]);
    }
    sum
}

#[inline(always)]
fn store<R: Registers, const WIDTH: usize>(
    registers: R,
    c: &mut [Column; WIDTH],
    group: usize,
    tile: [R::Rows; WIDTH],
) {
    for j in 0..WIDTH {
        registers.store(&mut c[j], group, tile[j]);
    }
}

/// `c ← c − a bᵀ` for a tile.
#[inline(always)]
pub fn subtract_product<R: Registers, const FIRST: usize, const WIDTH: usize>(
    registers: R,
    c: &mut [Column; WIDTH],
    a: &[Column],
    b: &[Column],
) {
    for group in 0..R::GROUPS {
        let tile = difference::<R, FIRST, WIDTH>(registers, c, a, b, group);
        store(registers, c, group, tile);
    }
}

/// `c ← (c − a bᵀ) L⁻ᵀ` for a tile, L the lower triangle in the rows `FIRST..FIRST + 4` of `l`, which holds the
/// reciprocals of its diagonal.
#[inline(always)]
pub fn eliminate<R: Registers, const FIRST: usize>(
    registers: R,
    c: &mut [Column; COLUMNS],
    a: &[Column],
    b: &[Column],
    l: &[Column; COLUMNS],
) {
    for group in 0..R::GROUPS {
        let mut tile = difference::<R, FIRST, COLUMNS>(registers, c, a, b, group);
        for j in 0..COLUMNS {
            tile[j] = registers.scale(tile[j], l[j].0[FIRST + j]);
            for k in j + 1..COLUMNS {
                tile[k] = registers.add_product(tile[j], -l[j].0[FIRST + k], tile[k]);
            }
        }
        store(registers, c, group, tile);
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
