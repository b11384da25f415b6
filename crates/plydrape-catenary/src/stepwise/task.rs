//! What the stepwise planner plans: a layup, in how many steps, within which limits.

use crate::layup::Layup;

/// A layup whose motion is to be planned.
#[derive(Debug, Clone, Copy)]
pub struct Task<'a> {
    /// The ply, its mold, its target and, as the first step of its motion, where the grippers start.
    pub layup: &'a Layup,
    /// Most steps of the motion, the start being the first.
    pub steps: usize,
    /// Farthest that a gripper may move in one step (m); `None` for a share of its distance to go.
    pub move_limit: Option<f64>,
    /// Limits of the ply and of the grippers.
    pub limits: Limits,
}

/// Limits that the stepwise planner keeps; infinite where there is none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Largest shear angle of a cell (rad).
    pub shear: f64,
    /// Largest angle between the normal of the ply at a gripper and the vertical (rad).
    pub tilt: f64,
    /// Largest horizontal force of a span (N).
    pub force: f64,
    /// Smallest distance between neighboring grippers (m). Infinite, they come no nearer to each other than they are.
    pub gripper_distance: f64,
    /// Largest stretch of an edge beyond its fabric, as a share of the whole edge.
    pub overstretch: f64,
    /// Largest slack of a free segment at the end, as a share of its length.
    pub slack_ratio: f64,
    /// Farthest that a gripper may end from its target (m).
    pub landing_gripper: f64,
    /// Box that the grippers can reach: [from, to] in x, y and z (m).
    pub workspace: Option<[[f64; 2]; 3]>,
}
