//! The drape: gripper positions step by step, the equilibrium at each, and the contact with the mold.
//!
//! One loop, the paper's section 4: move the grippers ([`crate::scene::Motion`]), solve the equilibrium
//! ([`crate::equilibrium`]), find the contact (`contact`), measure ([`crate::measure`]) and record
//! ([`record`]). A search drapes in the same way and keeps only the verdicts ([`Judged`]).

pub(crate) mod attitude;
mod bracket;
mod bridge;
mod contact;
mod crossing;
pub mod gap;
pub(crate) mod landing;
pub(crate) mod load;
pub(crate) mod misfit;
pub(crate) mod reach;
pub mod record;
mod report;
pub mod sampling;
mod snapshot;
pub mod spans;
mod stepping;
mod stop;
mod tuning;

use crate::measure::{Before, Judge, State, Verdict};
use crate::scene::Scene;
pub(crate) use attitude::attitude;
pub use bridge::Bridge;
pub(crate) use crossing::hanging as stations;
pub(crate) use landing::fabric;
pub(crate) use misfit::{lying_segments, misfit};
use record::{Step, Summary};
pub use snapshot::{CellShear, ContactStatus, Snapshot};
use std::ops::ControlFlow;
use std::time::Duration;
pub(crate) use stepping::Draping;
pub use tuning::{TUNING, Tuning};

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

/// How a drape of a search came out.
#[derive(Debug, Clone)]
pub struct Judged {
    /// Every limit that applies, but those of a motion in time.
    pub limits: Vec<Verdict>,
    /// All steps were done, and every limit holds.
    pub accepted: bool,
    /// Share of the steps that were not done: it was broken off.
    pub missing: f64,
    /// Steps whose equilibrium or contact was not found.
    pub unsolved: usize,
}

/// Drapes the ply of a scene along its motion.
///
/// `progress` is called after each step with the number of steps done; when it breaks, the drape ends there, complete
/// for the steps done. It also ends where no ply would survive, see `Summary::stopped`.
pub fn simulate(scene: &Scene, mut progress: impl FnMut(usize) -> ControlFlow<()>) -> Drape {
    let mut draping = Draping::new(scene);
    draping.run(&mut progress).0
}

/// Drapes without keeping more than the verdicts; broken off after the step in which more than `most` equilibria have
/// been solved. The times of the motion have no influence.
pub(crate) fn judge(
    scene: &Scene,
    most: usize,
    mut progress: impl FnMut(usize) -> ControlFlow<()>,
) -> Judged {
    let mut draping = Draping::new(scene);
    draping.most = most;
    let mut judge = Judge::new(scene, false);
    let (planned, mut done, mut unsolved) = (scene.motion.positions.len(), 0, 0);
    let mut before: Option<Before> = None;
    for step in 0..planned {
        let snapshot = draping.advance(step);
        let state = State::new(scene, &snapshot, &draping.solver, before.as_ref());
        judge.see(&state, step + 1 == planned);
        unsolved += usize::from(snapshot.failure().is_some());
        done = step + 1;
        if progress(done).is_break() || draping.equilibria > most || stop::breaks(&state) {
            break;
        }
        before = Some(state.as_before());
    }
    let limits = judge.verdicts();
    let accepted = done == planned && limits.iter().all(|verdict| verdict.ok);
    Judged { limits, accepted, missing: 1.0 - done as f64 / planned.max(1) as f64, unsolved }
}
