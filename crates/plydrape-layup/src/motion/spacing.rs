//! Distances of the knots: as far as the grippers move, farther where the path bends.
//!
//! At a steady ṡ = v velocity, acceleration and jerk are v p', v² p'' and v³ p'''; their control points
//! bound them. A span in which they are shares of their bounds must be longer by
//! `ρ = max(|p'|, (|v² p''|/a_max)^½, (|v³ p'''|/j_max)^⅓)`. So every
//! spacing is multiplied by a power of its ρ, again and again, and the best seen is kept: a sharp bend is
//! slow where it is, and not elsewhere. Spacings are smoothed, less and less from round to round; without smoothing
//! they end as a zigzag in which every span reaches a bound and none is short. This is not in the paper.

use super::Bounds;
use super::path::{Polygon, Vector};
use super::tuning::TUNING;
use crate::geometry::vector::{distance, norm};

/// Distances of the knots (m) such that a steady motion with ṡ = `cruise.speed` keeps to the bounds `cruise`.
///
/// For two planned steps or more, of which none repeats the one before.
pub(super) fn spacing(planned: &[&[Vector]], cruise: &Bounds) -> Vec<f64> {
    let mut spacing: Vec<f64> = planned.windows(2).map(|step| farthest(step[0], step[1])).collect();
    for k in 1..spacing.len() {
        spacing[k] = spacing[k].max(spacing[k - 1] / TUNING.growth);
    }
    for k in (1..spacing.len()).rev() {
        spacing[k - 1] = spacing[k - 1].max(spacing[k] / TUNING.growth);
    }

    let mut best = spacing.clone();
    let mut shortest = f64::INFINITY;
    for round in 0..TUNING.rounds {
        let factors = factors(planned, &spacing, cruise);
        // Longer by its worst factor, the whole path keeps the bounds.
        let worst = factors.iter().copied().fold(0.0, f64::max);
        let length = worst * spacing.iter().sum::<f64>();
        if length < shortest {
            shortest = length;
            best = spacing.iter().map(|h| h * worst).collect();
        }
        for (h, factor) in spacing.iter_mut().zip(factors) {
            *h *= factor.clamp(TUNING.change[0], TUNING.change[1]).powf(TUNING.damping);
        }
        let left = 1.0 - round as f64 / TUNING.rounds as f64;
        for _ in 0..TUNING.passes {
            smooth(&mut spacing, TUNING.smoothing * left.powi(3));
        }
    }
    best
}

/// Largest distance that a gripper moves from one step to another (m).
pub fn farthest(from: &[Vector], to: &[Vector]) -> f64 {
    from.iter().zip(to).map(|(a, b)| distance(*a, *b)).fold(0.0, f64::max)
}

/// The factor ρ by which every span would have to grow to keep the bounds.
fn factors(planned: &[&[Vector]], spacing: &[f64], cruise: &Bounds) -> Vec<f64> {
    let grippers = planned[0].len();
    let speed = cruise.speed;
    let largest = |points: Vec<Vector>, factor: &dyn Fn(f64) -> f64| -> Vec<f64> {
        let worst = |row: &[Vector]| row.iter().map(|x| norm(*x)).fold(0.0, f64::max);
        points.chunks_exact(grippers).map(|row| factor(worst(row))).collect()
    };
    let [first, second, third] = Polygon::new(planned, spacing).derivatives();
    let first = largest(first, &|d| d);
    let second = largest(second, &|e| (e * speed.powi(2) / cruise.acceleration).sqrt());
    let third = largest(third, &|f| (f * speed.powi(3) / cruise.jerk).cbrt());
    // The span divides three control points of p', two of p'' and one of p'''.
    let factor = |k: usize| {
        let points = first[k..].iter().take(3).chain(second[k..].iter().take(2));
        points.copied().fold(third[k], f64::max)
    };
    (0..spacing.len()).map(factor).collect()
}

/// Draws every value a share of the way to the mean of its neighbors.
fn smooth(values: &mut [f64], share: f64) {
    let Some(mut before) = values.first().copied() else { return };
    for k in 0..values.len() {
        let own = values[k];
        let after = values.get(k + 1).copied().unwrap_or(own);
        values[k] += share * (0.5 * (before + after) - own);
        before = own;
    }
}
