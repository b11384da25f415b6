//! The drape: gripper positions step by step, the equilibrium at each, and what the mold catches.
//!
//! One loop, the paper's section 4: move the grippers ([`crate::scene::Motion`]), solve the equilibrium
//! ([`crate::equilibrium`]), look for contact ([`contact`]), measure (`measures`) and record
//! ([`record`]).

mod attitude;
pub mod contact;
mod crossing;
pub mod gap;
mod landing;
mod measures;
pub(crate) mod reach;
pub mod record;
mod report;
pub mod spans;

use crate::equilibrium::{Equilibrium, Solver};
use crate::mold::Mold;
use crate::ply::{Laid, shear};
use crate::scene::{Scene, Stepping};
pub(crate) use attitude::attitude;
use contact::{Bridge, IdealDiagonal};
use gap::{GapMemory, GapSamples};
pub(crate) use landing::fabric;
pub(crate) use measures::{fit, lying_rests};
use record::ResultFile;
use spans::{Point, Shape, shape};
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

/// Smallest part of a step that cutting leaves.
const SMALLEST_CUT: f64 = 1.0 / 256.0;

/// Rounds of contact at one place of the grippers before the rest is left to the next step.
const MAX_ROUNDS: usize = 50;

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
    /// Shear of each cell that shears.
    pub shear: Vec<Option<CellShear>>,
    /// Equilibria solved in this step.
    pub equilibria: usize,
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

/// A finished drape.
#[derive(Debug, Clone)]
pub struct Drape {
    /// Everything that is written.
    pub result: ResultFile,
    /// Time spent in equilibria; no part of the result, which is the same on every machine.
    pub solving: Duration,
}

/// Drapes the ply of a scene along its motion.
///
/// `progress` is told after each step how many are done; when it breaks, the drape ends there, complete
/// for the steps done.
pub fn simulate(scene: &Scene, progress: impl FnMut(usize) -> ControlFlow<()>) -> Drape {
    simulate_within(scene, usize::MAX, progress)
}

/// As [`simulate`], broken off after the step in which more than `most` equilibria have been solved.
pub(crate) fn simulate_within(
    scene: &Scene,
    most: usize,
    mut progress: impl FnMut(usize) -> ControlFlow<()>,
) -> Drape {
    let mut draping = Draping { most, ..Draping::new(scene) };
    let (result, _) = draping.run(&mut progress);
    Drape { result, solving: draping.solving }
}

/// What the ideal drape knows of each diagonal, where the mold is curved and the drape is known.
fn ideal_diagonals(scene: &Scene) -> Vec<Option<IdealDiagonal>> {
    let grid = scene.ply.grid;
    let mut out = vec![None; grid.catenaries()];
    let (Some(mold), Some(target)) = (&scene.mold, &scene.target) else { return out };
    if matches!(mold, Mold::Plane(_)) || target.drape.is_none() {
        return out;
    }
    for cell in 0..grid.cells() {
        let diagonals = [0, 1].map(|n| grid.edges() + 2 * cell + n);
        let ways = diagonals.map(|n| {
            let c = grid.catenary(n);
            let [a, b] = [c.from, c.to].map(|g| target.grippers[grid.index(g)]);
            mold.path_length(a, b)
        });
        let scale = shear::curved_scale(scene.ply.cell, ways);
        for (n, length) in diagonals.into_iter().zip(ways) {
            out[n] = Some(IdealDiagonal { length, scale });
        }
    }
    out
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
    ideal: Vec<Option<IdealDiagonal>>,
    /// What has been seen of the mold from the spans.
    seen: GapMemory,
    equilibria: usize,
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
            ideal: ideal_diagonals(scene),
            seen: GapMemory::new(scene.mold.as_ref(), count),
            equilibria: 0,
            most: usize::MAX,
            solving: Duration::ZERO,
        }
    }

    /// Drapes along the whole motion: the record, and the ply where it has come to.
    pub(crate) fn run(
        &mut self,
        progress: &mut impl FnMut(usize) -> ControlFlow<()>,
    ) -> (ResultFile, Option<Shape>) {
        let mut report = report::Report::new(self.scene);
        let mut last = None;
        for step in 0..self.scene.motion.positions.len() {
            let snapshot = self.advance(step);
            report.add(&snapshot, &self.solver);
            last = Some(snapshot.shape);
            if progress(step + 1).is_break() || self.equilibria > self.most {
                break;
            }
        }
        (report.finish(), last)
    }

    /// Solves the equilibrium at gripper positions.
    fn solve(&mut self, positions: &[Point]) -> Shape {
        let start = Instant::now();
        let equilibrium: Equilibrium = self.solver.solve(positions, &self.laid);
        self.solving += start.elapsed();
        self.equilibria += 1;
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
            shape,
            laid: self.laid.clone(),
            bridges: self.bridges.clone(),
            shear: self.shear(),
            equilibria: self.equilibria - before,
        }
    }

    /// Moves the grippers and follows the contact, by the scene's rule for steps.
    pub(crate) fn move_to(&mut self, goal: &[Point]) -> Shape {
        let shape = match self.scene.settings.contact.stepping {
            Stepping::Once => self.arrive(goal),
            Stepping::Cut => self.cut_to(goal),
        };
        self.positions.clear();
        self.positions.extend_from_slice(goal);
        shape
    }

    fn shear(&self) -> Vec<Option<CellShear>> {
        let shearing = self.solver.assembly().shearing.iter().enumerate();
        let shear = |(cell, stretched): (usize, &Option<(f64, bool)>)| {
            let (path, falling) = (*stretched)?;
            let sides = self.scene.ply.sides(cell, &self.laid);
            Some(CellShear { angle: shear::angle(sides, path), path, falling })
        };
        shearing.map(shear).collect()
    }

    /// As in the paper: one equilibrium, one look at the contact; solved anew where it has changed.
    fn arrive(&mut self, goal: &[Point]) -> Shape {
        let shape = self.solve(goal);
        let gaps = self.gaps(&shape);
        if self.touch(&shape, &gaps) { self.solve(goal) } else { shape }
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
            let mut shape = self.solve(&place);
            let mut gaps = self.gaps(&shape);
            if part > SMALLEST_CUT && self.is_deep(&gaps) && start != *goal {
                part *= 0.5;
                continue;
            }
            for _ in 0..MAX_ROUNDS {
                if !self.touch(&shape, &gaps) {
                    break;
                }
                shape = self.solve(&place);
                gaps = self.gaps(&shape);
            }
            if next >= 1.0 || self.equilibria > self.most {
                return shape;
            }
            (done, part) = (next, f64::min(2.0 * part, 1.0 - next));
        }
    }

    /// How far every span is from the mold; none without a mold.
    fn gaps(&mut self, shape: &Shape) -> Vec<GapSamples> {
        let Some(mold) = &self.scene.mold else {
            return Vec::new();
        };
        let tolerance = self.scene.settings.contact.tolerance;
        shape.spans.iter().map(|span| self.seen.samples(span, mold, tolerance)).collect()
    }

    /// Whether a span dips deeper below the mold than the tolerance.
    fn is_deep(&self, gaps: &[GapSamples]) -> bool {
        gaps.iter().any(|gap| gap.depth() > self.scene.settings.contact.tolerance)
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
        for (span, gap) in shape.spans.iter().zip(gaps) {
            let slot = &mut self.laid[span.catenary];
            let look = match slot {
                None => {
                    let ideal = self.ideal[span.catenary];
                    contact::first_touch(span, gap, mold, rule, ideal)
                }
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
