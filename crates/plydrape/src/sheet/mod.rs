//! The whole ply as a sheet of yarn segments and cells, between and beyond the grippers.
//!
//! The catenaries are right along the lines between grippers and blind inside the cells, where a woven ply hangs lower
//! and touches first. The sheet has nodes where the fabric's own lines cross; between neighbors along a line are yarn
//! segments that stretch (`stretch`), three in a row bend (`bending`), and four around a cell shear (`shear`). Pads
//! hold their nodes (`gripper`) until they let go (`release`, `event`), the mold carries what touches it and friction holds it (`contact`). Implicit
//! time steps with real mass (`cloth`) follow the motion of the grippers (`drape`).
//!
//! What measures ask of it is handed over as a [`crate::state::PlyState`] (`hand_over`). Lengths in meters, forces in newtons, angles in radians.

mod bending;
pub mod cholesky;
mod cloth;
mod configuration;
mod contact;
mod drape;
mod energy;
pub mod event;
pub mod fabric;
mod friction;
mod gripper;
mod hand_over;
mod inertia;
mod march;
mod model;
mod mount;
mod newton;
mod pads;
mod raised;
mod release;
mod report;
mod resting;
mod shear;
mod state;
mod stretch;
mod system;
mod tuning;
mod unknowns;
mod weight;

pub use drape::{Status, drape, is_kept};
pub use event::{Event, EventKind};
pub use fabric::Fabric;
pub use gripper::{Gripper, Pad};
pub use hand_over::HandOver;
pub use model::{Sheet, SheetError, coarsest_mesh, pitch};
pub use raised::{Raised, raised};
pub use report::{Drape, Report};
pub use state::State;
pub use tuning::Tuning;

#[cfg(test)]
pub(crate) mod tests;
