//! From a mold to gripper trajectories.

pub mod obstacles;
mod stand_in;

pub use stand_in::{Memory, PlanError, Planned, Progress, plan};
