//! A whole drape of the sheet: from the flat to the start, along the motion, to rest ([`super::march`]), with what is seen of
//! it in each step.

use super::cloth::Cloth;
use super::gripper::Pad;
use super::hand_over::{TILT_REACH, frame_around};
use super::march::March;
use super::matrix3::{IDENTITY, orthonormal};
use super::model::Sheet;
use super::release::Releases;
use super::report::{Report, SheetDrape};
use super::rim::Rim;
use super::shear::angle;
use super::state::ClothState;
use super::tuning::SheetTuning;
use crate::Error;
use crate::geometry::vector::cross;
use crate::layup::Layup;
use crate::ply::flat_axes;
use crate::stopwatch::Stopwatch;
use std::ops::ControlFlow;

/// Most times that a flat ply is raised by as much as it is still in the mold.
const RAISES: usize = 10;

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
    /// It was to go on from the air, but touches the mold there or does not come to rest.
    NotInTheAir,
}

/// Drapes the sheet of a layup along its motion; the motion is that of the grippers, so a tool has made it ([`Layup::carried`]).
///
/// `see` is called with the sheet, the state of each step and whether it is the last one, and may end the drape; so may `stop`, which is
/// asked before each time step.
///
/// # Errors
/// The errors of [`Sheet::new`], and [`Error::SheetNoMotion`] if the motion has no steps for the grippers.
pub fn drape(
    layup: &Layup,
    tuning: SheetTuning,
    stop: &dyn Fn() -> bool,
    see: impl FnMut(&Sheet, &ClothState, bool) -> ControlFlow<()>,
) -> Result<SheetDrape, Error> {
    drape_from(layup, tuning, Beginning::Flat, stop, see)
}

/// Where a drape begins.
#[derive(Debug, Clone, Copy)]
pub enum Beginning<'a> {
    /// With the flat ply, which is hung in the air where the motion starts.
    Flat,
    /// With a ply of the same fabric in the air that has come to a step of nearly the same motion: the grippers go to where those of this layup
    /// are in that step, the ply comes to rest there, and goes on. [`SheetDrape::status`] is [`Status::NotInTheAir`] if it does not
    /// rest clear of the mold there, and nothing is seen of it then.
    Air(&'a ClothState),
    /// With the ply laid on the mold, in the first step of the motion: the places of its nodes (m).
    Laid(&'a [[f64; 3]]),
}

/// As [`drape`], from somewhere on.
///
/// # Errors
/// As [`drape`].
pub fn drape_from(
    layup: &Layup,
    tuning: SheetTuning,
    beginning: Beginning,
    stop: &dyn Fn() -> bool,
    mut see: impl FnMut(&Sheet, &ClothState, bool) -> ControlFlow<()>,
) -> Result<SheetDrape, Error> {
    let watch = Stopwatch::start();
    let sheet = Sheet::new(layup)?;
    let steps = &layup.motion.positions;
    let grippers = sheet.grippers.len();
    let Some(start) = steps.first().filter(|_| steps.iter().all(|s| s.len() == grippers)) else {
        return Err(Error::SheetNoMotion { grippers });
    };
    // the ply begins at rest
    let (x, pads) = match beginning {
        Beginning::Flat => flat(&sheet, start),
        Beginning::Air(air) => (air.positions.clone(), air.pads.clone()),
        Beginning::Laid(places) => (places.to_vec(), pads_on(&sheet, places, start)),
    };
    let placed: Vec<[f64; 3]> = pads.iter().map(|pad| pad.target).collect();
    let mut cloth = Cloth::new(&sheet, tuning, x, pads);
    if !matches!(beginning, Beginning::Flat) {
        cloth.energies.table = None;
    }
    if let (Beginning::Laid(places), Some(contact)) = (beginning, &mut cloth.energies.contact) {
        // what lies exactly on the mold touches it, whatever rounding says
        contact.begin_lying(places);
    }
    let releases = Releases::new(layup, &sheet);
    let mut run = Run {
        layup,
        sheet: &sheet,
        tuning,
        march: March::new(layup, &sheet, tuning, cloth, releases, stop),
        report: Report::default(),
        landing_step: vec![None; sheet.fabric.places.len()],
        landing_shear: vec![None; sheet.fabric.cells.len()],
    };
    // follow the motion; the last state is that at which it ended
    let mut see = |state: &ClothState, last: bool| see(&sheet, state, last);
    let (status, last) = run.run(&placed, beginning, &mut see);
    let Run { march, landing_step, landing_shear, mut report, .. } = run;
    // what is counted on the way belongs to the report of the whole drape
    report.end(&sheet, tuning.release * sheet.pitch, &last);
    let March { cloth, releases, time_steps, smallest_step, .. } = march;
    (report.time_steps, report.smallest_step) = (time_steps, smallest_step);
    report.solves = cloth.solves;
    let events = releases.map(Releases::events).unwrap_or_default();
    let (steps, duration) = (last.step, watch.elapsed());
    drop(cloth);
    Ok(SheetDrape {
        sheet,
        status,
        steps,
        report,
        events,
        landing_step,
        landing_shear,
        last,
        duration,
    })
}

/// Whether a step of this many is among the `keep` states that are kept, evenly over the steps, the first and the last with
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
    layup: &'a Layup,
    sheet: &'a Sheet,
    tuning: SheetTuning,
    march: March<'a>,
    report: Report,
    landing_step: Vec<Option<usize>>,
    landing_shear: Vec<Option<f64>>,
}

impl Run<'_> {
    /// From where the drape begins, with the grippers at `placed` (m), to the end of the motion. Returns the last state.
    fn run(
        &mut self,
        placed: &[[f64; 3]],
        beginning: Beginning,
        see: &mut impl FnMut(&ClothState, bool) -> ControlFlow<()>,
    ) -> (Status, ClothState) {
        let motion = &self.layup.motion;
        let begin = if let Beginning::Air(air) = beginning { air.step } else { 1 };
        // the ply is hung in the air if it does not lie, and comes to rest over the mold
        let (start, time) = (&motion.positions[begin - 1], motion.times[begin - 1]);
        let hung = match beginning {
            Beginning::Laid(_) => Ok(()),
            Beginning::Flat | Beginning::Air(_) => self.march.hang(placed, start),
        };
        let mut resting = hung.is_ok() && self.march.rest(start, false);
        if begin > 1 && !self.march.is_stopped() && !(resting && self.is_clear()) {
            return (Status::NotInTheAir, self.state(begin, time));
        }
        if let Err(ended) = hung {
            return (ended.status(), self.state(begin, time));
        }
        let mut state = self.see(begin, time);

        // it follows the motion, at whose end it comes to rest again
        for step in begin + 1..=motion.positions.len() {
            if see(&state, false).is_break() {
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
        if self.march.releases.is_some()
            && (see(&state, false).is_break() || self.march.is_stopped())
        {
            return (Status::Interrupted, state);
        }
        if let Some(time) = self.march.let_go_of_all() {
            resting = self.march.rest(&motion.positions[steps - 1], true);
            state = self.see(steps, time);
        }
        match see(&state, true) {
            ControlFlow::Break(()) => (Status::Interrupted, state),
            ControlFlow::Continue(()) if resting => (Status::Converged, state),
            ControlFlow::Continue(()) if self.march.is_stopped() => (Status::Interrupted, state),
            ControlFlow::Continue(()) => (Status::NotAtRest, state),
        }
    }

    /// Whether no node touches the mold.
    fn is_clear(&self) -> bool {
        let Some(mold) = &self.sheet.mold else { return true };
        let clear = self.tuning.release * self.sheet.pitch;
        self.march.cloth.now.x.iter().all(|x| mold.signed_distance(*x) > clear)
    }

    /// Evaluates the state of a step at a time (s).
    fn see(&mut self, step: usize, time: f64) -> ClothState {
        let state = self.state(step, time);
        let touching = self.layup.settings.contact.tolerance;
        self.report.see(self.sheet, &self.march.cloth.pads.gripped, &state, touching);
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

    fn state(&mut self, step: usize, time: f64) -> ClothState {
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
        ClothState {
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

/// The pads of grippers at places (m) on a laid fabric, turned as the fabric around them.
fn pads_on(sheet: &Sheet, x: &[[f64; 3]], at: &[[f64; 3]]) -> Vec<Pad> {
    let pad = |(gripper, place): (&super::Gripper, &[f64; 3])| {
        let reach = gripper.radius.max(TILT_REACH * sheet.pitch);
        let around = frame_around(&sheet.fabric, x, gripper.place, reach);
        let turn = around.map_or(IDENTITY, |(normal, u)| {
            let v = cross(normal, u);
            [0, 1, 2].map(|n| [u[n], v[n], normal[n]])
        });
        Pad { turn: orthonormal(&turn), ..Pad::new(*place) }
    };
    sheet.grippers.iter().zip(at).map(pad).collect()
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
    let mut nodes: Vec<[f64; 3]> = sheet.fabric.places.iter().map(|uv| place(*uv)).collect();
    let raise = sheet.mold.as_ref().map_or(0.0, |mold| raise(Rim::new(mold, sheet.mesh), &nodes));
    nodes.iter_mut().for_each(|x| x[2] += raise);
    let turn = [0, 1, 2].map(|n| [u[n], v[n], normal[n]]);
    let pad = |gripper: &super::Gripper| {
        let [x, y, z] = place(gripper.place);
        Pad { turn, ..Pad::new([x, y, z + raise]) }
    };
    (nodes, sheet.grippers.iter().map(pad).collect())
}

/// How much higher nodes at `x` (m) must be to be clear of a mold (m).
fn raise(mold: Rim, x: &[[f64; 3]]) -> f64 {
    let mut raise = 0.0;
    for _ in 0..RAISES {
        let distances = x.iter().map(|[x, y, z]| mold.closest_point([*x, *y, z + raise]).distance);
        let depth = -distances.fold(0.0, f64::min);
        if depth == 0.0 {
            break;
        }
        raise += depth;
    }
    raise
}
