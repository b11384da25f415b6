//! The factorization: analysis once for a pattern, then elimination and substitution as often as the numbers change.

use crate::analysis::{self, Front};
use crate::assembly::{self, Addition};
use crate::block_matrix::{BlockMatrix, check_length};
use crate::error::Error;
use crate::front::{self, Shape};
use crate::graph::Graph;
use crate::kernel::{self, Column};
use crate::restriction::{OUT, Restriction};
use crate::substitution::{Backward, Forward};
use crate::supernode::{PANEL_NODES, Supernodes};
use crate::tuning::CholeskyTuning;
use std::sync::Arc;

/// A factorization `P A Pᵀ = L Lᵀ` whose order P and storage are found once for a pattern.
#[derive(Debug, Clone)]
pub struct Cholesky {
    /// The node at each place of the order of elimination.
    order: Vec<u32>,
    /// The nodes that are not left out, in the order of elimination.
    remaining: Vec<u32>,
    /// For each place in the whole order the place among the remaining nodes, or [`OUT`].
    places: Vec<u32>,
    restriction: Restriction,
    /// Fronts, children before parents.
    fronts: Vec<Front>,
    /// Panels of update rows from which on a front is eliminated on several threads.
    split_panels: usize,
    /// Pattern of the matrix below the diagonal, to recognize another one.
    pattern: Arc<[[u32; 2]]>,
    /// Whether `factor` is that of a matrix, in the order of the remaining nodes.
    is_factorized: bool,
    /// Columns of L, front by front.
    factor: Vec<Column>,
    /// Two stacks of updates.
    updates: [Vec<Column>; 2],
    /// Unknowns in the order of elimination.
    unknowns: Vec<[f64; 3]>,
    /// Unknowns of one front: right-hand side, solution.
    local: [Vec<Column>; 2],
}

impl Cholesky {
    /// Finds order and storage for the pattern of a matrix; its numbers do not matter.
    #[must_use]
    pub fn new(matrix: &BlockMatrix) -> Self {
        Self::with_tuning(matrix, &CholeskyTuning::default())
    }

    /// As [`Self::new`], with other tuning constants.
    #[must_use]
    pub fn with_tuning(matrix: &BlockMatrix, tuning: &CholeskyTuning) -> Self {
        let n = matrix.nodes();
        // order, supernodes, and the front of each: all that depends on the pattern alone
        let graph = Graph::new(n, matrix.pairs());
        let supernodes = Supernodes::new(&graph, &graph.minimum_degree_order(), tuning);
        let fronts = analysis::fronts(matrix, &supernodes);

        // room for the factor, for the updates of fronts that wait for their parent, and for one front
        let shapes = || fronts.iter().map(|front| front.shape);
        let stack = |parity| {
            let mine = fronts.iter().filter(|front| front.parity == parity);
            mine.map(|front| front.update + front.shape.update_len()).max().unwrap_or(0)
        };
        let panels = [Shape::pivot_panels, Shape::panels].map(|count| shapes().map(count).max());
        Self {
            split_panels: if n < tuning.thread_nodes {
                usize::MAX
            } else {
                tuning.split_rows.div_ceil(PANEL_NODES)
            },
            pattern: matrix.pattern().clone(),
            is_factorized: false,
            factor: vec![Column::ZERO; shapes().map(Shape::factor_len).sum()],
            updates: [0, 1].map(|parity| vec![Column::ZERO; stack(parity)]),
            unknowns: vec![[0.0; 3]; n],
            local: panels.map(|len| vec![Column::ZERO; len.unwrap_or(0)]),
            remaining: supernodes.order.clone(),
            places: (0..n as u32).collect(),
            order: supernodes.order,
            restriction: Restriction::new(&fronts),
            fronts,
        }
    }

    /// Leaves out those nodes for which `is_out` is true, from now on: what follows is about the matrix without their rows and
    /// columns, and [`Self::solve`] gives them zero. Nodes that were left out before and are not now come back. It allocates
    /// nothing.
    pub fn leave_out(&mut self, is_out: impl Fn(usize) -> bool) {
        self.remaining.clear();
        let mut changed = false;
        for (place, node) in self.places.iter_mut().zip(&self.order) {
            let mut new = OUT;
            if !is_out(*node as usize) {
                new = self.remaining.len() as u32;
                self.remaining.push(*node);
            }
            changed |= new != *place;
            *place = new;
        }
        if changed {
            self.is_factorized = false;
            self.restriction.apply(&self.places, &mut self.fronts);
        }
    }

    /// Factorizes a matrix with the pattern given to [`Self::new`]. On one thread it allocates nothing.
    ///
    /// # Errors
    /// If a pivot is not positive or not finite, or if the matrix has another pattern. There is no factorization then.
    pub fn factorize(&mut self, matrix: &BlockMatrix) -> Result<(), Error> {
        self.is_factorized = false;
        let pattern = matrix.pattern();
        let is_same = Arc::ptr_eq(pattern, &self.pattern) || *pattern == self.pattern;
        if matrix.nodes() != self.order.len() || !is_same {
            return Err(Error::OtherPattern);
        }
        if self.split_panels == usize::MAX {
            self.eliminate(matrix)?;
        } else {
            // among the threads, which then wait for each other less than a thread from outside does
            rayon::scope(|_| self.eliminate(matrix))?;
        }
        self.is_factorized = true;
        Ok(())
    }

    /// Eliminates front after front.
    fn eliminate(&mut self, matrix: &BlockMatrix) -> Result<(), Error> {
        let [even, odd] = &mut self.updates;
        for front in &self.fronts {
            let (own, children) =
                if front.parity == 0 { (&mut *even, &*odd) } else { (&mut *odd, &*even) };
            let shape = front.shape;
            let factor = &mut self.factor[front.factor..][..shape.factor_len()];
            let update = &mut own[front.update..][..shape.update_len()];
            assembly::clear(shape, factor, update);
            assembly::place(shape, factor, &front.entries, matrix.blocks());
            for (child, rows) in &front.children {
                let child = &self.fronts[*child];
                let child = &children[child.update..][..child.shape.update_len()];
                kernel::dispatch(Addition { shape, factor, update, rows, child });
            }
            if shape.pivots == 0 {
                continue;
            }
            front::eliminate(shape, factor, update, self.split_panels).map_err(|row| {
                Error::NotPositiveDefinite { node: self.remaining[front.first + row / 3] as usize }
            })?;
        }
        Ok(())
    }

    /// Solves `A x = b` with the last factorization: `x` is b before and the solution after, three entries per node. It
    /// allocates nothing.
    ///
    /// # Errors
    /// If there are not three entries for each node, or if there is no factorization. `x` is as before then.
    pub fn solve(&mut self, x: &mut [f64]) -> Result<(), Error> {
        check_length(x, self.order.len())?;
        if !self.is_factorized {
            return Err(Error::NotFactorized);
        }
        // into the order of elimination
        let x = x.as_chunks_mut::<3>().0;
        for (unknown, &node) in self.unknowns.iter_mut().zip(&self.remaining) {
            *unknown = x[node as usize];
        }
        let [right, solution] = &mut self.local;
        let fronts = self.fronts.iter().filter(|front| front.shape.pivots > 0);
        // forward: L y = b, from the leaves to the root
        for front in fronts.clone() {
            let shape = front.shape;
            let factor = &self.factor[front.factor..][..shape.factor_len()];
            let pivots = &mut right[..shape.pivot_panels()];
            let rows = &mut solution[..shape.update_panels()];
            let own = &mut self.unknowns[front.first..][..shape.pivots];
            gather(pivots, own.iter());
            kernel::dispatch(Forward { shape, factor, pivots, rows });
            for (k, own) in own.iter_mut().enumerate() {
                *own = node_of(pivots, k);
            }
            for (k, &row) in front.rows.iter().enumerate() {
                let change = node_of(rows, k);
                let unknown = &mut self.unknowns[row as usize];
                for r in 0..3 {
                    unknown[r] -= change[r];
                }
            }
        }
        // backward: Lᵀ x = y, from the root to the leaves
        for front in fronts.rev() {
            let shape = front.shape;
            let factor = &self.factor[front.factor..][..shape.factor_len()];
            let right = &mut right[..shape.pivot_panels()];
            let all = &mut solution[..shape.panels()];
            let (pivots, rows) = all.split_at_mut(shape.pivot_panels());
            pivots.fill(Column::ZERO);
            gather(rows, front.rows.iter().map(|&row| &self.unknowns[row as usize]));
            let own = &mut self.unknowns[front.first..][..shape.pivots];
            gather(right, own.iter());
            kernel::dispatch(Backward { shape, factor, right, all });
            for (k, own) in own.iter_mut().enumerate() {
                *own = node_of(all, k);
            }
        }
        // back into the order of the caller; nodes that are left out get zero
        x.fill([0.0; 3]);
        for (unknown, &node) in self.unknowns.iter().zip(&self.remaining) {
            x[node as usize] = *unknown;
        }
        Ok(())
    }
}

/// Fills panels with the unknowns of nodes, and with zero after the last one.
fn gather<'a>(panels: &mut [Column], mut unknowns: impl Iterator<Item = &'a [f64; 3]>) {
    for panel in panels {
        for node in panel.0.as_chunks_mut::<3>().0 {
            *node = unknowns.next().copied().unwrap_or([0.0; 3]);
        }
    }
}

/// The unknowns of one node in panels.
fn node_of(panels: &[Column], k: usize) -> [f64; 3] {
    panels[k / PANEL_NODES].0.as_chunks::<3>().0[k % PANEL_NODES]
}
