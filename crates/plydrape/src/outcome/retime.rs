//! The same drape in another time: the places stay, and what is measured of the time is measured again.

use super::{Drape, Step, Summary};
use crate::layup::{Layup, Model};
use crate::measure::{
    Found, Limits, Name, Observation, Past, Scope, Verdict, Worst, last_numbers, worst_numbers,
};
use crate::sheet::event::last_release;
use crate::state::{GripperState, PlyState};

impl Drape {
    /// Takes other times for a motion along the same places. `layup` has the motion in these times; `step_time` gives that of a step,
    /// `event_time` that of an event, from the times (s) before.
    pub fn retime(
        &mut self,
        layup: &Layup,
        limits: &Limits,
        step_time: impl Fn(usize, f64) -> f64,
        event_time: impl Fn(f64) -> f64,
    ) {
        for step in &mut self.steps {
            step.time = step_time(step.step, step.time);
        }
        if let Some(sheet) = &mut self.sheet {
            for state in sheet.states.iter_mut().chain([&mut sheet.drape.last]) {
                state.time = step_time(state.step, state.time);
            }
            for event in &mut sheet.drape.events {
                event.time = event_time(event.time);
            }
        }
        for event in &mut self.summary.events {
            event.time = event_time(event.time);
        }
        self.summary.measure_time(layup, limits, &mut self.steps);
    }
}

impl Summary {
    /// Measures again what depends on the times of the steps, and judges that.
    pub(crate) fn measure_time(&mut self, layup: &Layup, limits: &Limits, steps: &mut [Step]) {
        let timed = |name: &&Name| name.measure().scope() == Scope::Time;
        let names: Vec<Name> = Name::ALL.iter().filter(timed).copied().collect();
        self.measure_again(layup, limits, steps, &names);
    }

    /// Measures again what follows from the grippers alone, in every step, and judges that in place of what was found before.
    pub(crate) fn measure_again(
        &mut self,
        layup: &Layup,
        limits: &Limits,
        steps: &mut [Step],
        names: &[Name],
    ) {
        let (count, released) = (steps.len(), last_release(&self.events));
        let duration = layup.motion.times.last().copied().unwrap_or(0.0);
        let mut past: Option<Past> = None;
        for (n, step) in steps.iter_mut().enumerate() {
            let state = step.state_of_grippers(self.model);
            let seen = Observation { layup, limits, state: &state, past: past.as_ref() };
            let mut found: Vec<(Name, Option<Found>)> =
                names.iter().map(|name| (*name, name.measure().evaluate(&seen))).collect();
            // the motion takes until the last pads have let go
            if let (true, Some(time)) = (n + 1 == count, released) {
                let end = PlyState { time: time.max(state.time), ..state.clone() };
                let seen = Observation { state: &end, ..seen };
                for (name, found) in &mut found {
                    if *name == Name::Duration {
                        *found = name.measure().evaluate(&seen);
                    }
                }
            }
            for (name, found) in found {
                step.measures.set(name, found.map(|found| Worst::new(&found, layup)));
            }
            past = Some(Past::after(&state, past.take(), duration));
        }
        self.worst = worst_numbers(steps.iter().map(|step| &step.measures));
        self.last = last_numbers(steps.last().map(|step| &step.measures));
        for name in names {
            let Some(limit) = name.limit(layup, limits) else { continue };
            let Some(again) = worst_verdict(*name, steps, limit) else { continue };
            match self.limits.iter_mut().find(|verdict| verdict.name == *name) {
                Some(verdict) => *verdict = again,
                None => self.limits.push(again),
            }
        }
    }
}

/// The verdict on a measure by its worst step, or the last one if it counts at the end.
fn worst_verdict(name: Name, steps: &[Step], limit: f64) -> Option<Verdict> {
    let (sense, at_end) = (name.measure().sense(), name.measure().scope() == Scope::End);
    let values = steps.iter().filter_map(|step| Some((step.step, step.measures.get(name)?)));
    let (step, worst) = values.reduce(|most, next| {
        let replaced = at_end || sense.is_worse(next.1.value, most.1.value);
        if replaced { next } else { most }
    })?;
    Some(Verdict::new(name, worst.clone(), limit, Some(step)))
}

impl Step {
    /// What is kept of the state of the ply, by a model: the grippers alone.
    #[must_use]
    pub(crate) fn state_of_grippers(&self, model: Model) -> PlyState {
        let gripper = |gripper: &super::Gripper| GripperState {
            position: gripper.position,
            commanded: gripper.commanded,
            quaternion: gripper.quaternion,
            tilt: gripper.tilt_deg.to_radians(),
            force: gripper.force,
            slide: gripper.slide_mm * 1e-3,
            holds: gripper.holds,
        };
        PlyState {
            model,
            step: self.step,
            time: self.time,
            points: Vec::new(),
            lines: Vec::new(),
            cells: Vec::new(),
            grippers: self.grippers.iter().map(gripper).collect(),
            unsolved: None,
        }
    }
}
