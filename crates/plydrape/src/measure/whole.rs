//! A whole motion in time as a measure sees it.

use super::observation::rate_window;
use super::{Found, Limits, Name, Verdict, Worst};
use crate::arm::ArmRecord;
use crate::layup::Layup;
use crate::motion::{Attitudes, Motion, Peak, Peaks, TimedMotion};
use crate::state::Site;
use crate::tool::ToolPeaks;

/// A whole motion in time, with what was found of it.
#[derive(Debug, Clone, Copy)]
pub struct WholeMotion<'a> {
    /// What is draped along it.
    pub layup: &'a Layup,
    /// The limits of the scene.
    pub limits: &'a Limits,
    /// The motion.
    pub motion: Course<'a>,
    /// Orientations of the grippers along it; `None` before a model has draped along it.
    pub attitudes: Option<&'a Attitudes>,
    /// The largest speed, acceleration and jerk.
    pub peaks: MotionPeaks,
    /// How fast the tool turns and its axes move; `None` without a tool.
    pub tool: Option<&'a ToolPeaks>,
    /// Samples a second of a smooth motion as it is written (Hz).
    pub rate: f64,
}

/// The largest rates of the parts of a motion that have limits of their own.
#[derive(Debug, Clone, Copy, Default)]
pub struct MotionPeaks {
    /// Peaks of the transport.
    pub transport: Peaks,
    /// Peaks of all that the limits of the transport do not bound.
    pub drape: Peaks,
}

impl MotionPeaks {
    /// The peaks of a motion in time whose transport ends at one of its steps.
    #[must_use]
    pub fn new(motion: &TimedMotion, last_free: usize, limits: &Limits) -> Self {
        let until = motion.times()[last_free];
        Self::with(limits, *motion.peaks(), || {
            [[0.0, until], [until, motion.duration()]].map(|times| motion.peaks_within(times))
        })
    }

    /// The peaks of the whole, and of the transport and what follows where the scene limits the transport.
    fn with(limits: &Limits, all: Peaks, parts: impl Fn() -> [Peaks; 2]) -> Self {
        if limits.transport_bounds().is_none() {
            return MotionPeaks { transport: Peaks::default(), drape: all };
        }
        let [transport, after] = parts();
        let is_own = |name| limits.get(name).is_some();
        let drape = Peaks {
            speed: if is_own(Name::TransportSpeed) { after.speed } else { all.speed },
            acceleration: match is_own(Name::TransportAcceleration) {
                true => after.acceleration,
                false => all.acceleration,
            },
            jerk: if is_own(Name::TransportJerk) { after.jerk } else { all.jerk },
        };
        MotionPeaks { transport, drape }
    }
}

/// How a motion goes in time.
#[derive(Debug, Clone, Copy)]
pub enum Course<'a> {
    /// Smoothly, by a time law: its peaks are exact.
    Smooth(&'a TimedMotion),
    /// Through the steps of a motion that was given: its peaks are those that no way from one to the next can avoid.
    Steps(&'a Motion),
}

impl Course<'_> {
    fn times(&self) -> &[f64] {
        match self {
            Course::Smooth(motion) => motion.times(),
            Course::Steps(motion) => &motion.times,
        }
    }

    fn gripper_at(&self, gripper: usize, time: f64) -> [f64; 3] {
        match self {
            Course::Smooth(motion) => motion.gripper_at(gripper, time),
            Course::Steps(motion) => motion.gripper_at(gripper, time),
        }
    }
}

/// Verdicts on all limits of the motion in time of a layup, as its steps and its tool make it, and the arm along it. The transport ends at the
/// step of index `last_free`.
#[must_use]
pub(crate) fn verdicts_of_steps(
    layup: &Layup,
    limits: &Limits,
    last_free: usize,
) -> (Vec<Verdict>, Option<ArmRecord>) {
    let (carried, _) = layup.carried();
    let motion = &carried.motion;
    let window = rate_window(motion.times.last().copied().unwrap_or(0.0));
    let tool = layup.tool.as_ref().map(|tool| tool.least_peaks(&layup.motion, window));
    let whole = WholeMotion {
        layup,
        limits,
        motion: Course::Steps(motion),
        attitudes: None,
        peaks: MotionPeaks::with(limits, motion.least_peaks(window), || {
            let until = motion.times.get(last_free).copied().unwrap_or(0.0);
            [[0.0, until], [until, f64::INFINITY]]
                .map(|times| motion.least_peaks_within(window, times))
        }),
        tool: tool.as_ref(),
        rate: 0.0,
    };
    (whole.verdicts(), tool.and_then(|peaks| peaks.arm_record))
}

impl WholeMotion<'_> {
    /// Every limit of a motion in time, judged.
    #[must_use]
    pub fn verdicts(&self) -> Vec<Verdict> {
        let verdict = |name: &Name| {
            let limit = name.limit(self.layup, self.limits)?;
            let (found, time) = name.measure().evaluate_motion(self)?;
            let step = time.map(|time| self.step(time));
            Some(Verdict::new(*name, Worst::new(&found, self.layup), limit, step))
        };
        Name::ALL.iter().filter_map(verdict).collect()
    }

    /// The largest value of a gripper along the motion, where the gripper is then, and its time (s).
    pub(super) fn gripper_peak(&self, peak: Peak) -> (Found, Option<f64>) {
        let Peak { value, gripper, time } = peak;
        let place = Some(self.motion.gripper_at(gripper, time));
        (Found { value, site: Site::Gripper(gripper), place }, Some(time))
    }

    /// The largest rate of the frame of the tool (rad) in degrees, and its time (s).
    pub(super) fn frame_peak(&self, peak: Peak) -> (Found, Option<f64>) {
        let value = peak.value.to_degrees();
        (Found { value, site: Site::Frame, place: None }, Some(peak.time))
    }

    /// The step on the way to which a time (s) is, counted from 1.
    fn step(&self, time: f64) -> usize {
        let times = self.motion.times();
        (times.partition_point(|t| *t < time) + 1).min(times.len())
    }
}

#[cfg(test)]
mod tests {
    use super::super::sample;
    use super::*;
    use crate::motion::Bounds;

    /// Down by 50 mm from rest to rest, with the jerk at its limit: the motion is judged by what bounds it, and not by tools or bodies that are
    /// not there.
    #[test]
    fn a_motion_is_judged_by_its_speed_acceleration_and_jerk() {
        let layup = sample::layup();
        let limits = Limits::usual(&layup);
        let [speed, acceleration, jerk] =
            [Name::Speed, Name::Acceleration, Name::Jerk].map(|name| limits.most(name));
        let bounds = Bounds { speed, acceleration, jerk };
        let motion = &TimedMotion::new(&layup.motion.positions, &bounds).unwrap();
        let whole = WholeMotion {
            layup: &layup,
            limits: &limits,
            motion: Course::Smooth(motion),
            attitudes: None,
            peaks: MotionPeaks::new(motion, 0, &limits),
            tool: None,
            rate: 100.0,
        };
        let verdicts = whole.verdicts();
        let names: Vec<Name> = verdicts.iter().map(|verdict| verdict.name).collect();
        assert_eq!(names, [Name::Speed, Name::Acceleration, Name::Jerk]);
        for verdict in &verdicts {
            assert!(
                verdict.ok && verdict.step == Some(2) && verdict.place.is_some(),
                "{verdict:?}"
            );
        }
        // its time has a margin of a ten-thousandth, of which the jerk has the third power
        assert!((verdicts[2].value - jerk).abs() < 1e-3 * jerk, "{:?}", verdicts[2]);
    }
}
