//! A whole drape of the sheet: from the flat to the start, along the motion, to rest ([`super::march`]), with what is seen of
//! it in each step.

use super::cloth::Cloth;
use super::gripper::Pad;
use super::march::March;
use super::measure::{Effort, Extremes, Summary};
use super::model::{Sheet, SheetError};
use super::release::Releases;
use super::shear::angle;
use super::state::State;
use super::tuning::Tuning;
use crate::ply::flat_axes;
use crate::scene::Scene;
use crate::stopwatch::Stopwatch;
use std::ops::ControlFlow;
use std::time::Duration;

/// How a drape of the sheet ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Status {
    /// Every step was solved, and the ply is at rest.
    Converged,
    /// Every step was solved, but the ply still moves.
    NotAtRest,
    /// A step could not be solved in the shortest time step: the drape ends before it.
    NotSolved,
    /// The caller ended it.
    Interrupted,
}

/// A finished drape of the sheet.
#[derive(Debug, Clone)]
pub struct Drape {
    /// The sheet that was draped.
    pub sheet: Sheet,
    /// What was measured, and the verdict.
    pub summary: Summary,
    /// The step of the motion in which each node came to the mold and stayed; none of one that did not.
    pub landing_step: Vec<Option<usize>>,
    /// Shear angle of each cell (rad) in the step in which the last of its nodes came to the mold; none of others.
    pub landing_shear: Vec<Option<f64>>,
    /// The last state.
    pub last: State,
    /// Time that it took.
    pub duration: Duration,
}

/// Drapes the sheet of a scene along its motion, as its tool makes it. `see` is called with the state of each step and may end the drape, and so
/// may `stop`, which is asked before each time step.
///
/// # Errors
/// If the scene has no sheet.
pub fn drape(
    scene: &Scene,
    tuning: Tuning,
    stop: &dyn Fn() -> bool,
    mut see: impl FnMut(&State) -> ControlFlow<()>,
) -> Result<Drape, SheetError> {
    let watch = Stopwatch::start();
    let (carried, _) = scene.carried();
    let scene = &*carried;
    let sheet = Sheet::new(scene)?;
    let steps = &scene.motion.positions;
    let grippers = sheet.grippers.len();
    let Some(start) = steps.first().filter(|_| steps.iter().all(|s| s.len() == grippers)) else {
        return Err(SheetError::NoMotion { grippers });
    };
    let (flat, pads) = flat(&sheet, start);
    let placed: Vec<[f64; 3]> = pads.iter().map(|pad| pad.position).collect();
    let cloth = Cloth::new(&sheet, tuning, flat, pads);
    let releases = Releases::of(scene, &sheet);
    let mut run = Run {
        scene,
        sheet: &sheet,
        tuning,
        march: March::new(scene, &sheet, tuning, cloth, releases, stop),
        extremes: Extremes::default(),
        landing_step: vec![None; sheet.fabric.places.len()],
        landing_shear: vec![None; sheet.fabric.cells.len()],
    };
    let (status, last) = run.run(&placed, &mut see);
    let effort = Effort {
        time_steps: run.march.time_steps,
        solves: run.march.cloth.solves,
        smallest_step: run.march.smallest_step,
    };
    let clear = tuning.release * sheet.pitch;
    let mut summary = Summary::new(scene, &sheet, clear, &run.extremes, &last, status, effort);
    let Run { landing_step, landing_shear, march, .. } = run;
    summary.events = march.releases.map(Releases::events).unwrap_or_default();
    Ok(Drape { sheet, summary, landing_step, landing_shear, last, duration: watch.elapsed() })
}

/// Whether a step of so many is among the `keep` states that are kept, evenly over the steps, the first and the last with
/// them.
#[must_use]
pub fn is_kept(step: usize, steps: usize, keep: usize) -> bool {
    let keep = keep.max(2);
    if steps <= keep {
        return true;
    }
    // step k of the kept ones is 1 + round(k (steps − 1) / (keep − 1))
    let place = |k: usize| 1 + (2 * k * (steps - 1) + keep - 1) / (2 * (keep - 1));
    let near = (step - 1) * (keep - 1) / (steps - 1);
    (near.saturating_sub(1)..=near + 1).any(|k| k < keep && place(k) == step)
}

/// A drape under way, and what is measured of it.
struct Run<'a> {
    scene: &'a Scene,
    sheet: &'a Sheet,
    tuning: Tuning,
    march: March<'a>,
    extremes: Extremes,
    landing_step: Vec<Option<usize>>,
    landing_shear: Vec<Option<f64>>,
}

impl Run<'_> {
    /// From the flat, where grippers are at `placed` (m), to the end. Returns the last state.
    fn run(
        &mut self,
        placed: &[[f64; 3]],
        see: &mut impl FnMut(&State) -> ControlFlow<()>,
    ) -> (Status, State) {
        let motion = &self.scene.motion;
        // the flat ply is hung in the air, and comes to rest over the mold
        if let Err(ended) = self.march.hang(placed, &motion.positions[0]) {
            return (ended.status(), self.state(1, motion.times[0]));
        }
        let mut resting = self.march.rest(&motion.positions[0], false);
        let mut state = self.see(1, motion.times[0]);

        // it follows the motion, at whose end it comes to rest again
        for step in 2..=motion.positions.len() {
            if see(&state).is_break() {
                return (Status::Interrupted, state);
            }
            let [from, to] = [step - 2, step - 1].map(|n| &motion.positions[n]);
            let times = [step - 2, step - 1].map(|n| motion.times[n]);
            if let Err(ended) = self.march.follow(from, to, times) {
                return (ended.status(), state);
            }
            if step == motion.positions.len() {
                resting = self.march.rest(to, false);
            }
            state = self.see(step, times[1]);
        }

        // pads that hold to the end let go together
        let steps = motion.positions.len();
        if self.march.releases.is_some() && (see(&state).is_break() || self.march.is_stopped()) {
            return (Status::Interrupted, state);
        }
        if let Some(time) = self.march.let_go_of_all() {
            resting = self.march.rest(&motion.positions[steps - 1], true);
            state = self.see(steps, time);
        }
        match see(&state) {
            ControlFlow::Break(()) => (Status::Interrupted, state),
            ControlFlow::Continue(()) if resting => (Status::Converged, state),
            ControlFlow::Continue(()) if self.march.is_stopped() => (Status::Interrupted, state),
            ControlFlow::Continue(()) => (Status::NotAtRest, state),
        }
    }

    /// Evaluates the state of a step at a time (s).
    fn see(&mut self, step: usize, time: f64) -> State {
        let state = self.state(step, time);
        let touching = self.scene.settings.contact.tolerance;
        self.extremes.see(self.sheet, &self.march.cloth.pads.gripped, &state, touching);
        for (landed, touches) in self.landing_step.iter_mut().zip(&state.contact) {
            *landed = touches.then(|| landed.unwrap_or(step));
        }
        let cells = self.sheet.fabric.cells.iter().zip(&state.shear);
        for (landed, (cell, shear)) in self.landing_shear.iter_mut().zip(cells) {
            let touches = cell.nodes.iter().all(|n| state.contact[*n as usize]);
            *landed = touches.then(|| landed.unwrap_or(*shear));
        }
        state
    }

    fn state(&mut self, step: usize, time: f64) -> State {
        let fabric = &self.sheet.fabric;
        let cloth = &mut self.march.cloth;
        let positions = cloth.now.x.clone();
        let height = |mold: &crate::mold::Mold| {
            positions.iter().map(|x| mold.signed_distance(*x)).collect::<Vec<f64>>()
        };
        let heights = self.sheet.mold.as_ref().map(height).unwrap_or_default();
        // a node under a gripper touches where it is as near as one that is not clear
        let clear = self.tuning.release * self.sheet.pitch;
        let near = |node: usize| heights.get(node).is_some_and(|height| *height <= clear);
        let gripped = cloth.pads.gripped.iter().enumerate();
        let mut contact: Vec<bool> = gripped.map(|(node, held)| *held && near(node)).collect();
        for node in cloth.touching() {
            contact[node] = true;
        }
        let shear = fabric.cells.iter().map(|c| angle(c.nodes.map(|n| positions[n as usize])));
        let shear = shear.collect();
        let tension = (0..fabric.segments.len()).map(|n| cloth.tension(n)).collect();
        let forces = cloth.forces();
        let (pads, holds) = (cloth.now.pads.clone(), cloth.pads.holds());
        let (energy, kinetic_energy) = (cloth.energy(), cloth.kinetic_energy());
        State {
            step,
            time,
            positions,
            heights,
            contact,
            shear,
            tension,
            pads,
            holds,
            forces,
            energy,
            kinetic_energy,
        }
    }
}

/// The flat fabric at rest near the places `at` of its grippers (m): positions of its nodes, and its pads.
fn flat(sheet: &Sheet, at: &[[f64; 3]]) -> (Vec<[f64; 3]>, Vec<Pad>) {
    let count = at.len() as f64;
    let middle = [0, 1, 2].map(|n| at.iter().map(|p| p[n]).sum::<f64>() / count);
    let origin = [0, 1].map(|n| sheet.grippers.iter().map(|g| g.place[n]).sum::<f64>() / count);
    let held: Vec<[f64; 2]> = sheet.grippers.iter().map(|gripper| gripper.place).collect();
    let [u, v, normal] = flat_axes(&held, at);
    let place = |[a, b]: [f64; 2]| {
        [0, 1, 2].map(|n| middle[n] + (a - origin[0]) * u[n] + (b - origin[1]) * v[n])
    };
    let turn = [0, 1, 2].map(|n| [u[n], v[n], normal[n]]);
    let pad = |gripper: &super::Gripper| Pad { turn, ..Pad::new(place(gripper.place)) };
    let nodes = sheet.fabric.places.iter().map(|uv| place(*uv)).collect();
    (nodes, sheet.grippers.iter().map(pad).collect())
}
