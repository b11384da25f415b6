//! Shear of the cells: area · ∫ τ dγ, sin γ = ê_u · ê_v with e_u and e_v the cell's two mid-lines.
//!
//! With θ = 90° − γ the angle between the mid-lines and n their common normal, a turn of them out of the cell's plane by
//! (α, β) changes γ by −[(α² + β²) cos θ − 2 α β] / (2 sin θ): by the stress τ the second derivative has the parts
//! τ tan(θ/2) for a turn alike and −τ cot(θ/2) for an opposite one. Where the whole matrix is not positive definite with
//! all of it, only the positive parts are kept.
//!
//! Resin adds q to τ where the ply is draped in real time, q̇ = G₁ γ̇ − q/θ. Over a time step Δt, by the implicit rule of Euler,
//! q = (qⁿ + G₁ (γ − γⁿ)) / (1 + Δt/θ), which is the slope of an energy in γ, so that a time step stays a minimum.

use super::Sheet;
use super::configuration::Configuration;
use super::energy::{Energy, Stiffness};
use super::fabric::Cell;
use super::system::{Pair, System, add};
use crate::geometry::vector::{cross, dot, norm, sub};
use crate::material::ShearCurve;
use crate::sheet::matrix3::{Matrix3, outer, plus, scaled, transposed};

/// Signs of the four nodes in twice the mid-lines e_u and e_v.
const SIGNS: [[f64; 2]; 4] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
/// Sines of the shear angle beyond which a cell counts as folded flat.
const FOLDED: f64 = 0.9999;

/// Shear of all cells.
#[derive(Debug)]
pub struct Shear {
    cells: Vec<Element>,
    curve: ShearCurve,
    /// What resin adds; `None` where the ply has none, or time is no real one.
    flow: Option<Flow>,
}

/// The Maxwell elements of all cells over a time step.
#[derive(Debug)]
struct Flow {
    /// Stiffness G₁ (N/m per rad).
    stiffness: f64,
    /// Relaxation time θ (s).
    relaxation: f64,
    /// Shear angle of each cell at the beginning of the time step γⁿ (rad).
    angles: Vec<f64>,
    /// Force per length of each cell at the beginning of the time step qⁿ (N/m).
    forces: Vec<f64>,
    /// What a time step leaves of a force that is there at once, 1/(1 + Δt/θ).
    left: f64,
}

impl Flow {
    /// Energy per area (J/m²), force per length (N/m) and its slope (N/m per rad) that a cell adds at a shear angle (rad).
    fn stress(&self, cell: usize, angle: f64) -> [f64; 3] {
        let (before, more) = (self.forces[cell], angle - self.angles[cell]);
        let slope = self.left * self.stiffness;
        let force = self.left * before + slope * more;
        [(self.left * before + 0.5 * slope * more) * more, force, slope]
    }
}

#[derive(Debug)]
struct Element {
    nodes: [usize; 4],
    area: f64,
    /// Nodes 00–10, 00–01, 11–10, 11–01, 00–11 and 10–01.
    pairs: [Pair; 6],
}

/// The mid-lines of a cell and the angle between them.
struct MidLines {
    unit: [[f64; 3]; 2],
    length: [f64; 2],
    angle: f64,
    sin: f64,
    cos: f64,
}

impl MidLines {
    fn new(nodes: [[f64; 3]; 4]) -> Self {
        let [a, b, c, d] = nodes;
        let along = [0, 1, 2].map(|n| 0.5 * (b[n] + c[n] - a[n] - d[n]));
        let across = [0, 1, 2].map(|n| 0.5 * (c[n] + d[n] - a[n] - b[n]));
        let length = [norm(along), norm(across)].map(|l| l.max(f64::MIN_POSITIVE));
        let unit = [along.map(|x| x / length[0]), across.map(|x| x / length[1])];
        let sin = dot(unit[0], unit[1]).clamp(-FOLDED, FOLDED);
        MidLines { unit, length, angle: sin.asin(), sin, cos: (1.0 - sin * sin).sqrt() }
    }
}

/// Shear angle of a cell (rad) by its four nodes (m), positive where the mid-lines close.
#[must_use]
pub fn angle(nodes: [[f64; 3]; 4]) -> f64 {
    MidLines::new(nodes).angle
}

impl Shear {
    /// The shear of the cells of a sheet.
    pub fn new(sheet: &Sheet, system: &System) -> Self {
        let element = |cell: &Cell| {
            let [a, b, c, d] = cell.nodes;
            let pairs = [[a, b], [a, d], [c, b], [c, d], [a, c], [b, d]];
            Element {
                nodes: cell.nodes.map(|node| node as usize),
                area: cell.area,
                pairs: pairs.map(|nodes| system.pair(nodes)),
            }
        };
        let cells = &sheet.fabric.cells;
        let flow = sheet.shear_rate.as_ref().map(|rate| Flow {
            stiffness: rate.stiffness,
            relaxation: rate.time(),
            angles: vec![0.0; cells.len()],
            forces: vec![0.0; cells.len()],
            left: 1.0,
        });
        Shear { cells: cells.iter().map(element).collect(), curve: sheet.shear.clone(), flow }
    }

    /// Begins a time step `dt` (s) of a ply with its nodes at `x` (m); an infinite one has no time, and nothing flows in it.
    pub fn begin(&mut self, x: &[[f64; 3]], dt: f64) {
        let Some(flow) = &mut self.flow else { return };
        flow.left = 1.0 / (1.0 + dt / flow.relaxation);
        flow.see(&self.cells, x);
    }

    /// Ends a time step with the nodes at `x` (m): what resin holds there is what it begins the next one with.
    pub fn end(&mut self, x: &[[f64; 3]]) {
        let Some(flow) = &mut self.flow else { return };
        for (cell, e) in self.cells.iter().enumerate() {
            let [_, force, _] = flow.stress(cell, angle(e.nodes.map(|n| x[n])));
            flow.forces[cell] = force;
        }
        flow.left = 1.0;
        flow.see(&self.cells, x);
    }

    /// Goes on with what resin holds in the same cells with other unknowns.
    pub fn take_over(&mut self, before: Self) {
        self.flow = before.flow;
    }

    /// The longest relaxation (s), 0 where nothing flows.
    pub fn relaxation(&self) -> f64 {
        self.flow.as_ref().map_or(0.0, |flow| flow.relaxation)
    }

    /// Shear stress of a cell at a shear angle (N/m), its slope (N/m per rad).
    fn stress(&self, cell: usize, angle: f64) -> [f64; 2] {
        let (size, slope) = self.curve.force(angle);
        let stress = if angle < 0.0 { -size } else { size };
        let [_, more, steeper] =
            self.flow.as_ref().map_or([0.0; 3], |flow| flow.stress(cell, angle));
        [stress + more, slope + steeper]
    }
}

impl Flow {
    /// Takes the shear angles of cells with nodes at `x` (m) for those of the beginning.
    fn see(&mut self, cells: &[Element], x: &[[f64; 3]]) {
        for (before, e) in self.angles.iter_mut().zip(cells) {
            *before = angle(e.nodes.map(|n| x[n]));
        }
    }
}

impl Energy for Shear {
    fn value(&self, now: &Configuration) -> f64 {
        let energy = |(cell, e): (usize, &Element)| {
            let angle = angle(e.nodes.map(|n| now.x[n]));
            let flow = self.flow.as_ref().map_or(0.0, |flow| flow.stress(cell, angle)[0]);
            e.area * (self.curve.energy(angle) + flow)
        };
        self.cells.iter().enumerate().map(energy).sum()
    }

    fn linearize(&self, now: &Configuration, stiffness: Stiffness, system: &mut System) {
        for (cell, e) in self.cells.iter().enumerate() {
            if system.skips(&e.nodes) {
                continue;
            }
            let lines = MidLines::new(e.nodes.map(|n| now.x[n]));
            let [stress, slope] = self.stress(cell, lines.angle);
            let [u, v] = lines.unit;

            // ∂γ/∂e_u = (v − sin γ u) / (|e_u| cos γ), and ∂γ/∂e_v alike
            let by = [
                sub(v, u.map(|c| lines.sin * c)).map(|c| c / (lines.length[0] * lines.cos)),
                sub(u, v.map(|c| lines.sin * c)).map(|c| c / (lines.length[1] * lines.cos)),
            ];
            for (node, [along, across]) in e.nodes.into_iter().zip(SIGNS) {
                let force = e.area * stress * 0.5;
                add(&mut system.gradient[node], force * along, by[0]);
                add(&mut system.gradient[node], force * across, by[1]);
            }

            if !system.wants_matrix() {
                continue;
            }

            // turns of the mid-lines out of the plane of the cell, alike and opposite, eq. (19c)
            let normal = cross(u, v).map(|c| c / lines.cos);
            let turn = [0, 1].map(|n| normal.map(|c| c / lines.length[n]));
            // tan(θ/2) = cos γ / (1 + sin γ)
            let tangent = lines.cos / (1.0 + lines.sin);
            let [alike, opposite] =
                [stress * tangent, -stress / tangent].map(|k| stiffness.keep(k));
            let [own, mixed] = [alike + opposite, alike - opposite].map(|sum| 0.5 * e.area * sum);
            // second derivatives to the mid-lines
            let second = |i: usize, j: usize| {
                let mut k = scaled(e.area * slope, &outer(by[i], by[j]));
                k = plus(&k, if i == j { own } else { mixed }, &outer(turn[i], turn[j]));
                if i == j && stiffness.negative() > 0.0 {
                    // along a mid-line and across it: a longer one turns less
                    let both = outer(by[i], lines.unit[i].map(|c| c / lines.length[i]));
                    let stress = -e.area * stress * stiffness.negative();
                    k = plus(&plus(&k, stress, &both), stress, &transposed(&both));
                }
                k
            };
            let (uu, uv, vv) = (second(0, 0), second(0, 1), second(1, 1));
            let vu = transposed(&uv);
            // and from these to the nodes, with the signs of the nodes in the mid-lines
            let mix = |a: f64, b: f64, c: f64, d: f64| -> Matrix3 {
                [0, 1, 2].map(|i| {
                    [0, 1, 2]
                        .map(|j| 0.25 * (a * uu[i][j] + b * uv[i][j] + c * vu[i][j] + d * vv[i][j]))
                })
            };
            let rising = mix(1.0, 1.0, 1.0, 1.0);
            let falling = mix(1.0, -1.0, -1.0, 1.0);
            let side = mix(-1.0, 1.0, -1.0, 1.0);
            let minus = |k: &Matrix3| scaled(-1.0, k);
            for node in [e.nodes[0], e.nodes[2]] {
                system.stiffen(node, &rising);
            }
            for node in [e.nodes[1], e.nodes[3]] {
                system.stiffen(node, &falling);
            }
            let blocks = [side, minus(&side), minus(&side), side, minus(&rising), minus(&falling)];
            for (pair, block) in e.pairs.into_iter().zip(&blocks) {
                system.couple(pair, block);
            }
        }
    }
}
