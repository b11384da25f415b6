#![doc = include_str!("../README.md")]
//!
//! # Stages
//!
//! A folder is a stage, and each uses only those above it; a test holds that order.
//!
//! | stage | what it is |
//! |---|---|
//! | [`geometry`] | vectors, rotations, placements, closed lines in a plane |
//! | [`mold`] | the surface: its distance, closest point and paths along it |
//! | [`material`], [`ply`] | laws of the woven ply; its outline, grippers, lines and cells |
//! | [`net`] | the ideal drape: where every point of the fabric should end on the mold |
//! | [`motion`] | positions step by step become smooth in time, within limits of speed, acceleration and jerk |
//! | [`bodies`], [`arm`], [`tool`] | what grippers and robot carry, the robot's arm, and the frame that carries the grippers |
//! | [`layup`] | one ply and how it is laid |
//! | [`clearance`] | how far the bodies stay from the mold, from obstacles and from each other |
//! | [`placement`] | where the scene should stand for its robot |
//! | [`state`] | the ply after one step, as any model can say it |
//!
//! Equations are numbered in `docs/theory` of the project. With the feature `serde` molds, plies, motions and settings can be written by serde.

pub mod arm;
pub mod bodies;
pub mod clearance;
mod error;
pub mod geometry;
mod gripper;
pub mod layup;
pub mod material;
pub mod mold;
pub mod motion;
pub mod net;
pub mod placement;
pub mod ply;
pub mod state;
pub mod stopwatch;
pub mod tool;

pub use error::Error;
pub use layup::{Layup, Settings, Target};
pub use material::Material;
pub use mold::Mold;
pub use motion::Motion;
pub use ply::Ply;
