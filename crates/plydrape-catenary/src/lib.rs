#![doc = include_str!("../README.md")]
//!
//! # Stages
//!
//! A folder is a stage of the method, and each uses only those above it; a test holds that order.
//!
//! | stage | what it is |
//! |---|---|
//! | [`catenary`] | one span in closed form |
//! | [`elastica`] | one strip of any sag, without the assumption of small slopes |
//! | [`equilibrium`] | all forces and shared slopes at given positions of the grippers |
//! | [`draping`] | the motion step by step, with contact |
//! | [`sensitivity`] | quantities of a solved ply, with exact gradients to the positions of the grippers |
//! | [`stepwise`] | a planner that solves a quadratic program for each step |
//!
//! What is draped, a [`Layup`], and what comes of it, a [`state::PlyState`], are those of every model of the ply: their modules are those of
//! `plydrape-layup`, which this crate hands on.
//!
//! # One span
//!
//! 100 mm of ply between two grippers 98 mm apart pull with 0.4173 N and sag by 8.7 mm:
//!
//! ```
//! use plydrape_catenary::catenary::{EndCondition, Profile, Span};
//!
//! let span = Span {
//!     run: 0.098,
//!     rise: 0.0,
//!     length: 0.1,
//!     ends: [EndCondition::Free; 2],
//!     weight: 0.3143 * 9.8,
//!     flexural_rigidity: 9e-6,
//!     axial_stiffness: f64::INFINITY,
//! };
//! let force = span.solve(None).force.expect("a span with slack hangs");
//! let sag = -Profile::new(&span, force).station(0.5 * span.run).z;
//! assert!((force - 0.41728).abs() < 1e-5 && (sag - 8.7022e-3).abs() < 1e-7);
//! ```
//!
//! SI units throughout, z up, gravity along −z. With the feature `serde` states can be written by serde.

pub mod catenary;
pub mod draping;
pub mod elastica;
pub mod equilibrium;
mod error;
pub mod sensitivity;
pub mod stepwise;

pub use equilibrium::Solver;
pub use error::Error;
pub use plydrape_layup::{
    Error as LayupError, Layup, Material, Mold, Motion, Ply, Settings, Target, geometry, layup,
    material, mold, motion, ply, state, stopwatch,
};
