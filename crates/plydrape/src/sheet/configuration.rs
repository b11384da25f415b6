//! Where the ply is and how it moves at one moment.

use super::gripper::Pad;
use crate::geometry::vector::{norm, sub};

/// The configuration of the ply: positions, velocities and pads.
#[derive(Debug, Clone, PartialEq)]
pub struct Configuration {
    /// Positions of the nodes (m).
    pub x: Vec<[f64; 3]>,
    /// Velocities of the nodes (m/s).
    pub v: Vec<[f64; 3]>,
    /// The grippers' pads.
    pub pads: Vec<Pad>,
}

impl Configuration {
    /// The configuration at rest with nodes at `x` (m).
    pub fn at_rest(x: Vec<[f64; 3]>, pads: Vec<Pad>) -> Self {
        Configuration { v: vec![[0.0; 3]; x.len()], x, pads }
    }

    /// Copies another configuration of the same ply without allocating.
    pub fn copy_from(&mut self, other: &Configuration) {
        self.x.copy_from_slice(&other.x);
        self.v.copy_from_slice(&other.v);
        self.pads.clone_from_slice(&other.pads);
    }

    /// Sets the velocities of a time step `dt` (s) from the configuration before it: v = (x − xⁿ)/Δt.
    pub fn set_velocities(&mut self, before: &Configuration, dt: f64) {
        for (v, (x, before)) in self.v.iter_mut().zip(self.x.iter().zip(&before.x)) {
            *v = [0, 1, 2].map(|n| (x[n] - before[n]) / dt);
        }
    }

    /// Distance of each node from where it is in another configuration (m).
    pub fn movements(&self, other: &Configuration) -> impl Iterator<Item = f64> {
        self.x.iter().zip(&other.x).map(|(a, b)| norm(sub(*a, *b)))
    }
}
