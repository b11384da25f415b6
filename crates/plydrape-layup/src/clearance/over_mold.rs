//! The distance of a body from the mold.
//!
//! A mold of triangles is asked as another body. Any other one knows its distance d from a point, in closed form or with its own
//! search ([`Mold::closest_point`]); it has no triangles that would stand for it without an error. So the body's surface is divided.
//! With the normal n at the closest point, and hollows of the mold nowhere sharper than 1/b, a part of the surface around c comes
//! no nearer than `d(c) + min n·(p − c) − κ r²/2` with its reach r and `κ = b/(1 − b (d + r))`, as long as b (d + r) < 1: the second
//! derivative of the distance is k/(1 + k d), and a ball of the radius 1/b rolls over all of the mold. Anywhere it comes no nearer than
//! d(c) − r. Parts that could hold a nearer point are divided, the nearest first. Where the body is in the mold, what is found is the
//! depth of its deepest point.
//!
//! Farther from the mold than 1/b only the second bound is known, and for a height over a plane with [`Mold::clear`] in place of d:
//! what is found there is the distance of points that are close together, as a share of their distance.
//!
//! Waves and plies that lie on a mold count with their greatest height everywhere.

use super::tuning::TUNING;
use crate::bodies::{Apart, Patch, Solid, Solids, Surface};
use crate::mold::{Face, Mold, Pose, Relief, Steepness};
use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::sync::Arc;

/// A mold and what bounds its distances.
#[derive(Debug, Clone)]
pub(super) struct OverMold<'a> {
    /// Without what raises it.
    mold: &'a Mold,
    /// By how much it is raised at most (m).
    raised: f64,
    steepness: Steepness,
    /// Sharpest curvature of its hollows (1/m); infinite where it is not known.
    hollow: f64,
    /// Triangles as a body.
    triangles: Option<Arc<Solid>>,
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
    pub fn new(mold: &'a Mold, solids: &Solids) -> Self {
        let (mut bare, mut raised) = (mold, 0.0);
        loop {
            (bare, raised) = match bare {
                Mold::Wavy(wavy) => (&wavy.mold, raised + wavy.relief.most()),
                Mold::Layered(layered) => (&layered.mold, raised + layered.relief.most()),
                _ => break,
            };
        }
        let steepness = bare.steepness();
        let inside = |face: Face, radius: f64| match face {
            Face::Outside => 0.0,
            Face::Inside => 1.0 / radius,
        };
        let (hollow, triangles) = match bare {
            Mold::Plane(_) => (0.0, None),
            Mold::Cylinder(cylinder) => (inside(cylinder.face, cylinder.radius), None),
            Mold::Sphere(sphere) => (inside(sphere.face, sphere.radius), None),
            Mold::Torus(torus) => match torus.face {
                Face::Outside => (1.0 / (torus.ring_radius - torus.tube_radius), None),
                Face::Inside => (1.0 / torus.tube_radius, None),
            },
            Mold::Graph(_) => (steepness.bend, None),
            Mold::Mesh(mesh) => (f64::INFINITY, Some(solids.of_mesh(mesh))),
            Mold::Wavy(_) | Mold::Layered(_) => (f64::INFINITY, None),
        };
        OverMold { mold: bare, raised, steepness, hollow, triangles }
    }

    /// A distance (m) that nothing within a ball (m) falls short of.
    pub fn gap(&self, middle: [f64; 3], radius: f64) -> f64 {
        let found = self.mold.separation(middle, f64::INFINITY);
        let known = found.beyond || found.distance <= 0.0 || !self.steepness.bend.is_finite();
        let clear =
            if known { found.distance } else { self.mold.clear(middle, found, self.steepness) };
        clear - radius - self.raised
    }

    /// How far a body, with its surface, placed by a pose, is from the mold, to `resolution` (m).
    pub fn apart(&self, solid: &Solid, surface: &Surface, pose: &Pose, resolution: f64) -> Apart {
        let mut found = match &self.triangles {
            None => self.searched(surface, pose, resolution),
            Some(triangles) => {
                let found = solid.apart(pose, triangles, &Pose::upright([0.0; 3]));
                let within = self.mold.signed_distance(pose.place(solid.ball.0)) < 0.0;
                match found.distance > 0.0 && !within {
                    true => found,
                    // how deep, coarsely: the depth of a triangle is not that of a mold
                    false => {
                        let deep = self.searched(surface, pose, TUNING.far * solid.ball.1);
                        Apart { distance: deep.distance.min(0.0), ..deep }
                    }
                }
            }
        };
        found.distance -= self.raised;
        found
    }

    fn searched(&self, surface: &Surface, pose: &Pose, resolution: f64) -> Apart {
        let mut best = Apart { distance: f64::INFINITY, place: pose.position };
        let mut parts: BinaryHeap<Part> = BinaryHeap::new();
        // how near a patch is at its middle, and how near any point of it can be
        let see = |patch: Patch, best: &mut Apart| {
            let (middle, reach, belongs) = surface.ball(&patch);
            let middle = pose.place(middle);
            let found = self.mold.closest_point(middle);
            if belongs && found.distance < best.distance {
                *best = Apart { distance: found.distance, place: middle };
            }
            // near a mold of bounded curvature the distance falls at most by the patch's extent along the normal and the bend of the
            // mold
            let sharpness = self.hollow * (found.distance + reach).max(0.0);
            if !found.beyond && sharpness < 1.0 {
                let bend = self.hollow / (1.0 - sharpness);
                let down = surface.extent(&patch, pose.turn_back(found.normal));
                let fall = (down + 0.5 * bend * reach * reach).min(reach);
                let done = belongs && reach <= 0.5 * resolution;
                return Part { least: found.distance - fall, patch, done };
            }
            // elsewhere the bound of the mold's own tree
            let least = self.gap(middle, reach) + self.raised;
            let far = reach <= TUNING.far * (least + reach).abs();
            Part { least, patch, done: belongs && (far || reach <= 0.5 * resolution) }
        };
        // branch and bound: halve the patch that could be nearest until none could be nearer by the resolution
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
