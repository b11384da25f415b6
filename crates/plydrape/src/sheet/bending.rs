//! Bending along each line: ½ D′ · width · |κ|² over half the spacing to each side, κ the second difference of three
//! neighbouring nodes. It is quadratic, so that its second derivative is constant.

use super::fabric::Bend;
use super::system::{Pair, System, add};

/// Bending of all lines.
#[derive(Debug)]
pub struct Bending {
    bends: Vec<Element>,
}

#[derive(Debug)]
struct Element {
    nodes: [usize; 3],
    pairs: [Pair; 3],
    /// κ = Σ weight · x (1/m²).
    weights: [f64; 3],
    /// D′ · width · length (N·m³).
    stiffness: f64,
}

/// Weights of the second difference over uneven spacings (1/m²).
pub fn weights([before, after]: [f64; 2]) -> [f64; 3] {
    let sum = before + after;
    let (first, last) = (2.0 / (before * sum), 2.0 / (after * sum));
    [first, -(first + last), last]
}

impl Bending {
    /// Of lines with a flexural rigidity per width D′ along u and v (N·m).
    pub fn new(bends: &[Bend], rigidity: [f64; 2], system: &System) -> Self {
        let element = |b: &Bend| {
            let [i, j, k] = b.nodes;
            Element {
                nodes: b.nodes.map(|node| node as usize),
                pairs: [[i, j], [j, k], [i, k]].map(|nodes| system.pair(nodes)),
                weights: weights(b.spacing),
                stiffness: rigidity[b.direction] * b.width * 0.5 * (b.spacing[0] + b.spacing[1]),
            }
        };
        Bending { bends: bends.iter().map(element).collect() }
    }

    /// Energy (J).
    pub fn energy(&self, x: &[[f64; 3]]) -> f64 {
        let one =
            |e: &Element| 0.5 * e.stiffness * e.curvature(x).iter().map(|c| c * c).sum::<f64>();
        self.bends.iter().map(one).sum()
    }

    /// Adds gradient and second derivative.
    pub fn add(&self, x: &[[f64; 3]], system: &mut System) {
        for e in &self.bends {
            if system.skips(&e.nodes) {
                continue;
            }
            let curvature = e.curvature(x);
            for (node, weight) in e.nodes.into_iter().zip(e.weights) {
                add(&mut system.gradient[node], e.stiffness * weight, curvature);
                system.stiffen_scalar(node, e.stiffness * weight * weight);
            }
            let [a, b, c] = e.weights;
            for (pair, product) in e.pairs.into_iter().zip([a * b, b * c, a * c]) {
                system.couple_scalar(pair, e.stiffness * product);
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
}
