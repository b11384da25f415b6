//! Storage of all fronts and what is added to each, found once for a pattern.

use crate::assembly::Entry;
use crate::block_matrix::BlockMatrix;
use crate::front::Shape;
use crate::supernode::Supernodes;

/// One front of the elimination.
#[derive(Debug, Clone)]
pub struct Front {
    /// Number of its pivots and update rows.
    pub shape: Shape,
    /// Place of the first pivot in the order of elimination.
    pub first: usize,
    /// Where its columns of L begin.
    pub factor: usize,
    /// Where its update begins on the stack of its parity.
    pub update: usize,
    /// Depth in the tree of fronts, modulo two: a front writes its update to one stack and its children to the other.
    pub parity: usize,
    /// Blocks of the matrix that belong to its pivots.
    pub entries: Vec<Entry>,
    /// Update rows as places in the order of elimination, ascending.
    pub rows: Vec<u32>,
    /// Children, and the rows of this front that the update rows of each have.
    pub children: Vec<(usize, Vec<u32>)>,
}

impl Front {
    /// The row of the front that a place in the order of elimination has.
    fn row(&self, place: u32) -> u32 {
        let pivot = place as usize - self.first;
        if pivot < self.shape.pivots {
            pivot as u32
        } else {
            self.shape.update_row(self.rows.partition_point(|&row| row < place)) as u32
        }
    }
}

/// The fronts of supernodes in postorder.
pub fn fronts(matrix: &BlockMatrix, supernodes: &Supernodes) -> Vec<Front> {
    let n = supernodes.len();
    let mut parity = vec![0; n];
    let mut children = vec![Vec::new(); n];
    // a front and its children take turns on two stacks, so that the update of one is never written over what it reads
    for s in (0..n).rev() {
        parity[s] = supernodes.parents[s].map_or(0, |parent| 1 - parity[parent]);
    }
    for s in 0..n {
        if let Some(parent) = supernodes.parents[s] {
            children[parent].push(s);
        }
    }
    let (mut factor, mut tops) = (0, [0; 2]);
    let mut fronts: Vec<Front> = Vec::with_capacity(n);
    for s in 0..n {
        let first = supernodes.starts[s];
        let rows = supernodes.rows[s].clone();
        let shape = Shape { pivots: supernodes.starts[s + 1] - first, rows: rows.len() };
        // the updates of the children leave their stack; the own one goes on top of the other
        if let Some(&child) = children[s].first() {
            tops[1 - parity[s]] = fronts[child].update;
        }
        let update = tops[parity[s]];
        tops[parity[s]] += shape.update_len();
        // where the rows that each child leaves are in this front
        let mut front = Front {
            shape,
            first,
            factor,
            update,
            parity: parity[s],
            entries: Vec::new(),
            rows,
            children: Vec::new(),
        };
        front.children = children[s]
            .iter()
            .map(|&child| (child, fronts[child].rows.iter().map(|&p| front.row(p)).collect()))
            .collect();
        factor += shape.factor_len();
        fronts.push(front);
    }
    distribute(matrix, supernodes, &mut fronts);
    fronts
}

/// Gives every block of the matrix to the front that eliminates the earlier one of its nodes.
fn distribute(matrix: &BlockMatrix, supernodes: &Supernodes, fronts: &mut [Front]) {
    let n = matrix.nodes();
    let mut place = vec![0; n];
    for (k, &node) in supernodes.order.iter().enumerate() {
        place[node as usize] = k as u32;
    }
    let diagonal = (0..n as u32).map(|node| [node, node]);
    for (block, [i, j]) in diagonal.chain(matrix.pairs().iter().copied()).enumerate() {
        let (row, column) = (place[i as usize], place[j as usize]);
        let (later, earlier) = (row.max(column), row.min(column));
        let s = supernodes.starts.partition_point(|&start| start <= earlier as usize) - 1;
        let front = &mut fronts[s];
        let entry = Entry {
            block: block as u32,
            row: front.row(later),
            pivot: front.row(earlier),
            transposed: row < column,
        };
        front.entries.push(entry);
    }
    for front in fronts {
        front.entries.sort_unstable_by_key(|entry| (entry.row, entry.pivot));
    }
}
