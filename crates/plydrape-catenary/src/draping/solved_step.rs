//! A solved step and what follows from it; each part is computed when it is first needed.

use super::Snapshot;
use super::attitude::{Attitude, attitude};
use super::landing::{Landing, landing};
use super::misfit::{LyingSegment, Misfit, lying_segments, misfit};
use crate::equilibrium::Solver;
use crate::geometry::rotation::{continued, normal};
use crate::geometry::vector::angle_between;
use crate::layup::Layup;
use crate::ply::{ContactSegment, Grid};
use std::cell::OnceCell;

/// A solved step.
pub struct SolvedStep<'a> {
    /// What is draped.
    pub layup: &'a Layup,
    /// The ply.
    pub snapshot: &'a Snapshot,
    /// The solver, as it was left by the step.
    pub solver: &'a Solver,
    /// Orientations of the grippers in the step before (x, y, z, w), which signs continue; `None` in the first step.
    before: Option<&'a [[f64; 4]]>,
    attitudes: OnceCell<Vec<Attitude>>,
    hanging: OnceCell<Vec<Misfit>>,
    lying: OnceCell<Vec<Vec<LyingSegment>>>,
    landings: OnceCell<Vec<Option<Landing>>>,
}

impl<'a> SolvedStep<'a> {
    /// A step of which nothing has been asked yet.
    #[must_use]
    pub fn new(
        layup: &'a Layup,
        snapshot: &'a Snapshot,
        solver: &'a Solver,
        before: Option<&'a [[f64; 4]]>,
    ) -> Self {
        SolvedStep {
            layup,
            snapshot,
            solver,
            before,
            attitudes: OnceCell::new(),
            hanging: OnceCell::new(),
            lying: OnceCell::new(),
            landings: OnceCell::new(),
        }
    }

    /// How the grippers are tilted.
    pub fn attitudes(&self) -> &[Attitude] {
        self.attitudes.get_or_init(|| {
            let (ply, positions) = (&self.layup.ply, &self.snapshot.positions);
            let neighbors = if ply.grid == Grid::NONE { ply.neighbors() } else { Vec::new() };
            let before = |n: usize| self.before.map(|before| before[n]);
            let tolerance = self.layup.settings.contact.tolerance;
            // the ply turns a pad, and the mold does where it has come to it
            let turned = |n: usize| {
                let own = attitude(self.solver, ply, &neighbors, positions, n, before(n));
                let Some(mold) = &self.layup.mold else { return own };
                let closest = mold.closest_point(positions[n]);
                if closest.beyond || closest.normal[2] <= 0.0 {
                    return own;
                }
                own.landing(closest.distance, closest.normal, tolerance, before(n))
            };
            let mut attitudes: Vec<Attitude> = (0..ply.grippers()).map(turned).collect();
            // with a tool it tilts from the stem, and a pad without a joint is turned with the frame
            if self.layup.tool.is_some() {
                let stem = self.layup.stems(positions);
                let fixed = self.layup.fixed_pads(positions);
                for (n, attitude) in attitudes.iter_mut().enumerate() {
                    attitude.tilt = angle_between(normal(attitude.quaternion), stem);
                    if let Some(turned) = fixed {
                        attitude.quaternion = continued(turned, before(n));
                    }
                }
            }
            attitudes
        })
    }

    /// Orientations of the grippers (x, y, z, w), for the next step.
    #[must_use]
    pub fn quaternions(&self) -> Vec<[f64; 4]> {
        self.attitudes().iter().map(|attitude| attitude.quaternion).collect()
    }

    /// How each free span fits, in the order of [`Equilibrium::spans`](super::spans::Equilibrium::spans).
    pub fn hanging(&self) -> &[Misfit] {
        self.hanging.get_or_init(|| {
            let spans = self.snapshot.shape.spans.iter();
            spans.map(|span| misfit(span, self.snapshot.contacts[span.catenary].as_ref())).collect()
        })
    }

    /// The segments of each catenary beside its contact that do not hang; none without a mold.
    pub fn lying(&self) -> &[Vec<LyingSegment>] {
        self.lying.get_or_init(|| {
            let Some(mold) = &self.layup.mold else { return Vec::new() };
            let (lines, tolerance) =
                (self.layup.ply.lines(), self.layup.settings.contact.tolerance);
            let segments = |(n, contact): (usize, &Option<ContactSegment>)| {
                let Some(contact) = contact else { return Vec::new() };
                let grippers = lines.ends(n).map(|gripper| self.snapshot.positions[gripper]);
                lying_segments(n, contact, grippers, mold, tolerance)
            };
            self.snapshot.contacts.iter().enumerate().map(segments).collect()
        })
    }

    /// How each contact segment has landed, where the ideal drape is known.
    pub fn landings(&self) -> &[Option<Landing>] {
        self.landings.get_or_init(|| {
            let contacts = self.snapshot.contacts.iter().enumerate();
            contacts.map(|(n, contact)| landing(self.layup, n, contact.as_ref()?)).collect()
        })
    }
}
