//! The lips of vacuum cups: soft discs that bend with the fabric under them as long as the cup holds it, eq. (19d) of
//! `docs/theory/sheet.md`.

use super::fabric::{Bend, Fabric};
use crate::layup::Lip;

/// Parts along each side into which the fabric of a bend is divided, to see how much of it is under a lip.
const PARTS: usize = 5;

/// The bends of a fabric under a lip around a place of it (m), each with the rigidity that the lip adds (N·m): its own, times the share of the bend
/// that is under it.
pub fn under(fabric: &Fabric, lip: &Lip, place: [f64; 2]) -> Vec<(usize, f64)> {
    let rigidity = |(n, bend): (usize, &Bend)| {
        let share = share_under(bend, fabric.places[bend.nodes[1] as usize], lip.radius, place);
        (share > 0.0).then_some((n, share * lip.rigidity))
    };
    fabric.bends.iter().enumerate().filter_map(rigidity).collect()
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
