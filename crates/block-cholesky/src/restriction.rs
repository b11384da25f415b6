//! Fronts of a matrix in which some nodes are left out, found from the fronts of the whole matrix.
//!
//! Without the rows and columns of some nodes, the others keep their order of elimination and their supernodes. The update
//! rows of a front are again those of its blocks and of its children, so that the factor has no more entries than an
//! analysis in this order would find. Every part of a front keeps the storage that it has in the whole matrix, or less.

use crate::analysis::Front;
use crate::assembly::Entry;
use crate::supernode::PANEL_NODES;

/// A node or row that is left out.
pub const OUT: u32 = u32::MAX;

/// What is needed to leave out nodes without new memory.
#[derive(Debug, Clone)]
pub struct Restriction {
    /// Fronts of the whole matrix.
    whole: Vec<Front>,
    /// For each front which of its update rows remain.
    remaining: Vec<Vec<u32>>,
    /// For each row of one front the row that it becomes.
    rows: Vec<u32>,
}

impl Restriction {
    /// The restriction of the fronts of the whole matrix, with nothing left out.
    pub fn new(whole: &[Front]) -> Self {
        let rows = whole.iter().map(|front| front.shape.panels() * PANEL_NODES).max();
        let remaining = whole.iter().map(|front| (0..front.rows.len() as u32).collect());
        Self {
            remaining: remaining.collect(),
            whole: whole.to_vec(),
            rows: vec![OUT; rows.unwrap_or(0)],
        }
    }

    /// Gives `fronts` what remains. `places` has the new place of each place in the order of elimination, or [`OUT`].
    pub fn apply(&mut self, places: &[u32], fronts: &mut [Front]) {
        for (s, whole) in self.whole.iter().enumerate() {
            let (before, after) = fronts.split_at_mut(s);
            let front = &mut after[0];
            let first_row = whole.shape.update_row(0);
            let rows = &mut self.rows[..whole.shape.panels() * PANEL_NODES];
            rows.fill(OUT);

            // pivots
            let pivots = &places[whole.first..][..whole.shape.pivots];
            front.shape.pivots = 0;
            front.first = 0;
            for (row, place) in rows.iter_mut().zip(pivots).filter(|(_, place)| **place != OUT) {
                if front.shape.pivots == 0 {
                    front.first = *place as usize;
                }
                *row = front.shape.pivots as u32;
                front.shape.pivots += 1;
            }

            // update rows, first marked, then numbered
            let is_in = |row: u32| places[whole.rows[row as usize - first_row] as usize] != OUT;
            for entry in &whole.entries {
                let below = entry.row as usize >= first_row;
                if below && rows[entry.pivot as usize] != OUT && is_in(entry.row) {
                    rows[entry.row as usize] = 0;
                }
            }
            for (child, to) in &whole.children {
                let to = self.remaining[*child].iter().map(|k| to[*k as usize]);
                for row in to.filter(|row| *row as usize >= first_row) {
                    rows[row as usize] = 0;
                }
            }
            front.rows.clear();
            let remaining = &mut self.remaining[s];
            remaining.clear();
            for (k, place) in whole.rows.iter().enumerate() {
                let row = &mut rows[first_row + k];
                if *row != OUT {
                    *row = front.shape.update_row(front.rows.len()) as u32;
                    front.rows.push(places[*place as usize]);
                    remaining.push(k as u32);
                }
            }
            front.shape.rows = front.rows.len();

            // blocks of the matrix and updates of children
            front.entries.clear();
            let moved = |entry: &Entry| Entry {
                row: rows[entry.row as usize],
                pivot: rows[entry.pivot as usize],
                ..*entry
            };
            let entries = whole.entries.iter().map(moved);
            front.entries.extend(entries.filter(|entry| entry.row != OUT && entry.pivot != OUT));
            for ((child, own), (_, to)) in front.children.iter_mut().zip(&whole.children) {
                debug_assert_eq!(before[*child].rows.len(), self.remaining[*child].len());
                own.clear();
                own.extend(self.remaining[*child].iter().map(|k| rows[to[*k as usize] as usize]));
            }
        }
    }
}
