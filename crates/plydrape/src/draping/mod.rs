//! The drape: gripper positions step by step, the equilibrium at each, and the contact with the mold.
//!
//! One loop, the paper's section 4: move the grippers ([`crate::scene::Motion`]), solve the equilibrium
//! ([`crate::equilibrium`]), find the contact (`contact`), measure ([`crate::measure`]) and record
//! ([`record`]). A search drapes in the same way and keeps only the verdicts (`judged`).

pub(crate) mod attitude;
mod bracket;
mod bridge;
mod contact;
mod curves;
#[doc(hidden)]
pub mod gap;
mod judged;
pub(crate) mod landing;
pub(crate) mod load;
pub(crate) mod misfit;
#[cfg(test)]
mod mount_tests;
pub(crate) mod reach;
pub mod record;
mod report;
#[doc(hidden)]
pub mod sampling;
mod snapshot;
pub mod spans;
mod standing;
mod stepping;
mod stop;
mod tuning;

use crate::scene::Scene;
pub(crate) use attitude::attitude;
pub use curves::curves;
pub(crate) use curves::free_curves;
pub(crate) use curves::hanging as stations;
#[doc(hidden)]
pub use judged::Judged;
pub(crate) use judged::judge;
pub(crate) use landing::fabric;
pub(crate) use misfit::{lying_segments, misfit};
use record::{Step, Summary};
pub use snapshot::ContactStatus;
pub(crate) use snapshot::{CellShear, Snapshot};
use std::ops::ControlFlow;
use std::time::Duration;
pub(crate) use stepping::Draping;

/// A finished drape.
#[derive(Debug, Clone)]
pub struct Drape {
    /// The ply in every step, the start being the first.
    pub steps: Vec<Step>,
    /// How it came out.
    pub summary: Summary,
    /// Time spent in equilibria; no part of the result, which is the same on every machine.
    pub solving: Duration,
}

/// Drapes the ply of a scene along its motion, as its tool makes it.
///
/// `progress` is called after each step with the number of steps done; when it breaks, the drape ends there, complete
/// for the steps done. It also ends where no ply would survive, see `Summary::stopped`.
pub fn simulate(scene: &Scene, mut progress: impl FnMut(usize) -> ControlFlow<()>) -> Drape {
    let (carried, record) = scene.carried();
    let mut drape = Draping::new(&carried).run(&mut progress).0;
    if let Some(record) = record {
        drape.summary.follow_tool(scene, record);
    }
    drape
}
