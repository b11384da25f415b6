//! The motion of a recorded drape, made again from its plan and its steps.

use super::{Attitudes, Bounds, MotionError, TimedMotion};
use crate::draping::record::{PlanRecord, Step};
use crate::scene::Limits;

impl PlanRecord {
    /// The motion at any time, under the limits that it was planned for.
    ///
    /// # Errors
    /// [`MotionError`] if the plan is none that a planner has made.
    pub fn motion(&self, limits: &Limits) -> Result<TimedMotion, MotionError> {
        let bounds = Bounds::from(limits);
        let slower = |motion: TimedMotion, factor: f64| match factor > 1.0 {
            true => motion.slowed(factor),
            false => motion,
        };
        let planned = |path| TimedMotion::new(path, &bounds).map(|new| slower(new, self.slowed));
        let Some(picked_up) = &self.picked_up else { return planned(&self.path) };
        let moved = planned(&picked_up.planned)?.moved(&self.path, &bounds)?;
        Ok(slower(moved, picked_up.slowed))
    }
}

impl Attitudes {
    /// Orientations of the grippers between the steps of a drape.
    ///
    /// # Errors
    /// [`MotionError`] if there are no steps.
    pub fn of(steps: &[Step]) -> Result<Attitudes, MotionError> {
        let times: Vec<f64> = steps.iter().map(|step| step.time).collect();
        let quaternions: Vec<Vec<[f64; 4]>> = steps
            .iter()
            .map(|step| step.grippers.iter().map(|gripper| gripper.quaternion).collect())
            .collect();
        Attitudes::new(&times, &quaternions)
    }
}
