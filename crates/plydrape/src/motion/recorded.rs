//! The motion of a recorded drape, read from its plan and its steps.

use super::{Attitudes, MotionError, TimedMotion};
use crate::draping::record::{LimitedBy, PlanRecord, Step};
use crate::scene::PlanMethod;

impl PlanRecord {
    /// The record of a motion of planned positions.
    #[must_use]
    pub fn of(
        method: PlanMethod,
        evaluations: usize,
        rate: f64,
        path: Vec<Vec<[f64; 3]>>,
        motion: &TimedMotion,
        limited_by: Vec<LimitedBy>,
    ) -> Self {
        let (spacing, law) = (motion.spacing(), motion.law());
        PlanRecord { method, evaluations, rate, limited_by, path, spacing, law, picked_up: None }
    }

    /// The motion at any time.
    ///
    /// # Errors
    /// [`MotionError`] if the plan is none that a planner has made.
    pub fn motion(&self) -> Result<TimedMotion, MotionError> {
        TimedMotion::recorded(&self.path, &self.spacing, &self.law)
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
