//! The distance of a body from the mold.
//!
//! A mold knows its distance from a point, in closed form or with its own search ([`Mold::separation`]); it has no triangles that
//! would stand for it without an error. No two points are farther apart in their distances than from each other, so a part of the
//! body's surface within a ball of radius r comes no nearer than the distance of the ball's middle less r. Parts that could hold
//! a nearer point are divided, the nearest first. Where the body is in the mold, what is found is the depth of its deepest point.
//!
//! The closest point of a height over a plane is found downhill, and is the closest of all only near the mold, nearer than its
//! smallest radius of curvature. Farther away the bound is that of [`Mold::clear`], and what is found is the distance of
//! points that are close together, as a share of their distance.

use super::solid::Apart;
use super::surface::{Patch, Surface};
use super::tuning::TUNING;
use crate::mold::{Mold, Pose, Steepness};
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// A mold and what bounds its distances.
#[derive(Debug, Clone, Copy)]
pub(super) struct OverMold<'a> {
    mold: &'a Mold,
    steepness: Steepness,
}

/// A part of a surface, and a distance (m) that none of its points falls short of.
struct Part {
    least: f64,
    patch: Patch,
    /// No smaller parts are of use.
    done: bool,
}

impl PartialEq for Part {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Part {}

impl PartialOrd for Part {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Part {
    /// The nearest is the greatest.
    fn cmp(&self, other: &Self) -> Ordering {
        other.least.total_cmp(&self.least)
    }
}

impl<'a> OverMold<'a> {
    pub fn new(mold: &'a Mold) -> Self {
        OverMold { mold, steepness: mold.steepness() }
    }

    /// How far a surface, placed by a pose, is from the mold, to `resolution` (m).
    pub fn apart(&self, surface: &Surface, pose: &Pose, resolution: f64) -> Apart {
        let mut best = Apart { distance: f64::INFINITY, place: pose.position };
        let mut parts: BinaryHeap<Part> = BinaryHeap::new();
        let see = |patch: Patch, best: &mut Apart| {
            let (middle, reach, belongs) = surface.ball(&patch);
            let middle = pose.place(middle);
            let found = self.mold.separation(middle, f64::INFINITY);
            if belongs && found.distance < best.distance {
                *best = Apart { distance: found.distance, place: middle };
            }
            let bounded = self.steepness.bend.is_finite() && !found.beyond && found.distance > 0.0;
            let clear = if bounded {
                self.mold.clear(middle, found, self.steepness)
            } else {
                found.distance
            };
            let far = clear < found.distance && reach <= TUNING.far * clear;
            let done = belongs && (far || reach <= 0.5 * resolution);
            Part { least: clear - reach, patch, done }
        };
        parts.extend(surface.patches.iter().map(|patch| see(*patch, &mut best)));
        for _ in 0..TUNING.patches {
            let Some(Part { least, patch, done }) = parts.pop() else { break };
            if least >= best.distance - resolution {
                break;
            }
            if !done {
                for half in surface.halves(&patch) {
                    let part = see(half, &mut best);
                    if part.least < best.distance - resolution {
                        parts.push(part);
                    }
                }
            }
        }
        best
    }
}
