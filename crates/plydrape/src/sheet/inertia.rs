//! Inertia over a time step: Σ m/(2 Δt²) |x − x̂|², x̂ = xⁿ + Δt vⁿ, the first term of eq. (19g) of `docs/theory/sheet.md`.
//!
//! x̂ is where the nodes would go without forces. The term is quadratic, and its stiffness m/Δt² is positive.

use super::configuration::Configuration;
use super::energy::{Energy, Stiffness};
use super::system::{System, add};
use crate::geometry::vector::{dot, sub};

/// Inertia of all nodes over a time step.
#[derive(Debug)]
pub struct Inertia {
    /// Mass of each node (kg).
    masses: Vec<f64>,
    /// Where each node would go without forces x̂ (m).
    free: Vec<[f64; 3]>,
    /// The time step Δt (s).
    dt: f64,
}

impl Inertia {
    /// The inertia of nodes with their masses (kg), before the first time step.
    pub fn new(masses: &[f64]) -> Self {
        Inertia { masses: masses.to_vec(), free: vec![[0.0; 3]; masses.len()], dt: f64::INFINITY }
    }

    /// Begins a time step `dt` (s): predicts where the nodes would go without forces.
    pub fn predict(&mut self, now: &Configuration, dt: f64) {
        self.dt = dt;
        for (free, (x, v)) in self.free.iter_mut().zip(now.x.iter().zip(&now.v)) {
            *free = [0, 1, 2].map(|n| x[n] + dt * v[n]);
        }
    }

    /// Kinetic energy (J).
    pub fn kinetic_energy(&self, now: &Configuration) -> f64 {
        self.masses.iter().zip(&now.v).map(|(m, v)| 0.5 * m * dot(*v, *v)).sum()
    }
}

impl Energy for Inertia {
    fn value(&self, now: &Configuration) -> f64 {
        let nodes = self.masses.iter().zip(now.x.iter().zip(&self.free));
        let squares = nodes.map(|(m, (x, free))| {
            let off = sub(*x, *free);
            0.5 * m / (self.dt * self.dt) * dot(off, off)
        });
        squares.sum()
    }

    fn linearize(&self, now: &Configuration, _: Stiffness, system: &mut System) {
        for (node, mass) in self.masses.iter().enumerate() {
            let rate = mass / (self.dt * self.dt);
            let off = sub(now.x[node], self.free[node]);
            add(&mut system.gradient[node], rate, off);
            system.stiffen_scalar(node, rate);
        }
    }
}
