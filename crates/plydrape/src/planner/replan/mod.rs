//! A planned motion for a ply that does not lie where it was planned to lie.
//!
//! The grippers meet the same points of the fabric, so the start is that of the plan, moved as one body: shifted by d and turned by φ about
//! an upright axis through the middle of the grippers. Step k of the transport is moved alike, by a share w_k of both,
//!
//! `p ↦ p + w_k d + (R(w_k φ) − 1)(p − c_k)`
//!
//! with c_k the middle of the grippers in that step. A shift and a turn about the vertical change no distance of two grippers, no weight
//! and no slope, so the ply has the shape and the forces of the plan. w falls from 1 at the pick-up to 0 before the ply
//! first meets the mold. From there on the motion is the planned one, and so is the landing with its verdict.
//!
//! 1. `fade`: the share in each step: 1 until the ply is clear of the obstacles it may lie on, then down over all that is left of the
//!    transport, because the longer that takes, the slower it is;
//! 2. `correction`: the control points whose path passes the moved steps;
//! 3. `shapes`: the recorded ply in each step, and whether it meets the mold where it is moved;
//! 4. `record`: the steps and the outcome, moved; what depends on the motion is measured and judged again.
//!
//! [`Replanner`] prepares what does not depend on the offset, so that a cell has an answer for each ply at once.

mod correction;
mod fade;
mod record;
mod shapes;
#[cfg(test)]
mod tests;
mod tuning;

pub use shapes::SheetShapes;

use crate::Error;
use crate::clearance::Nearest;
use crate::layup::{Release, SheetTime};
use crate::measure::Name;
use crate::motion::{Attitudes, TimedMotion};
use crate::outcome::{Step, Summary, attitudes};
use crate::pick_up::{Moved, Offset};
use crate::planner::cycle::Cycle;
use crate::planner::record::{PickedUp, PlanRecord};
use crate::planner::tuning::TUNING;
use crate::scene::Scene;
use crate::tool::ToolPeaks;
use shapes::Shapes;

/// A plan that was found and draped, with all that a correction needs of it.
#[derive(Debug, Clone, Copy)]
pub struct KnownPlan<'a> {
    /// Scene; the motion in it does not count.
    pub scene: &'a Scene,
    /// What its motion is made of.
    pub record: &'a PlanRecord,
    /// The steps of the drape along it, by the model that decides.
    pub steps: &'a [Step],
    /// The outcome.
    pub summary: &'a Summary,
}

/// Answers where a ply lies with a motion.
#[derive(Debug)]
pub struct Replanner<'a> {
    scene: &'a Scene,
    record: &'a PlanRecord,
    /// The steps and the outcome of the plan, in the time of the drape alone.
    steps: Vec<Step>,
    summary: Summary,
    /// The motion of the drape alone, and with all that comes before it and after it.
    motion: TimedMotion,
    whole: TimedMotion,
    /// The control points of the path that the steps of the motion pass (m), one list a step.
    path: Vec<Vec<[f64; 3]>>,
    /// The middle of the grippers in each step (m).
    middles: Vec<[f64; 2]>,
    /// Share of the offset in each step.
    weights: Vec<f64>,
    /// The last step, from 0, in which nothing touches the mold.
    last_free: usize,
    shapes: Shapes,
    /// The nearest bodies from the last free step on, where the motion stays.
    landing: Option<Nearest>,
}

/// A corrected plan.
#[derive(Debug, Clone)]
pub struct Replanned {
    /// What its motion is made of again, with the offset.
    pub record: PlanRecord,
    /// The motion in time.
    pub motion: TimedMotion,
    /// How the grippers are turned in it.
    pub attitudes: Attitudes,
    /// How many times as long as the planned motion it takes.
    pub longer: f64,
    /// The steps of the drape along it, by the model that decides.
    pub steps: Vec<Step>,
    /// The outcome: what belongs to the landing is that of the plan, what belongs to the motion is judged again.
    pub summary: Summary,
    /// How the ply of each step was moved.
    moved: Vec<Moved>,
    /// When the drape begins in the planned motion and in this one (s).
    begins: [f64; 2],
    /// When it ends in this one (s).
    ends: f64,
}

impl Replanned {
    /// Where a point (m) of the recorded ply is in a step, from 0, of the corrected motion.
    #[must_use]
    pub fn place(&self, step: usize, point: [f64; 3]) -> [f64; 3] {
        self.moved.get(step).map_or(point, |moved| moved.place(point))
    }

    /// A vector in that step, such as a force.
    #[must_use]
    pub fn turn(&self, step: usize, vector: [f64; 3]) -> [f64; 3] {
        self.moved.get(step).map_or(vector, |moved| moved.turn(vector))
    }

    /// An orientation (x, y, z, w) in that step.
    #[must_use]
    pub fn orientation(&self, step: usize, quaternion: [f64; 4]) -> [f64; 4] {
        self.moved.get(step).map_or(quaternion, |moved| moved.orientation(quaternion))
    }

    /// Whether the ply of that step is moved at all.
    #[must_use]
    pub fn is_moved(&self, step: usize) -> bool {
        self.moved.get(step).is_some_and(|moved| !moved.is_nothing())
    }

    /// The time (s) in the corrected motion of one of the planned motion, after whose last step at `planned_duration` (s) pads may press for
    /// some more time.
    #[must_use]
    pub fn time(&self, planned: f64, planned_duration: f64) -> f64 {
        match planned < planned_duration {
            true => self.begins[1] + (planned - self.begins[0]) * self.longer,
            false => self.ends + (planned - planned_duration),
        }
    }
}

impl<'a> Replanner<'a> {
    /// Prepares a plan; where the sheet decides, with its recorded states.
    ///
    /// # Errors
    /// [`Error::ReplanAgain`] if the plan was corrected before; [`Error::ReplanRealTime`], [`Error::ReplanUnfinished`], [`Error::ReplanNoShapes`]
    /// or [`Error::ReplanMotion`] if its drape says too little; [`Error::ReplanNoTransport`] if it has no transport in which an offset could
    /// be taken out.
    pub fn new(plan: KnownPlan<'a>, sheet: Option<&SheetShapes>) -> Result<Self, Error> {
        let KnownPlan { scene, record, steps, summary } = plan;
        if record.picked_up.is_some() {
            return Err(Error::ReplanAgain);
        }
        if scene.layup.settings.sheet.time == SheetTime::Real && summary.sheet.is_some() {
            return Err(Error::ReplanRealTime);
        }
        let motion = record.drape_motion().map_err(Error::ReplanMotion)?;
        let whole = record.motion().map_err(Error::ReplanMotion)?;
        let count = motion.times().len();
        if summary.steps != summary.steps_planned || steps.len() != count || count < 2 {
            return Err(Error::ReplanUnfinished { steps: steps.len(), planned: count });
        }
        // an offset must be taken out before the ply lands; events get their times in the motion of the drape alone
        let first = summary.first_contact_step();
        let last_free = summary.last_free(count);
        let (mut steps, mut summary) = (steps.to_vec(), summary.clone());
        record::times(&mut steps, &motion);
        if let Some(cycle) = &record.cycle {
            for event in &mut summary.events {
                event.time = cycle.before_delay(event);
            }
        }
        let mut shapes = Shapes::new(scene, &steps, sheet, last_free);
        if shapes.is_empty() {
            return Err(Error::ReplanNoShapes);
        }
        // a ply that lies on a table is off as a whole until it is lifted
        let lifted = scene.layup.pick_up.map_or(0, |pick_up| pick_up.lift_steps);
        let clear = shapes.clear_of_obstacles(scene).max(lifted);
        let weights = fade::weights(motion.parameter(), clear, last_free)
            .ok_or(Error::ReplanNoTransport { clear: clear + 1, first })?;
        shapes.measure(scene);

        let middle = |places: &Vec<[f64; 3]>| {
            [0, 1].map(|c| places.iter().map(|p| p[c]).sum::<f64>() / places.len() as f64)
        };
        let middles = motion.positions().iter().map(middle).collect();
        // bodies come no nearer than they did from the last free step on, where nothing is corrected any more
        let landing = match scene.layup.bodies.is_empty() {
            true => None,
            false => {
                let times = [motion.times()[last_free], motion.duration()];
                let attitudes = attitudes(&steps).map_err(Error::ReplanMotion)?;
                let least = scene.limits.least(Name::Clearance);
                // the arm keeps the configuration of the plan
                let arm = summary.tool.as_ref().and_then(|tool| tool.arm);
                Nearest::of_motion_within(
                    &scene.layup.beginning_as(arm.as_ref()),
                    least,
                    scene.plan.rate,
                    &motion,
                    &attitudes,
                    times,
                    f64::INFINITY,
                )
            }
        };
        let path = TimedMotion::moving(&record.path);
        Ok(Replanner {
            scene,
            record,
            steps,
            summary,
            motion,
            whole,
            path,
            middles,
            weights,
            last_free,
            shapes,
            landing,
        })
    }

    /// The planned motion.
    #[must_use]
    pub fn planned(&self) -> &TimedMotion {
        &self.whole
    }

    /// The plan in the time of the drape alone.
    fn plan(&self) -> KnownPlan<'_> {
        let Replanner { scene, record, steps, summary, .. } = self;
        KnownPlan { scene, record, steps, summary }
    }

    /// Share of the offset in each step of the motion.
    #[must_use]
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// The motion for a ply that lies off by `offset`; `residual` is what seen points leave of it (m), for the record.
    ///
    /// # Errors
    /// [`Error::ReplanOffset`] if the offset is no number; [`Error::ReplanTouches`] if the ply would touch the mold before the planned landing;
    /// [`Error::ReplanNotRigid`], [`Error::ReplanDwells`] or [`Error::ReplanMotion`] if it could not be carried there as one body.
    pub fn replan(&self, offset: &Offset, residual: Option<f64>) -> Result<Replanned, Error> {
        let Replanner { scene, record, .. } = *self;
        if !offset.is_near() {
            return Err(Error::ReplanOffset);
        }
        let offset = offset.about(self.middles[0]);
        let moved: Vec<Moved> = self
            .middles
            .iter()
            .zip(&self.weights)
            .map(|(middle, weight)| {
                Moved::new(*middle, offset.shift.map(|c| weight * c), weight * offset.yaw)
            })
            .collect();

        // the path through the moved steps, and its time
        let path = correction::corrected(&self.motion, &self.path, &moved, self.last_free);
        // the offset changes the transport alone
        let bounds = scene.limits.transport_bounds();
        let bounds = bounds.unwrap_or_else(|| scene.limits.motion_bounds());
        let mut motion = self.motion.moved(&path, &bounds).map_err(Error::ReplanMotion)?;
        correction::rigid(scene, &self.motion, &motion, self.last_free)?;
        if let Some(touch) = self.shapes.touches(scene, &moved) {
            return Err(touch);
        }

        // slower, where grippers or the tool would turn too fast
        let mut steps = record::steps(self.plan(), &motion, &moved, self.last_free);
        record::times(&mut steps, &motion);
        let fastest = record::fastest_tilt(scene, &motion, &steps);
        let limit = scene.limits.most(Name::TiltRate).to_degrees();
        let planned = self.summary.worst.value(Name::TiltRate).unwrap_or(0.0);
        // the time over which a rate is taken grows with the motion, so a rate is as much smaller as the motion is longer
        let turned = (fastest / limit.max(planned)).max(1.0);
        let peaks = |motion: &TimedMotion| -> Option<ToolPeaks> {
            scene.layup.tool.as_ref()?.peaks(motion, motion.fitting_rate(scene.plan.rate)).ok()
        };
        let carried = match (&peaks(&motion), &scene.layup.tool) {
            (Some(peaks), Some(tool)) if peaks.stretch(tool) > 1.0 => {
                TUNING.sampled_margin * peaks.stretch(tool)
            }
            _ => 1.0,
        };
        let slowed = turned.max(carried);
        if slowed > 1.0 {
            motion = motion.slowed(slowed);
        }
        let longer = match self.motion.duration() > 0.0 {
            true => motion.duration() / self.motion.duration(),
            false => 1.0,
        };
        let dwells = scene.layup.release.as_ref().is_some_and(Release::dwells_on_the_way);
        if longer > 1.0 && dwells {
            return Err(Error::ReplanDwells { longer });
        }

        // with what the grippers do before it and after it
        let cycle = Cycle::around(scene, &motion)?;
        let begins = [&record.cycle, &cycle].map(|cycle| cycle.as_ref().map_or(0.0, Cycle::begins));
        let drape = motion;
        let motion = match &cycle {
            Some(cycle) => cycle.whole(&drape).map_err(Error::ReplanMotion)?,
            None => drape.clone(),
        };
        let ends = begins[1] + drape.duration();
        record::times(&mut steps, &motion);
        let attitudes = attitudes(&steps).map_err(Error::ReplanMotion)?;
        record::places(&mut steps, &moved, self.last_free);
        let corrected = record::CorrectedMotion {
            motion: &motion,
            attitudes: &attitudes,
            longer,
            begins: begins[1],
            grip: cycle.as_ref().map_or(0.0, |cycle| cycle.grip),
            ends,
            tool: peaks(&motion),
            landing: self.landing,
            last_free: self.last_free,
        };
        let summary = corrected.summary(self.plan(), &mut steps, &moved);
        let picked_up = PickedUp { offset, residual, weights: self.weights.clone() };
        // what limited the plan need not limit this motion
        let limited_by = Vec::new();
        let (method, evaluations) = (record.method, record.evaluations);
        let rate = motion.fitting_rate(record.rate);
        let record = PlanRecord {
            picked_up: Some(picked_up),
            cycle,
            ..PlanRecord::new(method, evaluations, rate, path, &drape, limited_by)
        };
        Ok(Replanned { record, motion, attitudes, longer, steps, summary, moved, begins, ends })
    }
}
