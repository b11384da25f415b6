//! Whole trajectories, evaluated by complete drapes, section 17 of `docs/theory`.

mod formation;
mod fronts;
mod geometry;
pub mod preload;
mod search;
mod start;
mod strategy;
mod tabulation;
mod taut;
mod trajectory;
mod transport;
pub mod tuning;

pub use formation::{Formation, MoldHeights};
pub(super) use fronts::Fronts;
pub use search::most_candidates;
pub(super) use search::search;
pub use start::LowStart;
pub use strategy::Strategy;
pub use trajectory::trajectory;
pub(super) use transport::bilinear;
pub use transport::transport;
