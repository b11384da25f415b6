//! Supernodes: sets of nodes that are eliminated together, because the columns of the factor below them are alike.
//!
//! Each supernode has a dense front, its own nodes (pivots) and the later nodes that they are coupled to once everything
//! before is eliminated (update rows). What remains on the update rows goes to the front of the parent, which is the
//! supernode of the first update row. Duff and Reid 1983, "The multifrontal solution of indefinite sparse symmetric
//! linear equations".

use crate::graph::Graph;
use crate::kernel::{COLUMNS, ROWS};
use crate::tuning::CholeskyTuning;

/// Nodes in a row panel.
pub const PANEL_NODES: usize = ROWS / 3;

/// The supernodes in postorder, and the order of the nodes that goes with them.
#[derive(Debug, Clone)]
pub struct Supernodes {
    /// The node at each place of the order of elimination.
    pub order: Vec<u32>,
    /// For each supernode where its pivots begin in `order`; one entry more than supernodes.
    pub starts: Vec<usize>,
    /// Update rows of each supernode: places in the order of elimination, ascending.
    pub rows: Vec<Vec<u32>>,
    /// Supernode of the first update row.
    pub parents: Vec<Option<usize>>,
}

impl Supernodes {
    /// Supernodes of an order of elimination: nodes that are cheaper together than apart are merged.
    ///
    /// The order of the result is another one with the same or a little more fill.
    pub fn new(graph: &Graph, order: &[u32], tuning: &CholeskyTuning) -> Self {
        let single: Vec<Vec<u32>> = order.iter().map(|&node| vec![node]).collect();
        let merged = Self::analyze(graph, &single).merge(single, tuning);
        // the stack of updates needs a supernode directly after its descendants
        let postorder = Self::analyze(graph, &merged).postorder();
        let mut slots: Vec<Option<Vec<u32>>> = merged.into_iter().map(Some).collect();
        let groups: Vec<Vec<u32>> = postorder.iter().filter_map(|&s| slots[s].take()).collect();
        Self::analyze(graph, &groups)
    }

    /// Update rows and parents of groups that are eliminated one after the other.
    fn analyze(graph: &Graph, groups: &[Vec<u32>]) -> Self {
        // place of every node in the order, and the group that has it
        let order: Vec<u32> = groups.iter().flatten().copied().collect();
        let mut place = vec![0; order.len()];
        for (k, &node) in order.iter().enumerate() {
            place[node as usize] = k as u32;
        }
        let mut starts = vec![0];
        let mut group_of = Vec::with_capacity(order.len());
        for (s, group) in groups.iter().enumerate() {
            starts.push(starts[s] + group.len());
            group_of.extend(group.iter().map(|_| s));
        }
        let mut parents = vec![None; groups.len()];
        let mut children = vec![Vec::new(); groups.len()];
        let mut rows: Vec<Vec<u32>> = Vec::with_capacity(groups.len());
        // rows of a group: neighbors that are eliminated later, and what its children leave; its parent has the first of them
        for s in 0..groups.len() {
            let end = starts[s + 1] as u32;
            let own = groups[s].iter().flat_map(|&node| graph.neighbors(node));
            let own = own.map(|&node| place[node as usize]);
            let inherited = children[s].iter().flat_map(|&child: &usize| &rows[child]).copied();
            let mut all: Vec<u32> = own.chain(inherited).filter(|&row| row >= end).collect();
            all.sort_unstable();
            all.dedup();
            if let Some(&row) = all.first() {
                let parent = group_of[row as usize];
                parents[s] = Some(parent);
                children[parent].push(s);
            }
            rows.push(all);
        }
        Self { order, starts, rows, parents }
    }

    /// Number of supernodes.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Supernodes, each after all of its descendants.
    fn postorder(&self) -> Vec<usize> {
        let n = self.len();
        let mut order = Vec::with_capacity(n);
        let mut children = vec![Vec::new(); n];
        let mut pending: Vec<(usize, bool)> = Vec::new();
        for s in (0..n).rev() {
            match self.parents[s] {
                Some(parent) => children[parent].push(s),
                None => pending.push((s, false)),
            }
        }
        while let Some((s, expanded)) = pending.pop() {
            if expanded {
                order.push(s);
            } else {
                pending.push((s, true));
                pending.extend(children[s].iter().map(|&child| (child, false)));
            }
        }
        order
    }

    /// The groups after every supernode has taken in those of its children that are cheaper that way.
    fn merge(&self, mut groups: Vec<Vec<u32>>, tuning: &CholeskyTuning) -> Vec<Vec<u32>> {
        let n = self.len();
        let mut children: Vec<Vec<usize>> = vec![Vec::new(); n];
        for s in 0..n {
            loop {
                let cost = |pivots, k: usize| front_cost(pivots, self.rows[k].len(), tuning) as i64;
                let own = groups[s].len();
                let change = children[s].iter().enumerate().map(|(k, &child)| {
                    let other = groups[child].len();
                    (cost(own + other, s) - cost(own, s) - cost(other, child), k)
                });
                let Some((_, k)) = change.min().filter(|&(change, _)| change < 0) else { break };
                let child = children[s].remove(k);
                let mut pivots = std::mem::take(&mut groups[child]);
                pivots.append(&mut groups[s]);
                groups[s] = pivots;
                let grandchildren = std::mem::take(&mut children[child]);
                children[s].extend(grandchildren);
            }
            if let Some(parent) = self.parents[s] {
                children[parent].push(s);
            }
        }
        groups.retain(|group| !group.is_empty());
        groups
    }
}

/// Time to eliminate the pivots of a front and to add what remains to its parent, in the units of [`CholeskyTuning`].
fn front_cost(pivots: usize, rows: usize, tuning: &CholeskyTuning) -> usize {
    let columns = (3 * pivots).next_multiple_of(COLUMNS);
    let (pivot_panels, panels) = (pivots.div_ceil(PANEL_NODES), rows.div_ceil(PANEL_NODES));
    // Σ of the lengths of the products up to each tile of a row
    let row = |columns: usize| {
        let tiles = columns / COLUMNS;
        tiles * tuning.tile_cost + COLUMNS * tiles * tiles.saturating_sub(1) / 2
    };
    let diagonal: usize = (1..=pivot_panels).map(|i| row((ROWS * i).min(columns))).sum();
    let update_tiles = panels * (panels + 1) / 2 * (ROWS / COLUMNS);
    diagonal
        + panels * row(columns)
        + update_tiles * (columns + tuning.tile_cost)
        + rows * (rows + 1) / 2 * tuning.block_cost
        + tuning.front_cost
}
