//! The angles of the joints along a motion of the flange, and what it takes of them.

use super::inverse::Found;
use super::tuning::{FAR, HALVINGS, ROUNDING};
use super::{Angles, Arm, JOINTS, Joint};
use crate::geometry::Pose;
use crate::geometry::rotation::continued;
use crate::geometry::vector::between;
use crate::motion::{Peak, slerp};
use rayon::prelude::*;
use std::f64::consts::TAU;

/// An arm along a motion of its flange.
#[derive(Debug, Clone, PartialEq)]
pub struct ArmCourse {
    /// The angles of the joints (rad) at each time.
    pub angles: Vec<Angles>,
    /// What it takes of the joints.
    pub peaks: ArmPeaks,
    /// In how many configurations the arm reaches the first pose.
    pub configurations: usize,
    /// From how many of them it follows the motion to its end, within its limits.
    pub keeping: usize,
}

/// What a motion takes of an arm. The gripper of a peak is the number of the joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ArmPeaks {
    /// What is left of the pose that the arm misses most, as a length (m), and when.
    pub missed: Peak,
    /// Speed of the joint that is nearest to its limit, as a share of it.
    pub speed_share: Peak,
    /// Largest angular acceleration (rad/s²).
    pub acceleration: Peak,
    /// The least singular value; see [`Arm::least_singular`].
    pub singular: Peak,
    /// Least distance of a joint from an end of its range (rad); negative beyond it.
    pub margin: Peak,
}

/// What a motion takes of an arm, for reports.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct ArmRecord {
    /// In how many configurations the arm reaches the first pose.
    pub configurations: usize,
    /// From how many of them it follows the motion to its end, within its limits.
    pub keeping: usize,
    /// The angle of each joint at the start (°).
    pub start_deg: Angles,
    /// Smallest and largest angle of each joint (°).
    pub ranges_deg: [[f64; 2]; JOINTS],
}

impl ArmCourse {
    /// Smallest and largest angle of each joint (rad).
    fn ranges(&self) -> [[f64; 2]; JOINTS] {
        std::array::from_fn(|n| {
            let ends = [f64::INFINITY, f64::NEG_INFINITY];
            self.angles.iter().fold(ends, |[low, high], a| [low.min(a[n]), high.max(a[n])])
        })
    }

    /// The course for reports.
    #[must_use]
    pub fn record(&self) -> ArmRecord {
        let start = self.angles.first().copied().unwrap_or_default();
        ArmRecord {
            configurations: self.configurations,
            keeping: self.keeping,
            start_deg: start.map(f64::to_degrees),
            ranges_deg: self.ranges().map(|range| range.map(f64::to_degrees)),
        }
    }
}

impl ArmPeaks {
    /// Whether the arm reaches every pose within its limits.
    fn keeps(&self, arm: &Arm) -> bool {
        self.missed.value <= arm.allowed_miss()
            && self.speed_share.value <= 1.0
            && arm.acceleration.is_none_or(|most| self.acceleration.value <= most)
            && self.singular.value >= arm.singular
            && self.margin.value >= arm.margin
    }

    /// How many times its limits the arm stays from singularities and from the ends of its joints; the smaller of both.
    #[must_use]
    pub fn freedom(&self, arm: &Arm) -> f64 {
        (self.singular.value / arm.singular).min(self.margin.value / arm.margin)
    }

    /// How good it is, the better the larger: first what the arm misses, then its limits, then how far it stays from them.
    fn worth(&self, arm: &Arm, start: &Angles) -> [f64; 4] {
        let reaches = self.missed.value <= arm.allowed_miss();
        let missed = if reaches { 0.0 } else { -self.missed.value };
        // of two that are as free, but for rounding, the one that is nearer to the middle of its ranges
        let middle = |(joint, angle): (&Joint, &f64)| {
            (angle - 0.5 * (joint.range[0] + joint.range[1])).abs()
        };
        let off: f64 = arm.joints.iter().zip(start).map(middle).sum();
        [missed, f64::from(u8::from(self.keeps(arm))), (self.freedom(arm) / ROUNDING).round(), -off]
    }
}

impl Arm {
    /// The arm along poses of the flange in the frame of its foot, at ascending times (s); rates are taken between the times `apart`, by
    /// their index, from rest to rest. It begins in the configuration nearest to [`Arm::start`], or in the one from which it follows best.
    /// `None` without poses.
    #[must_use]
    pub fn course(&self, times: &[f64], poses: &[Pose], apart: &[usize]) -> Option<ArmCourse> {
        let starts = self.configurations(poses.first()?);
        let configurations = starts.iter().filter(|start| start.reaches()).count();
        let courses: Vec<ArmCourse> = starts
            .par_iter()
            .map(|start| {
                let (angles, missed) = self.follow(times, poses, start);
                let angles = self.wound(angles);
                let peaks = self.peaks(times, &angles, apart, missed);
                ArmCourse { angles, peaks, configurations, keeping: 0 }
            })
            .collect();
        let keeping = courses.iter().filter(|course| course.peaks.keeps(self)).count();
        // how near it begins to where it shall, and else how good it is
        let worth = |course: &ArmCourse| match &self.start {
            Some(start) => {
                let turned = course.angles[0].iter().zip(start).map(|(a, b)| (a - b).cos());
                [turned.sum(), 0.0, 0.0, 0.0]
            }
            None => course.peaks.worth(self, &course.angles[0]),
        };
        // of two that are as good the first found stays
        let best = courses.into_iter().reduce(|best, next| {
            if worth(&next).partial_cmp(&worth(&best)).is_some_and(|order| order.is_gt()) {
                next
            } else {
                best
            }
        })?;
        Some(ArmCourse { keeping, ..best })
    }

    /// The angles along the poses from a start, and the pose that is missed most.
    fn follow(&self, times: &[f64], poses: &[Pose], start: &Found) -> (Vec<Angles>, Peak) {
        let mut missed = Peak { value: start.left * self.reach(), gripper: 0, time: times[0] };
        let mut angles = vec![start.angles];
        let mut now = start.angles;
        for (n, pair) in poses.windows(2).enumerate() {
            let found = self.go([&pair[0], &pair[1]], &now, HALVINGS);
            now = found.angles;
            angles.push(now);
            let left = found.left * self.reach();
            if left > missed.value {
                missed = Peak { value: left, gripper: 0, time: times[n + 1] };
            }
        }
        (angles, missed)
    }

    /// From one pose to the next, by poses between them where joints turn far.
    fn go(&self, [from, to]: [&Pose; 2], angles: &Angles, halvings: u32) -> Found {
        let found = self.nearest(to, angles);
        let turns = found.angles.iter().zip(angles).map(|(a, b)| (a - b).abs());
        if halvings == 0 || turns.fold(0.0, f64::max) <= FAR {
            return found;
        }
        let a = from.quaternion();
        let b = continued(to.quaternion(), Some(a));
        let middle = between(from.position, to.position, 0.5);
        let middle = Pose::of_quaternion(middle, slerp(&a, &b, 0.5));
        let half = self.go([from, &middle], angles, halvings - 1);
        self.go([&middle, to], &half.angles, halvings - 1)
    }

    /// The angles with as many full turns more or less of each joint as keep it farthest from its ends.
    fn wound(&self, mut angles: Vec<Angles>) -> Vec<Angles> {
        for (n, joint) in self.joints.iter().enumerate() {
            let [low, high] = angles
                .iter()
                .fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], q| [a.min(q[n]), b.max(q[n])]);
            let middle = 0.5 * (joint.range[0] + joint.range[1]) - 0.5 * (low + high);
            let turns = TAU * (middle / TAU).round();
            angles.iter_mut().for_each(|q| q[n] += turns);
        }
        angles
    }

    /// What angles along a motion take of the joints.
    fn peaks(&self, times: &[f64], angles: &[Angles], apart: &[usize], missed: Peak) -> ArmPeaks {
        let none = Peak::default();
        let far = Peak { value: f64::INFINITY, ..none };
        let mut peaks =
            ArmPeaks { missed, speed_share: none, acceleration: none, singular: far, margin: far };
        // the larger of two values, and the smaller
        let most = |peak: &mut Peak, value: f64, gripper: usize, time: f64| {
            if value > peak.value {
                *peak = Peak { value, gripper, time };
            }
        };
        let least = |peak: &mut Peak, value: f64, gripper: usize, time: f64| {
            if value < peak.value {
                *peak = Peak { value, gripper, time };
            }
        };
        for (time, q) in times.iter().zip(angles) {
            least(&mut peaks.singular, self.least_singular(q), 0, *time);
            for (n, joint) in self.joints.iter().enumerate() {
                least(&mut peaks.margin, joint.margin(q[n]), n, *time);
            }
        }
        let speed =
            |a: usize, b: usize, n: usize| (angles[b][n] - angles[a][n]) / (times[b] - times[a]);
        for (k, pair) in times.windows(2).enumerate() {
            for (n, joint) in self.joints.iter().enumerate() {
                let share = speed(k, k + 1, n).abs() / joint.speed;
                most(&mut peaks.speed_share, share, n, 0.5 * (pair[0] + pair[1]));
            }
        }
        // from rest to the middle of the first pair, from middle to middle, and to rest
        let mut before = ([0.0; JOINTS], 0.0);
        let pairs = apart.windows(2).map(|pair| {
            let middle = 0.5 * (times[pair[0]] + times[pair[1]]);
            (std::array::from_fn(|n| speed(pair[0], pair[1], n)), middle, times[pair[0]])
        });
        let rest = apart.last().map(|last| ([0.0; JOINTS], times[*last], times[*last]));
        for (speeds, middle, time) in pairs.chain(rest) {
            if middle > before.1 {
                for n in 0..JOINTS {
                    let gained = (speeds[n] - before.0[n]).abs() / (middle - before.1);
                    most(&mut peaks.acceleration, gained, n, time);
                }
            }
            before = (speeds, middle);
        }
        peaks
    }
}
