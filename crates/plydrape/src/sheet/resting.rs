//! Nodes that lie on the mold among others, and are no unknowns of a time step.
//!
//! Behind a front most of the ply lies on the mold and does not move. A node lies if it hardly moved in the last time steps,
//! and the mold presses it, or next to nothing is out of balance at it, or its gripper stands. It is left out if all nodes
//! that share a term of the energy with it lie too. This is decided anew in each time step, with the forces of all elements.

use super::configuration::Configuration;
use super::contact::Contact;
use super::system::System;
use super::tuning::SheetTuning;
use super::unknowns::{Carrier, coupled_pairs};
use super::weight::Weight;
use super::{Fabric, Sheet};
use crate::geometry::vector::norm;

/// Which nodes lie, and for how long they have not moved.
#[derive(Debug)]
pub struct Resting {
    /// Largest movement of a node that lies in a time step (m).
    movement: f64,
    /// Time steps for which a node has not moved more, before it lies.
    steps: u32,
    /// Force at a node that the mold does not press, per mass (m/s²).
    force: f64,
    /// Pairs of nodes that a term couples.
    pairs: Vec<[u32; 2]>,
    /// Time steps for which each node has hardly moved.
    quiet: Vec<u32>,
    /// Whether each node lies on the mold, or is held by a gripper that stands.
    lies: Vec<bool>,
    /// Whether each node is among nodes that lie.
    pub still: Vec<bool>,
    /// Whether each node moves on in the iterations of a time step, or one near by does.
    moving: Vec<bool>,
    /// Rings of nodes around one that moves, which are unknowns with it.
    rings: usize,
    /// Whether each node moved before the last ring was added; then whether it is no unknown.
    held: Vec<bool>,
}

impl Resting {
    /// The nodes of a sheet, none of which lies.
    pub fn new(sheet: &Sheet, tuning: &SheetTuning) -> Self {
        let fabric: &Fabric = &sheet.fabric;
        let nodes = fabric.places.len();
        Resting {
            movement: tuning.lying_movement * sheet.mesh,
            steps: tuning.lying_steps,
            force: sheet.gravity * tuning.lying_force,
            pairs: coupled_pairs(sheet),
            quiet: vec![0; nodes],
            lies: vec![false; nodes],
            still: vec![false; nodes],
            moving: vec![true; nodes],
            rings: tuning.moving_rings,
            held: vec![false; nodes],
        }
    }

    /// Leaves nodes out of the linear systems of a time step that lie among others on a mold that holds them; all are unknowns
    /// without such a `contact`. The system has the gradient of all terms.
    pub fn leave_out(
        &mut self,
        now: &Configuration,
        contact: Option<&Contact>,
        weight: &Weight,
        system: &mut System,
    ) {
        // nodes that lie
        self.lies.fill(false);
        if let Some(contact) = contact.filter(|contact| contact.sticks()) {
            for node in contact.lying(&now.x, &system.gradient, self.movement) {
                self.lies[node] = true;
            }
            for (node, lies) in self.lies.iter_mut().enumerate() {
                *lies |= match system.carrier(node) {
                    Carrier::Free { .. } => {
                        norm(system.gradient[node]) <= self.force * weight.mass(node)
                    }
                    _ => norm(system.moved[node]) <= self.movement,
                };
                *lies &= self.quiet[node] >= self.steps;
            }
        }

        // those of them whose neighbors lie too
        self.still.copy_from_slice(&self.lies);
        for [a, b] in self.pairs.iter().map(|pair| pair.map(|node| node as usize)) {
            self.still[a] &= self.lies[b];
            self.still[b] &= self.lies[a];
        }
        system.keep_still(&self.still);
    }

    /// Leaves nodes out of the linear systems of a time step from now on that stay where they are: those that have moved by no
    /// more than the tolerance (m) in the linear step that was taken, and whose neighbors and theirs have not either. What is
    /// out of balance there goes with the square of that step, and is seen in the next time step.
    pub fn narrow(&mut self, tolerance: f64, system: &mut System) {
        self.moving.clear();
        self.moving.extend(system.step.iter().map(|step| norm(*step) > tolerance));
        for _ in 0..self.rings {
            self.held.copy_from_slice(&self.moving);
            for [a, b] in self.pairs.iter().map(|pair| pair.map(|node| node as usize)) {
                self.moving[a] |= self.held[b];
                self.moving[b] |= self.held[a];
            }
        }
        for (held, (moving, still)) in self.held.iter_mut().zip(self.moving.iter().zip(&self.still))
        {
            *held = !moving || *still;
        }
        system.keep_still(&self.held);
    }

    /// Counts a time step: for how many of them each node has hardly moved.
    pub fn count(&mut self, now: &Configuration, before: &Configuration) {
        for (quiet, moved) in self.quiet.iter_mut().zip(now.movements(before)) {
            *quiet = if moved <= self.movement { *quiet + 1 } else { 0 };
        }
    }

    /// Takes nodes for moving that a pad has let go.
    pub fn wake(&mut self, nodes: &[usize]) {
        for node in nodes {
            self.quiet[*node] = 0;
        }
    }
}
