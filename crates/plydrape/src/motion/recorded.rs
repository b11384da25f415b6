//! The motion of a result: made again from the plan that its file holds.

use super::{Attitudes, Bounds, MotionError, TimedMotion};
use crate::draping::record::ResultFile;

impl ResultFile {
    /// The motion of a planned drape at any time, and the orientations along it; none of a simulated one.
    ///
    /// # Errors
    /// [`MotionError`] if plan and steps are none that a planner has written.
    pub fn motion(&self) -> Result<Option<(TimedMotion, Attitudes)>, MotionError> {
        let Some(plan) = &self.plan else { return Ok(None) };
        let motion = TimedMotion::new(&plan.path, &Bounds::from(&self.scene.limits))?;
        let motion = if plan.slowed > 1.0 { motion.slowed(plan.slowed) } else { motion };
        Ok(Some((motion, self.attitudes()?)))
    }

    /// Orientations of the grippers between the steps.
    ///
    /// # Errors
    /// [`MotionError`] if there are no steps.
    pub fn attitudes(&self) -> Result<Attitudes, MotionError> {
        let times: Vec<f64> = self.steps.iter().map(|step| step.time).collect();
        let quaternions: Vec<Vec<[f64; 4]>> = (self.steps.iter())
            .map(|step| step.grippers.iter().map(|gripper| gripper.quaternion).collect())
            .collect();
        Attitudes::new(&times, &quaternions)
    }
}
