//! The outcome of a stepwise plan.

use crate::geometry::Point;
use crate::ply::GripperId;

/// A planned motion and how the planning ended.
#[derive(Debug, Clone, PartialEq)]
pub struct Stepwise {
    /// Positions (m) of each step, the start first, in the order of [`crate::ply::Ply::index`].
    pub positions: Vec<Vec<Point>>,
    /// How it ended.
    pub outcome: StepwiseEnd,
}

/// How a stepwise plan ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum StepwiseEnd {
    /// Every gripper stands on its target.
    Arrived,
    /// The steps are used up: the gripper that is farthest from its target.
    OutOfSteps(PositionError),
    /// The longest moves in all steps do not reach the target: the gripper with the largest shortfall, and the shortfall.
    OutOfReach(PositionError),
    /// The caller ended it.
    Interrupted,
    /// The layup has no target.
    NoTarget,
}

/// A gripper and its distance from where it should be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PositionError {
    /// The gripper.
    pub gripper: GripperId,
    /// Distance (m).
    pub distance: f64,
}
