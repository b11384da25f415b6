//! Values of the measures, step by step, that become verdicts at the end of a drape.

use super::{
    ByName, Found, Limits, Measures, Name, Numbers, Observation, Past, Scope, TUNING, Verdict,
    Worst,
};
use crate::layup::Layup;
use crate::state::{PlyState, Unsolved};

/// Collects the worst values of a drape by one model step by step, and judges them at the end.
#[derive(Debug)]
pub struct Judge<'a> {
    layup: &'a Layup,
    limits: &'a Limits,
    /// Whether the steps have the times of a motion.
    timed: bool,
    so_far: WorstSoFar,
    past: Option<Past>,
}

/// The worst values that a judge has seen so far.
#[derive(Debug, Clone, Default)]
pub struct WorstSoFar {
    worst: ByName<(usize, Found)>,
    unsolved: Option<(usize, Unsolved)>,
}

impl<'a> Judge<'a> {
    /// For a layup and limits; `timed` if the steps have the times of a motion, which those of a search do not have yet.
    #[must_use]
    pub fn new(layup: &'a Layup, limits: &'a Limits, timed: bool) -> Self {
        Judge { layup, limits, timed, so_far: WorstSoFar::default(), past: None }
    }

    /// As [`Judge::new`], after others have been seen; what compares a step with the one before begins anew.
    #[must_use]
    pub fn after(so_far: WorstSoFar, layup: &'a Layup, limits: &'a Limits, timed: bool) -> Self {
        Judge { so_far, ..Judge::new(layup, limits, timed) }
    }

    /// The worst values so far.
    #[must_use]
    pub fn worst(&self) -> &WorstSoFar {
        &self.so_far
    }

    /// The limit of a measure that a drape is judged by.
    fn limit(&self, name: Name) -> Option<f64> {
        let judged = match name.measure().scope() {
            Scope::EveryStep | Scope::End => true,
            Scope::Time => self.timed,
            Scope::Motion | Scope::Whole => false,
        };
        name.limit(self.layup, self.limits).filter(|_| judged)
    }

    /// Evaluates the limits of a step; `last` if no other follows.
    pub fn see(&mut self, state: &PlyState, last: bool) {
        let found = self.evaluate(state, |name| {
            (last || name.measure().scope() != Scope::End) && self.limit(name).is_some()
        });
        self.keep(state, &found);
    }

    /// Evaluates every measure of a step, and returns them.
    pub fn see_all(&mut self, state: &PlyState) -> Measures {
        let found = self.evaluate(state, |_| true);
        self.keep(state, &found);
        found.iter().map(|(name, found)| (*name, Worst::new(found, self.layup))).collect()
    }

    /// Evaluates the measures of a step that count.
    fn evaluate(&self, state: &PlyState, counts: impl Fn(Name) -> bool) -> Vec<(Name, Found)> {
        let Judge { layup, limits, past, .. } = self;
        let seen = Observation { layup, limits, state, past: past.as_ref() };
        let names = Name::ALL.iter().copied().filter(|name| counts(*name));
        names.filter_map(|name| Some((name, name.measure().evaluate(&seen)?))).collect()
    }

    /// Keeps what was found in a step, and the step as the past of the next one.
    fn keep(&mut self, state: &PlyState, found: &[(Name, Found)]) {
        for (name, found) in found {
            let measure = name.measure();
            let beaten =
                self.so_far.worst.get(*name).is_some_and(|(_, before)| match measure.sense() {
                    _ if measure.scope() == Scope::End => false,
                    sense => !sense.is_worse(found.value, before.value),
                });
            if !beaten {
                self.so_far.worst.set(*name, Some((state.step, *found)));
            }
        }
        if self.so_far.unsolved.is_none() {
            self.so_far.unsolved = state.unsolved.map(|unsolved| (state.step, unsolved));
        }
        let duration = self.layup.motion.times.last().copied().unwrap_or(0.0);
        self.past = Some(Past::after(state, self.past.take(), duration));
    }

    /// Every limit that applies, in the order of [`Name::ALL`].
    #[must_use]
    pub fn verdicts(&self) -> Vec<Verdict> {
        let judged = Name::ALL.iter().filter_map(|name| {
            let (limit, (step, found)) = (self.limit(*name)?, self.so_far.worst.get(*name)?);
            Some(Verdict::new(*name, Worst::new(found, self.layup), limit, Some(*step)))
        });
        let mut out: Vec<Verdict> = judged.collect();
        if let Some((step, Unsolved { why, residual })) = self.so_far.unsolved {
            let worst = Worst { value: residual, at: why.into(), place: None };
            let verdict =
                Verdict::new(Name::Equilibrium, worst, TUNING.equilibrium_residual, Some(step));
            out.push(Verdict { ok: false, ..verdict });
        }
        out
    }
}

/// The worst of each measure over all steps as a plain number; of those that count at the end too.
#[must_use]
pub(crate) fn worst_numbers<'a>(steps: impl Iterator<Item = &'a Measures>) -> Numbers {
    let mut out: Vec<Option<f64>> = vec![None; Name::ALL.len()];
    for measures in steps {
        for (name, worst) in measures.iter() {
            let slot = &mut out[name as usize];
            let sense = name.measure().sense();
            if slot.is_none_or(|before| sense.is_worse(worst.value, before)) {
                *slot = Some(worst.value);
            }
        }
    }
    reported(|name| out[name as usize])
}

/// The numbers of one step.
#[must_use]
pub(crate) fn last_numbers(measures: Option<&Measures>) -> Numbers {
    reported(|name| measures.and_then(|measures| measures.value(name)))
}

fn reported(value: impl Fn(Name) -> Option<f64>) -> Numbers {
    let of_steps = |name: &&Name| !matches!(name.measure().scope(), Scope::Motion | Scope::Whole);
    let names = Name::ALL.iter().filter(of_steps);
    // what the model does not measure is missing
    names.filter_map(|name| Some((*name, Some(value(*name)?)))).collect()
}
