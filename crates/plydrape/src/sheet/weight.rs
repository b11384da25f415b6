//! Weight: Σ m g z over the nodes, a term of eq. (19) of `docs/theory/sheet.md`. It has no stiffness.

use super::configuration::Configuration;
use super::energy::{Energy, Stiffness};
use super::system::System;

/// Weight of all nodes.
#[derive(Debug)]
pub struct Weight {
    /// Mass of each node (kg).
    masses: Vec<f64>,
    /// Acceleration of gravity g (m/s²).
    gravity: f64,
}

impl Weight {
    /// The weight of nodes with their masses (kg) under gravity (m/s²).
    pub fn new(masses: Vec<f64>, gravity: f64) -> Self {
        Weight { masses, gravity }
    }

    /// Mass of a node (kg).
    pub fn mass(&self, node: usize) -> f64 {
        self.masses[node]
    }
}

impl Energy for Weight {
    fn value(&self, now: &Configuration) -> f64 {
        self.masses.iter().zip(&now.x).map(|(m, x)| m * self.gravity * x[2]).sum()
    }

    fn linearize(&self, _: &Configuration, _: Stiffness, system: &mut System) {
        for (gradient, mass) in system.gradient.iter_mut().zip(&self.masses) {
            gradient[2] += mass * self.gravity;
        }
    }
}
