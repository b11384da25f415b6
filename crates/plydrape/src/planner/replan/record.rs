//! The steps and the outcome of a corrected plan.
//!
//! Up to the last step without contact the ply is moved as a body; what a turn about the vertical does not change stays as it was
//! recorded. Measured again is what depends on where the ply is or on the motion: how fast grippers tilt, the workspace, the clearance of bodies, the
//! gap, the distance to the target, the duration, the rates of the motion and of the tool. The rest of the verdict is that of the plan.

use super::KnownPlan;
use crate::clearance::Nearest;
use crate::geometry::vector::distance;
use crate::measure::{
    Course, MotionPeaks, Name, Observation, Past, Scope, Verdict, WholeMotion, Worst,
};
use crate::motion::{Attitudes, TimedMotion};
use crate::outcome::{Step, Summary};
use crate::pick_up::Moved;
use crate::planner::evaluation::{self, clearance_verdict};
use crate::scene::Scene;
use crate::sheet::EventKind;
use crate::tool::{ToolPeaks, ToolRecord};

/// What depends on where the grippers are and when.
const AGAIN: [Name; 5] =
    [Name::TiltRate, Name::Workspace, Name::LandingGripper, Name::Clearance, Name::Duration];

/// The recorded steps, moved, with the grippers where the motion has them.
pub fn steps(
    plan: KnownPlan,
    motion: &TimedMotion,
    moved: &[Moved],
    last_free: usize,
) -> Vec<Step> {
    let mut steps = plan.steps.to_vec();
    let targets = plan.scene.layup.target.as_ref().map(|target| &target.grippers);
    for (k, step) in steps.iter_mut().take(last_free + 1).enumerate() {
        let moved = &moved[k];
        for (n, gripper) in step.grippers.iter_mut().enumerate() {
            let commanded = motion.positions()[k][n];
            let rigid = gripper.position == gripper.commanded;
            gripper.position = if rigid { commanded } else { moved.place(gripper.position) };
            gripper.commanded = commanded;
            gripper.force = moved.turn(gripper.force);
            gripper.quaternion = moved.orientation(gripper.quaternion);
            if let (Some(far), Some(targets)) = (&mut gripper.target_distance_mm, targets) {
                *far = distance(gripper.position, targets[n]) * 1e3;
            }
        }
        let lines = step.catenaries.iter_mut().flat_map(|step| &mut step.catenaries);
        for bridge in lines.filter_map(|line| line.bridging.as_mut()) {
            bridge.place = moved.place(bridge.place);
        }
    }
    steps
}

/// Sets the times of steps to those of a motion.
pub fn times(steps: &mut [Step], motion: &TimedMotion) {
    for (step, time) in steps.iter_mut().zip(motion.times()) {
        step.time = *time;
    }
}

/// How fast the gripper tilts that tilts fastest (°/s), along a motion in whose times the steps are.
pub fn fastest_tilt(scene: &Scene, motion: &TimedMotion, steps: &[Step]) -> f64 {
    let layup = evaluation::along_motion(&scene.layup, motion.steps());
    let (mut past, mut fastest) = (None, 0.0_f64);
    for step in steps {
        let state = step.state_of_grippers(layup.settings.model);
        let (limits, past_ref) = (&scene.limits, past.as_ref());
        let seen = Observation { layup: &layup, limits, state: &state, past: past_ref };
        let found = Name::TiltRate.measure().evaluate(&seen);
        fastest = found.map_or(fastest, |found| fastest.max(found.value));
        past = Some(Past::after(&state, past.take(), motion.duration()));
    }
    fastest
}

/// Moves the places of what was measured with the ply, and forgets the gap, which is another one where the ply is moved.
pub fn places(steps: &mut [Step], moved: &[Moved], last_free: usize) {
    for (step, moved) in steps.iter_mut().take(last_free + 1).zip(moved) {
        step.measures = step
            .measures
            .iter()
            .filter(|(name, _)| *name != Name::Gap || moved.is_nothing())
            .map(|(name, worst)| {
                let place = worst.place.map(|place| moved.place(place));
                (name, Worst { place, ..worst.clone() })
            })
            .collect();
    }
}

/// A corrected motion, with all by which its outcome is judged.
#[derive(Debug)]
pub struct CorrectedMotion<'a> {
    /// The motion.
    pub motion: &'a TimedMotion,
    /// How its grippers are turned.
    pub attitudes: &'a Attitudes,
    /// How many times as long as the planned one it takes.
    pub longer: f64,
    /// When the drape begins in it (s).
    pub begins: f64,
    /// For how long the pads stand on the ply before the drape begins (s).
    pub grip: f64,
    /// When the drape ends in it (s).
    pub ends: f64,
    /// The rates of the tool along it; `None` where each gripper moves by itself.
    pub tool: Option<ToolPeaks>,
    /// The nearest bodies of the planned motion from the last free step on.
    pub landing: Option<Nearest>,
    /// The last step, from 0, in which nothing touches the mold.
    pub last_free: usize,
}

impl CorrectedMotion<'_> {
    /// The outcome along the steps.
    pub fn summary(&self, plan: KnownPlan, steps: &mut [Step], moved: &[Moved]) -> Summary {
        let scene = plan.scene;
        let mut summary = plan.summary.clone();
        for verdict in &mut summary.limits {
            // where what stays was worst
            let step = verdict.step.map_or(usize::MAX, |step| step - 1);
            if step <= self.last_free {
                verdict.place = verdict.place.map(|place| moved[step].place(place));
            }
        }
        let planned = plan.steps.last().map_or(0.0, |step| step.time);
        for event in &mut summary.events {
            event.time = match event.time < planned {
                true if event.kind == EventKind::Grip => self.begins - self.grip,
                true => self.begins + event.time * self.longer,
                // how long pads press after the motion is the scene's
                false => self.ends + (event.time - planned),
            };
        }

        // what depends on where the grippers are and when, measured again
        let layup = evaluation::along_motion(&scene.layup, self.motion.steps());
        summary.measure_again(&layup, &scene.limits, steps, &AGAIN);
        summary.judge_also(self.clearance(scene));
        let whole = WholeMotion {
            layup: &scene.layup,
            limits: &scene.limits,
            motion: Course::Smooth(self.motion),
            // the nearest bodies were looked for above, without the landing, which stays
            attitudes: None,
            peaks: MotionPeaks::new(self.motion, self.last_free, &scene.limits),
            tool: self.tool.as_ref(),
            rate: self.motion.fitting_rate(scene.plan.rate),
        };
        // no verdict on the planned motion is one on this motion
        summary.limits.retain(|verdict| verdict.name.measure().scope() != Scope::Motion);
        summary.judge_also(whole.verdicts());
        if let Some(tool) = &scene.layup.tool {
            let carried = tool.carry(self.motion.positions()).record;
            if let Some(planned) = &plan.summary.tool {
                let kept = carried.residual_mm <= planned.residual_mm;
                let record = if kept { carried.with_residual_of(planned) } else { carried };
                let arm = self.tool.and_then(|peaks| peaks.arm_record);
                let record = ToolRecord { arm, ..record };
                summary.follow_tool(scene, record);
            }
        }
        summary.judge_rest(&scene.layup, &scene.limits);
        summary
    }

    /// The verdict on the nearest bodies along the whole motion.
    fn clearance(&self, scene: &Scene) -> Option<Verdict> {
        let until = self.motion.times()[self.last_free];
        let landing = self
            .landing
            .map(|nearest| Nearest { time: self.begins + nearest.time * self.longer, ..nearest });
        // only what is nearer than the landing is looked for on the way
        let below = landing.map_or(f64::INFINITY, |nearest| nearest.distance);
        let times = [0.0, until];
        let least = scene.limits.least(Name::Clearance);
        let arm = self.tool.and_then(|peaks| peaks.arm_record);
        let way = Nearest::of_motion_within(
            &scene.layup.beginning_as(arm.as_ref()),
            least,
            self.motion.fitting_rate(scene.plan.rate),
            self.motion,
            self.attitudes,
            times,
            below,
        );
        let nearest = way.or(landing)?;
        let times = self.motion.times();
        let step = times.partition_point(|t| *t < nearest.time) + 1;
        Some(clearance_verdict(scene, &nearest, step.min(times.len())))
    }
}
