//! Whole trajectories, judged by complete drapes, section 17 of `docs/theory`.

mod formation;
mod quick;
mod refine;
mod search;
mod strategy;
mod trajectory;

pub use formation::{Formation, Ground};
pub use refine::correction;
pub use search::{Candidate, search};
pub use strategy::Strategy;
pub use trajectory::{longest_move, trajectory};
