//! The linear system of one Newton step: terms of the energy add to nodes and to blocks of unknowns, and what carries a node
//! ([`Carrier`]) decides which unknowns these are.

use super::configuration::Configuration;
use super::energy::Stiffness;
use super::unknowns::Carrier;
use crate::geometry::vector::{along, cross, dot, sub};
use crate::sheet::matrix3::{
    IDENTITY, Matrix3, outer, plus, product, scaled, skew, times, transposed, transposed_times,
};
use block_cholesky::{BlockMatrix, Cholesky, Error, Slot};

/// A pair of nodes that an element couples, and where two free nodes are in the matrix.
#[derive(Debug, Clone, Copy)]
pub struct Pair {
    nodes: [u32; 2],
    slot: Option<Slot>,
}

/// The linear step of a pad.
#[derive(Debug, Clone, Copy, Default)]
pub struct PadStep {
    /// Turn of the pad (rad).
    pub turn: [f64; 3],
    /// Shift of the pad's middle (m).
    pub shift: [f64; 3],
}

/// What is assembled of a linear system.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Parts {
    /// Gradient and matrix.
    All,
    /// The gradient; the matrix stays as it is.
    Gradient,
}

/// The linear system.
#[derive(Debug)]
pub struct System {
    parts: Parts,
    carriers: Vec<Carrier>,
    matrix: BlockMatrix,
    cholesky: Cholesky,
    /// Gradient of the energy at each node (N).
    pub gradient: Vec<[f64; 3]>,
    /// Gradient of the energy to blocks of unknowns themselves, as pads are.
    block_gradient: Vec<(u32, [f64; 3])>,
    /// How far grippers move each node in the next linear step (m); zero once it is taken.
    pub moved: Vec<[f64; 3]>,
    /// Whether grippers move any node in the next linear step.
    moves: bool,
    /// What the movement of held nodes adds to the gradient of each node (N).
    pulled: Vec<[f64; 3]>,
    /// Arm of each node of a pad from the pad's middle (m).
    arms: Vec<[f64; 3]>,
    /// Nodes that stay where they are.
    still: Vec<bool>,
    /// Whether each block of unknowns is that of a node that stays where it is.
    out: Vec<bool>,
    /// Right-hand side, what pulls at the unknowns.
    right: Vec<f64>,
    /// Newton's step of the unknowns.
    solution: Vec<f64>,
    /// Newton's step of each node (m).
    pub step: Vec<[f64; 3]>,
    /// Newton's step of each pad.
    pub pad_steps: Vec<PadStep>,
}

impl System {
    /// The system of nodes with their carriers, of a number of blocks of unknowns and of pads, where elements couple pairs of
    /// nodes.
    pub fn new(carriers: Vec<Carrier>, blocks: usize, pads: usize, pairs: &[[u32; 2]]) -> Self {
        // the matrix has a block where elements couple unknowns, and where a pad turns and shifts
        let unknowns = |node: u32| carriers[node as usize].blocks();
        let mut coupled = Vec::new();
        for [a, b] in pairs {
            for i in unknowns(*a).into_iter().flatten() {
                coupled.extend(unknowns(*b).into_iter().flatten().map(|j| [i, j]));
            }
        }
        for carrier in &carriers {
            if let Carrier::Pad { turn: Some(turn), shift: Some(shift), .. } = carrier {
                coupled.push([*turn, *shift]);
            }
        }
        coupled.retain(|[i, j]| i != j);
        let matrix = BlockMatrix::new(blocks, coupled).expect("carriers name blocks of unknowns");
        // order and storage of the factor follow from the pattern alone
        let nodes = carriers.len();
        let zero = vec![[0.0; 3]; nodes];
        System {
            parts: Parts::All,
            carriers,
            cholesky: Cholesky::new(&matrix),
            gradient: zero.clone(),
            block_gradient: Vec::new(),
            moved: zero.clone(),
            moves: false,
            pulled: zero.clone(),
            arms: zero.clone(),
            still: vec![false; nodes],
            out: vec![false; blocks],
            right: vec![0.0; 3 * blocks],
            solution: vec![0.0; 3 * blocks],
            step: zero,
            pad_steps: vec![PadStep::default(); pads],
            matrix,
        }
    }

    /// Decides which free nodes are no unknowns, until [`System::free_all`].
    pub fn keep_still(&mut self, still: &[bool]) {
        for (node, carrier) in self.carriers.iter().enumerate() {
            if let Carrier::Free { block } = carrier {
                self.still[node] = still[node];
                self.out[*block as usize] = still[node];
            }
        }
        let out = &self.out;
        self.cholesky.leave_out(|block| out[block]);
    }

    /// Makes the terms of all nodes count again.
    pub fn free_all(&mut self) {
        self.still.fill(false);
    }

    /// Whether a term of these nodes is left out, because all of them stay where they are.
    pub fn skips(&self, nodes: &[usize]) -> bool {
        nodes.iter().all(|node| self.still[*node])
    }

    /// A pair of nodes for [`System::couple`].
    pub fn pair(&self, nodes: [u32; 2]) -> Pair {
        let slot = match nodes.map(|node| self.carriers[node as usize]) {
            [Carrier::Free { block: i }, Carrier::Free { block: j }] => Some(self.slot(i, j)),
            _ => None,
        };
        Pair { nodes, slot }
    }

    /// Where the matrix has two blocks of unknowns that elements or a pad couple.
    #[inline]
    fn slot(&self, i: u32, j: u32) -> Slot {
        self.matrix.slot(i as usize, j as usize).expect("these blocks of unknowns are coupled")
    }

    /// What carries a node.
    pub fn carrier(&self, node: usize) -> Carrier {
        self.carriers[node]
    }

    /// Begins a system in a configuration: nothing is added yet. Where grippers move nodes in the next step
    /// ([`System::moved`]), this adds to the gradient of their neighbors.
    pub fn begin(&mut self, now: &Configuration, parts: Parts) {
        self.parts = parts;
        if self.wants_matrix() {
            self.matrix.clear();
        }
        self.gradient.fill([0.0; 3]);
        self.block_gradient.clear();
        self.pulled.fill([0.0; 3]);
        self.moves = self.moved.iter().any(|moved| *moved != [0.0; 3]);
        for (node, carrier) in self.carriers.iter().enumerate() {
            if let Carrier::Pad { gripper, .. } = carrier {
                self.arms[node] = sub(now.x[node], now.pads[*gripper as usize].position);
            }
        }
    }

    /// Whether second derivatives are asked for, or the gradient alone.
    pub fn wants_matrix(&self) -> bool {
        self.parts == Parts::All
    }

    /// Adds the second derivative `k` of an energy to two different nodes (N/m); the block of the second and the first
    /// is its transpose.
    pub fn couple(&mut self, pair: Pair, k: &Matrix3) {
        debug_assert!(self.wants_matrix(), "terms that couple nodes ask first");
        // two free nodes are unknowns themselves
        if let Some(slot) = pair.slot {
            self.matrix.add(slot, k);
            return;
        }
        let [a, b] = pair.nodes.map(|node| node as usize);
        // nodes that grippers move in this step pull at the others: k times the move goes to the right-hand side
        if self.moves {
            let (forth, back) = (times(k, self.moved[b]), transposed_times(k, self.moved[a]));
            add(&mut self.pulled[a], 1.0, forth);
            add(&mut self.pulled[b], 1.0, back);
        }
        // a node on a pad moves by p + θ × r, so its block is that of the shift, and with the skew arm that of the turn
        for (side, i) in self.carriers[a].blocks().into_iter().enumerate() {
            for (other, j) in self.carriers[b].blocks().into_iter().enumerate() {
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
                    let slot = self.slot(i, j);
                    self.matrix.add(slot, &block);
                }
            }
        }
    }

    /// Adds to two different nodes, as [`System::couple`], `s` times the identity.
    pub fn couple_scalar(&mut self, pair: Pair, s: f64) {
        debug_assert!(self.wants_matrix(), "terms that couple nodes ask first");
        match pair.slot {
            Some(slot) => self.matrix.add_scalar(slot, s),
            None => self.couple(pair, &scaled(s, &IDENTITY)),
        }
    }

    /// Adds the second derivative `k` of an energy to one node (N/m).
    pub fn stiffen(&mut self, node: usize, k: &Matrix3) {
        if !self.wants_matrix() {
            return;
        }
        let carrier = self.carriers[node];
        if let Carrier::Free { block } = carrier {
            self.matrix.add_diagonal(block as usize, k);
            return;
        }
        if self.moves {
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
                let slot = self.slot(turn, shift);
                self.matrix.add(slot, &turned);
            }
        }
    }

    /// Adds to one node, as [`System::stiffen`], `s` times the identity.
    pub fn stiffen_scalar(&mut self, node: usize, s: f64) {
        self.stiffen(node, &scaled(s, &IDENTITY));
    }

    /// Adds gradient and second derivative of an energy to a block of unknowns itself: to a pad's turn (N·m) or shift (N).
    pub fn add_to_block(&mut self, block: u32, gradient: [f64; 3], k: &Matrix3) {
        self.block_gradient.push((block, gradient));
        if self.wants_matrix() {
            self.matrix.add_diagonal(block as usize, k);
        }
    }

    /// Ends the assembly: the gradient at nodes becomes that of the unknowns. How the forces on a pad act on its turn by their
    /// arms is added here, the whole second derivative or its positive part.
    pub fn end(&mut self, stiffness: Stiffness) {
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
                        if self.parts == Parts::All {
                            self.matrix.add_diagonal(turn as usize, &lever(force, arm, stiffness));
                        }
                    }
                    if let Some(shift) = shift {
                        add_at(&mut self.right, shift, g);
                    }
                }
            }
        }
        for (block, g) in &self.block_gradient {
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
    pub fn factorize(&mut self) -> Result<(), Error> {
        self.cholesky.factorize(&self.matrix)
    }

    /// Solves for Newton's step of all nodes and pads with the matrix that was factorized last.
    pub fn solve(&mut self) {
        self.solution.copy_from_slice(&self.right);
        self.cholesky.solve(&mut self.solution).expect("a matrix is factorized");
        self.spread();
    }

    /// Spreads Newton's step of the unknowns to the nodes and pads that they carry.
    fn spread(&mut self) {
        for node in 0..self.carriers.len() {
            self.step[node] = match self.carriers[node] {
                Carrier::Free { block } => self.block_step(block),
                Carrier::Held { .. } => self.moved[node],
                Carrier::Pad { gripper, turn, shift } => {
                    let shift = shift.map_or([0.0; 3], |shift| self.block_step(shift));
                    let moved = along(self.moved[node], 1.0, shift);
                    // the arms of a pad without a joint have swung with the frame, its middle has not
                    let (turn, middle) = match turn {
                        Some(turn) => (self.block_step(turn), moved),
                        None => ([0.0; 3], shift),
                    };
                    self.pad_steps[gripper as usize] = PadStep { turn, shift: middle };
                    sub(moved, cross(self.arms[node], turn))
                }
            };
        }
    }

    /// Newton's step of a block of unknowns.
    fn block_step(&self, block: u32) -> [f64; 3] {
        [0, 1, 2].map(|n| self.solution[3 * block as usize + n])
    }

    /// Whether a block of a node's carrier is a pad's turn.
    fn turns(&self, node: usize, which: usize) -> bool {
        which == 0 && matches!(self.carriers[node], Carrier::Pad { .. })
    }
}

const ZERO: Matrix3 = [[0.0; 3]; 3];

/// Second derivative of the work of a force −g on an arm a over the turn of the arm: ½ (g aᵀ + a gᵀ) − (g·a) I. Its
/// positive part is that of a force that pulls along the arm.
fn lever(g: [f64; 3], arm: [f64; 3], stiffness: Stiffness) -> Matrix3 {
    let (reach, square) = (-dot(g, arm), dot(arm, arm));
    let pulls = reach > 0.0 && square > 0.0;
    let mut whole = plus(&scaled(0.5, &outer(g, arm)), 0.5, &outer(arm, g));
    let mut positive = if pulls { scaled(-reach / square, &outer(arm, arm)) } else { ZERO };
    for n in 0..3 {
        whole[n][n] += reach;
        positive[n][n] += if pulls { reach } else { 0.0 };
    }
    plus(&scaled(1.0 - stiffness.negative(), &positive), stiffness.negative(), &whole)
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

/// What tests of derivatives look at.
#[cfg(test)]
impl System {
    /// The gradient to all unknowns.
    pub fn gradient_of_unknowns(&self) -> Vec<f64> {
        self.right.iter().map(|pull| -pull).collect()
    }

    /// The matrix times a direction of all unknowns.
    pub fn multiply(&self, direction: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; direction.len()];
        self.matrix.multiply(direction, &mut product).expect("three entries per block");
        product
    }

    /// Makes a direction of all unknowns the linear step.
    pub fn go_along(&mut self, direction: &[f64]) {
        self.solution.copy_from_slice(direction);
        self.spread();
    }

    /// Whether the matrix has no negative eigenvalue beyond rounding, as a share of its largest entry on the diagonal.
    pub fn is_positive(&mut self, rounding: f64) -> bool {
        let blocks = self.out.len();
        let unit = |n: usize| (0..3 * blocks).map(|k| f64::from(k == n)).collect::<Vec<f64>>();
        let diagonal = (0..3 * blocks).map(|n| self.multiply(&unit(n))[n]);
        let shift = rounding * diagonal.fold(f64::MIN_POSITIVE, f64::max);
        let shift = scaled(shift, &IDENTITY);
        (0..blocks).for_each(|block| self.matrix.add_diagonal(block, &shift));
        self.factorize().is_ok()
    }
}
