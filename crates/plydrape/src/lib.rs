//! How an array of grippers must move to lay a carbon-fiber ply on a curved mold without wrinkles.
//!
//! The ply is a net of catenaries with bending stiffness hung between the grippers, with large shear and mold
//! contact, after Krogh, Jakobsen and Sherwood 2018 (arXiv:1810.07619). A span of ply with horizontal force *H*,
//! flexural rigidity *EI* and load *q* per horizontal length has the shape *z*(*x*) with
//!
//! *H z″ − EI z⁗ = q*
//!
//! and *H* follows from its length. The forces of all spans and the slopes that they share at the grippers are the
//! solution of a small nonlinear program. Equations are numbered in `docs/theory` of the project.
//!
//! # One span
//!
//! 100 mm of ply between two grippers 98 mm apart pull with 0.4173 N and sag by 8.7 mm:
//!
//! ```
//! use plydrape::catenary::{EndCondition, Profile, Span};
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
//! # A drape
//!
//! [`simulate`] moves the grippers of a [`Scene`] and follows the ply, [`plan`] finds the motion. The crate `plydrape-io`
//! reads scenes from files and writes results; `examples/drape.rs` makes a scene without a file.
//!
//! # Modules
//!
//! They follow the stages of the method, and data flows one way:
//!
//! 1. [`mold`], [`catenary`], [`elastica`]: the surface, and one span of ply, in closed form or exact;
//! 2. [`net`]: the ideal drape, where every point of the fabric should end on the mold;
//! 3. [`material`], [`ply`]: grippers, edges, diagonals and shear;
//! 4. [`scene`], [`preset`]: everything that one drape needs, and named sets of limits;
//! 5. [`equilibrium`]: all horizontal forces and shared slopes at given gripper positions;
//! 6. [`draping`]: the motion step by step, with contact;
//! 7. [`clearance`]: how far bodies of grippers and robot stay from mold, obstacles and each other;
//! 8. [`measure`]: what is measured of a step, limits, and the verdict;
//! 9. [`motion`]: positions step by step become smooth in time, within limits of speed, acceleration, jerk;
//! 10. [`planner`]: gripper trajectories, and limits that no trajectory can keep;
//! 11. [`tool`]: the frame and axes of a robot that carries the grippers, and the motion that it makes;
//! 12. [`errors`]: how far a real cell may be from its scene, and the scene of one such cell;
//! 13. [`pick_up`]: where the ply was picked up, if not where it was planned.
//!
//! SI units throughout, z up, gravity along −z. This crate reads and writes no files; with the feature `serde` its types
//! can be written by serde.

pub mod bodies;
pub mod catenary;
pub mod clearance;
pub mod draping;
pub mod elastica;
pub mod equilibrium;
pub mod errors;
pub mod fit;
pub mod geometry;
pub mod layup;
pub mod material;
pub mod measure;
pub mod mold;
pub mod motion;
pub mod net;
pub mod outcome;
pub mod pick_up;
pub mod planner;
pub mod ply;
pub mod scene;
pub mod sheet;
pub mod state;
mod stopwatch;
pub mod tool;

pub use equilibrium::Solver;
pub use errors::Errors;
pub use layup::{Layup, Settings, Target};
pub use material::Material;
pub use measure::Limits;
pub use mold::Mold;
pub use motion::Motion;
pub use outcome::{ModelError, Outcome, simulate};
pub use planner::{Planned, plan};
pub use ply::Ply;
pub use scene::{Plan, Scene};
