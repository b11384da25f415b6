//! Gripper positions over the steps of a motion.

/// Gripper positions over the steps.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    /// Time of each step (s), ascending, from 0.
    pub times: Vec<f64>,
    /// Positions (m) of each step, in the order of [`crate::ply::Ply::index`].
    pub positions: Vec<Vec<[f64; 3]>>,
}
