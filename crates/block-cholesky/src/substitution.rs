//! Forward and backward substitution with the columns of one front.

use crate::front::Shape;
use crate::kernel::{self, COLUMNS, Column, ROWS};
use pulp::{Simd, WithSimd};

/// Solves `L₁₁ y = x` for the pivots and gives `L₂₁ y` for the update rows.
pub struct Forward<'a> {
    pub shape: Shape,
    pub factor: &'a [Column],
    /// Pivots, one entry per row of the pivot panels: x, on return y.
    pub pivots: &'a mut [Column],
    /// On return `L₂₁ y` in panels.
    pub rows: &'a mut [Column],
}

impl WithSimd for Forward<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { shape, factor, pivots, rows } = self;
        let columns = shape.columns();
        let (head, tail) = factor.split_at(shape.pivot_panels() * columns);
        for (i, panel) in head.chunks_exact(columns).enumerate() {
            let (before, rest) = panel.split_at(ROWS * i);
            let (solved, x) = pivots.split_at_mut(i);
            let sum = kernel::combine(simd, before, solved);
            let mut x_rest = x[0].0;
            for r in 0..ROWS {
                x_rest[r] -= sum.0[r];
            }
            // the triangle of the panel; its columns are zero above the diagonal
            for (c, column) in rest.iter().take(ROWS).enumerate() {
                let y = x_rest[c] * column.0[c];
                x[0].0[c] = y;
                for r in 0..ROWS {
                    x_rest[r] -= y * column.0[r];
                }
            }
        }
        for (panel, row) in tail.chunks_exact(columns).zip(rows) {
            *row = kernel::combine(simd, panel, pivots);
        }
    }
}

/// Solves `L₁₁ᵀ y = x − L₂₁ᵀ z` for the pivots, z the update rows.
pub struct Backward<'a> {
    pub shape: Shape,
    pub factor: &'a [Column],
    /// Right-hand side x of the pivots.
    pub right: &'a [Column],
    /// Zero for the pivots, then z, in panels; on return y is in the place of the zeros.
    pub all: &'a mut [Column],
}

impl WithSimd for Backward<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { shape, factor, right, all } = self;
        let columns = shape.columns();
        for first in (0..columns).step_by(COLUMNS).rev() {
            let (i, r) = (first / ROWS, first % ROWS);
            // rows that are not solved yet are zero
            let below = kernel::project(simd, &factor[i * columns + first..], columns, &all[i..]);
            let tile = &factor[i * columns + first..][..COLUMNS];
            for c in (0..COLUMNS).rev() {
                let mut y = right[i].0[r + c] - below[c];
                for k in c + 1..COLUMNS {
                    y -= tile[c].0[r + k] * all[i].0[r + k];
                }
                all[i].0[r + c] = y * tile[c].0[r + c];
            }
        }
    }
}
