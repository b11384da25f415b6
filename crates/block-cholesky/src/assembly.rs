//! Assembly of a front from blocks of the matrix and from the updates of its children.

use crate::block_matrix::Block;
use crate::front::{Shape, update_start};
use crate::kernel::{COLUMNS, Column, ROWS};
use crate::supernode::PANEL_NODES;
use pulp::{Simd, WithSimd};

/// Where a block of the matrix goes in the pivot columns of its front.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Entry {
    /// Index of the block in the matrix.
    pub block: u32,
    /// Row of the front, in nodes.
    pub row: u32,
    /// Pivot.
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

/// Adds the update of a child to a front.
pub struct Addition<'a> {
    pub shape: Shape,
    pub factor: &'a mut [Column],
    pub update: &'a mut [Column],
    /// Rows of the front that the update rows of the child have, ascending.
    pub rows: &'a [u32],
    /// Update of the child.
    pub child: &'a [Column],
}

impl WithSimd for Addition<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { shape, factor, update, rows, child } = self;
        let columns = shape.columns();
        let pivot_rows = shape.pivot_panels() * PANEL_NODES;
        let pivots = rows.partition_point(|&row| (row as usize) < pivot_rows);
        let mut end = 0;
        while end < rows.len() {
            // rows that are neighbors in one panel here and there are added together; above the diagonal nothing is
            // read later
            let first = end;
            let (panel, to) =
                (rows[first] as usize / PANEL_NODES, rows[first] as usize % PANEL_NODES);
            end += 1;
            while end < rows.len()
                && !end.is_multiple_of(PANEL_NODES)
                && rows[end] == rows[end - 1] + 1
                && !(rows[end] as usize).is_multiple_of(PANEL_NODES)
            {
                end += 1;
            }
            let source = &child[update_start(first / PANEL_NODES)..][..3 * end];
            let (source_pivots, source_rows) = source.split_at(3 * pivots.min(end));
            let run = Run { from: 3 * (first % PANEL_NODES), to: 3 * to, nodes: end - first };
            let target = &mut factor[panel * columns..][..columns];
            run.add(target, &rows[..pivots], 0, source_pivots);
            if first >= pivots {
                let target = &mut update[update_start(panel - shape.pivot_panels())..];
                run.add(target, &rows[pivots..], pivot_rows, source_rows);
            }
        }
    }
}

/// Rows that are neighbors in a panel of the child and in one of the front.
#[derive(Clone, Copy)]
struct Run {
    /// First of them in the child's panel.
    from: usize,
    /// First of them in the front's panel.
    to: usize,
    /// Number of nodes.
    nodes: usize,
}

impl Run {
    /// Adds columns of three per node; node k of the source is the node `columns[k] − shift` of the target.
    #[inline(always)]
    fn add(self, target: &mut [Column], columns: &[u32], shift: usize, source: &[Column]) {
        match self.nodes {
            1 => self.add_rows::<3>(target, columns, shift, source),
            2 => self.add_rows::<6>(target, columns, shift, source),
            3 => self.add_rows::<9>(target, columns, shift, source),
            _ => self.add_rows::<12>(target, columns, shift, source),
        }
    }

    #[inline(always)]
    fn add_rows<const N: usize>(
        self,
        target: &mut [Column],
        columns: &[u32],
        shift: usize,
        source: &[Column],
    ) {
        for (source, &column) in source.as_chunks::<3>().0.iter().zip(columns) {
            let first = 3 * (column as usize - shift);
            let target: &mut [Column; 3] = target[first..].first_chunk_mut().expect("a node");
            for c in 0..3 {
                let source: &[f64; N] = source[c].0[self.from..].first_chunk().expect("a run");
                let target: &mut [f64; N] =
                    target[c].0[self.to..].first_chunk_mut().expect("a run");
                for r in 0..N {
                    target[r] += source[r];
                }
            }
        }
    }
}

const _: () = assert!(ROWS.is_multiple_of(COLUMNS) && ROWS == 3 * PANEL_NODES);
