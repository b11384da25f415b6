//! The drape: gripper positions step by step, the equilibrium at each, and what the mold catches.
//!
//! One loop, the paper's section 4: move the grippers ([`crate::scene::Motion`]), solve the equilibrium
//! ([`crate::equilibrium`]), look for contact ([`contact`]), measure ([`crate::measure`]) and record
//! ([`record`]). A search drapes in the same way and keeps the verdicts alone ([`Judged`]).

pub(crate) mod attitude;
pub mod contact;
mod curves;
pub mod gap;
pub(crate) mod landing;
pub(crate) mod load;
pub(crate) mod misfit;
pub(crate) mod reach;
pub mod record;
mod report;
pub mod spans;
mod stop;

use crate::equilibrium::{Equilibrium, Solver, Status};
use crate::measure::{Before, Judge, State, Verdict};
use crate::ply::{Grid, Kind, Laid, shear};
use crate::scene::{Scene, Stepping};
pub(crate) use attitude::attitude;
use contact::{Bridge, Diagonal};
pub use curves::curves;
pub(crate) use curves::hanging as stations;
use gap::{GapMemory, GapSamples};
pub(crate) use landing::fabric;
pub(crate) use misfit::{lying_segments, misfit};
use record::{Step, Summary};
use spans::{FreeSpan, Point, Shape, shape};
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

/// Smallest part of a step that cutting leaves.
const SMALLEST_CUT: f64 = 1.0 / 256.0;

/// Rounds of contact and equilibrium at one place of the grippers before the step counts as unsolved.
const MAX_ROUNDS: usize = 50;

/// How the contact of a step was followed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum ContactStatus {
    /// Until nothing changed any more, no new touch deeper than the tolerance.
    Followed,
    /// It still changed when the rounds at one place were spent.
    RoundLimit,
    /// An edge snapped onto the mold deeper than the tolerance, however short the step was cut: its depth is penetration.
    CutLimit,
}

impl ContactStatus {
    /// As tables have it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            ContactStatus::Followed => "followed",
            ContactStatus::RoundLimit => "round-limit",
            ContactStatus::CutLimit => "cut-limit",
        }
    }
}

/// The ply in one step, with everything that is known of it.
#[derive(Debug, Clone)]
pub struct Snapshot {
    /// Counts from 1, the start.
    pub step: usize,
    /// Time (s).
    pub time: f64,
    /// Gripper positions (m).
    pub positions: Vec<Point>,
    /// Free spans and the equilibrium that holds them.
    pub shape: Shape,
    /// What the mold has caught of each catenary.
    pub laid: Vec<Option<Laid>>,
    /// Touches that the model does not follow, by catenary.
    pub bridges: Vec<Option<Bridge>>,
    /// Depth of the deepest span below the mold (m), its catenary and the place (m): at the end of the step, and where an edge snapped
    /// onto the mold on the way. None if all are clear of it.
    pub deepest: Option<(f64, usize, Point)>,
    /// Shear of each cell that shears.
    pub shear: Vec<Option<CellShear>>,
    /// Equilibria solved in this step.
    pub equilibria: usize,
    /// The first equilibrium of this step that did not converge, or else the last one.
    pub solved: Equilibrium,
    /// How the contact was followed.
    pub contact: ContactStatus,
}

impl Snapshot {
    /// Why this step is no solution, if it is none.
    #[must_use]
    pub fn failure(&self) -> Option<&'static str> {
        match (self.solved.status, self.contact) {
            (Status::Converged, ContactStatus::RoundLimit) => {
                Some("contact that changes without end")
            }
            (Status::Converged, _) => None,
            (status, _) => Some(status.name()),
        }
    }
}

/// Shear of a cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CellShear {
    /// Shear angle γ (rad).
    pub angle: f64,
    /// Taut path of the stretched diagonal (m).
    pub path: f64,
    /// Whether the falling diagonal is the stretched one.
    pub falling: bool,
}

impl CellShear {
    /// Shear angle (rad), negative where the falling diagonal is the stretched one.
    #[must_use]
    pub fn signed(&self) -> f64 {
        if self.falling { -self.angle } else { self.angle }
    }
}

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
/// `progress` is told after each step how many are done; when it breaks, the drape ends there, complete
/// for the steps done. It also ends where no ply would survive, see `Summary::stopped`.
pub fn simulate(scene: &Scene, mut progress: impl FnMut(usize) -> ControlFlow<()>) -> Drape {
    let mut draping = Draping::new(scene);
    draping.run(&mut progress).0
}

/// Drapes without keeping more than the verdicts; broken off after the step in which more than `most` equilibria have
/// been solved. The times of the motion count for nothing.
pub(crate) fn judge(
    scene: &Scene,
    most: usize,
    mut progress: impl FnMut(usize) -> ControlFlow<()>,
) -> Judged {
    let mut draping = Draping { most, ..Draping::new(scene) };
    let mut judge = Judge::new(scene, false);
    let (planned, mut done, mut unsolved) = (scene.motion.positions.len(), 0, 0);
    let mut before: Option<Before> = None;
    for step in 0..planned {
        let snapshot = draping.advance(step);
        let state = State::new(scene, &snapshot, &draping.solver, before.as_ref());
        judge.see(&state, step + 1 == planned);
        unsolved += usize::from(snapshot.failure().is_some());
        done = step + 1;
        if progress(done).is_break() || draping.equilibria > most || stop::tears(&state) {
            break;
        }
        before = Some(state.as_before());
    }
    let limits = judge.verdicts();
    let accepted = done == planned && limits.iter().all(|verdict| verdict.ok);
    Judged { limits, accepted, missing: 1.0 - done as f64 / planned.max(1) as f64, unsolved }
}

/// A drape under way.
#[derive(Clone)]
pub(crate) struct Draping<'a> {
    scene: &'a Scene,
    /// The solver, as it was left by the last move.
    pub(crate) solver: Solver,
    /// Where the grippers are (m).
    pub(crate) positions: Vec<Point>,
    /// What the mold has caught of each catenary.
    pub(crate) laid: Vec<Option<Laid>>,
    bridges: Vec<Option<Bridge>>,
    deepest: Option<(f64, usize, Point)>,
    /// What has been seen of the mold from the spans.
    seen: GapMemory,
    equilibria: usize,
    /// The first equilibrium of a step that did not converge.
    unsolved: Option<Equilibrium>,
    contact: ContactStatus,
    /// Equilibria after which a step is not cut any further.
    most: usize,
    solving: Duration,
}

impl<'a> Draping<'a> {
    pub(crate) fn new(scene: &'a Scene) -> Self {
        let count = scene.ply.grid.catenaries();
        Draping {
            scene,
            solver: Solver::new(&scene.ply, &scene.settings),
            positions: scene.motion.positions[0].clone(),
            laid: vec![None; count],
            bridges: vec![None; count],
            deepest: None,
            seen: GapMemory::new(scene.mold.as_ref(), count),
            equilibria: 0,
            unsolved: None,
            contact: ContactStatus::Followed,
            most: usize::MAX,
            solving: Duration::ZERO,
        }
    }

    /// Drapes along the whole motion: the record, and the ply where it has come to.
    pub(crate) fn run(
        &mut self,
        progress: &mut impl FnMut(usize) -> ControlFlow<()>,
    ) -> (Drape, Option<Shape>) {
        let mut report = report::Report::new(self.scene);
        let mut last = None;
        for step in 0..self.scene.motion.positions.len() {
            let snapshot = self.advance(step);
            let goes_on = report.add(&snapshot, &self.solver);
            last = Some(snapshot.shape);
            if progress(step + 1).is_break() || !goes_on {
                break;
            }
        }
        let (steps, summary) = report.finish();
        (Drape { steps, summary, solving: self.solving }, last)
    }

    /// Solves the equilibrium at gripper positions.
    fn solve(&mut self, positions: &[Point]) -> Shape {
        let start = Instant::now();
        let equilibrium: Equilibrium = self.solver.solve(positions, &self.laid);
        self.solving += start.elapsed();
        self.equilibria += 1;
        if equilibrium.status != Status::Converged {
            self.unsolved.get_or_insert(equilibrium);
        }
        shape(&self.scene.ply, &self.solver, equilibrium, positions, &self.laid)
    }

    /// Moves the grippers to the positions of a step, counted from 0.
    fn advance(&mut self, step: usize) -> Snapshot {
        let before = self.equilibria;
        let goal = &self.scene.motion.positions[step];
        let shape = self.move_to(goal);
        Snapshot {
            step: step + 1,
            time: self.scene.motion.times[step],
            positions: goal.clone(),
            laid: self.laid.clone(),
            bridges: self.bridges.clone(),
            deepest: self.deepest,
            shear: self.shear(),
            equilibria: self.equilibria - before,
            solved: self.unsolved.unwrap_or(shape.equilibrium),
            contact: self.contact,
            shape,
        }
    }

    /// Moves the grippers and follows the contact, by the scene's rule for steps.
    pub(crate) fn move_to(&mut self, goal: &[Point]) -> Shape {
        (self.unsolved, self.contact) = (None, ContactStatus::Followed);
        self.deepest = None;
        let shape = match self.scene.settings.contact.stepping {
            Stepping::Once => self.arrive(goal),
            Stepping::Cut => self.cut_to(goal),
        };
        self.positions.clear();
        self.positions.extend_from_slice(goal);
        shape
    }

    fn shear(&self) -> Vec<Option<CellShear>> {
        let shearing = self.solver.problem().shearing.iter().enumerate();
        let shear = |(cell, stretched): (usize, &Option<(f64, bool)>)| {
            let (path, falling) = (*stretched)?;
            let sides = self.scene.ply.sides(cell, &self.laid);
            Some(CellShear { angle: shear::angle(sides, path), path, falling })
        };
        shearing.map(shear).collect()
    }

    /// As in the paper: one equilibrium, one look at the contact; solved anew where it has changed.
    fn arrive(&mut self, goal: &[Point]) -> Shape {
        let mut shape = self.solve(goal);
        let mut gaps = self.gaps(&shape);
        if self.touch(&shape, &gaps) {
            shape = self.solve(goal);
            gaps = self.gaps(&shape);
        }
        self.note_depth(&shape, &gaps);
        shape
    }

    /// Cuts the way where the ply would dip deeper than the tolerance, and follows the contact at each
    /// place until it rests.
    fn cut_to(&mut self, goal: &[Point]) -> Shape {
        let start = self.positions.clone();
        let at = |fraction: f64| -> Vec<Point> {
            start
                .iter()
                .zip(goal)
                .map(|(a, b)| [0, 1, 2].map(|n| a[n] + fraction * (b[n] - a[n])))
                .collect()
        };
        let (mut done, mut part) = (0.0, 1.0);
        loop {
            let next = f64::min(done + part, 1.0);
            let place = if next >= 1.0 { goal.to_vec() } else { at(next) };
            let unsolved = self.unsolved;
            let mut shape = self.solve(&place);
            let mut gaps = self.gaps(&shape);
            let deep = self.deep(&shape, &gaps).filter(|_| start != *goal);
            if deep.is_some() && part > SMALLEST_CUT {
                // this place is not gone to, and how it was solved says nothing
                self.unsolved = unsolved;
                part *= 0.5;
                continue;
            }
            // a fibre that snaps so far is penetration, which has a limit; a diagonal is none
            if deep.is_some_and(|catenary| catenary < self.scene.ply.grid.edges()) {
                self.contact = ContactStatus::CutLimit;
                self.note_depth(&shape, &gaps);
            }
            let mut rounds = 0;
            while self.touch(&shape, &gaps) {
                shape = self.solve(&place);
                gaps = self.gaps(&shape);
                rounds += 1;
                if rounds == MAX_ROUNDS {
                    self.contact = ContactStatus::RoundLimit;
                    break;
                }
            }
            if next >= 1.0 || self.equilibria > self.most {
                self.note_depth(&shape, &gaps);
                return shape;
            }
            (done, part) = (next, f64::min(2.0 * part, 1.0 - next));
        }
    }

    /// Where every span touches the mold; none without a mold.
    fn gaps(&mut self, shape: &Shape) -> Vec<GapSamples> {
        let Some(mold) = &self.scene.mold else {
            return Vec::new();
        };
        let tolerance = self.scene.settings.contact.tolerance;
        shape.spans.iter().map(|span| self.seen.samples(span, mold, tolerance)).collect()
    }

    /// The first span that touches anew, deeper below the mold than the tolerance: its catenary. Depths that no contact would
    /// change are left out: those of the grippers, and second touches; and so are diagonals that have landed: they
    /// are no fibres, and snap where the slopes at their grippers do.
    fn deep(&self, shape: &Shape, gaps: &[GapSamples]) -> Option<usize> {
        let mold = self.scene.mold.as_ref()?;
        let tolerance = self.scene.settings.contact.tolerance;
        let deep = |(span, gaps): &(&FreeSpan, &GapSamples)| {
            let caught = self.laid[span.catenary].is_some();
            let follows = !caught || span.catenary < self.scene.ply.grid.edges();
            follows
                && gaps.depth() > tolerance
                && contact::new_depth(span, gaps, mold, caught, tolerance) > tolerance
        };
        shape.spans.iter().zip(gaps).find(deep).map(|(span, _)| span.catenary)
    }

    /// Notes the deepest span of a step; diagonals that have landed are left out, as above.
    fn note_depth(&mut self, shape: &Shape, gaps: &[GapSamples]) {
        for (span, gaps) in shape.spans.iter().zip(gaps) {
            let landed = self.laid[span.catenary].is_some();
            if landed && span.catenary >= self.scene.ply.grid.edges() {
                continue;
            }
            let Some((t, distance)) = gaps.deepest() else { continue };
            if -distance > self.deepest.map_or(0.0, |(most, ..)| most) {
                self.deepest = Some((-distance, span.catenary, span.point(t)));
            }
        }
    }

    /// A diagonal that nothing has caught yet, and the shear of its cell.
    fn diagonal(&self, catenary: usize) -> Option<Diagonal> {
        let grid: Grid = self.scene.ply.grid;
        let cell = catenary.checked_sub(grid.edges())? / 2;
        let shearing = self.solver.problem().shearing[cell];
        let sides = self.scene.ply.sides(cell, &self.laid);
        let shear = shearing.map_or(0.0, |(path, falling)| {
            CellShear { angle: shear::angle(sides, path), path, falling }.signed()
        });
        let sign = if grid.catenary(catenary).kind == Kind::Rising { 1.0 } else { -1.0 };
        Some(Diagonal { sides: self.scene.ply.cell, shear, sign })
    }

    /// Looks at every span once; true if the contact has changed.
    fn touch(&mut self, shape: &Shape, gaps: &[GapSamples]) -> bool {
        let Some(mold) = &self.scene.mold else {
            return false;
        };
        let rule = &self.scene.settings.contact;
        let mut changed = false;
        for bridge in &mut self.bridges {
            *bridge = None;
        }
        // what lands in one look lands with the shear that its cell had before
        let diagonals: Vec<Option<Diagonal>> =
            shape.spans.iter().map(|span| self.diagonal(span.catenary)).collect();
        for ((span, gap), diagonal) in shape.spans.iter().zip(gaps).zip(diagonals) {
            let slot = &mut self.laid[span.catenary];
            let look = match slot {
                None => contact::first_touch(span, gap, mold, rule, diagonal),
                Some(laid) => contact::next_touch(span, gap, laid, mold, rule),
            };
            if let Some(laid) = look.laid {
                *slot = Some(laid);
                changed = true;
            }
            let deeper = |old: &Bridge, new: &Bridge| new.gap > old.gap;
            let bridge = &mut self.bridges[span.catenary];
            if let Some(new) = look.bridge
                && bridge.as_ref().is_none_or(|old| deeper(old, &new))
            {
                *bridge = Some(new);
            }
        }
        changed
    }
}
