//! One step after the other: the grippers move, and the contact follows.

use super::bridge::Bridge;
use super::contact::{self, Diagonal};
use super::gap::GapSamples;
use super::sampling::GapCache;
use super::spans::{Equilibrium, FreeSpan, Point};
use super::tuning::TUNING;
use super::{CellShear, ContactStatus, Snapshot};
use crate::equilibrium::{Solved, Solver, Status};
use crate::geometry::vector::between;
use crate::layup::{Layup, Stepping};
use crate::ply::{ContactSegment, Kind, Lines, shear};
use crate::stopwatch::Stopwatch;
use std::sync::Arc;
use std::time::Duration;

/// A drape under way.
#[derive(Clone)]
pub struct Draping<'a> {
    pub(super) layup: &'a Layup,
    /// The lines of the ply.
    lines: Arc<Lines>,
    /// The solver, as it was left by the last move.
    pub solver: Solver,
    /// Where the grippers are (m), which hold the fabric there.
    pub positions: Vec<Point>,
    /// Contact segment of each catenary.
    pub contacts: Vec<Option<ContactSegment>>,
    bridges: Vec<Option<Bridge>>,
    deepest: Option<(f64, usize, Point)>,
    /// Bounds of the gaps of each span from earlier steps.
    gap_cache: GapCache,
    pub(super) equilibria: usize,
    /// The first equilibrium of a step that did not converge.
    unsolved: Option<Solved>,
    contact_status: ContactStatus,
    /// Equilibria after which a step is not cut any further.
    pub(super) most: usize,
    pub(super) solving: Duration,
}

impl<'a> Draping<'a> {
    /// A layup at the start of its motion, without contact. Where the motion has no step, the grippers have no positions until they
    /// are moved.
    #[must_use]
    pub fn new(layup: &'a Layup) -> Self {
        let count = layup.ply.lines().catenaries();
        Draping {
            layup,
            lines: layup.ply.lines(),
            solver: Solver::new(&layup.ply, &layup.settings),
            positions: layup.motion.positions.first().cloned().unwrap_or_default(),
            contacts: vec![None; count],
            bridges: vec![None; count],
            deepest: None,
            gap_cache: GapCache::new(layup.mold.as_ref(), count),
            equilibria: 0,
            unsolved: None,
            contact_status: ContactStatus::Followed,
            most: usize::MAX,
            solving: Duration::ZERO,
        }
    }

    /// Solves the equilibrium at gripper positions (m).
    fn solve(&mut self, positions: &[Point]) -> Equilibrium {
        let watch = Stopwatch::start();
        let equilibrium = self.solver.solve(positions, &self.contacts);
        self.solving += watch.elapsed();
        self.equilibria += 1;
        if equilibrium.status != Status::Converged {
            self.unsolved.get_or_insert(equilibrium);
        }
        Equilibrium::new(&self.layup.ply, &self.solver, equilibrium, positions, &self.contacts)
    }

    /// Moves the grippers to the positions of a step, counted from 0.
    pub(super) fn advance(&mut self, step: usize) -> Snapshot {
        let before = self.equilibria;
        let goal = &self.layup.motion.positions[step];
        let shape = self.move_to(goal);
        Snapshot {
            step: step + 1,
            time: self.layup.motion.times[step],
            positions: goal.clone(),
            contacts: self.contacts.clone(),
            bridges: self.bridges.clone(),
            deepest: self.deepest,
            shear: self.shear(),
            equilibria: self.equilibria - before,
            solved: self.unsolved.unwrap_or(shape.solved),
            contact_status: self.contact_status,
            shape,
        }
    }

    /// Moves the grippers and follows the contact, by the layup's rule for steps.
    pub fn move_to(&mut self, goal: &[Point]) -> Equilibrium {
        (self.unsolved, self.contact_status) = (None, ContactStatus::Followed);
        self.deepest = None;
        let shape = match self.layup.settings.contact.stepping {
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
            let sides = self.layup.ply.trellis(&self.lines.cells()[cell], &self.contacts);
            Some(CellShear { angle: shear::angle(sides, path), path, falling })
        };
        shearing.map(shear).collect()
    }

    /// As in the paper: one equilibrium, the contact evaluated once; solved anew where it has changed.
    fn arrive(&mut self, goal: &[Point]) -> Equilibrium {
        let mut shape = self.solve(goal);
        let mut gaps = self.gaps(&shape);
        if self.update_contact(&shape, &gaps) {
            shape = self.solve(goal);
            gaps = self.gaps(&shape);
        }
        self.note_depth(&shape, &gaps);
        shape
    }

    /// Cuts the move where the ply would penetrate the mold deeper than the tolerance, and follows the contact at each position
    /// until it no longer changes.
    fn cut_to(&mut self, goal: &[Point]) -> Equilibrium {
        let start = self.positions.clone();
        let positions_at = |share: f64| -> Vec<Point> {
            start.iter().zip(goal).map(|(a, b)| between(*a, *b, share)).collect()
        };
        let (mut done, mut part) = (0.0, 1.0);
        loop {
            let next = f64::min(done + part, 1.0);
            let place = if next >= 1.0 { goal.to_vec() } else { positions_at(next) };
            let before = self.unsolved;
            let mut shape = self.solve(&place);
            let mut gaps = self.gaps(&shape);
            let deep = self.deep(&shape, &gaps).filter(|_| start != *goal);
            if deep.is_some() && part > TUNING.smallest_cut {
                // the grippers do not go to this position, so how it was solved does not count
                self.unsolved = before;
                part *= 0.5;
                continue;
            }
            // a fiber that jumps so far penetrates the mold, which has a limit; a diagonal is no fiber
            if deep.is_some_and(|catenary| catenary < self.lines.edges()) {
                self.contact_status = ContactStatus::CutLimit;
                self.note_depth(&shape, &gaps);
            }
            let mut rounds = 0;
            while self.update_contact(&shape, &gaps) {
                shape = self.solve(&place);
                gaps = self.gaps(&shape);
                rounds += 1;
                if rounds == TUNING.contact_rounds {
                    self.contact_status = ContactStatus::RoundLimit;
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

    /// Gap samples of every span; none without a mold.
    fn gaps(&mut self, shape: &Equilibrium) -> Vec<GapSamples> {
        let Some(mold) = &self.layup.mold else {
            return Vec::new();
        };
        let tolerance = self.layup.settings.contact.tolerance;
        shape.spans.iter().map(|span| self.gap_cache.samples(span, mold, tolerance)).collect()
    }

    /// The catenary of the first span with a new contact that is deeper below the mold than the tolerance. Depths that no contact would
    /// change are left out: those of the grippers, and second touches. Diagonals that have landed are left out too, because they
    /// are no fibers, and jump where the slopes at their grippers do.
    fn deep(&self, shape: &Equilibrium, gaps: &[GapSamples]) -> Option<usize> {
        let mold = self.layup.mold.as_ref()?;
        let tolerance = self.layup.settings.contact.tolerance;
        let deep = |(span, gaps): &(&FreeSpan, &GapSamples)| {
            let in_contact = self.contacts[span.catenary].is_some();
            let follows = !in_contact || span.catenary < self.lines.edges();
            follows
                && gaps.depth() > tolerance
                && contact::new_depth(span, gaps, mold, in_contact, tolerance) > tolerance
        };
        shape.spans.iter().zip(gaps).find(deep).map(|(span, _)| span.catenary)
    }

    /// Notes the deepest span of a step; diagonals that have landed are left out, as above.
    fn note_depth(&mut self, shape: &Equilibrium, gaps: &[GapSamples]) {
        for (span, gaps) in shape.spans.iter().zip(gaps) {
            let landed = self.contacts[span.catenary].is_some();
            if landed && span.catenary >= self.lines.edges() {
                continue;
            }
            let Some((t, distance)) = gaps.deepest() else { continue };
            if -distance > self.deepest.map_or(0.0, |(most, ..)| most) {
                self.deepest = Some((-distance, span.catenary, span.point(t)));
            }
        }
    }

    /// A bias line without contact, and the shear of its cell; of a side between two cells the mean of their sines.
    fn diagonal(&self, catenary: usize) -> Option<Diagonal> {
        let cells = self.lines.cells_of(catenary);
        let shear = |cell: usize| {
            let sides = self.layup.ply.trellis(&self.lines.cells()[cell], &self.contacts);
            self.solver.problem().shearing[cell].map_or(0.0, |(path, falling)| {
                CellShear { angle: shear::angle(sides, path), path, falling }.signed()
            })
        };
        let mut shears = cells.clone().map(shear);
        let shear = match [shears.next(), shears.next()] {
            [Some(first), Some(second)] => (0.5 * (first.sin() + second.sin())).asin(),
            [first, _] => first?,
        };
        let cell = &self.lines.cells()[cells.clone().next()?];
        let sides = cell.trellis.map(|side| side * self.layup.ply.length_factor);
        let sign = if self.lines.catenary(catenary).kind == Kind::Rising { 1.0 } else { -1.0 };
        Some(Diagonal { sides, fibers: cell.fibers, shear, sign })
    }

    /// Updates the contact of every span once; true if it has changed.
    fn update_contact(&mut self, shape: &Equilibrium, gaps: &[GapSamples]) -> bool {
        let Some(mold) = &self.layup.mold else {
            return false;
        };
        let rule = &self.layup.settings.contact;
        let mut changed = false;
        for bridge in &mut self.bridges {
            *bridge = None;
        }
        // diagonals that land together land with the shear that their cell had before
        let diagonals: Vec<Option<Diagonal>> =
            shape.spans.iter().map(|span| self.diagonal(span.catenary)).collect();
        for ((span, gap), diagonal) in shape.spans.iter().zip(gaps).zip(diagonals) {
            let slot = &mut self.contacts[span.catenary];
            let change = match slot {
                None => contact::first_contact(span, gap, mold, rule, diagonal),
                Some(contact) => contact::next_contact(span, gap, contact, mold, rule),
            };
            if let Some(segment) = change.segment {
                *slot = Some(segment);
                changed = true;
            }
            let deeper = |old: &Bridge, new: &Bridge| new.gap > old.gap;
            let bridge = &mut self.bridges[span.catenary];
            if let Some(new) = change.bridge
                && bridge.as_ref().is_none_or(|old| deeper(old, &new))
            {
                *bridge = Some(new);
            }
        }
        changed
    }
}
