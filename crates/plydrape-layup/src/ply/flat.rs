//! How the flat ply is turned that comes nearest to places of its grippers.

use super::Ply;
use crate::geometry::vector::{along, cross, dot, sub, unit};

impl Ply {
    /// Unit vectors of u, v and the normal of the flat ply whose grippers come nearest to places (m).
    #[must_use]
    pub fn flat_axes(&self, at: &[[f64; 3]]) -> [[f64; 3]; 3] {
        let held: Vec<[f64; 2]> = (0..at.len()).map(|n| self.place(n)).collect();
        flat_axes(&held, at)
    }
}

/// As [`Ply::flat_axes`], of grippers at fabric coordinates (m).
#[must_use]
pub fn flat_axes(held: &[[f64; 2]], at: &[[f64; 3]]) -> [[f64; 3]; 3] {
    let count = at.len() as f64;
    let middle = [0, 1, 2].map(|n| at.iter().map(|p| p[n]).sum::<f64>() / count);
    let origin = [0, 1].map(|n| held.iter().map(|place| place[n]).sum::<f64>() / count);
    // the directions of u and v in space, by least squares
    let [u, v] = [0, 1].map(|n| {
        let pairs = held.iter().zip(at);
        let add = |sum, (place, p): (&[f64; 2], &[f64; 3])| {
            along(sum, place[n] - origin[n], sub(*p, middle))
        };
        unit(pairs.fold([0.0; 3], add))
    });
    let u = u.unwrap_or([1.0, 0.0, 0.0]);
    let aside = unit(cross([0.0, 0.0, 1.0], u)).unwrap_or([0.0, 1.0, 0.0]);
    let v = v.filter(|v| dot(*v, u).abs() < 0.999).unwrap_or(aside);
    // turned alike from both to a right angle
    let sum = unit([0, 1, 2].map(|n| u[n] + v[n])).unwrap_or(u);
    let off = unit(sub(u, v)).unwrap_or(aside);
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let u = [0, 1, 2].map(|n| half * (sum[n] + off[n]));
    let v = [0, 1, 2].map(|n| half * (sum[n] - off[n]));
    [u, v, cross(u, v)]
}
