//! The table on which the ply lies before it is lifted: ½ k · area · d² of a depth d below it, a term of eq. (19) of
//! `docs/theory/sheet.md`.
//!
//! Nothing holds the ply along the table. Once all of the ply is clear of it, the table is gone: what is below the ply from then on is
//! the mold.

use super::Sheet;
use super::configuration::Configuration;
use super::energy::{Energy, Stiffness};
use super::friction::penalty;
use super::system::System;
use super::tuning::SheetTuning;
use super::unknowns::Carrier;

/// The table under a ply.
#[derive(Debug)]
pub struct Table {
    /// Height of the table z (m).
    height: f64,
    /// Height over it at which a node is clear of it (m).
    clear: f64,
    /// Each node that may touch, with its force per depth (N/m).
    nodes: Vec<(usize, f64)>,
    /// Whether the table presses each of these nodes, when that was last looked at.
    pressed: Vec<bool>,
    /// Whether it pressed others the time before.
    pub switched: bool,
}

impl Table {
    /// The table under a sheet, with all nodes whose places are unknowns; `None` of a sheet that lies on none.
    pub fn new(sheet: &Sheet, tuning: &SheetTuning, system: &System) -> Option<Self> {
        let pressure = penalty(sheet, tuning.contact_depth);
        let nodes = sheet.fabric.areas.iter().enumerate();
        let nodes: Vec<(usize, f64)> = nodes
            .filter(|(node, _)| !matches!(system.carrier(*node), Carrier::Held { .. }))
            .map(|(node, area)| (node, pressure * area))
            .collect();
        Some(Table {
            height: sheet.table?,
            clear: tuning.release * sheet.pitch,
            pressed: vec![false; nodes.len()],
            nodes,
            switched: true,
        })
    }

    /// Looks which nodes it presses, with the nodes at `x` (m).
    pub fn find(&mut self, x: &[[f64; 3]]) {
        self.switched = false;
        for (pressed, (node, _)) in self.pressed.iter_mut().zip(&self.nodes) {
            let now = x[*node][2] < self.height;
            self.switched |= now != *pressed;
            *pressed = now;
        }
    }

    /// Whether all of the ply is clear of it, with the nodes at `x` (m).
    pub fn is_left(&self, x: &[[f64; 3]]) -> bool {
        x.iter().all(|x| x[2] > self.height + self.clear)
    }
}

impl Energy for Table {
    fn value(&self, now: &Configuration) -> f64 {
        let depth = |node: usize| (self.height - now.x[node][2]).max(0.0);
        self.nodes.iter().map(|(node, k)| 0.5 * k * depth(*node).powi(2)).sum()
    }

    fn linearize(&self, now: &Configuration, _: Stiffness, system: &mut System) {
        for ((node, k), _) in self.nodes.iter().zip(&self.pressed).filter(|(_, pressed)| **pressed)
        {
            if system.skips(&[*node]) {
                continue;
            }
            system.gradient[*node][2] += k * (now.x[*node][2] - self.height);
            system.stiffen(*node, &[[0.0; 3], [0.0; 3], [0.0, 0.0, *k]]);
        }
    }
}
