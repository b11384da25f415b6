//! Clearance: how far the bodies that grippers and robot carry stay from the mold, from what stands in the cell, and from
//! each other, along a whole motion.
//!
//! 1. `body`: what is carried and what stands there: cylinders, boxes and meshes;
//! 2. `poses`: where the pads, the stems and the flange are at one time;
//! 3. `moves`: how they move between two times, with bounds of how far and how much they turn;
//! 4. `solid`: the distance of two shapes, by the crate `parry` (this is the only file that knows it);
//! 5. `surface`, `triangles`, `over_mold`: the distance of a body from the mold, by the mold's own distance from points of the body;
//! 6. `nearest`: the nearest pair along a motion, found with a bound that no sampling misses.
//!
//! Judged are: every body against every obstacle, bodies of different grippers against each other, and all but pads against the
//! mold. Pads press the ply on the mold, so they are not judged there. Bodies of one gripper are not judged against each other, and
//! bodies of the flange are not judged against those of the grippers that it carries.

mod body;
mod moves;
mod nearest;
mod over_mold;
mod poses;
mod solid;
mod surface;
mod triangles;
mod tuning;

pub use body::{Bodies, Body, Mount, Obstacle, Shape};
pub use nearest::{Near, Nearest, Part, at};
pub(crate) use nearest::{along_positions, between_steps, from_obstacles, label};
pub use poses::Poses;

#[cfg(test)]
mod tests;
