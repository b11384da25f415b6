//! How fast a tool turns and its axes move, as the motion is written: between its samples.

use super::{Posture, Tool};
use crate::Error;
use crate::arm::{Angles, Arm, ArmCourse, ArmPeaks, ArmRecord};
use crate::geometry::vector::{along, cross, dot, norm, sub, unit};
use crate::mold::Pose;
use crate::motion::{Motion, Peak, TimedMotion};
use rayon::prelude::*;
use std::f64::consts::PI;

/// The largest rates of a tool.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ToolPeaks {
    /// Angular speed of the frame (rad/s), and when.
    pub turn_rate: Peak,
    /// Angular acceleration of the frame (rad/s²), and when.
    pub turn_acceleration: Peak,
    /// Speed of the axis that is nearest to its limit, as a share of it, and of which gripper and when.
    pub axis_share: Peak,
    /// Which axis that is.
    pub axis: usize,
    /// What the motion takes of the arm; `None` where it is not known.
    pub arm: Option<ArmPeaks>,
    /// The arm along the motion, for reports.
    pub arm_record: Option<ArmRecord>,
}

impl ToolPeaks {
    /// How many times longer the motion must take for the tool to keep its limits; at most 1 if it does.
    #[must_use]
    pub fn stretch(&self, tool: &Tool) -> f64 {
        let turn = self.turn_rate.value / tool.turn_rate;
        let acceleration = (self.turn_acceleration.value / tool.turn_acceleration).sqrt();
        turn.max(acceleration).max(self.axis_share.value)
    }
}

impl Tool {
    /// The largest rates along a motion between its samples at a rate (Hz), which begins and ends at rest.
    ///
    /// # Errors
    /// The errors of [`TimedMotion::samples`].
    pub fn peaks(&self, motion: &TimedMotion, rate: f64) -> Result<ToolPeaks, Error> {
        // as many samples as at that rate, evenly: the last pair of a motion may be as short as rounding
        let count = motion.samples(rate)?.len();
        let last = count.saturating_sub(1).max(1) as f64;
        let times: Vec<f64> = (0..count).map(|k| motion.duration() * k as f64 / last).collect();
        let postures: Vec<Posture> =
            times.par_iter().map(|t| self.posture(&motion.at(*t))).collect();
        let all: Vec<usize> = (0..count).collect();
        Ok(self.rates(&times, &postures, &all))
    }

    /// The arm along postures of the tool at ascending times (s); its angular acceleration is taken between the times `apart`, by their
    /// index. `None` where the arm is not known.
    #[must_use]
    pub fn arm_along(
        &self,
        times: &[f64],
        postures: &[Posture],
        apart: &[usize],
    ) -> Option<ArmCourse> {
        let arm = self.arm.as_ref()?;
        let flange = |p: &Posture| self.world.compose(&p.frame.compose(&self.flange));
        let poses: Vec<Pose> = postures.iter().map(flange).collect();
        arm.course(times, &poses, apart)
    }

    /// The tool whose arm begins in the configuration of a record.
    #[must_use]
    pub fn beginning_as(&self, record: &ArmRecord) -> Tool {
        let start = Some(record.start_deg.map(f64::to_radians));
        let arm = self.arm.as_ref().map(|arm| Arm { start, ..arm.clone() });
        Tool { arm, ..self.clone() }
    }

    /// Where the links of the arm are in the scene at angles of its joints (rad), the foot first; nothing where the arm is not known.
    #[must_use]
    pub fn links(&self, angles: &Angles) -> Vec<Pose> {
        let foot = self.world.inverse();
        let links = self.arm.iter().flat_map(|arm| arm.links(angles));
        links.map(|link| foot.compose(&link)).collect()
    }

    /// The rates between the steps of a motion, which begins and ends at rest; accelerations over a `window` (s) at least, see
    /// [`Motion::least_peaks`].
    #[must_use]
    pub fn least_peaks(&self, motion: &Motion, window: f64) -> ToolPeaks {
        let postures: Vec<Posture> =
            motion.positions.par_iter().map(|places| self.posture(places)).collect();
        self.rates(&motion.times, &postures, &motion.apart(window))
    }

    /// The largest rates from one posture to the next, and the largest angular acceleration over some of them.
    fn rates(&self, times: &[f64], postures: &[Posture], apart: &[usize]) -> ToolPeaks {
        let mut found = ToolPeaks::default();
        let meet = |peak: &mut Peak, value: f64, gripper: usize, time: f64| {
            let worse = value > peak.value;
            if worse {
                *peak = Peak { value, gripper, time };
            }
            worse
        };
        // angular velocity from one of two postures to the other, and when
        let turning = |a: usize, b: usize| {
            let turn = turn_between(&postures[a].frame.axes, &postures[b].frame.axes);
            (turn.map(|c| c / (times[b] - times[a])), 0.5 * (times[a] + times[b]))
        };
        for (k, pair) in postures.windows(2).enumerate() {
            let (speed, middle) = turning(k, k + 1);
            meet(&mut found.turn_rate, norm(speed), 0, middle);
            let takes = times[k + 1] - times[k];
            for (gripper, (a, b)) in pair[0].strokes.iter().zip(&pair[1].strokes).enumerate() {
                for (n, axis) in self.axes.iter().enumerate() {
                    let share = (b[n] - a[n]).abs() / takes / axis.speed;
                    if meet(&mut found.axis_share, share, gripper, middle) {
                        found.axis = n;
                    }
                }
            }
        }
        // from rest to the middle of the first pair, from middle to middle, and to rest
        let mut before = ([0.0; 3], 0.0, 0.0);
        let rest = apart.last().map(|last| ([0.0; 3], times[*last], times[*last]));
        let pairs = apart.windows(2).map(|pair| {
            let (speed, middle) = turning(pair[0], pair[1]);
            (speed, middle, times[pair[0]])
        });
        for (speed, middle, time) in pairs.chain(rest) {
            if middle > before.1 {
                let gained = norm(sub(speed, before.0)) / (middle - before.1);
                meet(&mut found.turn_acceleration, gained, 0, time);
            }
            before = (speed, middle, time);
        }
        let course = self.arm_along(times, postures, apart);
        found.arm = course.as_ref().map(|course| course.peaks);
        found.arm_record = course.as_ref().map(ArmCourse::record);
        found
    }
}

/// The turn (rotation vector, rad) that takes three axes at right angles to three others.
#[must_use]
pub fn turn_between(from: &[[f64; 3]; 3], to: &[[f64; 3]; 3]) -> [f64; 3] {
    // twice the axis times the sine, and one plus twice the cosine
    let mut sine = [0.0; 3];
    let mut trace = 0.0;
    for (a, b) in from.iter().zip(to) {
        let c = cross(*a, *b);
        sine = [0, 1, 2].map(|n| sine[n] + c[n]);
        trace += dot(*a, *b);
    }
    let length = norm(sine);
    if length == 0.0 {
        // no turn, or half a turn, which has no sine either: each axis and where it goes have the axis of the turn between them
        let sums = [0, 1, 2].map(|k| along(from[k], 1.0, to[k]));
        let longest = sums.into_iter().max_by(|a, b| norm(*a).total_cmp(&norm(*b)));
        let axis = longest.and_then(unit).filter(|_| trace < 0.0);
        return axis.map_or([0.0; 3], |axis| axis.map(|c| PI * c));
    }
    let angle = (0.5 * length).atan2(0.5 * (trace - 1.0));
    sine.map(|c| c * angle / length)
}
