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
        let motion = TimedMotion::new(&self.path, &Bounds::from(limits))?;
        Ok(if self.slowed > 1.0 { motion.slowed(self.slowed) } else { motion })
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
