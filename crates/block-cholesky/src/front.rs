//! The dense front of one supernode: how its parts are stored, and the elimination of its pivots.
//!
//! Pivot rows and update rows begin a new row panel each. The pivot columns, padded to whole tiles with a unit
//! diagonal, become columns of the factor L; the lower triangle on the update rows becomes the update
//! `U − L₂₁ L₂₁ᵀ`, of which panel i has the columns of the panels up to i.

use crate::kernel::{self, COLUMNS, Column, ROWS, Registers, TileOperation};
use crate::supernode::PANEL_NODES;
use std::ops::Range;

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

/// Eliminates the pivots of a front. `factor` has the assembled pivot columns, on return the columns of L with the
/// reciprocals of its diagonal; `update` the assembled lower triangle of the update rows, on return the update. A front of
/// `split` panels of update rows or more is eliminated on several threads.
///
/// # Errors
/// The pivot (a row of the front) that is not positive.
pub fn eliminate(
    shape: Shape,
    factor: &mut [Column],
    update: &mut [Column],
    split: usize,
) -> Result<(), usize> {
    let columns = shape.columns();
    let (head, tail) = factor.split_at_mut(shape.pivot_panels() * columns);
    kernel::dispatch_tiles(Pivots { columns, head })?;
    below(columns, head, tail, split);
    remainder(columns, tail, update, 0..shape.update_panels(), split);
    Ok(())
}

/// The columns of L on the update rows; panels do not depend on each other.
fn below(columns: usize, head: &[Column], tail: &mut [Column], split: usize) {
    let panels = tail.len() / columns;
    if panels < split.max(2) {
        kernel::dispatch_tiles(Below { columns, head, tail });
        return;
    }
    let (first, second) = tail.split_at_mut(panels / 2 * columns);
    rayon::join(|| below(columns, head, first, split), || below(columns, head, second, split));
}

/// What remains on the update rows of some panels; panels do not depend on each other.
fn remainder(
    columns: usize,
    tail: &[Column],
    update: &mut [Column],
    panels: Range<usize>,
    split: usize,
) {
    if panels.len() < split.max(2) {
        kernel::dispatch_tiles(Remainder { columns, tail, update, panels });
        return;
    }
    let middle = panels.start + panels.len() / 2;
    let (first, second) = update.split_at_mut(update_start(middle) - update_start(panels.start));
    rayon::join(
        || remainder(columns, tail, first, panels.start..middle, split),
        || remainder(columns, tail, second, middle..panels.end, split),
    );
}

/// Factorizes the pivot rows.
pub struct Pivots<'a> {
    pub columns: usize,
    pub head: &'a mut [Column],
}

impl TileOperation for Pivots<'_> {
    /// The pivot that is not positive, if there is one.
    type Output = Result<(), usize>;

    #[inline(always)]
    fn run<R: Registers>(self, registers: R) -> Self::Output {
        let Self { columns, head } = self;
        for i in 0..head.len() / columns {
            let (above, panel) = head.split_at_mut(i * columns);
            let panel = &mut panel[..columns];
            eliminate_above(registers, columns, above, panel);
            // its own columns
            for first in (ROWS * i..(ROWS * (i + 1)).min(columns)).step_by(COLUMNS) {
                let (a, c) = tile(panel, first);
                let pivot = match first % ROWS {
                    0 => diagonal::<R, 0>(registers, c, a),
                    4 => diagonal::<R, 4>(registers, c, a),
                    _ => diagonal::<R, 8>(registers, c, a),
                };
                pivot.map_err(|j| first + j)?;
            }
        }
        Ok(())
    }
}

/// Gives the columns of L on panels of update rows.
pub struct Below<'a> {
    pub columns: usize,
    pub head: &'a [Column],
    pub tail: &'a mut [Column],
}

impl TileOperation for Below<'_> {
    type Output = ();

    #[inline(always)]
    fn run<R: Registers>(self, registers: R) {
        let Self { columns, head, tail } = self;
        for panel in tail.chunks_exact_mut(columns) {
            eliminate_above(registers, columns, head, panel);
        }
    }
}

/// Subtracts `L₂₁ L₂₁ᵀ` from panels of the update.
pub struct Remainder<'a> {
    pub columns: usize,
    pub tail: &'a [Column],
    /// The part of the update that has the panels.
    pub update: &'a mut [Column],
    pub panels: Range<usize>,
}

impl TileOperation for Remainder<'_> {
    type Output = ();

    #[inline(always)]
    fn run<R: Registers>(self, registers: R) {
        let Self { columns, tail, update, panels } = self;
        let begin = update_start(panels.start);
        for row in panels {
            let panel = &tail[row * columns..][..columns];
            let c = &mut update[update_start(row) - begin..update_start(row + 1) - begin];
            for (c, b) in c.as_chunks_mut::<ROWS>().0.iter_mut().zip(tail.chunks_exact(columns)) {
                registers.subtract_panel(c, panel, b);
            }
        }
    }
}

/// The columns of L of a panel that belong to the panels above.
#[inline(always)]
fn eliminate_above<R: Registers>(
    registers: R,
    columns: usize,
    above: &[Column],
    panel: &mut [Column],
) {
    for (j, l) in above.chunks_exact(columns).enumerate() {
        let end = (ROWS * (j + 1)).min(columns);
        for first in (ROWS * j..end).step_by(COLUMNS) {
            let (a, c) = tile(panel, first);
            let (b, l) = (&l[..first], columns_at(l, first));
            match first % ROWS {
                0 => kernel::eliminate::<R, 0>(registers, c, a, b, l),
                4 => kernel::eliminate::<R, 4>(registers, c, a, b, l),
                _ => kernel::eliminate::<R, 8>(registers, c, a, b, l),
            }
        }
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
fn diagonal<R: Registers, const FIRST: usize>(
    registers: R,
    c: &mut [Column; COLUMNS],
    a: &[Column],
) -> Result<(), usize> {
    // the columns of the panel that are factorized already
    kernel::subtract_product::<R, FIRST, COLUMNS>(registers, c, a, a);
    // Cholesky of the 4 × 4 triangle; its diagonal keeps the reciprocals, because solving multiplies
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
    // rows below are divided by the triangle
    let mut triangle = [Column::ZERO; COLUMNS];
    for j in 0..COLUMNS {
        triangle[j].0[FIRST..FIRST + COLUMNS].copy_from_slice(&l[j]);
    }
    kernel::eliminate::<R, FIRST>(registers, c, &[], &[], &triangle);
    for j in 0..COLUMNS {
        c[j].0[..FIRST].fill(0.0);
        c[j].0[FIRST..FIRST + COLUMNS].copy_from_slice(&l[j]);
    }
    Ok(())
}
