//! Shear of the cells: area · ∫ τ dγ, sin γ = ê_u · ê_v with e_u and e_v the cell's two mid-lines.
//!
//! With θ = 90° − γ the angle between the mid-lines and n their common normal, a turn of them out of the cell's plane by
//! (α, β) changes γ by −[(α² + β²) cos θ − 2 α β] / (2 sin θ): by the stress τ the second derivative has the parts
//! τ tan(θ/2) for a turn alike and −τ cot(θ/2) for an opposite one. Where the whole matrix is not positive definite with
//! all of it, only the positive parts are kept.

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
    fn of(nodes: [[f64; 3]; 4]) -> Self {
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
    MidLines::of(nodes).angle
}

impl Shear {
    /// The shear of cells with a shear law.
    pub fn new(cells: &[Cell], curve: ShearCurve, system: &System) -> Self {
        let element = |cell: &Cell| {
            let [a, b, c, d] = cell.nodes;
            let pairs = [[a, b], [a, d], [c, b], [c, d], [a, c], [b, d]];
            Element {
                nodes: cell.nodes.map(|node| node as usize),
                area: cell.area,
                pairs: pairs.map(|nodes| system.pair(nodes)),
            }
        };
        Shear { cells: cells.iter().map(element).collect(), curve }
    }
}

impl Energy for Shear {
    fn value(&self, now: &Configuration) -> f64 {
        let energy =
            |e: &Element| e.area * self.curve.energy(MidLines::of(e.nodes.map(|n| now.x[n])).angle);
        self.cells.iter().map(energy).sum()
    }

    fn linearize(&self, now: &Configuration, stiffness: Stiffness, system: &mut System) {
        for e in &self.cells {
            if system.skips(&e.nodes) {
                continue;
            }
            let lines = MidLines::of(e.nodes.map(|n| now.x[n]));
            let (size, slope) = self.curve.force(lines.angle);
            let stress = if lines.angle < 0.0 { -size } else { size };
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
            let [alike, opposite] = [stress * tangent, -stress / tangent].map(|k| stiffness.of(k));
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
