//! Height over the mold, split into ridges and bridges.
//!
//! Along each line of fabric, the nodes that are clear of the mold lie between two that touch. Where the fabric between
//! those is longer than the way along the mold, the excess length forms a *ridge*; where it is shorter, the fabric
//! is taut over a hollow, a *bridge*. A node on two such lines counts for the one with the larger difference of its length.

use super::fabric::Fabric;
use crate::geometry::vector::distance;
use crate::mold::Mold;

/// What holds a node over the mold.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Raised {
    /// Excess length.
    Ridge,
    /// Fabric that is too short for a hollow.
    Bridge,
}

/// What holds each node that is more than `clear` (m) over the mold; `None` for nodes that touch, are off to the side of the
/// mold, or are raised only on lines with a free end.
#[must_use]
pub fn raised(fabric: &Fabric, mold: &Mold, x: &[[f64; 3]], clear: f64) -> Vec<Option<Raised>> {
    let closest: Vec<_> = x.iter().map(|p| mold.closest_point(*p)).collect();
    let lifted = |node: usize| closest[node].distance > clear;
    // excess of length as a share of it
    let mut excess: Vec<Option<f64>> = vec![None; x.len()];
    for chain in fabric.chains() {
        let mut first = 0;
        while first < chain.len() {
            if !lifted(chain[first]) {
                first += 1;
                continue;
            }
            let mut last = first;
            while last + 1 < chain.len() && lifted(chain[last + 1]) {
                last += 1;
            }
            // between two nodes that touch, the length of the fabric is compared with its way over the mold
            if first > 0 && last + 1 < chain.len() {
                let run = &chain[first - 1..=last + 1];
                let (mut length, mut way) = (0.0, 0.0);
                for pair in run.windows(2) {
                    let flat = flat_distance(fabric.places[pair[0]], fabric.places[pair[1]]);
                    length += fabric.length_factor * flat;
                    way += distance(closest[pair[0]].point, closest[pair[1]].point);
                }
                // a node on two lines belongs to the one that is farther from fitting
                let share = (length - way) / length;
                for node in &chain[first..=last] {
                    if excess[*node].is_none_or(|before| share.abs() > before.abs()) {
                        excess[*node] = Some(share);
                    }
                }
            }
            first = last + 1;
        }
    }
    // too long, and the fabric is a ridge; too short, and it bridges a hollow
    let kind = |excess: f64| if excess >= 0.0 { Raised::Ridge } else { Raised::Bridge };
    excess
        .into_iter()
        .zip(&closest)
        .map(|(excess, closest)| excess.map(kind).filter(|_| !closest.beyond))
        .collect()
}

fn flat_distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}
