//! Assembly of a front from blocks of the matrix and from the updates of its children.

use super::block_matrix::Block;
use super::front::{Shape, update_start};
use super::kernel::{COLUMNS, Column, ROWS};
use super::supernode::PANEL_NODES;

/// Where a block of the matrix goes in the pivot columns of its front.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Entry {
    /// Index of the block in the matrix.
    pub block: u32,
    /// Its row of the front, in nodes.
    pub row: u32,
    /// Its pivot.
    pub pivot: u32,
    /// The transpose of the block is what belongs there.
    pub transposed: bool,
}

/// Zero pivot columns with a unit diagonal in the padding.
pub fn clear(shape: Shape, factor: &mut [Column], update: &mut [Column]) {
    factor.fill(Column::ZERO);
    update.fill(Column::ZERO);
    let columns = shape.columns();
    for c in 3 * shape.pivots..columns {
        factor[c / ROWS * columns + c].0[c % ROWS] = 1.0;
    }
}

/// Puts blocks of the matrix into the pivot columns.
pub fn place(shape: Shape, factor: &mut [Column], entries: &[Entry], blocks: &[Block]) {
    let columns = shape.columns();
    for entry in entries {
        let block = &blocks[entry.block as usize];
        let (row, pivot) = (entry.row as usize, entry.pivot as usize);
        let first = row / PANEL_NODES * columns + 3 * pivot;
        let target = &mut factor[first..first + 3];
        let r0 = 3 * (row % PANEL_NODES);
        for c in 0..3 {
            for r in 0..3 {
                target[c].0[r0 + r] = if entry.transposed { block[c][r] } else { block[r][c] };
            }
        }
    }
}

/// Adds the update of a child to a front; `rows` are the rows of the front that the child's update rows have.
pub fn add_child(
    shape: Shape,
    factor: &mut [Column],
    update: &mut [Column],
    rows: &[u32],
    child: &[Column],
) {
    let pivot_rows = shape.pivot_panels() * PANEL_NODES;
    let pivots = rows.partition_point(|&row| (row as usize) < pivot_rows);
    for (i, &row) in rows.iter().enumerate() {
        let (panel, to) = (row as usize / PANEL_NODES, 3 * (row as usize % PANEL_NODES));
        let (source, from) = (&child[update_start(i / PANEL_NODES)..], 3 * (i % PANEL_NODES));
        let (source_pivots, source_rows) = source[..3 * (i + 1)].split_at(3 * pivots.min(i + 1));
        let target = &mut factor[panel * shape.columns()..][..shape.columns()];
        add_row(target, to, &rows[..pivots], 0, source_pivots, from);
        if i >= pivots {
            let target = &mut update[update_start(panel - shape.pivot_panels())..];
            add_row(target, to, &rows[pivots..], pivot_rows, source_rows, from);
        }
    }
}

/// Adds one row of nodes.
#[inline]
fn add_row(
    target: &mut [Column],
    to: usize,
    columns: &[u32],
    shift: usize,
    source: &[Column],
    from: usize,
) {
    for (source, &column) in source.as_chunks::<3>().0.iter().zip(columns) {
        let first = 3 * (column as usize - shift);
        let target = &mut target[first..first + 3];
        for c in 0..3 {
            let source = &source[c].0[from..from + 3];
            let target = &mut target[c].0[to..to + 3];
            for r in 0..3 {
                target[r] += source[r];
            }
        }
    }
}

const _: () = assert!(ROWS.is_multiple_of(COLUMNS) && ROWS == 3 * PANEL_NODES);
