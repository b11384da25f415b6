//! Gripper motions that lay a ply where it belongs, without wrinkles.

pub mod sensitivity;
pub mod stepwise;
