//! The control points of the corrected path.
//!
//! Control points that are moved each as a body of its own make a path that passes between them: at a knot it is a mean of
//! three, and a mean of three turned arrays is a smaller array. So what is moved is where the path shall pass. With B the means of the spline, the
//! control points are to solve `B δ = D` for the displacements D of the steps. Richardson's iteration
//! `δ ← δ + (D − B δ)` does it, because all eigenvalues of B are in 0 … 1, and it stays local: points from the landing on
//! are not touched.

use super::tuning::TUNING;
use crate::Error;
use crate::geometry::vector::{distance, norm};
use crate::motion::TimedMotion;
use crate::pick_up::Moved;
use crate::scene::Scene;

/// The control points (m) of a path that passes each step of a motion where it is moved to. `path` are those of the motion. Points that the
/// path from step `last_free` on depends on stay as they are.
#[must_use]
pub fn corrected(
    motion: &TimedMotion,
    path: &[Vec<[f64; 3]>],
    moved: &[Moved],
    last_free: usize,
) -> Vec<Vec<[f64; 3]>> {
    // a span of the path depends on the points of its ends and on one more at either side
    let points = last_free.saturating_sub(1);
    let ways: Vec<Vec<[f64; 3]>> = motion
        .positions()
        .iter()
        .zip(moved)
        .map(|(places, moved)| places.iter().map(|p| moved.displacement(*p)).collect())
        .collect();
    let none = vec![[0.0; 3]; motion.grippers()];
    let mut shifts: Vec<Vec<[f64; 3]>> = ways
        .iter()
        .enumerate()
        .map(|(k, ways)| if k < points { ways } else { &none }.clone())
        .collect();
    let size = ways.iter().flatten().map(|way| norm(*way)).fold(0.0, f64::max);
    for _ in 0..TUNING.rounds {
        let means = motion.means(&shifts);
        let mut most: f64 = 0.0;
        // the path begins at its first point
        for k in 1..points {
            for (n, shift) in shifts[k].iter_mut().enumerate() {
                let left = [0, 1, 2].map(|c| ways[k][n][c] - means[k][n][c]);
                *shift = [0, 1, 2].map(|c| shift[c] + left[c]);
                most = most.max(norm(left));
            }
        }
        if most <= TUNING.passed * size {
            break;
        }
    }
    let add = |(places, shifts): (&Vec<[f64; 3]>, &Vec<[f64; 3]>)| {
        let place = |(p, shift): (&[f64; 3], &[f64; 3])| [0, 1, 2].map(|c| p[c] + shift[c]);
        places.iter().zip(shifts).map(place).collect()
    };
    path.iter().zip(&shifts).map(add).collect()
}

/// Refuses a motion that changes the distance of neighboring grippers in the steps up to `last_free`.
pub fn rigid(
    scene: &Scene,
    planned: &TimedMotion,
    motion: &TimedMotion,
    last_free: usize,
) -> Result<(), Error> {
    let lines = scene.layup.ply.lines();
    let mut pairs: Vec<[usize; 2]> = (0..lines.catenaries()).map(|n| lines.ends(n)).collect();
    pairs.extend((1..motion.grippers()).map(|n| [n - 1, n]));
    let (mut most, mut worst) = (0.0, 0);
    for (k, (from, to)) in planned.positions().iter().zip(motion.positions()).enumerate() {
        if k > last_free {
            break;
        }
        for [a, b] in &pairs {
            let [before, after] = [from, to].map(|places| distance(places[*a], places[*b]));
            let change = (after - before).abs() / before;
            if change > most || change.is_nan() {
                (most, worst) = (change, k);
            }
        }
    }
    match most <= TUNING.rigid {
        true => Ok(()),
        false => Err(Error::ReplanNotRigid { step: worst + 1, change: most, limit: TUNING.rigid }),
    }
}
