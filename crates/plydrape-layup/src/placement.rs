//! Where the scene should stand for its robot.
//!
//! How far the foot of an arm is from the middle of its motion, how high, and how the motion is turned to it decide whether the arm follows; the
//! direction in which it is seen from the foot hardly does, because the first joint turns there. So places on a grid of distance, height and
//! turn are tried, in units of the arm's reach, with the motion that the layup has.

use crate::arm::ArmCourse;
use crate::clearance::Nearest;
use crate::geometry::vector::sub;
use crate::layup::Layup;
use crate::mold::Pose;
use crate::motion::Motion;
use crate::tool::{Posture, Tool};
use rayon::prelude::*;
use std::cmp::Ordering;
use std::f64::consts::TAU;

/// Distances of the motion's middle from the axis of the foot, in units of the reach.
const FAR: [f64; 6] = [0.4, 0.5, 0.6, 0.7, 0.8, 0.9];
/// Heights of the motion's middle over the foot, in units of the reach.
const HIGH: [f64; 8] = [-0.2, -0.05, 0.1, 0.25, 0.4, 0.55, 0.7, 0.85];
/// Turns of the scene about the vertical, to a full one.
const TURNS: u32 = 8;
/// Distance from singularities and ends of joints, as a multiple of the least one that is accepted, from which more is no gain.
const FREE: f64 = 2.0;
/// Places are rounded to whole steps: the step is the largest power of ten (m) up to the reach divided by this number.
const ROUND: f64 = 1e3;

/// Where a scene stands for its robot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placement {
    /// Where the origin of the scene is in the world of the robot.
    pub world: Pose,
    /// Turn of the scene about the vertical (rad).
    pub yaw: f64,
    /// From how many configurations the arm follows the motion of the layup there.
    pub keeping: usize,
}

impl Layup {
    /// The place of the scene in the world of its robot where the arm follows the motion of the layup best, and its links stay farther than `clearance` (m)
    /// from mold and obstacles. `None` without an arm or a motion, and where the arm follows from no place.
    #[must_use]
    pub fn placement(&self, clearance: f64) -> Option<Placement> {
        let tool = self.tool.as_ref().filter(|tool| tool.arm.is_some())?;
        let reach = tool.arm.as_ref()?.reach();
        let motion = self.whole_way();
        let postures: Vec<Posture> =
            motion.positions.par_iter().map(|places| tool.posture(places)).collect();
        let count = postures.len().max(1) as f64;
        let flange = |p: &Posture| p.frame.compose(&tool.flange).position;
        let middle = [0, 1, 2].map(|c| postures.iter().map(|p| flange(p)[c]).sum::<f64>() / count);

        let mut places: Vec<(Pose, f64)> = Vec::new();
        for far in FAR {
            for high in HIGH {
                for n in 0..TURNS {
                    // half a turn to either side
                    let share = f64::from(n) / f64::from(TURNS);
                    let yaw = TAU * (share - share.round());
                    let turned = Pose::new([0.0; 3], [0.0, 0.0, yaw]);
                    let origin = sub([far * reach, 0.0, high * reach], turned.turn(middle));
                    let step = 10.0_f64.powf((reach / ROUND).log10().floor());
                    let position = origin.map(|c| step * (c / step).round());
                    places.push((Pose { position, ..turned }, yaw));
                }
            }
        }
        let tool_at = |world: &Pose| Tool { world: *world, ..tool.clone() };
        let mut found: Vec<(f64, Placement)> = places
            .par_iter()
            .filter_map(|(world, yaw)| {
                let course: ArmCourse = tool_at(world).arm_along(&motion.times, &postures, &[])?;
                let placement = Placement { world: *world, yaw: *yaw, keeping: course.keeping };
                let free = course.peaks.freedom(tool.arm.as_ref()?);
                (course.keeping > 0).then_some((free, placement))
            })
            .collect();
        // far enough from its limits first, then from more configurations, then the freest; of those that are alike, the first of the grid
        let worth =
            |(free, placement): &(f64, Placement)| (free.min(FREE), placement.keeping, *free);
        found.sort_by(|a, b| worth(b).partial_cmp(&worth(a)).unwrap_or(Ordering::Equal));
        let clear = |placement: &Placement| {
            let layup = Layup { tool: Some(tool_at(&placement.world)), ..self.clone() };
            // the plan is not this motion, so there is some room
            let room = FREE * clearance;
            let nearest = Nearest::of_arm(&layup, room, &motion);
            nearest.is_none_or(|nearest| nearest.distance >= room)
        };
        found.into_iter().map(|(_, placement)| placement).find(clear)
    }

    /// The motion of the layup, or straight to its target where it only has a start.
    fn whole_way(&self) -> Motion {
        let mut motion = self.motion.clone();
        if let ([start], Some(target)) = (&motion.positions[..], &self.target) {
            motion = Motion {
                times: vec![0.0, 1.0],
                positions: vec![start.clone(), target.grippers.clone()],
            };
        }
        motion
    }
}
