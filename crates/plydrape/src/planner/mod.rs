//! How the grippers must move so that the ply lies where the ideal drape has it, without wrinkles.
//!
//! 1. [`obstacles`]: what no plan can keep, found before any search;
//! 2. [`path`]: whole trajectories of few parameters, judged by complete drapes, on all cores;
//! 3. [`stepwise`]: step by step, each a quadratic program, as Krogh et al. 2018 sketch it;
//! 4. [`sensitivity`]: what both look at in a solved ply, with exact gradients;
//! 5. [`judge`]: the complete drape along a plan, and how far its worst measure is from its limit;
//! 6. `plan`: from a scene to a motion in time and the drape along it.

pub mod board;
pub mod judge;
mod memory;
pub mod obstacles;
pub mod path;
mod plan;
mod program;
pub mod sensitivity;
pub mod stepwise;

pub use board::{Progress, Watcher};
pub use memory::Memory;
pub use plan::{PlanError, Planned, plan};
