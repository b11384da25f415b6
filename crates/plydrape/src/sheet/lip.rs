//! The lips of vacuum cups: soft discs that bend with the fabric under them as long as the cup holds it, eq. (19d) of
//! `docs/theory/sheet.md`, and share out among it what the mount of the cup does.

use super::fabric::{Bend, Fabric};
use crate::layup::Lip;
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// Parts along each side into which the fabric of a bend is divided, to see how much of it is under a lip.
const PARTS: usize = 5;
/// Rings of equal area into which a lip is divided, to see how much of it each node bears.
const RINGS: usize = 4;
/// Points on each ring; an even number, so that each has one opposite.
const SPOKES: usize = 16;
/// Share of a lip below which a node bears nothing of it.
const ROUNDING: f64 = 1e-9;

/// The fabric under the lip of a cup.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Under {
    /// The bends under it, each with the rigidity that the lip adds (N·m): its own, times the share of the bend that is under it.
    pub bends: Vec<(usize, f64)>,
    /// The nodes on which the mount of the cup acts, each with its share; empty if it acts on the middle alone. The mean of their places in
    /// the flat is the middle of the cup.
    pub nodes: Vec<(usize, f64)>,
}

impl Under {
    /// The fabric under a lip around a place of it (m).
    #[must_use]
    pub fn new(fabric: &Fabric, lip: &Lip, place: [f64; 2]) -> Self {
        let rigidity = |(n, bend): (usize, &Bend)| {
            let at = fabric.places[bend.nodes[1] as usize];
            let share = share_under(bend, at, lip.radius, place);
            (share > 0.0).then_some((n, share * lip.rigidity))
        };
        Under {
            bends: fabric.bends.iter().enumerate().filter_map(rigidity).collect(),
            nodes: bearing_nodes(fabric, lip.radius, place),
        }
    }
}

/// The nodes that bear a lip with a radius around a place (m), each with its share. A point of the lip that hangs over the boundary bears
/// nothing, and neither does the one opposite, so that the mean of all is the middle.
fn bearing_nodes(fabric: &Fabric, radius: f64, place: [f64; 2]) -> Vec<(usize, f64)> {
    let mut shares = BTreeMap::new();
    for (ring, spoke) in (0..RINGS).flat_map(|ring| (0..SPOKES).map(move |spoke| (ring, spoke))) {
        let reach = radius * ((ring as f64 + 0.5) / RINGS as f64).sqrt();
        let point = |spoke: usize| {
            let (sin, cos) = (TAU * spoke as f64 / SPOKES as f64).sin_cos();
            fabric.point_at([place[0] + reach * cos, place[1] + reach * sin])
        };
        if let (Some(point), Some(_)) = (point(spoke), point(spoke + SPOKES / 2)) {
            for (node, weight) in point.nodes.into_iter().zip(point.weights) {
                *shares.entry(node as usize).or_insert(0.0) += weight;
            }
        }
    }
    let sum: f64 = shares.values().sum();
    let shares = shares.into_iter().map(|(node, share)| (node, share / sum));
    shares.filter(|(_, share)| *share > ROUNDING).collect()
}

/// The share of the rectangle of fabric that a bend at a place stands for which is within a radius of another place (m).
fn share_under(bend: &Bend, at: [f64; 2], radius: f64, place: [f64; 2]) -> f64 {
    let [before, after] = bend.spacing.map(|spacing| 0.5 * spacing);
    let half_width = 0.5 * bend.width;
    let (along, across) = (bend.direction, 1 - bend.direction);
    let off = [along, across].map(|n| at[n] - place[n]);
    if off[0].abs() - before.max(after) > radius || off[1].abs() - half_width > radius {
        return 0.0;
    }
    let between =
        |low: f64, high: f64, n: usize| low + (high - low) * (n as f64 + 0.5) / PARTS as f64;
    let is_under = |n: &usize| {
        let u = off[0] + between(-before, after, n % PARTS);
        let v = off[1] + between(-half_width, half_width, n / PARTS);
        u.hypot(v) <= radius
    };
    let count = PARTS * PARTS;
    (0..count).filter(is_under).count() as f64 / count as f64
}
