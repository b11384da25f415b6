//! The dense front of one supernode: how its parts are stored, and the elimination of its pivots.
//!
//! Pivot rows and update rows begin a new row panel each. The pivot columns, padded to whole tiles with a unit
//! diagonal, become columns of the factor L; the lower triangle on the update rows becomes the update
//! `U − L₂₁ L₂₁ᵀ`, of which panel i has the columns of the panels up to i.

use super::kernel::{self, COLUMNS, Column, ROWS};
use super::supernode::PANEL_NODES;
use pulp::{Simd, WithSimd};

/// Sizes of a front.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shape {
    /// Number of pivot nodes.
    pub pivots: usize,
    /// Number of update nodes.
    pub rows: usize,
}

impl Shape {
    /// Columns of the factor, with the padding.
    pub fn columns(self) -> usize {
        (3 * self.pivots).next_multiple_of(COLUMNS)
    }

    /// Row panels of the pivots.
    pub fn pivot_panels(self) -> usize {
        self.pivots.div_ceil(PANEL_NODES)
    }

    /// Row panels of the update rows.
    pub fn update_panels(self) -> usize {
        self.rows.div_ceil(PANEL_NODES)
    }

    /// Row panels of both.
    pub fn panels(self) -> usize {
        self.pivot_panels() + self.update_panels()
    }

    /// Stored panel columns of the factor.
    pub fn factor_len(self) -> usize {
        self.panels() * self.columns()
    }

    /// Stored panel columns of the update.
    pub fn update_len(self) -> usize {
        update_start(self.update_panels())
    }

    /// Which node row of the panels an update node has; pivot `p` has row `p`.
    pub fn update_row(self, k: usize) -> usize {
        self.pivot_panels() * PANEL_NODES + k
    }
}

/// Where panel `i` of an update begins.
pub fn update_start(i: usize) -> usize {
    ROWS * i * (i + 1) / 2
}

/// Eliminates the pivots of a front.
pub struct Elimination<'a> {
    pub shape: Shape,
    /// Assembled pivot columns; on return the columns of L with the reciprocals of its diagonal.
    pub factor: &'a mut [Column],
    /// Assembled lower triangle of the update rows; on return the update.
    pub update: &'a mut [Column],
}

impl WithSimd for Elimination<'_> {
    /// The pivot (a row of the front) that is not positive, if there is one.
    type Output = Result<(), usize>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let Self { shape, factor, update } = self;
        let (columns, pivot_panels) = (shape.columns(), shape.pivot_panels());
        for i in 0..shape.panels() {
            let (above, panel) = factor.split_at_mut(i * columns);
            let panel = &mut panel[..columns];
            // the columns of the panels above
            for (j, l) in above.chunks_exact(columns).take(pivot_panels).enumerate() {
                let end = (ROWS * (j + 1)).min(columns);
                for first in (ROWS * j..end).step_by(COLUMNS) {
                    let (a, c) = tile(panel, first);
                    let (b, l) = (&l[..first], columns_at(l, first));
                    match first % ROWS {
                        0 => kernel::eliminate::<S, 0>(simd, c, a, b, l),
                        4 => kernel::eliminate::<S, 4>(simd, c, a, b, l),
                        _ => kernel::eliminate::<S, 8>(simd, c, a, b, l),
                    }
                }
            }
            if i < pivot_panels {
                // its own columns
                for first in (ROWS * i..(ROWS * (i + 1)).min(columns)).step_by(COLUMNS) {
                    let (a, c) = tile(panel, first);
                    let pivot = match first % ROWS {
                        0 => diagonal::<S, 0>(simd, c, a),
                        4 => diagonal::<S, 4>(simd, c, a),
                        _ => diagonal::<S, 8>(simd, c, a),
                    };
                    pivot.map_err(|j| first + j)?;
                }
            } else {
                // what remains on the update rows
                let row = i - pivot_panels;
                let c = &mut update[update_start(row)..update_start(row + 1)];
                for (j, c) in c.chunks_exact_mut(ROWS).enumerate() {
                    let b = if j == row {
                        &*panel
                    } else {
                        &above[(pivot_panels + j) * columns..][..columns]
                    };
                    let (c, _) = c.as_chunks_mut::<COLUMNS>();
                    kernel::subtract_product::<S, 0>(simd, &mut c[0], panel, b);
                    kernel::subtract_product::<S, 4>(simd, &mut c[1], panel, b);
                    kernel::subtract_product::<S, 8>(simd, &mut c[2], panel, b);
                }
            }
        }
        Ok(())
    }
}

/// The columns of a panel before `first`, and the tile that begins there.
#[inline(always)]
fn tile(panel: &mut [Column], first: usize) -> (&[Column], &mut [Column; COLUMNS]) {
    let (a, c) = panel.split_at_mut(first);
    (a, c.first_chunk_mut().expect("panels have whole tiles"))
}

#[inline(always)]
fn columns_at(panel: &[Column], first: usize) -> &[Column; COLUMNS] {
    panel[first..].first_chunk().expect("panels have whole tiles")
}

/// Factorizes the tile whose rows `FIRST..FIRST + 4` are on the diagonal; its rows above become zero.
#[inline(always)]
fn diagonal<S: Simd, const FIRST: usize>(
    simd: S,
    c: &mut [Column; COLUMNS],
    a: &[Column],
) -> Result<(), usize> {
    kernel::subtract_product::<S, FIRST>(simd, c, a, a);
    let mut l = [[0.0; COLUMNS]; COLUMNS];
    for j in 0..COLUMNS {
        let mut pivot = c[j].0[FIRST + j];
        for k in 0..j {
            pivot -= l[k][j] * l[k][j];
        }
        if !(pivot > 0.0 && pivot < f64::INFINITY) {
            return Err(j);
        }
        let reciprocal = 1.0 / pivot.sqrt();
        l[j][j] = reciprocal;
        for r in j + 1..COLUMNS {
            let mut value = c[j].0[FIRST + r];
            for k in 0..j {
                value -= l[k][r] * l[k][j];
            }
            l[j][r] = value * reciprocal;
        }
    }
    let mut triangle = [Column::ZERO; COLUMNS];
    for j in 0..COLUMNS {
        triangle[j].0[FIRST..FIRST + COLUMNS].copy_from_slice(&l[j]);
    }
    kernel::eliminate::<S, FIRST>(simd, c, &[], &[], &triangle);
    for j in 0..COLUMNS {
        c[j].0[..FIRST].fill(0.0);
        c[j].0[FIRST..FIRST + COLUMNS].copy_from_slice(&l[j]);
    }
    Ok(())
}
