//! A whole drape of the sheet: from the flat to the start, along the motion, to rest.
//!
//! The motion is stretched in time until the speed of the grippers is of no matter (or taken as it is), and followed in
//! shares of its steps: a share that is not solved is halved, one that is solved easily is followed by a longer one. Pads
//! let go on the way or after it, as the layup says.

use super::cloth::Cloth;
use super::gripper::Pad;
use super::model::{Sheet, SheetError};
use super::release::Releases;
use super::report::{Drape, Report};
use super::shear::angle;
use super::state::State;
use super::tuning::Tuning;
use crate::geometry::vector::{between, distance};
use crate::layup::{Layup, SheetTime};
use crate::ply::flat_axes;
use crate::stopwatch::Stopwatch;
use std::ops::ControlFlow;

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

/// Drapes the sheet of a layup along its motion; the motion is that of the grippers, so a tool has made it ([`Layup::carried`]).
///
/// `see` is called with the sheet, the state of each step and whether it is the last one, and may end the drape; so may `stop`, which is
/// asked before each time step. Nodes up to `low` (m) over the mold lie, as far as the release of pads asks for that.
///
/// # Errors
/// If the layup has no sheet.
pub fn drape(
    layup: &Layup,
    tuning: Tuning,
    low: f64,
    stop: &dyn Fn() -> bool,
    mut see: impl FnMut(&Sheet, &State, bool) -> ControlFlow<()>,
) -> Result<Drape, SheetError> {
    let watch = Stopwatch::start();
    let sheet = Sheet::new(layup)?;
    let steps = &layup.motion.positions;
    let grippers = sheet.grippers.len();
    let Some(start) = steps.first().filter(|_| steps.iter().all(|s| s.len() == grippers)) else {
        return Err(SheetError::NoMotion { grippers });
    };
    let (flat, pads) = flat(&sheet, start);
    let placed: Vec<[f64; 3]> = pads.iter().map(|pad| pad.position).collect();
    let cloth = Cloth::new(&sheet, tuning, flat, pads);
    let mut run = Run {
        layup,
        sheet: &sheet,
        tuning,
        cloth,
        releases: Releases::of(layup, &sheet, low),
        stop,
        targets: placed.clone(),
        share: 1.0,
        time_steps: 0,
        smallest_step: 1.0,
        report: Report::default(),
        landing_step: vec![None; sheet.fabric.places.len()],
        landing_shear: vec![None; sheet.fabric.cells.len()],
    };
    let mut see = |state: &State, last: bool| see(&sheet, state, last);
    let (status, last) = run.run(&placed, &mut see);
    let Run { cloth, landing_step, landing_shear, releases, mut report, .. } = run;
    report.end(&sheet, tuning.release * sheet.pitch, &last);
    (report.time_steps, report.smallest_step) = (run.time_steps, run.smallest_step);
    report.solves = cloth.solves;
    let events = releases.map(Releases::events).unwrap_or_default();
    let (steps, duration) = (last.step, watch.elapsed());
    drop(cloth);
    Ok(Drape { sheet, status, steps, report, events, landing_step, landing_shear, last, duration })
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

/// A drape under way.
struct Run<'a> {
    layup: &'a Layup,
    sheet: &'a Sheet,
    tuning: Tuning,
    cloth: Cloth<'a>,
    /// When pads let go; none if they hold to the end.
    releases: Option<Releases<'a>>,
    stop: &'a dyn Fn() -> bool,
    /// Where grippers go in the next time step (m).
    targets: Vec<[f64; 3]>,
    /// Share of a step of the motion that the next time step tries.
    share: f64,
    time_steps: usize,
    smallest_step: f64,
    report: Report,
    landing_step: Vec<Option<usize>>,
    landing_shear: Vec<Option<f64>>,
}

/// Share of a step of the motion that is no time.
const ROUNDING: f64 = 1e-6;

/// Why a motion was not followed to its end.
enum Ended {
    NotSolved,
    Stopped,
}

impl Run<'_> {
    /// From the flat, where grippers are at `placed` (m), to the end. Returns the last state.
    fn run(
        &mut self,
        placed: &[[f64; 3]],
        see: &mut impl FnMut(&State, bool) -> ControlFlow<()>,
    ) -> (Status, State) {
        let motion = &self.layup.motion;
        let contact = self.cloth.contact.take();
        let hung = self.follow(placed, &motion.positions[0], None);
        self.cloth.contact = contact;
        if let Err(ended) = hung {
            return (ended.status(), self.state(1, motion.times[0]));
        }
        let mut resting = self.rest(&motion.positions[0], false);
        let mut state = self.see(1, motion.times[0]);
        for step in 2..=motion.positions.len() {
            if see(&state, false).is_break() {
                return (Status::Interrupted, state);
            }
            let [from, to] = [step - 2, step - 1].map(|n| &motion.positions[n]);
            let times = [step - 2, step - 1].map(|n| motion.times[n]);
            if let Err(ended) = self.follow(from, to, Some(times)) {
                return (ended.status(), state);
            }
            if step == motion.positions.len() {
                resting = self.rest(to, false);
            }
            state = self.see(step, times[1]);
        }
        let steps = motion.positions.len();
        if let Some(releases) = &mut self.releases {
            if see(&state, false).is_break() || (self.stop)() {
                return (Status::Interrupted, state);
            }
            let (all, time) = releases.end();
            self.cloth.release(&all);
            resting = self.rest(&motion.positions[steps - 1], true);
            state = self.see(steps, time);
        }
        match see(&state, true) {
            ControlFlow::Break(()) => (Status::Interrupted, state),
            ControlFlow::Continue(()) if resting => (Status::Converged, state),
            ControlFlow::Continue(()) if (self.stop)() => (Status::Interrupted, state),
            ControlFlow::Continue(()) => (Status::NotAtRest, state),
        }
    }

    /// Evaluates the state of a step at a time (s).
    fn see(&mut self, step: usize, time: f64) -> State {
        let state = self.state(step, time);
        let touching = self.layup.settings.contact.tolerance;
        self.report.see(self.sheet, &self.cloth.gripped, &state, touching);
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

    /// Moves the grippers from one place to another (m), in a step of the motion between two times (s).
    fn follow(
        &mut self,
        from: &[[f64; 3]],
        to: &[[f64; 3]],
        times: Option<[f64; 2]>,
    ) -> Result<(), Ended> {
        let way = from.iter().zip(to).map(|(a, b)| distance(*a, *b)).fold(0.0, f64::max);
        let stretched = self.stretched(way);
        let takes = times.map(|[begin, end]| end - begin);
        let (duration, longest) = match (self.layup.settings.sheet.time, takes) {
            (SheetTime::Real, Some(takes)) => {
                (takes, self.tuning.real_step * (self.sheet.pitch / self.sheet.gravity).sqrt())
            }
            _ => (stretched, f64::INFINITY),
        };
        let tolerance = self.tuning.step_tolerance * self.sheet.mesh;
        self.cloth.leaves_out = true;
        let mut done = 0.0;
        // a motion in its own time needs so many steps at least
        let mut tries = self.tuning.tries + (2.0 * duration / longest) as usize;
        while done < 1.0 {
            if (self.stop)() {
                return Err(Ended::Stopped);
            }
            if tries == 0 {
                return Err(Ended::NotSolved);
            }
            tries -= 1;
            let most = self.share.min(1.0 - done).min(longest / duration);
            let least = self.tuning.contact_way * self.sheet.pitch / way;
            let share = (self.cloth.longest_step(most * duration) / duration).max(least).min(most);
            // steps of one length to the end
            let share = (1.0 - done) / ((1.0 - done) / share - 1e-9).ceil();
            let next = if done + share > 1.0 - 1e-9 { 1.0 } else { done + share };
            // a pad lets go at the end of its dwell, not later
            let due =
                self.due(times).filter(|due| (done + ROUNDING..next - ROUNDING).contains(due));
            let (next, share) = due.map_or((next, share), |due| (due, due - done));
            for (target, (a, b)) in self.targets.iter_mut().zip(from.iter().zip(to)) {
                *target = between(*a, *b, next);
            }
            match self.cloth.advance(&self.targets, share * duration, tolerance) {
                Ok(iterations) => {
                    self.time_steps += 1;
                    self.smallest_step = self.smallest_step.min(share);
                    done = next;
                    if let Some([begin, end]) = times {
                        self.let_go(begin + done * (end - begin), ROUNDING * (end - begin));
                    }
                    if iterations <= self.tuning.easy_iterations {
                        self.share = (2.0 * self.share).min(1.0);
                    }
                }
                Err(_) => {
                    self.share = 0.5 * share;
                    if self.share < self.tuning.smallest_step && due.is_none() {
                        return Err(Ended::NotSolved);
                    }
                }
            }
        }
        Ok(())
    }

    /// Time (s) in which grippers go so far (m) that the ply's kinetic energy is of no matter; where they stand, that of a
    /// pitch.
    fn stretched(&self, way: f64) -> f64 {
        let lift = self.tuning.lift * self.sheet.pitch;
        let speed = (2.0 * self.sheet.gravity * lift).sqrt();
        (way / speed).max(lift / speed)
    }

    /// Share of a step between two times (s) at which the next pad lets go, if what lies goes on lying.
    fn due(&self, times: Option<[f64; 2]>) -> Option<f64> {
        let (due, [begin, end]) = (self.releases.as_ref()?.due()?, times?);
        Some((due - begin) / (end - begin))
    }

    /// Lets go at a time (s) with the pads that are due by then, give or take the rounding (s).
    fn let_go(&mut self, time: f64, rounding: f64) {
        let Some(releases) = &mut self.releases else { return };
        let gone = releases.see(time, rounding, &self.cloth);
        if !gone.is_empty() {
            self.cloth.release(&gone);
        }
    }

    /// Holds the grippers until nothing moves any more. A ply that may fall (`falls`) goes no farther in a time step than it
    /// is from the mold.
    fn rest(&mut self, at: &[[f64; 3]], falls: bool) -> bool {
        let tolerance = self.tuning.rest_tolerance * self.sheet.mesh;
        let longest = self.stretched(self.sheet.pitch);
        self.cloth.leaves_out = false;
        let mut dt = 0.01 * longest;
        if falls {
            // the time of a fall by the way that a node may land with
            dt = dt.min((self.tuning.contact_way * self.sheet.pitch / self.sheet.gravity).sqrt());
        }
        for _ in 0..self.tuning.rest_steps {
            if (self.stop)() {
                return false;
            }
            if falls {
                dt = self.cloth.longest_step(dt);
            }
            match self.cloth.advance(at, dt, tolerance) {
                Ok(_) => {
                    self.time_steps += 1;
                    let still =
                        self.cloth.movement() <= self.tuning.rest_movement * self.sheet.mesh;
                    if still && dt >= longest {
                        return true;
                    }
                    dt = (2.0 * dt).min(longest);
                }
                Err(_) => dt *= 0.25,
            }
        }
        false
    }

    fn state(&mut self, step: usize, time: f64) -> State {
        let fabric = &self.sheet.fabric;
        let positions = self.cloth.now.x.clone();
        let height = |mold: &crate::mold::Mold| {
            positions.iter().map(|x| mold.signed_distance(*x)).collect::<Vec<f64>>()
        };
        let heights = self.sheet.mold.as_ref().map(height).unwrap_or_default();
        // a node under a gripper touches where it is as near as one that is not clear
        let clear = self.tuning.release * self.sheet.pitch;
        let near = |node: usize| heights.get(node).is_some_and(|height| *height <= clear);
        let gripped = self.cloth.gripped.iter().enumerate();
        let mut contact: Vec<bool> = gripped.map(|(node, held)| *held && near(node)).collect();
        for node in self.cloth.contact.iter().flat_map(|contact| contact.touching()) {
            contact[node] = true;
        }
        let shear = fabric.cells.iter().map(|c| angle(c.nodes.map(|n| positions[n as usize])));
        let shear = shear.collect();
        let tension = (0..fabric.segments.len()).map(|n| self.cloth.tension(n)).collect();
        let forces = self.cloth.forces();
        let (pads, holds) = (self.cloth.now.pads.clone(), self.cloth.holds());
        let (energy, kinetic_energy) = (self.cloth.energy(), self.cloth.kinetic_energy());
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

impl Ended {
    fn status(&self) -> Status {
        match self {
            Ended::NotSolved => Status::NotSolved,
            Ended::Stopped => Status::Interrupted,
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
