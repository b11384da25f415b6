//! Bodies: what grippers and robot carry, and what stands in the cell.
//!
//! 1. `body`: cylinders, boxes and meshes, what they move with, and obstacles;
//! 2. `solid`: the distance of two shapes, by the crate `parry` (this is the only file that knows it);
//! 3. `surface`, `triangles`: points of a body's surface, for its distance from a mold.

mod body;
mod solid;
mod surface;
mod triangles;

pub(crate) use body::Solids;
pub use body::{Bodies, Body, Mount, Obstacle, Shape};
pub(crate) use solid::{Apart, Solid, between_segments};
pub(crate) use surface::{Patch, Surface};
