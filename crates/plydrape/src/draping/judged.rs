//! A drape of a search, of which only the verdicts are kept.

use super::{Draping, stop};
use crate::measure::{Before, Judge, State, Verdict};
use crate::scene::Scene;
use std::ops::ControlFlow;

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

/// Drapes without keeping more than the verdicts; broken off after the step in which more than `most` equilibria have
/// been solved. The times of the motion have no influence.
pub fn judge(
    scene: &Scene,
    most: usize,
    mut progress: impl FnMut(usize) -> ControlFlow<()>,
) -> Judged {
    let (carried, _) = scene.carried();
    let scene = &*carried;
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
