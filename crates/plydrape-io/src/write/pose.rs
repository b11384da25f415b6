//! Where the flat ply starts: the rigid move of the fabric that best fits the first gripper positions.
//!
//! With fabric points $(u_k, v_k)$ and places $\mathbf p_k$, both from their means, the best pair of unit vectors
//! $Q = [\mathbf e_u, \mathbf e_v]$ at right angles in the sense of least squares is the polar factor of
//! $M = [\sum u_k \mathbf p_k, \sum v_k \mathbf p_k]$,
//!
//! ```text
//! Q = M S⁻¹,   S = √(MᵀM) = (MᵀM + d 1)/√(tr MᵀM + 2 d),   d = √det MᵀM
//! ```
//!
//! the root of a symmetric 2 × 2 matrix in closed form. A single strip has no v: it is laid level across.

use crate::Error;
use crate::result::ResultFile;
use plydrape::geometry::vector::{cross, dot, unit};
use plydrape::outcome::Gripper;

/// A rigid place of the flat fabric.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Pose {
    /// Place of the fabric point (0, 0) (m).
    pub origin: [f64; 3],
    /// Unit vectors along u and v, at right angles.
    pub axes: [[f64; 3]; 2],
}

impl Pose {
    /// The best fit of fabric points (m) to the places of the grippers in the first step of a result.
    ///
    /// # Errors
    /// [`Error::NotPossible`] if the result has no steps, or its grippers start on one line.
    pub fn start(
        result: &ResultFile,
        fabric: &[[f64; 2]],
        place: fn(&Gripper) -> [f64; 3],
    ) -> Result<Pose, Error> {
        let first = result.steps.first().ok_or_else(|| {
            let message = "the result has no steps, so there is no motion to write";
            Error::not_possible(message, "simulate the scene again")
        })?;
        let places: Vec<[f64; 3]> = first.grippers.iter().map(place).collect();
        Pose::fit(fabric, &places).ok_or_else(|| {
            let message = "the grippers of step 1 are on one line or in one point, so the flat ply has no place among them";
            Error::not_possible(message, "spread them in the scene and simulate it again")
        })
    }

    /// The best fit of fabric points (m) to places (m); `None` if all places are one, or on one line while the fabric is not.
    pub fn fit(fabric: &[[f64; 2]], places: &[[f64; 3]]) -> Option<Pose> {
        let share = 1.0 / places.len() as f64;
        let middle = [0, 1].map(|c| share * fabric.iter().map(|f| f[c]).sum::<f64>());
        let center = [0, 1, 2].map(|c| share * places.iter().map(|p| p[c]).sum::<f64>());
        let moment = [0, 1].map(|c| {
            [0, 1, 2].map(|n| {
                let terms = fabric.iter().zip(places);
                terms.map(|(f, p)| (f[c] - middle[c]) * (p[n] - center[n])).sum::<f64>()
            })
        });

        let strip = fabric.iter().all(|f| f[1] == middle[1]);
        let axes = if strip {
            let along = unit(moment[0])?;
            let level = unit(cross([0.0, 0.0, 1.0], along)).unwrap_or([0.0, 1.0, 0.0]);
            [along, level]
        } else {
            polar(moment)?
        };
        let origin = [0, 1, 2].map(|n| center[n] - middle[0] * axes[0][n] - middle[1] * axes[1][n]);
        Some(Pose { origin, axes })
    }

    /// Place of a fabric point (m).
    pub fn place(&self, [u, v]: [f64; 2]) -> [f64; 3] {
        [0, 1, 2].map(|n| self.origin[n] + u * self.axes[0][n] + v * self.axes[1][n])
    }

    /// A direction of the fabric in space.
    pub fn turn(&self, [u, v]: [f64; 2]) -> [f64; 3] {
        [0, 1, 2].map(|n| u * self.axes[0][n] + v * self.axes[1][n])
    }
}

/// The polar factor of two columns, if they are not parallel.
fn polar([p, q]: [[f64; 3]; 2]) -> Option<[[f64; 3]; 2]> {
    let (pp, pq, qq) = (dot(p, p), dot(p, q), dot(q, q));
    let square = pp * qq - pq * pq;
    if square.is_nan() || square <= 1e-12 * pp * qq {
        return None;
    }
    let root = square.sqrt();
    let trace = (pp + qq + 2.0 * root).sqrt();
    // S⁻¹ = [s₂₂, −s₁₂; −s₁₂, s₁₁]/det S with det S = root
    let [first, off, second] = [pp + root, pq, qq + root].map(|s| s / (trace * root));
    let mix = |a: f64, b: f64| [0, 1, 2].map(|n| a * p[n] + b * q[n]);
    Some([mix(second, -off), mix(-off, first)])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fabric() -> Vec<[f64; 2]> {
        (0..8).map(|k| [0.1 * f64::from(k % 4), 0.07 * f64::from(k / 4)]).collect()
    }

    fn misfit(pose: &Pose, fabric: &[[f64; 2]], places: &[[f64; 3]]) -> f64 {
        let distance = |(f, p): (&[f64; 2], &[f64; 3])| {
            pose.place(*f).iter().zip(p).map(|(a, b)| (a - b).powi(2)).sum::<f64>()
        };
        fabric.iter().zip(places).map(distance).sum()
    }

    /// Places that are the fabric itself, turned and moved, are met exactly.
    #[test]
    fn a_rigid_move_is_found_again() {
        let (s, c) = 0.6_f64.sin_cos();
        let axes = [[c, s * 0.8, s * 0.6], [-s, c * 0.8, c * 0.6]];
        let moved = Pose { origin: [1.0, -2.0, 0.3], axes };
        let places: Vec<_> = fabric().iter().map(|f| moved.place(*f)).collect();
        let found = Pose::fit(&fabric(), &places).unwrap();
        assert!(misfit(&found, &fabric(), &places) < 1e-24, "{found:?}");
    }

    /// No small turn or shift of the pose fits distorted places better, and its axes stay at right angles.
    #[test]
    fn no_other_rigid_place_fits_better() {
        let fabric = fabric();
        let bump = |k: usize| 0.02 * ((k * k) as f64 * 1.3).sin();
        let places: Vec<_> = (fabric.iter().enumerate())
            .map(|(k, [u, v])| [0.9 * u + 0.3 * v, 0.2 * u + v, bump(k) + 0.4 * u])
            .collect();
        let pose = Pose::fit(&fabric, &places).unwrap();
        let [u, v] = pose.axes;
        assert!(dot(u, v).abs() + (dot(u, u) - 1.0).abs() + (dot(v, v) - 1.0).abs() < 1e-12);
        let least = misfit(&pose, &fabric, &places);
        for (axis, by) in (0..6).flat_map(|axis| [(axis, 1e-3), (axis, -1e-3)]) {
            let mut other = pose;
            if axis < 3 {
                other.origin[axis] += by;
            } else {
                let mut about = [0.0; 3];
                about[axis - 3] = by;
                // turned about the mean of the places, by a finite angle
                let center = [0, 1, 2].map(|n| places.iter().map(|p| p[n]).sum::<f64>() / 8.0);
                let turn = |p: [f64; 3]| {
                    let (sin, cos) = by.sin_cos();
                    let k = about.map(|a| a / by);
                    let side = cross(k, p);
                    [0, 1, 2].map(|n| p[n] * cos + side[n] * sin + k[n] * dot(k, p) * (1.0 - cos))
                };
                let arm = turn([0, 1, 2].map(|n| pose.origin[n] - center[n]));
                other.origin = [0, 1, 2].map(|n| center[n] + arm[n]);
                other.axes = pose.axes.map(turn);
            }
            assert!(misfit(&other, &fabric, &places) > least, "{axis} {by}");
        }
    }

    /// A strip lies level across its line; places on one line hold no ply.
    #[test]
    fn a_strip_is_level_across() {
        let strip = [[0.0, 0.0], [0.1, 0.0]];
        let pose = Pose::fit(&strip, &[[0.0, 0.0, 0.2], [0.06, 0.0, 0.28]]).unwrap();
        assert_eq!(pose.axes[1], [0.0, 1.0, 0.0]);
        assert!((pose.axes[0][2] - 0.8).abs() < 1e-12);
        let line: Vec<_> = (0..8).map(|k| [0.1 * f64::from(k), 0.0, 0.0]).collect();
        assert!(Pose::fit(&fabric(), &line).is_none());
    }
}
