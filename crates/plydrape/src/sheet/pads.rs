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
    /// The nodes on which the mount of each gripper acts that holds a point and gives, each with its share: those under its lip, or the one
    /// that it holds. Empty for other grippers.
    pub bearing: Vec<Vec<(usize, f64)>>,
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
        let bearing = |(gripper, held): (&Gripper, &HeldNodes)| match held.as_slice() {
            [(node, _)] if gripper.mount.is_some() => match gripper.lip.nodes.as_slice() {
                [] => vec![(*node, 1.0)],
                under => under.to_vec(),
            },
            _ => Vec::new(),
        };
        let bearing = sheet.grippers.iter().zip(&held).map(bearing).collect();
        Pads { sheet, held, bearing, gripped }
    }

    /// The nodes that each gripper holds; one that holds none has let go.
    pub fn held(&self) -> &[HeldNodes] {
        &self.held
    }

    /// The nodes that a gripper loads, each with its share of the load: those of a pad alike.
    pub fn shares(&self, gripper: usize) -> Vec<(usize, f64)> {
        let (held, bearing) = (&self.held[gripper], &self.bearing[gripper]);
        match bearing.as_slice() {
            [] => held.iter().map(|(node, _)| (*node, 1.0 / held.len() as f64)).collect(),
            bearing => bearing.to_vec(),
        }
    }

    /// Grippers and the nodes that they hold.
    fn each(&self) -> impl Iterator<Item = (&Gripper, &HeldNodes)> {
        self.sheet.grippers.iter().zip(&self.held)
    }

    /// Lets go of the ply with the pad of a gripper; returns the nodes on which it acted.
    pub fn let_go(&mut self, gripper: usize, now: &mut Configuration) -> Vec<usize> {
        let pad = &mut now.pads[gripper];
        (pad.position, pad.slip) = (pad.target, [0.0; 3]);
        let held = self.held[gripper].drain(..).map(|(node, _)| node);
        let bearing = self.bearing[gripper].drain(..).map(|(node, _)| node);
        let nodes: Vec<usize> = held.chain(bearing).collect();
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
        // a pad is where its carrier puts it: on its target, where its mount gives, or, below, on free nodes
        for (n, (pad, nodes)) in now.pads.iter_mut().zip(&self.held).enumerate() {
            let Some((node, _)) = nodes.first() else { continue };
            match system.carrier(*node) {
                Carrier::Free { .. } => {
                    add(&mut now.x[*node], share, system.step[*node]);
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
        for (pad, nodes) in now.pads.iter_mut().zip(&self.bearing) {
            if !nodes.is_empty() {
                pad.position = mean(nodes, &now.x);
            }
        }
    }

    /// Lets fabric slide under pads that are loaded beyond their slip force.
    pub fn slide(&self, now: &mut Configuration) {
        for ((gripper, nodes), pad) in self.each().zip(&mut now.pads) {
            if nodes.is_empty() {
                continue;
            }
            if let Some(hold) = gripper.hold(pad, pad.position) {
                add(&mut pad.slip, 1.0, hold.slides);
            }
        }
    }

    /// Force of the ply on each gripper (N) by the gradient of the ply's energy at the nodes (N); zero on one that has let go.
    pub fn forces(&self, now: &Configuration, gradient: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let force = |(n, (gripper, nodes)): (usize, (&Gripper, &HeldNodes))| {
            let bearing = &self.bearing[n];
            let middle = (!bearing.is_empty()).then(|| mean(bearing, &now.x));
            // fabric on a spring is in balance with it
            match middle.and_then(|middle| gripper.hold(&now.pads[n], middle)) {
                Some(hold) => hold.force,
                None => nodes.iter().fold([0.0; 3], |sum, (node, _)| sub(sum, gradient[*node])),
            }
        };
        self.each().enumerate().map(force).collect()
    }

    /// Whether each gripper's pad holds the ply.
    pub fn holds(&self) -> Vec<bool> {
        self.held.iter().map(|nodes| !nodes.is_empty()).collect()
    }
}

/// The mean of places (m) by the shares of nodes.
pub fn mean(shares: &[(usize, f64)], x: &[[f64; 3]]) -> [f64; 3] {
    shares.iter().fold([0.0; 3], |sum, (node, share)| along(sum, *share, x[*node]))
}
