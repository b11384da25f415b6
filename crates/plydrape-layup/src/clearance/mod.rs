//! Clearance: how far the bodies that grippers and robot carry stay from the mold, from what stands in the cell, and from
//! each other, along a whole motion.
//!
//! 1. `poses`: where the pads, the stems and the flange are at one time;
//! 2. `moves`: how they move between two times, with bounds of how far and how much they turn;
//! 3. `over_mold`: the distance of a body from the mold, by the mold's own distance from points of the body;
//! 4. `nearest`: the nearest pair along a motion, found with a bound that no sampling misses.
//!
//! Judged are: every body against every obstacle, bodies of different grippers against each other, and all but pads against the
//! mold. Pads press the ply on the mold, so they are not judged there, and neither against the table from which they pick it up. Bodies of one gripper are not judged against each other, and
//! bodies of the flange are not judged against those of the grippers that it carries.

mod moves;
mod nearest;
mod over_mold;
mod poses;
mod tuning;

pub use nearest::{
    Near, Nearest, Part, at_poses, between_steps, from_obstacles, label, standing_in_mold,
};
pub use poses::Poses;

#[cfg(test)]
mod tests;
