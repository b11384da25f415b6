//! A solved strip: places, slopes, moments and forces along it.

use super::Bending;
use super::panels::{Basis, DEGREE, NODES, Panels, RULE};
use crate::catenary::Station;

/// How a strip hangs.
#[derive(Debug, Clone)]
pub struct Shape {
    panels: Panels,
    /// θ at the nodes (rad).
    angle: Vec<f64>,
    /// Horizontal force, and vertical force at the second end (N).
    force: [f64; 2],
    /// Weight per length (N/m).
    weight: f64,
    /// Length of the strip (m).
    length: f64,
    bending: Bending,
    /// Place where each panel begins, and that of the second end (m).
    corners: Vec<[f64; 2]>,
}

impl Shape {
    /// The shape of a solution on a strip of unit length and weight; `scale` is the length (m) and w L² (N·m).
    pub(super) fn new(
        panels: Panels,
        angle: Vec<f64>,
        force: [f64; 2],
        bending: &Bending,
        [length, moments]: [f64; 2],
    ) -> Shape {
        let weight = moments / (length * length);
        let force = force.map(|f| f * weight * length);
        let bending = bending.clone();
        let mut shape =
            Shape { panels, angle, force, weight, length, bending, corners: vec![[0.0; 2]] };
        for panel in 0..shape.panels.count() {
            let end = shape.place(panel, 1.0);
            shape.corners.push(end);
        }
        shape
    }

    /// Horizontal force H (N), negative in compression.
    #[must_use]
    pub fn horizontal_force(&self) -> f64 {
        self.force[0]
    }

    /// Length of the strip (m).
    #[must_use]
    pub fn length(&self) -> f64 {
        self.length
    }

    /// Angle θ at an arc length (rad).
    #[must_use]
    pub fn angle(&self, s: f64) -> f64 {
        let (panel, t) = self.panels.find(s / self.length);
        self.sum(panel, &Basis::new(t).value)
    }

    /// Curvature at an arc length (1/m).
    #[must_use]
    pub fn curvature(&self, s: f64) -> f64 {
        let (panel, t) = self.panels.find(s / self.length);
        let (_, width) = self.panels.panel(panel);
        self.sum(panel, &Basis::new(t).slope) / (width * self.length)
    }

    /// Place [x, z] at an arc length, from the first end (m).
    #[must_use]
    pub fn at(&self, s: f64) -> [f64; 2] {
        let (panel, t) = self.panels.find(s / self.length);
        self.place(panel, t)
    }

    /// Places [x, z] at equal arc lengths from end to end (m): the corners of this many straight pieces. In one
    /// pass and by Simpson's rule, so it is for many pieces; [`Self::at`] is as exact as the solution.
    #[must_use]
    pub fn polyline(&self, pieces: usize) -> Vec<[f64; 2]> {
        // Simpson's rule from corner to corner
        let h = self.length / pieces as f64;
        let mut corners = vec![[0.0; 2]];
        let (mut from, mut place) = (self.angle(0.0).sin_cos(), [0.0; 2]);
        for n in 0..pieces {
            let middle = self.angle((n as f64 + 0.5) * h).sin_cos();
            let to = self.angle((n as f64 + 1.0) * h).sin_cos();
            place[0] += h / 6.0 * (from.1 + 4.0 * middle.1 + to.1);
            place[1] += h / 6.0 * (from.0 + 4.0 * middle.0 + to.0);
            corners.push(place);
            from = to;
        }
        corners
    }

    /// Everything at an arc length.
    #[must_use]
    pub fn station(&self, s: f64) -> Station {
        let [x, z] = self.at(s);
        Station {
            x,
            z,
            slope: self.angle(s).tan(),
            moment: self.bending.bend(self.curvature(s))[0],
            vertical_force: self.force[1] - self.weight * (self.length - s),
        }
    }

    /// Whether x grows all along the strip, so that it has one height at each place.
    #[must_use]
    pub fn is_graph(&self) -> bool {
        self.angle.iter().all(|angle| angle.abs() < std::f64::consts::FRAC_PI_2)
    }

    /// Arc length where the strip is at a horizontal distance `x` from its first end (m); `None` beyond the ends, or where it
    /// has several heights there ([`Shape::is_graph`]).
    #[must_use]
    pub fn arc(&self, x: f64) -> Option<f64> {
        let run = self.corners.last()?[0];
        let rounding = 1e-9 * self.length;
        if !self.is_graph() || !(-rounding..=run + rounding).contains(&x) {
            return None;
        }
        let (mut low, mut high) = (0.0, self.length);
        let mut s = self.length * (x / run).clamp(0.0, 1.0);
        for _ in 0..100 {
            let off = self.at(s)[0] - x;
            if off > 0.0 {
                high = s
            } else {
                low = s
            }
            let step = off / self.angle(s).cos();
            if step.abs() < 1e-15 * self.length || high - low < 1e-15 * self.length {
                break;
            }
            let next = s - step;
            s = if next >= low && next <= high { next } else { 0.5 * (low + high) };
        }
        Some(s)
    }

    /// Largest vertical distance below the chord, and at which arc length (m).
    #[must_use]
    pub fn sag(&self) -> (f64, f64) {
        let [run, rise] = *self.corners.last().unwrap_or(&[0.0; 2]);
        let slope = if run == 0.0 { 0.0 } else { rise / run };
        let depth = |s: f64| {
            let [x, z] = self.at(s);
            slope * x - z
        };
        // the deepest of many places, then golden sections around it
        let parts = 8 * self.panels.count();
        let h = self.length / parts as f64;
        let mut best = (0.0, 0.0);
        for n in 0..=parts {
            let s = h * n as f64;
            if depth(s) > best.0 {
                best = (depth(s), s);
            }
        }
        let (mut low, mut high) = ((best.1 - h).max(0.0), (best.1 + h).min(self.length));
        const GOLDEN: f64 = 0.618_033_988_749_895;
        while high - low > 1e-9 * self.length {
            let (a, b) = (high - GOLDEN * (high - low), low + GOLDEN * (high - low));
            if depth(a) > depth(b) { high = b } else { low = a }
        }
        let s = 0.5 * (low + high);
        if depth(s) > best.0 { (depth(s), s) } else { best }
    }

    fn sum(&self, panel: usize, values: &[f64; NODES]) -> f64 {
        let angles = &self.angle[DEGREE * panel..];
        values.iter().zip(angles).map(|(v, angle)| v * angle).sum()
    }

    /// Place in a panel: its beginning and the integral of the direction.
    fn place(&self, panel: usize, t: f64) -> [f64; 2] {
        let (_, width) = self.panels.panel(panel);
        let [mut x, mut z] = self.corners[panel];
        for (place, weight) in RULE.place.iter().zip(&RULE.weight) {
            let (sin, cos) = self.sum(panel, &Basis::new(t * place).value).sin_cos();
            let step = weight * t * width * self.length;
            x += step * cos;
            z += step * sin;
        }
        [x, z]
    }
}
