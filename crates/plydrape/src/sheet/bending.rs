//! Bending along each line: W(|κ|) · width over half the spacing to each side, κ the second difference of three
//! neighboring nodes and W the integral of the moment, eq. (19d) of `docs/theory/sheet.md`.
//!
//! Where the moment is D′ κ the energy is ½ D′ |κ|², quadratic in the positions, and its second derivative constant. Where it
//! is a measured curve, the second derivative to κ is W″ along κ and M/|κ| across: neither is negative, because the moment
//! rises. Under the lip of a cup that holds the fabric, the rigidity of the lip is added.

use super::Sheet;
use super::configuration::Configuration;
use super::energy::{Energy, Stiffness};
use super::fabric::Bend;
use super::pads::Pads;
use super::system::{Pair, System, add};
use crate::material::MomentCurve;
use crate::sheet::matrix3::{Matrix3, outer, plus, scaled};

/// Bending of all lines.
#[derive(Debug)]
pub struct Bending {
    bends: Vec<Element>,
    /// Moment over curvature along u and v, where it is no straight line.
    curves: [Option<MomentCurve>; 2],
}

#[derive(Debug)]
struct Element {
    nodes: [usize; 3],
    pairs: [Pair; 3],
    /// κ = Σ weight · x (1/m).
    weights: [f64; 3],
    direction: usize,
    /// D′ (N·m), zero where a curve has its place.
    rigidity: f64,
    /// What the lip of a cup that holds the fabric adds to it (N·m).
    lip: f64,
    /// Width · length (m²).
    area: f64,
}

/// Weights of the second difference over uneven spacings (1/m²).
pub fn weights([before, after]: [f64; 2]) -> [f64; 3] {
    let sum = before + after;
    let (first, last) = (2.0 / (before * sum), 2.0 / (after * sum));
    [first, -(first + last), last]
}

impl Bending {
    /// The bending of the lines of a sheet that is held by pads.
    pub fn new(sheet: &Sheet, pads: &Pads, system: &System) -> Self {
        let (bends, curves) = (&sheet.fabric.bends, &sheet.moment);
        let mut lips = vec![0.0; bends.len()];
        let holding = sheet.grippers.iter().zip(pads.held()).filter(|(_, nodes)| !nodes.is_empty());
        for (bend, rigidity) in holding.flat_map(|(gripper, _)| &gripper.lip.bends) {
            lips[*bend] += rigidity;
        }
        let element = |(b, lip): (&Bend, f64)| {
            let [i, j, k] = b.nodes;
            Element {
                nodes: b.nodes.map(|node| node as usize),
                pairs: [[i, j], [j, k], [i, k]].map(|nodes| system.pair(nodes)),
                weights: weights(b.spacing),
                direction: b.direction,
                rigidity: match curves[b.direction] {
                    None => sheet.rigidity[b.direction],
                    Some(_) => 0.0,
                },
                lip,
                area: b.width * 0.5 * (b.spacing[0] + b.spacing[1]),
            }
        };
        Bending { bends: bends.iter().zip(lips).map(element).collect(), curves: curves.clone() }
    }
}

impl Energy for Bending {
    fn value(&self, now: &Configuration) -> f64 {
        let energy = |e: &Element| {
            let squared = e.curvature(&now.x).iter().map(|c| c * c).sum::<f64>();
            let quadratic = 0.5 * (e.rigidity + e.lip) * e.area * squared;
            match &self.curves[e.direction] {
                None => quadratic,
                Some(curve) => quadratic + curve.bend(squared.sqrt())[0] * e.area,
            }
        };
        self.bends.iter().map(energy).sum()
    }

    /// The stiffness is positive as it is.
    fn linearize(&self, now: &Configuration, _: Stiffness, system: &mut System) {
        for e in &self.bends {
            if system.skips(&e.nodes) {
                continue;
            }
            let curvature = e.curvature(&now.x);
            match &self.curves[e.direction] {
                None => e.add((e.rigidity + e.lip) * e.area, None, curvature, system),
                Some(curve) => {
                    let size = curvature.iter().map(|c| c * c).sum::<f64>().sqrt();
                    let [_, moment, slope] = curve.bend(size);
                    if size > 0.0 {
                        let (secant, unit) = (moment / size, curvature.map(|c| c / size));
                        let softer = scaled((slope - secant) * e.area, &outer(unit, unit));
                        e.add((secant + e.lip) * e.area, Some(&softer), curvature, system);
                    } else {
                        e.add((slope + e.lip) * e.area, None, curvature, system);
                    }
                }
            }
        }
    }
}

impl Element {
    fn curvature(&self, x: &[[f64; 3]]) -> [f64; 3] {
        let [a, b, c] = self.nodes.map(|node| x[node]);
        let [p, q, r] = self.weights;
        [0, 1, 2].map(|n| p * a[n] + q * b[n] + r * c[n])
    }

    /// Adds the gradient `stiffness` · κ and the second derivative `stiffness` · I + `more` to κ (N·m³).
    fn add(
        &self,
        stiffness: f64,
        more: Option<&Matrix3>,
        curvature: [f64; 3],
        system: &mut System,
    ) {
        // κ is linear in the three nodes, so the chain rule multiplies by their weights
        let [a, b, c] = self.weights;
        for (node, weight) in self.nodes.into_iter().zip(self.weights) {
            add(&mut system.gradient[node], stiffness * weight, curvature);
        }
        if !system.wants_matrix() {
            return;
        }
        // a stiffness that is a multiple of the identity couples coordinates with themselves alone
        let couplings = self.pairs.into_iter().zip([a * b, b * c, a * c]);
        let Some(more) = more else {
            for (node, weight) in self.nodes.into_iter().zip(self.weights) {
                system.stiffen_scalar(node, stiffness * weight * weight);
            }
            for (pair, product) in couplings {
                system.couple_scalar(pair, stiffness * product);
            }
            return;
        };
        let whole = plus(more, stiffness, &crate::sheet::matrix3::IDENTITY);
        for (node, weight) in self.nodes.into_iter().zip(self.weights) {
            system.stiffen(node, &scaled(weight * weight, &whole));
        }
        for (pair, product) in couplings {
            system.couple(pair, &scaled(product, &whole));
        }
    }
}
