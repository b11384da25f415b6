//! How the grippers of a drape turn, in whatever time its motion takes.

use crate::layup::Layup;
use crate::measure::tilt_rate::{fastest, turn};
use crate::measure::{Limits, Name, Verdict, Worst};
use crate::state::{GripperState, PlyState};

/// The grippers of a drape in its steps, each with its number from 1.
#[derive(Debug, Clone, Default)]
pub(crate) struct Turning {
    steps: Vec<(usize, Vec<GripperState>)>,
}

/// How far (rad) the ply at each gripper turns from each step to the next one, at most of some drapes; empty if there are none.
#[derive(Debug, Clone, Default)]
pub(crate) struct Turns(Vec<Vec<f64>>);

impl Turning {
    /// Keeps the grippers of the next step; those of a ply that is released after the motion stay as they were.
    pub fn see(&mut self, ply: &PlyState) {
        if self.steps.last().is_none_or(|(step, _)| *step != ply.step) {
            self.steps.push((ply.step, ply.grippers.clone()));
        }
    }

    /// The verdict on the tilt rate along the motion of a layup, whose steps these are, in its time; `None` where nothing tilts.
    pub fn judge(&self, layup: &Layup, limits: &Limits) -> Option<Verdict> {
        let limit = Name::TiltRate.limit(layup, limits).filter(|_| layup.tilts())?;
        let (times, duration) = (&layup.motion.times, *layup.motion.times.last()?);
        let time = |step: usize| times[step - 1];
        let rates = self.steps.iter().enumerate().filter_map(|(n, (step, grippers))| {
            let earlier = self.steps[..n].iter().map(|(step, grippers)| (time(*step), grippers));
            let orientation = |grippers: &&Vec<GripperState>, n: usize| grippers[n].quaternion;
            Some((*step, fastest(grippers, time(*step), earlier, orientation, duration)?))
        });
        let (step, found) = rates.reduce(|most, next| {
            let faster = Name::TiltRate.measure().sense().is_worse(next.1.value, most.1.value);
            if faster { next } else { most }
        })?;
        Some(Verdict::new(Name::TiltRate, Worst::new(&found, layup), limit, Some(step)))
    }
}

impl Turns {
    /// The most of all drapes.
    pub fn most<'a>(drapes: impl IntoIterator<Item = &'a Turning>) -> Self {
        let mut turns: Vec<Vec<f64>> = Vec::new();
        for pair in drapes.into_iter().flat_map(|drape| drape.steps.windows(2)) {
            let [(step, from), (next, to)] = pair else { continue };
            // a step from which on a drape is judged may be later
            if *next != step + 1 {
                continue;
            }
            turns.resize_with(turns.len().max(*step), Vec::new);
            let most = &mut turns[step - 1];
            most.resize(most.len().max(to.len()), 0.0);
            for (most, (from, to)) in most.iter_mut().zip(from.iter().zip(to)) {
                if to.holds {
                    *most = most.max(turn(from.quaternion, to.quaternion));
                }
            }
        }
        Turns(turns)
    }

    /// That of a gripper from a step to the next (rad); zero where it is not known.
    #[must_use]
    pub fn of(&self, step: usize, gripper: usize) -> f64 {
        let turns = step.checked_sub(1).and_then(|step| self.0.get(step));
        turns.and_then(|turns| turns.get(gripper)).copied().unwrap_or(0.0)
    }
}
