//! The steps and the outcome of a corrected plan.
//!
//! Up to the last step without contact the ply is moved as a body; what a turn about the vertical does not change stays as it was
//! recorded. Measured again is what depends on where the ply is or on the motion: how fast grippers tilt, the workspace, the clearance of bodies, the
//! gap, the distance to the target, the duration, the rates of the motion and of the tool. The rest of the verdict is that of the plan.

use super::Plan;
use crate::clearance::{Nearest, Poses, between_steps};
use crate::draping::free_curves;
use crate::draping::reach::outside;
use crate::draping::record::{Step, Summary};
use crate::measure::{
    self, Found, Measures, Name, Site, Verdict, Worst, clearance_found, fastest_tilt, since,
    window_of,
};
use crate::mold::vector::distance;
use crate::motion::{Attitudes, Bounds, TimedMotion};
use crate::pick_up::Moved;
use crate::planner::evaluation::clearance_verdict;
use crate::planner::plan::{judge_whole, rates, tool_rates};
use crate::scene::Scene;
use crate::tool::ToolPeaks;
use rayon::prelude::*;

/// The recorded steps, moved, with the grippers where the motion has them.
pub fn steps(plan: Plan, motion: &TimedMotion, moved: &[Moved], last_free: usize) -> Vec<Step> {
    let mut steps = plan.steps.to_vec();
    let targets = plan.scene.target.as_ref().map(|target| &target.grippers);
    for (k, step) in steps.iter_mut().take(last_free + 1).enumerate() {
        let moved = &moved[k];
        for (n, gripper) in step.grippers.iter_mut().enumerate() {
            let commanded = motion.positions()[k][n];
            match &mut gripper.mount {
                None => gripper.position = commanded,
                Some(mount) => {
                    gripper.position = moved.place(gripper.position);
                    mount.commanded = commanded;
                    mount.force = moved.turn(mount.force);
                    let [x, y, _] = moved.turn([mount.slip[0], mount.slip[1], 0.0]);
                    mount.slip = [x, y];
                }
            }
            gripper.quaternion = moved.orientation(gripper.quaternion);
            if let (Some(far), Some(targets)) = (&mut gripper.target_distance_mm, targets) {
                *far = distance(gripper.position, targets[n]) * 1e3;
            }
        }
        for bridge in step.catenaries.iter_mut().filter_map(|line| line.bridging.as_mut()) {
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

/// How fast the gripper that tilts fastest does so in each step, at times of the steps (s).
pub fn tilt_rates(steps: &[Step], times: &[f64]) -> Vec<Option<Found>> {
    let turned: Vec<Vec<[f64; 4]>> =
        steps.iter().map(|step| step.grippers.iter().map(|g| g.quaternion).collect()).collect();
    let window = window_of(times.last().copied().unwrap_or(0.0));
    let rate = |k: usize| {
        let earlier = times[..k].iter().copied().zip(turned[..k].iter().map(Vec::as_slice));
        let positions: Vec<_> = steps[k].grippers.iter().map(|g| g.position).collect();
        fastest_tilt(&positions, &turned[k], since(earlier, times[k], window), window)
    };
    (0..steps.len()).map(rate).collect()
}

/// Measures the steps again as far as they are moved or faster.
pub fn measure(plan: Plan, steps: &mut [Step], moved: &[Moved], last_free: usize) {
    let scene = plan.scene;
    let times: Vec<f64> = steps.iter().map(|step| step.time).collect();
    let tilts = tilt_rates(steps, &times);
    let free = &steps[..=last_free];
    let changed = |k: &usize| !moved[*k].is_nothing() || (*k > 0 && !moved[*k - 1].is_nothing());
    let found: Vec<Vec<(Name, Option<Found>)>> = (0..free.len())
        .into_par_iter()
        .map(|k| match changed(&k) {
            true => places(scene, free, k),
            false => Vec::new(),
        })
        .collect();
    for (k, step) in steps.iter_mut().enumerate() {
        let mut measures: Measures = step
            .measures
            .iter()
            .map(|(name, worst)| {
                let place = match k <= last_free {
                    true => worst.place.map(|place| moved[k].place(place)),
                    false => worst.place,
                };
                (name, Worst { place, ..worst.clone() })
            })
            .collect();
        let duration = Found { value: step.time, site: Site::AllGrippers, place: None };
        let timed = [(Name::TiltRate, tilts[k]), (Name::Duration, Some(duration))];
        let again = found.get(k).into_iter().flatten().copied();
        for (name, found) in timed.into_iter().chain(again) {
            if measures.get(name).is_some() {
                measures.set(name, found.map(|found| Worst::of(&found, scene)));
            }
        }
        step.measures = measures;
    }
}

/// What depends on where the ply is, in one step.
fn places(scene: &Scene, steps: &[Step], k: usize) -> Vec<(Name, Option<Found>)> {
    let step = &steps[k];
    let commanded: Vec<_> = step.grippers.iter().map(|gripper| gripper.commanded()).collect();
    let mut out = Vec::new();
    if let Some(workspace) = scene.limits.workspace {
        out.push((Name::Workspace, outside(&commanded, workspace, scene.ply.cell)));
    }
    if let Some(target) = &scene.target {
        let mut most = measure::Most::default();
        for (n, (place, target)) in commanded.iter().zip(&target.grippers).enumerate() {
            most.meet(distance(*place, *target), Site::Gripper(n), *place);
        }
        out.push((Name::LandingGripper, most.in_units_of(1e-3)));
    }
    if let Some(mold) = &scene.mold {
        let mut most = measure::Most::default();
        for (n, points) in free_curves(&scene.ply, &scene.settings, step) {
            for point in points {
                most.meet(mold.signed_distance(point).max(0.0), Site::Catenary(n), point);
            }
        }
        out.push((Name::Gap, Some(most.in_units_of(1e-3).unwrap_or(Found::NONE))));
    }
    if !scene.bodies.is_empty() {
        let poses = |step: &Step| {
            let positions: Vec<_> = step.grippers.iter().map(|g| g.position).collect();
            let turned: Vec<_> = step.grippers.iter().map(|g| g.quaternion).collect();
            let commanded: Vec<_> = step.grippers.iter().map(|g| g.commanded()).collect();
            Poses::of(scene, &positions, &turned, &commanded)
        };
        let before = &steps[k.saturating_sub(1)];
        let nearest = between_steps(scene, &poses(before), &poses(step));
        let time = |share: f64| before.time + share * (step.time - before.time);
        let found = nearest.map(|nearest| clearance_found(&nearest, time(nearest.time)));
        out.push((Name::Clearance, found));
    }
    out
}

/// What an outcome is judged by.
#[derive(Debug)]
pub struct Outcome<'a> {
    /// The corrected motion.
    pub motion: &'a TimedMotion,
    /// How its grippers are turned.
    pub attitudes: &'a Attitudes,
    /// How many times as long it takes.
    pub longer: f64,
    /// The rates of the tool along it.
    pub tool: Option<ToolPeaks>,
    /// The nearest bodies of the planned motion from the last free step on.
    pub landing: Option<Nearest>,
    /// The last step, from 0, in which nothing touches the mold.
    pub last_free: usize,
}

impl Outcome<'_> {
    /// The outcome along the steps.
    pub fn summary(&self, plan: Plan, steps: &[Step], moved: &[Moved]) -> Summary {
        let scene = plan.scene;
        let mut summary = plan.summary.clone();
        summary.worst = measure::worst_numbers(steps.iter().map(|step| &step.measures));
        summary.last = measure::last_numbers(steps.last().map(|step| &step.measures));

        // where what stays was worst, and what was measured again
        let place = |verdict: &mut Verdict| {
            let step = verdict.step.map_or(usize::MAX, |step| step - 1);
            if step <= self.last_free {
                verdict.place = verdict.place.map(|place| moved[step].place(place));
            }
        };
        summary.limits.iter_mut().for_each(place);
        for name in [Name::TiltRate, Name::Workspace, Name::Duration, Name::Clearance] {
            let again = name.measure().limit(scene).and_then(|limit| worst(name, steps, limit));
            if let Some(again) = again {
                replace(&mut summary.limits, again);
            }
        }
        if let Some(whole) = self.clearance(scene) {
            judge_whole(&mut summary, whole);
        }
        let bounds = Bounds::from(&scene.limits);
        for again in rates(self.motion, &bounds, scene) {
            replace(&mut summary.limits, again);
        }
        if let (Some(tool), Some(peaks)) = (&scene.tool, &self.tool) {
            for again in tool_rates(tool, peaks, self.motion, scene) {
                replace(&mut summary.limits, again);
            }
            let carried = tool.carry(self.motion.positions()).record;
            if let Some(planned) = &plan.summary.tool {
                let kept = carried.residual_mm <= planned.residual_mm;
                let record = if kept { carried.with_residual_of(planned) } else { carried };
                summary.follow_tool(scene, record);
            }
        }

        if let Some(sheet) = &mut summary.sheet {
            sheet.limits.iter_mut().for_each(place);
            let planned = plan.steps.last().map_or(0.0, |step| step.time);
            for event in &mut sheet.events {
                event.time = match event.time < planned {
                    true => event.time * self.longer,
                    // how long pads press after the motion is the scene's
                    false => self.motion.duration() + (event.time - planned),
                };
            }
        }
        let sample = summary.sample.as_ref().is_none_or(|sample| sample.ok);
        summary.accepted = summary.accepted_without_errors() && sample;
        summary
    }

    /// The verdict on the nearest bodies along the whole motion.
    fn clearance(&self, scene: &Scene) -> Option<Verdict> {
        let until = self.motion.times()[self.last_free];
        let landing =
            self.landing.map(|nearest| Nearest { time: nearest.time * self.longer, ..nearest });
        // only what is nearer than the landing is looked for on the way
        let below = landing.map_or(f64::INFINITY, |nearest| nearest.distance);
        let times = [0.0, until];
        let way = Nearest::of_motion_within(scene, self.motion, self.attitudes, times, below);
        let nearest = way.or(landing)?;
        let times = self.motion.times();
        let step = times.partition_point(|t| *t < nearest.time) + 1;
        Some(clearance_verdict(scene, &nearest, step.min(times.len())))
    }
}

/// The verdict on a measure by its worst step.
fn worst(name: Name, steps: &[Step], limit: f64) -> Option<Verdict> {
    let sense = name.measure().sense();
    let values = steps.iter().filter_map(|step| Some((step.step, step.measures.get(name)?)));
    let (step, worst) =
        values.reduce(|most, next| match sense.is_worse(next.1.value, most.1.value) {
            true => next,
            false => most,
        })?;
    Some(Verdict::of(name, worst.clone(), limit, Some(step)))
}

/// Puts a verdict in the place of the earlier one on the same, behind those that no plan can keep; where there is none, at the end.
fn replace(limits: &mut Vec<Verdict>, again: Verdict) {
    match limits.iter_mut().rfind(|verdict| verdict.name == again.name && verdict.step.is_some()) {
        Some(verdict) => *verdict = again,
        None => limits.push(again),
    }
}
