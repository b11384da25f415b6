//! The pads as their grippers move them: which nodes they hold, where these go, and how the ply loads them.

use super::Sheet;
use super::configuration::Configuration;
use super::gripper::Gripper;
use super::system::{System, add};
use super::unknowns::Carrier;
use crate::geometry::vector::{along, sub};
use crate::sheet::matrix3::{plus, times, transposed};

/// The nodes that a gripper holds with their distance from its middle in the fabric (m); its own point first.
pub type HeldNodes = Vec<(usize, [f64; 2])>;

/// The pads of a sheet and the nodes that they hold.
#[derive(Debug)]
pub struct Pads<'a> {
    sheet: &'a Sheet,
    /// The nodes of each gripper; empty if it has let go.
    held: Vec<HeldNodes>,
    /// Whether a gripper holds each node.
    pub gripped: Vec<bool>,
}

impl<'a> Pads<'a> {
    /// The pads of a sheet, all of which hold the ply.
    pub fn new(sheet: &'a Sheet) -> Self {
        let held = sheet.held();
        let mut gripped = vec![false; sheet.fabric.places.len()];
        for (node, _) in held.iter().flatten() {
            gripped[*node] = true;
        }
        Pads { sheet, held, gripped }
    }

    /// The nodes that each gripper holds; one that holds none has let go.
    pub fn held(&self) -> &[HeldNodes] {
        &self.held
    }

    /// Grippers and the nodes that they hold.
    fn each(&self) -> impl Iterator<Item = (&Gripper, &HeldNodes)> {
        self.sheet.grippers.iter().zip(&self.held)
    }

    /// Lets go of the ply with the pad of a gripper; returns the nodes that it held.
    pub fn let_go(&mut self, gripper: usize, now: &mut Configuration) -> Vec<usize> {
        let pad = &mut now.pads[gripper];
        (pad.position, pad.slip) = (pad.target, [0.0; 3]);
        let nodes: Vec<usize> = self.held[gripper].drain(..).map(|(node, _)| node).collect();
        for node in &nodes {
            self.gripped[*node] = false;
        }
        nodes
    }

    /// Sends the grippers to new places (m); rigid mounts, and pads without joints, move their nodes in the next linear step.
    pub fn aim(&self, targets: &[[f64; 3]], now: &mut Configuration, system: &mut System) {
        system.moved.fill([0.0; 3]);
        let tool = self.sheet.tool.as_ref();
        let stem = tool.map(|tool| tool.direction(targets));
        let fixed = tool.and_then(|tool| tool.pads(targets)).map(|axes| transposed(&axes));
        for ((pad, target), (gripper, nodes)) in now.pads.iter_mut().zip(targets).zip(self.each()) {
            let moved = sub(*target, pad.target);
            pad.target = *target;
            pad.stem = stem.unwrap_or(pad.stem);
            if nodes.is_empty() {
                pad.position = *target;
            }
            if gripper.mount.is_none() {
                for (node, _) in nodes {
                    system.moved[*node] = moved;
                }
            }
            // the arms of a pad without a joint swing with the frame
            if let Some(turn) = fixed {
                let before = std::mem::replace(&mut pad.turn, turn);
                let swings = plus(&turn, -1.0, &before);
                for (node, off) in nodes {
                    add(&mut system.moved[*node], 1.0, times(&swings, [off[0], off[1], 0.0]));
                }
            }
        }
    }

    /// Takes a share of the linear step: of the pads, which place the nodes that they hold, and of all other nodes.
    pub fn take(&self, share: f64, now: &mut Configuration, system: &System) {
        // a pad is where its carrier puts it: on its free node, on its target, or where its mount gives
        for (n, (pad, nodes)) in now.pads.iter_mut().zip(&self.held).enumerate() {
            let Some((node, _)) = nodes.first() else { continue };
            match system.carrier(*node) {
                Carrier::Free { .. } => {
                    add(&mut now.x[*node], share, system.step[*node]);
                    pad.position = now.x[*node];
                }
                Carrier::Held { .. } => {
                    now.x[*node] = pad.target;
                    pad.position = pad.target;
                }
                Carrier::Pad { turn, shift, .. } => {
                    let step = system.pad_steps[n];
                    match (turn, shift) {
                        (None, None) => pad.position = pad.target,
                        _ => add(&mut pad.position, share, step.shift),
                    }
                    if turn.is_some() {
                        pad.rotate(step.turn.map(|c| share * c));
                    }
                    // its nodes lie flat in it
                    for (node, off) in nodes {
                        now.x[*node] = along(pad.position, 1.0, pad.arm(*off));
                    }
                }
            }
        }
        // nodes that no pad grips are unknowns of their own
        for ((x, step), gripped) in now.x.iter_mut().zip(&system.step).zip(&self.gripped) {
            if !gripped {
                add(x, share, *step);
            }
        }
    }

    /// Lets fabric slide under pads that are loaded beyond their slip force.
    pub fn slide(&self, now: &mut Configuration) {
        for ((gripper, nodes), pad) in self.each().zip(&mut now.pads) {
            let place = match nodes.as_slice() {
                [] => continue,
                [(node, _)] => now.x[*node],
                _ => pad.position,
            };
            if let Some(hold) = gripper.hold(pad, place) {
                add(&mut pad.slip, 1.0, hold.slides);
            }
        }
    }

    /// Force of the ply on each gripper (N) by the gradient of the ply's energy at the nodes (N); zero on one that has let go.
    pub fn forces(&self, now: &Configuration, gradient: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let force = |((gripper, nodes), pad): ((&Gripper, &HeldNodes), _)| match nodes.as_slice() {
            // a pin on a spring is in balance with it
            [(node, _)] if gripper.mount.is_some() => {
                gripper.hold(pad, now.x[*node]).map_or([0.0; 3], |hold| hold.force)
            }
            _ => nodes.iter().fold([0.0; 3], |sum, (node, _)| sub(sum, gradient[*node])),
        };
        self.each().zip(&now.pads).map(force).collect()
    }

    /// Whether each gripper's pad holds the ply.
    pub fn holds(&self) -> Vec<bool> {
        self.held.iter().map(|nodes| !nodes.is_empty()).collect()
    }
}
