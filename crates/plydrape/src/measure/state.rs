//! The ply of one step, with results that several measures share; each is computed when it is first needed.

use super::TUNING;
use crate::clearance::Poses;
use crate::draping::attitude::{Attitude, attitude, continued, normal};
use crate::draping::landing::{Landing, landing};
use crate::draping::misfit::{LyingSegment, Misfit, lying_segments, misfit};
use crate::draping::spans::Point;
use crate::draping::{Snapshot, stations};
use crate::equilibrium::Solver;
use crate::mold::vector::angle_between;
use crate::ply::Grid;
use crate::scene::Scene;
use std::cell::OnceCell;
use std::collections::VecDeque;

/// The step before, for rates and paths.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Before {
    /// Time (s).
    pub(crate) time: f64,
    /// Gripper positions (m).
    pub(crate) positions: Vec<Point>,
    /// Where the robot holds the grippers (m).
    pub(crate) commanded: Vec<Point>,
    /// Orientations of the grippers (x, y, z, w).
    pub(crate) quaternions: Vec<[f64; 4]>,
    /// Times (s) and orientations of earlier steps, back to `window` before this one and to the step before that.
    earlier: VecDeque<(f64, Vec<[f64; 4]>)>,
}

impl Before {
    /// Where everything is that bodies are mounted on.
    #[must_use]
    pub(crate) fn poses(&self, scene: &Scene) -> Poses {
        Poses::of(scene, &self.positions, &self.quaternions, &self.commanded)
    }
}

/// Time (s) over which a rate is taken at least: a share of the whole motion.
#[must_use]
pub(crate) fn window(scene: &Scene) -> f64 {
    window_of(scene.motion.times.last().copied().unwrap_or(0.0))
}

/// The same for a motion of a duration (s).
#[must_use]
pub(crate) fn window_of(duration: f64) -> f64 {
    TUNING.rate_window * duration
}

/// The ply of one step.
pub struct State<'a> {
    /// The scene that is draped.
    pub(crate) scene: &'a Scene,
    /// The ply.
    pub(crate) snapshot: &'a Snapshot,
    /// The solver, as it was left by the step.
    pub(crate) solver: &'a Solver,
    /// The step before; none of the first.
    pub(crate) before: Option<&'a Before>,
    attitudes: OnceCell<Vec<Attitude>>,
    lying: OnceCell<Vec<Vec<LyingSegment>>>,
    misfits: OnceCell<Vec<Misfit>>,
    landings: OnceCell<Vec<Option<Landing>>>,
    stations: OnceCell<Vec<Vec<Point>>>,
}

impl<'a> State<'a> {
    /// The ply of a step.
    #[must_use]
    pub(crate) fn new(
        scene: &'a Scene,
        snapshot: &'a Snapshot,
        solver: &'a Solver,
        before: Option<&'a Before>,
    ) -> Self {
        State {
            scene,
            snapshot,
            solver,
            before,
            attitudes: OnceCell::new(),
            lying: OnceCell::new(),
            misfits: OnceCell::new(),
            landings: OnceCell::new(),
            stations: OnceCell::new(),
        }
    }

    /// Number of edge catenaries; they come first.
    #[must_use]
    pub(crate) fn edges(&self) -> usize {
        self.scene.ply.lines().edges()
    }

    /// How the grippers are tilted.
    pub(crate) fn attitudes(&self) -> &[Attitude] {
        self.attitudes.get_or_init(|| {
            let (ply, positions) = (&self.scene.ply, &self.snapshot.positions);
            let neighbours = if ply.grid == Grid::NONE { ply.neighbours() } else { Vec::new() };
            let before = |n: usize| self.before.map(|before| before.quaternions[n]);
            let tolerance = self.scene.settings.contact.tolerance;
            let one = |n: usize| {
                let own = attitude(self.solver, ply, &neighbours, positions, n, before(n));
                let Some(mold) = &self.scene.mold else { return own };
                let closest = mold.closest_point(positions[n]);
                if closest.beyond || closest.normal[2] <= 0.0 {
                    return own;
                }
                own.landing(closest.distance, closest.normal, tolerance, before(n))
            };
            let mut attitudes: Vec<Attitude> = (0..ply.grippers()).map(one).collect();
            if self.scene.tool.is_some() {
                let commanded = self.snapshot.commanded();
                let stem = self.scene.stems(commanded);
                let fixed = self.scene.fixed_pads(commanded);
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

    /// Where everything is that bodies are mounted on.
    #[must_use]
    pub(crate) fn poses(&self) -> Poses {
        let turned: Vec<[f64; 4]> = self.attitudes().iter().map(|one| one.quaternion).collect();
        Poses::of(self.scene, &self.snapshot.positions, &turned, self.snapshot.commanded())
    }

    /// The state of this step that the next one needs.
    #[must_use]
    pub(crate) fn as_before(&self) -> Before {
        let time = self.snapshot.time;
        let mut earlier = VecDeque::new();
        if let Some(before) = self.before {
            earlier.clone_from(&before.earlier);
            earlier.push_back((before.time, before.quaternions.clone()));
        }
        // one step from before the window is enough
        while earlier.len() > 1 && time - earlier[1].0 >= window(self.scene) {
            earlier.pop_front();
        }
        Before {
            time,
            positions: self.snapshot.positions.clone(),
            commanded: self.snapshot.commanded().to_vec(),
            quaternions: self.attitudes().iter().map(|attitude| attitude.quaternion).collect(),
            earlier,
        }
    }

    /// The last step that is at least `window` before this one, else the first: the time since then (s) and its
    /// orientations. None in the first step.
    #[must_use]
    pub(crate) fn since(&self) -> Option<(f64, &[[f64; 4]])> {
        let before = self.before?;
        let earlier = before.earlier.iter().map(|(time, turned)| (*time, turned.as_slice()));
        let steps = earlier.chain([(before.time, before.quaternions.as_slice())]);
        since(steps, self.snapshot.time, window(self.scene))
    }

    /// The segments of each catenary that lie on the mold beside its contact.
    pub(crate) fn lying(&self) -> &[Vec<LyingSegment>] {
        self.lying.get_or_init(|| {
            let Some(mold) = &self.scene.mold else { return Vec::new() };
            let (lines, tolerance) =
                (self.scene.ply.lines(), self.scene.settings.contact.tolerance);
            let one = |(n, contact): (usize, &Option<_>)| {
                let grippers = lines.ends(n).map(|gripper| self.snapshot.positions[gripper]);
                let segments = |contact| lying_segments(n, contact, grippers, mold, tolerance);
                contact.as_ref().map(segments).unwrap_or_default()
            };
            self.snapshot.contacts.iter().enumerate().map(one).collect()
        })
    }

    /// How every free or lying segment fits: those that hang first, catenary by catenary.
    pub(crate) fn misfits(&self) -> &[Misfit] {
        self.misfits.get_or_init(|| {
            let hanging = self.snapshot.shape.spans.iter();
            let hanging = hanging.map(|s| misfit(s, self.snapshot.contacts[s.catenary].as_ref()));
            let lying = self.lying().iter().flatten().map(|segment| segment.misfit);
            hanging.chain(lying).collect()
        })
    }

    /// The misfits of edges; diagonals are no fibers.
    pub(crate) fn edge_misfits(&self) -> impl Iterator<Item = &Misfit> {
        let edges = self.edges();
        self.misfits().iter().filter(move |misfit| misfit.catenary < edges)
    }

    /// How each contact segment has landed, where the ideal drape is known.
    pub(crate) fn landings(&self) -> &[Option<Landing>] {
        self.landings.get_or_init(|| {
            let contact = self.snapshot.contacts.iter().enumerate();
            contact.map(|(n, contact)| landing(self.scene, n, contact.as_ref()?)).collect()
        })
    }

    /// Points of each free span (m), equally spaced along its run.
    pub(crate) fn stations(&self) -> &[Vec<Point>] {
        self.stations.get_or_init(|| self.snapshot.shape.spans.iter().map(stations).collect())
    }
}

/// The last of some earlier steps that is at least a window (s) before a time (s), else the first: the time since then (s) and its
/// orientations.
#[must_use]
pub(crate) fn since<'a>(
    earlier: impl DoubleEndedIterator<Item = (f64, &'a [[f64; 4]])> + Clone,
    time: f64,
    window: f64,
) -> Option<(f64, &'a [[f64; 4]])> {
    let long = window * (1.0 - 1e-9);
    let steps = earlier.map(|(then, turned)| (time - then, turned));
    let first = steps.clone().next();
    steps.rev().find(|(since, _)| *since >= long).or(first)
}
