//! How θ(s) is written: polynomials of one degree on panels of the strip, equal where two panels meet.
//!
//! The nodes of a panel are those of Chebyshev and Lobatto; integrals over it are Gauss–Legendre sums. Panels are narrow at the
//! ends, where bending layers are, and where the flexible catenary turns much.

use super::tuning::TUNING;
use std::f64::consts::PI;
use std::sync::LazyLock;

/// Degree of the polynomials.
pub(super) const DEGREE: usize = 8;
/// Nodes of a panel.
pub(super) const NODES: usize = DEGREE + 1;
/// Gauss points of a panel.
pub(super) const POINTS: usize = 14;

/// Values of the nodes' polynomials at a place of a panel, and their derivatives by the place from 0 to 1.
#[derive(Debug, Clone, Copy)]
pub(super) struct Basis {
    pub value: [f64; NODES],
    pub slope: [f64; NODES],
}

/// Gauss points of a panel from 0 to 1.
pub(super) struct Rule {
    pub place: [f64; POINTS],
    pub weight: [f64; POINTS],
    pub basis: [Basis; POINTS],
}

/// Place of the n-th node of a panel, from 0 to 1.
fn node(n: usize) -> f64 {
    0.5 - 0.5 * (PI * n as f64 / DEGREE as f64).cos()
}

impl Basis {
    /// The values at a place from 0 to 1.
    pub fn new(t: f64) -> Basis {
        let mut basis = Basis { value: [0.0; NODES], slope: [0.0; NODES] };
        for i in 0..NODES {
            // Lagrange's product and its derivative by the product rule
            let (mut value, mut slope) = (1.0, 0.0);
            for j in (0..NODES).filter(|j| *j != i) {
                let scale = 1.0 / (node(i) - node(j));
                slope = (slope * (t - node(j)) + value) * scale;
                value *= (t - node(j)) * scale;
            }
            (basis.value[i], basis.slope[i]) = (value, slope);
        }
        basis
    }
}

/// The Gauss points, computed once.
pub(super) static RULE: LazyLock<Rule> = LazyLock::new(|| {
    let mut place = [0.0; POINTS];
    let mut weight = [0.0; POINTS];
    for n in 0..POINTS {
        // Newton's method on the Legendre polynomial from the usual first guess
        let mut x = -(PI * (n as f64 + 0.75) / (POINTS as f64 + 0.5)).cos();
        let mut slope = 1.0;
        for _ in 0..50 {
            let (mut p, mut before) = (1.0, 0.0);
            for k in 1..=POINTS {
                let k = k as f64;
                (p, before) = (((2.0 * k - 1.0) * x * p - (k - 1.0) * before) / k, p);
            }
            slope = POINTS as f64 * (x * p - before) / (x * x - 1.0);
            let step = p / slope;
            x -= step;
            if step.abs() < 1e-16 {
                break;
            }
        }
        place[n] = 0.5 + 0.5 * x;
        weight[n] = 1.0 / ((1.0 - x * x) * slope * slope);
    }
    Rule { place, weight, basis: place.map(Basis::new) }
});

/// Panels of a strip of unit length.
#[derive(Debug, Clone)]
pub(super) struct Panels {
    /// Where they begin and end, ascending from 0 to 1.
    pub cuts: Vec<f64>,
}

impl Panels {
    /// Narrow as far as a first shape turns, and as layers at both ends ask for.
    pub fn new(angle: impl Fn(f64) -> f64, layers: [f64; 2]) -> Panels {
        let mut cuts = vec![0.0];
        let mut stack = vec![(0.0, 1.0)];
        while let Some((from, to)) = stack.pop() {
            let width: f64 = to - from;
            let wide = width > TUNING.panel
                || (from == 0.0 && width > TUNING.layer * layers[0])
                || (to == 1.0 && width > TUNING.layer * layers[1])
                || (angle(to) - angle(from)).abs() > TUNING.turn;
            if wide && width > TUNING.narrowest {
                let middle = 0.5 * (from + to);
                stack.extend([(middle, to), (from, middle)]);
            } else {
                cuts.push(to);
            }
        }
        Panels { cuts }
    }

    /// Number of panels.
    pub fn count(&self) -> usize {
        self.cuts.len() - 1
    }

    /// Arc length where a panel begins, and its width.
    pub fn panel(&self, n: usize) -> (f64, f64) {
        (self.cuts[n], self.cuts[n + 1] - self.cuts[n])
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        DEGREE * self.count() + 1
    }

    /// Arc length of a node.
    pub fn place(&self, n: usize) -> f64 {
        let panel = (n / DEGREE).min(self.count() - 1);
        let (from, width) = self.panel(panel);
        from + width * node(n - DEGREE * panel)
    }

    /// The panel that holds an arc length, and the place in it from 0 to 1.
    pub fn find(&self, s: f64) -> (usize, f64) {
        let panel = self.cuts.partition_point(|cut| *cut <= s).clamp(1, self.count()) - 1;
        let (from, width) = self.panel(panel);
        (panel, (s - from) / width)
    }
}
