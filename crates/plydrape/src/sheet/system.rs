//! The linear system of one Newton step: elements add to nodes, what carries a node decides which unknowns these are.
//!
//! A free node has a block of three unknowns. A node that a gripper holds follows the gripper. A node of a pad follows
//! the pad's turn δθ by δx = δθ × a, a its arm, and the pad's shift where its mount is not rigid; a pad without a joint has no turn of
//! its own.

use super::cholesky::{BlockMatrix, Cholesky, NotPositiveDefinite, Slot};
use crate::geometry::matrix3::{
    Matrix3, outer, plus, product, scaled, skew, times, transposed, transposed_times,
};
use crate::geometry::vector::{along, cross, dot};

/// What carries a node.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Carrier {
    /// Its own unknowns.
    Free {
        /// Their block.
        block: u32,
    },
    /// A gripper's point.
    Held {
        /// The gripper.
        gripper: u32,
    },
    /// A gripper's pad.
    Pad {
        /// The gripper.
        gripper: u32,
        /// Block of the pad's turn; none if it has no joint.
        turn: Option<u32>,
        /// Block of the pad's shift; none if its mount is rigid.
        shift: Option<u32>,
    },
}

/// A pair of nodes that an element couples, and where two free nodes stand in the matrix.
#[derive(Debug, Clone, Copy)]
pub struct Pair {
    nodes: [u32; 2],
    slot: Option<Slot>,
}

/// The linear system.
#[derive(Debug)]
pub struct System {
    carriers: Vec<Carrier>,
    matrix: BlockMatrix,
    cholesky: Cholesky,
    /// Gradient of the energy at each node (N).
    pub gradient: Vec<[f64; 3]>,
    /// How far grippers move each node in the step that is predicted (m); nothing in all others.
    pub moved: Vec<[f64; 3]>,
    predicts: bool,
    /// What the movement of held nodes adds to the gradient of each node (N).
    pulled: Vec<[f64; 3]>,
    arms: Vec<[f64; 3]>,
    /// Nodes that stay where they are, and whether terms of such nodes alone are left out of the sums.
    still: Vec<bool>,
    skips: bool,
    /// Whether each block of unknowns is that of a node that stays where it is.
    out: Vec<bool>,
    /// Right-hand side, what pulls at the unknowns.
    right: Vec<f64>,
    step: Vec<f64>,
}

impl System {
    /// For nodes at fabric places (m) with their carriers, the blocks of unknowns, and all pairs of nodes that elements
    /// couple.
    pub fn new(
        places: &[[f64; 2]],
        carriers: Vec<Carrier>,
        block_places: &[[f64; 2]],
        pairs: impl Iterator<Item = [u32; 2]>,
    ) -> Self {
        let unknowns = |node: u32| blocks(carriers[node as usize]);
        let mut coupled = Vec::new();
        for [a, b] in pairs {
            for i in unknowns(a).into_iter().flatten() {
                coupled.extend(unknowns(b).into_iter().flatten().map(|j| [i, j]));
            }
        }
        for carrier in &carriers {
            if let Carrier::Pad { turn: Some(turn), shift: Some(shift), .. } = carrier {
                coupled.push([*turn, *shift]);
            }
        }
        coupled.retain(|[i, j]| i != j);
        let matrix = BlockMatrix::new(block_places.len(), coupled);
        let cholesky = Cholesky::new(&matrix);
        let nodes = places.len();
        System {
            carriers,
            cholesky,
            gradient: vec![[0.0; 3]; nodes],
            moved: vec![[0.0; 3]; nodes],
            predicts: false,
            pulled: vec![[0.0; 3]; nodes],
            arms: vec![[0.0; 3]; nodes],
            still: vec![false; nodes],
            skips: false,
            out: vec![false; block_places.len()],
            right: vec![0.0; 3 * block_places.len()],
            step: vec![0.0; 3 * block_places.len()],
            matrix,
        }
    }

    /// Decides which free nodes stay where they are, from now on.
    pub fn keep_still(&mut self, still: &[bool]) {
        for (node, carrier) in self.carriers.iter().enumerate() {
            if let Carrier::Free { block } = carrier {
                self.still[node] = still[node];
                self.out[*block as usize] = self.still[node];
            }
        }
        let out = &self.out;
        self.cholesky.leave_out(|block| out[block]);
    }

    /// Whether a term of these nodes is left out, because all of them stay where they are.
    pub fn skips(&self, nodes: &[usize]) -> bool {
        self.skips && nodes.iter().all(|node| self.still[*node])
    }

    /// A pair of nodes for [`System::couple`].
    pub fn pair(&self, nodes: [u32; 2]) -> Pair {
        let slot = match nodes.map(|node| self.carriers[node as usize]) {
            [Carrier::Free { block: i }, Carrier::Free { block: j }] => {
                Some(self.matrix.slot(i as usize, j as usize))
            }
            _ => None,
        };
        Pair { nodes, slot }
    }

    /// What carries a node.
    pub fn carrier(&self, node: usize) -> Carrier {
        self.carriers[node]
    }

    /// Begins a system. `arm` gives a pad node's arm from its gripper (m); with `predicts`, the movement of held nodes
    /// ([`System::moved`]) adds to the gradient of their neighbors; with `skips`, terms of nodes alone that stay where they are
    /// are left out.
    pub fn begin(&mut self, predicts: bool, skips: bool, arm: impl Fn(usize, u32) -> [f64; 3]) {
        self.matrix.clear();
        self.gradient.fill([0.0; 3]);
        self.pulled.fill([0.0; 3]);
        self.predicts = predicts;
        self.skips = skips;
        for (node, carrier) in self.carriers.iter().enumerate() {
            if let Carrier::Pad { gripper, .. } = carrier {
                self.arms[node] = arm(node, *gripper);
            }
        }
    }

    /// Adds the second derivative `k` of an energy to two different nodes (N/m); the block of the second and the first
    /// is its transpose.
    pub fn couple(&mut self, pair: Pair, k: &Matrix3) {
        if let Some(slot) = pair.slot {
            self.matrix.add(slot, k);
            return;
        }
        let [a, b] = pair.nodes.map(|node| node as usize);
        if self.predicts {
            let (forth, back) = (times(k, self.moved[b]), transposed_times(k, self.moved[a]));
            add(&mut self.pulled[a], 1.0, forth);
            add(&mut self.pulled[b], 1.0, back);
        }
        for (side, i) in blocks(self.carriers[a]).into_iter().enumerate() {
            for (other, j) in blocks(self.carriers[b]).into_iter().enumerate() {
                let (Some(i), Some(j)) = (i, j) else { continue };
                let mut block = *k;
                if self.turns(a, side) {
                    block = product(&skew(self.arms[a]), &block);
                }
                if self.turns(b, other) {
                    block = product(&block, &transposed(&skew(self.arms[b])));
                }
                if i == j {
                    let both = plus(&block, 1.0, &transposed(&block));
                    self.matrix.add_diagonal(i as usize, &both);
                } else {
                    let slot = self.matrix.slot(i as usize, j as usize);
                    self.matrix.add(slot, &block);
                }
            }
        }
    }

    /// As [`System::couple`] with `s` times the identity.
    pub fn couple_scalar(&mut self, pair: Pair, s: f64) {
        match pair.slot {
            Some(slot) => self.matrix.add_scalar(slot, s),
            None => self.couple(pair, &[[s, 0.0, 0.0], [0.0, s, 0.0], [0.0, 0.0, s]]),
        }
    }

    /// Adds the second derivative `k` of an energy to one node (N/m).
    pub fn stiffen(&mut self, node: usize, k: &Matrix3) {
        let carrier = self.carriers[node];
        if let Carrier::Free { block } = carrier {
            self.matrix.add_diagonal(block as usize, k);
            return;
        }
        if self.predicts {
            let forth = times(k, self.moved[node]);
            add(&mut self.pulled[node], 1.0, forth);
        }
        if let Carrier::Pad { turn, shift, .. } = carrier {
            let arm = skew(self.arms[node]);
            let turned = product(&arm, k);
            if let Some(turn) = turn {
                let both = product(&turned, &transposed(&arm));
                self.matrix.add_diagonal(turn as usize, &both);
            }
            if let Some(shift) = shift {
                self.matrix.add_diagonal(shift as usize, k);
            }
            if let (Some(turn), Some(shift)) = (turn, shift) {
                let slot = self.matrix.slot(turn as usize, shift as usize);
                self.matrix.add(slot, &turned);
            }
        }
    }

    /// As [`System::stiffen`] with `s` times the identity.
    pub fn stiffen_scalar(&mut self, node: usize, s: f64) {
        self.stiffen(node, &[[s, 0.0, 0.0], [0.0, s, 0.0], [0.0, 0.0, s]]);
    }

    /// Adds a second derivative to a block of unknowns and a gradient to its right-hand side later.
    pub fn stiffen_block(&mut self, block: usize, k: &Matrix3) {
        self.matrix.add_diagonal(block, k);
    }

    /// Ends the assembly. `own` is what acts on blocks of unknowns themselves. How the forces on a pad act on its turn by
    /// their arms is added here, all of it (`whole`) or its positive parts.
    pub fn end(&mut self, own: &[(u32, [f64; 3])], whole: bool) {
        self.right.fill(0.0);
        for (node, carrier) in self.carriers.iter().enumerate() {
            let force = self.gradient[node];
            let g = along(force, 1.0, self.pulled[node]);
            match *carrier {
                Carrier::Free { block } => add_at(&mut self.right, block, g),
                Carrier::Held { .. } => {}
                Carrier::Pad { turn, shift, .. } => {
                    let arm = self.arms[node];
                    if let Some(turn) = turn {
                        add_at(&mut self.right, turn, cross(arm, g));
                        self.matrix.add_diagonal(turn as usize, &lever(force, arm, whole));
                    }
                    if let Some(shift) = shift {
                        add_at(&mut self.right, shift, g);
                    }
                }
            }
        }
        for (block, g) in own {
            add_at(&mut self.right, *block, *g);
        }
        for value in &mut self.right {
            *value = -*value;
        }
    }

    /// Factorizes the matrix.
    ///
    /// # Errors
    /// If it is not positive definite.
    pub fn factorize(&mut self) -> Result<(), NotPositiveDefinite> {
        self.cholesky.factorize(&self.matrix)
    }

    /// Solves for Newton's step with the matrix that was factorized last.
    pub fn solve(&mut self) {
        self.step.copy_from_slice(&self.right);
        self.cholesky.solve(&mut self.step);
    }

    /// The matrix times a direction at each free node.
    #[cfg(test)]
    pub fn multiply(&self, direction: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let block = |node: usize| match self.carriers[node] {
            Carrier::Free { block } => Some(3 * block as usize),
            _ => None,
        };
        let (mut x, mut y) = (vec![0.0; self.step.len()], vec![0.0; self.step.len()]);
        for (node, d) in direction.iter().enumerate() {
            if let Some(at) = block(node) {
                x[at..at + 3].copy_from_slice(d);
            }
        }
        self.matrix.multiply(&x, &mut y);
        let of = |node| block(node).map_or([0.0; 3], |at| [y[at], y[at + 1], y[at + 2]]);
        (0..direction.len()).map(of).collect()
    }

    /// Newton's step of a block of unknowns.
    pub fn step(&self, block: u32) -> [f64; 3] {
        [0, 1, 2].map(|n| self.step[3 * block as usize + n])
    }

    /// Whether a block of a node's carrier is a pad's turn.
    fn turns(&self, node: usize, which: usize) -> bool {
        which == 0 && matches!(self.carriers[node], Carrier::Pad { .. })
    }
}

/// The blocks that carry a node: its own, or a pad's turn and shift.
fn blocks(carrier: Carrier) -> [Option<u32>; 2] {
    match carrier {
        Carrier::Free { block } => [Some(block), None],
        Carrier::Held { .. } => [None, None],
        Carrier::Pad { turn, shift, .. } => [turn, shift],
    }
}

/// Second derivative of the work of a force −g on an arm a over the turn of the arm: ½ (g aᵀ + a gᵀ) − (g·a) I. Its
/// positive part is that of a force that pulls along the arm.
fn lever(g: [f64; 3], arm: [f64; 3], whole: bool) -> Matrix3 {
    let (reach, square) = (-dot(g, arm), dot(arm, arm));
    let pulls = reach > 0.0 && square > 0.0;
    let mut k = match whole {
        true => plus(&scaled(0.5, &outer(g, arm)), 0.5, &outer(arm, g)),
        false if pulls => scaled(-reach / square, &outer(arm, arm)),
        false => return [[0.0; 3]; 3],
    };
    for n in 0..3 {
        k[n][n] += reach;
    }
    k
}

/// a += s b.
pub fn add(a: &mut [f64; 3], s: f64, b: [f64; 3]) {
    for n in 0..3 {
        a[n] += s * b[n];
    }
}

fn add_at(step: &mut [f64], block: u32, g: [f64; 3]) {
    for n in 0..3 {
        step[3 * block as usize + n] += g[n];
    }
}
