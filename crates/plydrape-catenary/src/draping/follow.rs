//! The catenaries follow the motion of a layup, and every step is handed over as it is solved.

use super::ply_state::{Detail, ply_state};
use super::record::CatenaryStep;
use super::recording::catenary_step;
use super::solved_step::SolvedStep;
use super::spans::Equilibrium;
use super::{Draping, stop};
use crate::layup::Layup;
use crate::state::PlyState;
use std::ops::ControlFlow;
use std::time::Duration;

/// How far catenaries follow a motion, and how much they say of each step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Follow {
    /// Equilibria after which a step is not cut any further and the drape ends with it.
    pub most_equilibria: usize,
    /// Whether states are complete and come with the catenaries themselves, as a record needs them; a search needs neither.
    pub full: bool,
}

/// How catenaries followed a motion.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Followed {
    /// Steps done.
    pub steps: usize,
    /// Equilibria solved.
    pub equilibria: usize,
    /// Steps of which the equilibrium or the contact was not found.
    pub unsolved: usize,
    /// Why the drape ended with its last step, and what would help, if no ply would have survived that.
    pub torn: Option<String>,
    /// Time spent in equilibria; no part of the result, which is the same on every machine.
    pub solving: Duration,
}

/// Lets the catenaries of a layup follow its motion; where a tool carries the grippers, that of [`Layup::carried`].
///
/// `see` is shown every step: the ply, its catenaries where `options` ask for a record, and whether no other step follows. When it breaks,
/// or an edge is stretched more than any ply bears, the motion is followed no farther.
pub fn follow(
    layup: &Layup,
    options: Follow,
    see: impl FnMut(&PlyState, Option<CatenaryStep>, bool) -> ControlFlow<()>,
) -> Followed {
    Draping::new(layup).follow(options, see).0
}

impl Draping<'_> {
    /// Follows the whole motion, see [`follow`]; also the shape of the last step.
    pub fn follow(
        &mut self,
        options: Follow,
        mut see: impl FnMut(&PlyState, Option<CatenaryStep>, bool) -> ControlFlow<()>,
    ) -> (Followed, Option<Equilibrium>) {
        let Follow { most_equilibria, full } = options;
        self.most = most_equilibria;
        let planned = self.layup.motion.positions.len();
        let (mut followed, mut shape) = (Followed::default(), None);
        let (mut turned, mut first_landing) = (None, None);
        for step in 0..planned {
            let snapshot = self.advance(step);
            let solved = SolvedStep::new(self.layup, &snapshot, &self.solver, turned.as_deref());
            let is_last = step + 1 == planned;
            let state = ply_state(&solved, Detail { last: is_last, full });
            first_landing = first_landing.or_else(|| stop::landing_error(&solved));
            let torn = stop::reason(self.layup, &state, first_landing);
            let record = full.then(|| catenary_step(&solved));
            turned = Some(solved.quaternions());
            shape = Some(snapshot.shape);

            followed.steps += 1;
            followed.unsolved += usize::from(state.unsolved.is_some());
            // a search asks nothing of the end of a ply that is torn
            let is_last = is_last || (full && torn.is_some());
            let is_stopped = see(&state, record, is_last).is_break();
            followed.torn = torn;
            if is_stopped || self.equilibria > most_equilibria || followed.torn.is_some() {
                break;
            }
        }
        (followed.equilibria, followed.solving) = (self.equilibria, self.solving);
        (followed, shape)
    }
}
