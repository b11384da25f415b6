//! Stretch of the yarns: ∫ T(ε) dε · l₀ · width of each segment, ε = l/l₀ − 1.
//!
//! In the second derivative the tension that turns a segment, T/l (I − n nᵀ), is the one that the linear step before
//! predicts, and not that of the segment's present length: a step of an all but inextensible line is wrong in length by
//! the square of its turn, and the false tension of that error would freeze the iteration. Compression turns nothing where
//! the whole matrix would not be positive definite with it.

use super::configuration::Configuration;
use super::energy::{Energy, Stiffness};
use super::fabric::Segment;
use super::system::{Pair, System, add};
use crate::geometry::vector::{cross, dot, norm, sub};
use crate::material::TensionLaw;
use crate::sheet::matrix3::{Matrix3, outer};

/// The stretch of all segments.
#[derive(Debug)]
pub struct Stretch {
    segments: Vec<Segment>,
    pairs: Vec<Pair>,
    law: TensionLaw,
    /// Tension of each segment as the last linear step predicts it (N).
    predicted: Vec<f64>,
}

impl Stretch {
    /// The stretch of segments whose pairs of nodes are in `system`.
    pub fn new(segments: &[Segment], law: TensionLaw, system: &System) -> Self {
        let pairs = segments.iter().map(|s| system.pair(s.nodes)).collect();
        Stretch { segments: segments.to_vec(), pairs, law, predicted: vec![0.0; segments.len()] }
    }

    /// Tension of a segment per width (N/m).
    pub fn tension(&self, n: usize, x: &[[f64; 3]]) -> f64 {
        self.law.tension(strain(&self.segments[n], x))[1]
    }

    /// Starts the prediction of tensions with those of the segments' lengths.
    pub fn start(&mut self, x: &[[f64; 3]]) {
        for (s, predicted) in self.segments.iter().zip(&mut self.predicted) {
            *predicted = self.law.tension(strain(s, x))[1] * s.width;
        }
    }

    /// Predicts tensions after a share of a linear step of the nodes (m) from `x`, eq. (19h).
    pub fn predict(&mut self, x: &[[f64; 3]], step: &[[f64; 3]], share: f64) {
        for (s, predicted) in self.segments.iter().zip(&mut self.predicted) {
            let [a, b] = s.nodes.map(|node| node as usize);
            let (unit, length) = direction(x[a], x[b]);
            let [_, tension, slope] = self.law.tension(length / s.length - 1.0);
            let longer = dot(unit, sub(step[b], step[a])) / s.length;
            let next = (tension + slope * longer) * s.width;
            *predicted += share * (next - *predicted);
        }
    }

    /// Largest turn of a segment (rad) in a linear step of the nodes (m) from `x`; `NaN` if a number is not finite.
    pub fn largest_turn(&self, x: &[[f64; 3]], step: &[[f64; 3]]) -> f64 {
        let mut most = 0.0_f64;
        for s in &self.segments {
            let [a, b] = s.nodes.map(|node| node as usize);
            let (unit, _) = direction(x[a], x[b]);
            let turn = norm(cross(unit, sub(step[b], step[a]))) / s.length;
            if turn > most || turn.is_nan() {
                most = turn;
            }
        }
        most
    }
}

impl Energy for Stretch {
    fn value(&self, now: &Configuration) -> f64 {
        let energy = |s: &Segment| self.law.tension(strain(s, &now.x))[0] * s.length * s.width;
        self.segments.iter().map(energy).sum()
    }

    fn linearize(&self, now: &Configuration, stiffness: Stiffness, system: &mut System) {
        for ((s, pair), predicted) in self.segments.iter().zip(&self.pairs).zip(&self.predicted) {
            let [a, b] = s.nodes.map(|node| node as usize);
            if system.skips(&[a, b]) {
                continue;
            }
            // the yarn pulls its ends together by its tension
            let (unit, length) = direction(now.x[a], now.x[b]);
            let [_, tension, slope] = self.law.tension(length / s.length - 1.0);
            add(&mut system.gradient[b], tension * s.width, unit);
            add(&mut system.gradient[a], -tension * s.width, unit);

            if !system.wants_matrix() {
                continue;
            }

            // along it the slope of the law, across it the predicted tension, eq. (19h)
            let turning = stiffness.keep(*predicted) / length;
            let stretching = slope * s.width / s.length;
            let mut k: Matrix3 =
                outer(unit, unit).map(|row| row.map(|n| (stretching - turning) * n));
            for n in 0..3 {
                k[n][n] += turning;
            }
            system.stiffen(a, &k);
            system.stiffen(b, &k);
            system.couple(*pair, &k.map(|row| row.map(|n| -n)));
        }
    }
}

/// Unit vector from one point to another and their distance (m); any unit vector of two that are one.
pub fn direction(a: [f64; 3], b: [f64; 3]) -> ([f64; 3], f64) {
    let d = sub(b, a);
    let length = dot(d, d).sqrt();
    if length > f64::MIN_POSITIVE {
        (d.map(|c| c / length), length)
    } else {
        ([1.0, 0.0, 0.0], f64::MIN_POSITIVE)
    }
}

/// Strain of a segment.
pub fn strain(s: &Segment, x: &[[f64; 3]]) -> f64 {
    let [a, b] = s.nodes.map(|node| x[node as usize]);
    direction(a, b).1 / s.length - 1.0
}
