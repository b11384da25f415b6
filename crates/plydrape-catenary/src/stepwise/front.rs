//! The height of each gripper above the mold: the ply comes into contact from its middle outwards and rises ahead of
//! the front.
//!
//! Let r be the distance of a gripper's target from the middle of the ply on the mold, f the radius of the front,
//! h₀ its height and A a rate of rise. The ply should hang at
//!
//! `h(r) = h₀ + ½A (r − f)²` for r > f, at most as steep as the tilt of the grippers allows,
//!
//! above the mold. The ply curves away faster than the mold does, so that the next contact is beside the last
//! one. On a flat mold A = 0: the ply takes its final form above the mold and comes down as
//! a whole. The front is not in the paper, which leaves open in which order a ply should land.

use super::Task;
use super::tuning::TUNING;
use crate::geometry::vector::{mean, norm, sub};

/// Where the landing front is, and what follows for each gripper.
#[derive(Debug, Clone)]
pub struct Front {
    /// Distance of each gripper's target from the middle (m).
    pub distance: Vec<f64>,
    /// Normal of the mold at each gripper's target.
    pub normal: Vec<[f64; 3]>,
    /// Rate of rise A (1/m).
    pub rise: f64,
    /// Distance beyond the front from which the rise is straight (m).
    straight: f64,
    /// Height of the front above the mold h₀ (m).
    pub base: f64,
    /// Radius of the front f (m).
    pub radius: f64,
    /// Height from which a gripper goes down in one step (m).
    last: f64,
}

impl Front {
    /// The front before the first contact, for a ply whose grippers shall end at `targets` (m).
    pub fn new(task: &Task, targets: &[[f64; 3]]) -> Self {
        let up = [0.0, 0.0, 1.0];
        let mean = mean(targets);
        let middle = task.layup.mold.as_ref().map_or(mean, |mold| mold.closest_point(mean).point);
        let normal: Vec<[f64; 3]> =
            targets.iter().map(|p| task.layup.mold.as_ref().map_or(up, |m| m.normal(*p))).collect();
        let bend = |p: &[f64; 3]| {
            task.layup.mold.as_ref().map_or(0.0, |mold| {
                mold.curvatures(*p).principal.iter().fold(0.0_f64, |most, k| most.max(k.abs()))
            })
        };
        let rise = TUNING.rise * targets.iter().chain([&middle]).map(bend).fold(0.0, f64::max);
        // the tilt minus the mold's own slope
        let slope = |n: &[f64; 3]| n[0].hypot(n[1]) / n[2].max(TUNING.upright);
        let steepest = normal.iter().map(slope).fold(0.0, f64::max);
        let room =
            TUNING.tilt_share * task.limits.tilt.min(task.layup.settings.max_tilt).tan() - steepest;
        let cap = room.clamp(TUNING.slopes[0], TUNING.slopes[1]);
        Front {
            distance: targets.iter().map(|p| norm(sub(*p, middle))).collect(),
            normal,
            rise,
            straight: if rise > 0.0 { cap / rise } else { f64::INFINITY },
            base: 0.0,
            radius: 0.0,
            last: TUNING.last * task.layup.settings.contact.tolerance,
        }
    }

    /// Distance of the farthest gripper (m).
    pub fn farthest(&self) -> f64 {
        self.distance.iter().fold(0.0, |most, r| most.max(*r))
    }

    /// How high a gripper should be above the mold (m).
    ///
    /// A gripper goes down the last millimeter in one step: an edge that is in contact up to a gripper is held at the
    /// closest point of the gripper, and would be stretched by the height of the gripper above it.
    pub fn height(&self, gripper: usize) -> f64 {
        let height = self.base + self.lift(gripper, self.radius);
        if height > self.last { height } else { 0.0 }
    }

    /// Height of a gripper above that of the front, for a front of radius `radius` (m).
    pub fn lift(&self, gripper: usize, radius: f64) -> f64 {
        let x = self.distance[gripper] - radius;
        if x <= 0.0 || self.rise == 0.0 {
            return 0.0;
        }
        let near = x.min(self.straight);
        self.rise * near * (x - 0.5 * near)
    }

    /// Largest height that any gripper loses if the front grows to `radius` (m).
    pub fn drop(&self, radius: f64) -> f64 {
        let loss = |n: usize| self.lift(n, self.radius) - self.lift(n, radius);
        (0..self.distance.len()).map(loss).fold(0.0, f64::max)
    }
}
