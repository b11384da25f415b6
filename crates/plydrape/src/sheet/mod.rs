//! The whole ply as a sheet of yarn segments and cells, between and beyond the grippers.
//!
//! The catenaries are right along the lines between grippers and blind inside the cells, where a woven ply hangs lower
//! and touches first. The sheet has nodes where the fabric's own lines cross (`fabric`). `docs/theory/sheet.md` has the
//! equations:
//!
//! - The energy is a sum of terms with one interface (`energy`), each of them a file: yarn segments between neighbors along a
//!   line stretch (`stretch`), three nodes in a row bend (`bending`), four around a cell shear (`shear`); the mold carries what
//!   touches it (`contact`) and friction holds it (`friction`), before that a `table` on which the ply lies; pads are on mounts
//!   (`mount`); nodes have `weight` and `inertia`.
//! - An implicit time step is solved by Newton's method in numbered stages (`newton`). Pads move with their grippers (`pads`),
//!   nodes that lie are left out (`resting`), and what is left are the unknowns (`unknowns`) of a linear system (`system`,
//!   [`block_cholesky`]). `cloth` has all of these together, in a `configuration`.
//! - Time steps bring the ply from the flat to rest (`march`), until and after pads let go (`release`, [`event`]); `drape` sees
//!   to what is seen of it in each step.
//!
//! What measures ask of it is handed over as a [`crate::state::PlyState`] (`hand_over`). Lengths in meters, forces in newtons, angles in radians.

mod bending;
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
mod lip;
mod march;
pub(crate) mod matrix3;
mod model;
mod mount;
mod newton;
mod pads;
mod raised;
pub(crate) mod release;
mod report;
mod resting;
mod rim;
mod shear;
mod state;
mod stretch;
mod system;
mod table;
mod tuning;
mod unknowns;
mod weight;

pub(crate) use drape::{Beginning, drape_from};
pub use drape::{Status, drape, is_kept};
pub use event::{Event, EventKind};
pub use fabric::Fabric;
pub use gripper::{Gripper, Pad};
pub use hand_over::HandOver;
pub use model::{Sheet, coarsest_mesh, pitch};
pub use raised::{Raised, raised};
pub use report::{Report, SheetDrape};
pub use state::ClothState;
pub use tuning::SheetTuning;

#[cfg(test)]
pub(crate) mod tests;
