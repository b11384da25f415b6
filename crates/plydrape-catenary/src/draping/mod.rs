//! The catenaries' model of the ply: gripper positions step by step, the equilibrium at each, and the contact with the mold.
//!
//! [`follow`] is one loop, the paper's section 4: move the grippers ([`crate::motion::Motion`]), solve the equilibrium
//! ([`crate::equilibrium`]), find the contact, and hand over the ply as any model says it ([`PlyState`](crate::state::PlyState)), with
//! the catenaries themselves ([`record`]) where they are recorded. What is measured and judged follows from the states.
//!
//! 1. `stepping`: one move of the grippers; `contact`, `gap`, `sampling`, `bridge`: how the contact follows;
//! 2. `spans`, `snapshot`: the ply as it was solved; `attitude`, `misfit`, `landing`, `load`: what follows from that; `solved_step`
//!    computes it when it is needed;
//! 3. `ply_state`, `recording`: what is handed over of a step; `stop`: where no ply would survive;
//! 4. `curves`: the shapes of a recorded step.

pub(crate) mod attitude;
mod bracket;
mod bridge;
mod contact;
mod curves;
mod follow;
#[doc(hidden)]
pub mod gap;
mod landing;
mod load;
pub(crate) mod misfit;
mod ply_state;
#[cfg(test)]
mod ply_state_tests;
pub mod record;
mod recording;
#[doc(hidden)]
pub mod sampling;
mod snapshot;
mod solved_step;
pub mod spans;
mod stepping;
mod stop;
mod tuning;

pub(crate) use attitude::attitude;
pub use curves::{curves, free_curves};
pub use follow::{Follow, Followed, follow};
pub(crate) use landing::fabric;
pub(crate) use misfit::{lying_segments, misfit};
pub use snapshot::ContactStatus;
pub(crate) use snapshot::{CellShear, Snapshot};
pub use stepping::Draping;
