//! The solver: one [`Assembly`], its forces and slopes, and the memory that makes the next step cheap.
//!
//! [`Solver::solve`] is the paper's section 3: build the assembly, iterate on the shared slopes by one of
//! the two rules, read off the forces. Between calls it remembers forces and slopes by place, so an assembly
//! that has gained or lost a span still starts warm. The iteration allocates nothing.

use super::assembly::{Assembly, Build, Element, End, Factors, PlaneSlope, SlopeSource};
use super::element::{Settled, Wanted, settle, settle_still};
use super::{min_force, moment_balance};
use crate::catenary::SpanState;
use crate::ply::{Laid, Ply};
use crate::scene::{Settings, SlopeRule};
use serde::{Deserialize, Serialize};

/// How a solve ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Status {
    /// The slopes satisfy their rule to rounding.
    Converged,
    /// The rule could not be satisfied further: no step improves it.
    Stalled,
    /// The iteration limit came first.
    IterationLimit,
}

impl Status {
    /// In words.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Status::Converged => "converged",
            Status::Stalled => "stalled",
            Status::IterationLimit => "iteration-limit",
        }
    }
}

/// How the last solve went.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Equilibrium {
    /// How it ended.
    pub status: Status,
    /// Iterations on the slopes.
    pub iterations: usize,
    /// Optimality that is left: the Newton step of the slopes still to go, bounds respected.
    pub residual: f64,
}

/// Iterations after which a solve gives up.
pub(super) const MAX_ITERATIONS: usize = 100;

/// Newton step of the slopes beyond which none may be the last.
const LAST_STEP: f64 = 3e-4;

/// Error of the slopes that a solve aims at.
const AIM: f64 = 1e-8;

/// Share of the flexural rigidity from which a difficult ply is stiffened.
const LIMP: f64 = 1e-4;

/// Growth of the rigidity below which stiffening is given up.
const SMALLEST_GROWTH: f64 = 1.05;

/// Relative error of a length that spoils an equilibrium.
const LENGTH: f64 = 1e-8;

/// Turn of an element's ends that its series takes: the force to its cube, the derivatives to its square.
const SMALL_TURN: f64 = 1e-4;

/// Relative step of H over which derivatives may have been carried at the last step.
const SHARP: f64 = 2e-4;

/// Error of the slopes to expect after a Newton step of `size` that came after one of `before`: the
/// convergence is quadratic.
pub(super) fn error_after(size: f64, before: f64) -> f64 {
    if before.is_finite() && size > 0.0 { size * (size / before).powi(2) } else { size }
}

/// Finds equilibria, one after the other.
#[derive(Debug, Clone)]
pub struct Solver {
    pub(super) ply: Ply,
    pub(super) settings: Settings,
    pub(super) assembly: Assembly<f64>,
    /// Shared slopes, one a joint.
    pub(super) slopes: Vec<f64>,
    /// Slopes that hold both ends of each element; a free end's is its outcome.
    pub(super) held: Vec<[f64; 2]>,
    /// Each element's force with its derivatives.
    pub(super) settled: Vec<Settled<2>>,
    /// What is needed of each element's ends.
    pub(super) wanted: Vec<Wanted>,
    pub(super) work: Work,
    /// Height of each span's force above buckling, as a multiple of the parabola's.
    ratios: Vec<[Option<f64>; 2]>,
    /// Buckling force of each element with free ends, and the height of the parabola's force above it.
    heights: Vec<[f64; 2]>,
    memory: Vec<[f64; 2]>,
}

/// Buffers of the iteration.
#[derive(Debug, Clone, Default)]
pub(super) struct Work {
    pub gradient: Vec<f64>,
    pub step: Vec<f64>,
    pub trial: Vec<f64>,
    pub active: Vec<bool>,
    pub held: Vec<bool>,
    pub diagonal: Vec<f64>,
    pub vectors: [Vec<f64>; 4],
    pub start: Vec<f64>,
    pub right: Vec<f64>,
    pub product: Vec<f64>,
    pub free: Vec<f64>,
    pub blocks: Vec<[[f64; 2]; 2]>,
    pub adjoint: Vec<[f64; 2]>,
    pub rows: Vec<[[(usize, f64); 2]; 2]>,
}

impl Solver {
    /// A solver for a ply under given rules, with nothing remembered.
    #[must_use]
    pub fn new(ply: &Ply, settings: &Settings) -> Solver {
        Solver {
            ply: ply.clone(),
            settings: *settings,
            assembly: Assembly::default(),
            slopes: Vec::new(),
            held: Vec::new(),
            settled: Vec::new(),
            wanted: Vec::new(),
            work: Work::default(),
            ratios: vec![[None; 2]; ply.grid.catenaries()],
            heights: Vec::new(),
            memory: vec![[0.0; 2]; ply.grid.grippers()],
        }
    }

    /// Forgets earlier solutions: the next solve starts cold.
    pub fn forget(&mut self) {
        self.ratios.fill([None; 2]);
        self.memory.fill([0.0; 2]);
    }

    /// Solves the equilibrium at gripper positions (m), in the order of [`crate::ply::Grid::index`],
    /// with what the mold has caught of each catenary.
    ///
    /// Where the direct way fails, as it may for stiff plies in compression, the ply is made limp and
    /// stiffened by and by: that follows the hanging state to its like.
    pub fn solve(&mut self, positions: &[[f64; 3]], laid: &[Option<Laid>]) -> Equilibrium {
        let direct = self.attempt(positions, laid, 1.0);
        if direct.status == Status::Converged {
            return direct;
        }
        let mut iterations = direct.iterations;
        self.forget();
        let (mut done, mut growth) = (LIMP, 4.0);
        self.attempt(positions, laid, done);
        while growth > SMALLEST_GROWTH {
            let memory = (self.ratios.clone(), self.memory.clone());
            let next = f64::min(growth * done, 1.0);
            let outcome = self.attempt(positions, laid, next);
            iterations += outcome.iterations;
            if outcome.status != Status::Converged {
                (self.ratios, self.memory) = memory;
                growth = growth.sqrt();
            } else if next >= 1.0 {
                return Equilibrium { iterations, ..outcome };
            } else {
                done = next;
            }
        }
        self.forget();
        Equilibrium { iterations, ..self.attempt(positions, laid, 1.0) }
    }

    /// Solves with the flexural rigidity multiplied by `stiffness`.
    fn attempt(
        &mut self,
        positions: &[[f64; 3]],
        laid: &[Option<Laid>],
        stiffness: f64,
    ) -> Equilibrium {
        let build = Build {
            ply: &self.ply,
            settings: &self.settings,
            positions,
            laid,
            factors: Factors { length: [1.0; 3], weight: [1.0; 3], rigidity: [stiffness; 3] },
        };
        self.assembly.rebuild(&build);
        self.recall();
        let outcome = match self.settings.slopes {
            SlopeRule::MinForce => min_force::solve(self),
            SlopeRule::MomentBalance => moment_balance::solve(self),
        };
        self.remember();
        // a span that could not meet its length spoils the whole
        let unmet = self.settled.iter().map(|settled| settled.unmet).fold(0.0, f64::max);
        let lost = self.settled.iter().any(|settled| !settled.force.value.is_finite());
        if lost || unmet > LENGTH {
            let residual = outcome.residual.max(unmet);
            return Equilibrium { status: Status::Stalled, residual, ..outcome };
        }
        outcome
    }

    /// The assembly of the last solve.
    #[must_use]
    pub fn assembly(&self) -> &Assembly<f64> {
        &self.assembly
    }

    /// Shared slopes of the last solve, one a joint of the assembly.
    #[must_use]
    pub fn slopes(&self) -> &[f64] {
        &self.slopes
    }

    /// Horizontal force (N) of an element; none for a straight inextensible or vertical one.
    #[must_use]
    pub fn force(&self, element: usize) -> Option<f64> {
        let hangs = self.assembly.elements[element].state != SpanState::Straight;
        hangs.then(|| self.settled[element].force.value)
    }

    /// Slopes at both ends of an element.
    #[must_use]
    pub fn end_slopes(&self, element: usize) -> [f64; 2] {
        self.held[element]
    }

    /// Which ends of an element have a prescribed slope.
    #[must_use]
    pub fn holds(&self, element: usize) -> [bool; 2] {
        self.assembly.elements[element].ends.map(|end| !matches!(end, End::Free))
    }

    /// The span of an element, as solved.
    #[must_use]
    pub fn span(&self, element: usize) -> crate::catenary::Span {
        self.assembly.elements[element].span(self.settings.axial_stiffness, &self.held[element])
    }

    /// Largest slope of a ball joint.
    pub(super) fn bound(&self) -> f64 {
        self.settings.max_tilt.tan()
    }

    /// Marks the bounds that hold a slope: where the gradient of the objective, or the jump of moment,
    /// would push it farther.
    pub(super) fn mark_active(&mut self) {
        let bound = self.bound();
        let Work { active, gradient, .. } = &mut self.work;
        active.clear();
        for (s, g) in self.slopes.iter().zip(gradient) {
            active.push((*s >= bound && *g < 0.0) || (*s <= -bound && *g > 0.0));
        }
    }

    /// Starts from what was found last time at the same places.
    fn recall(&mut self) {
        let (count, bound) = (self.assembly.elements.len(), self.bound());
        self.slopes.clear();
        for joint in &self.assembly.joints {
            let slope = self.memory[joint.gripper][joint.direction];
            self.slopes.push(slope.clamp(-bound, bound));
        }
        self.held.clear();
        self.held.resize(count, [f64::NAN; 2]);
        self.settled.clear();
        self.settled.resize(count, Settled::default());
        self.wanted.clear();
        self.wanted.resize(count, Wanted::default());
        for n in 0..count {
            for end in self.assembly.elements[n].ends {
                match end {
                    End::Joint(_) => self.wanted[n].derivatives = true,
                    End::Plane(plane) => self.watch(n, &plane),
                    End::Free | End::Given(_) => {}
                }
            }
        }
        self.heights.clear();
        for (n, element) in self.assembly.elements.iter().enumerate() {
            // the force follows the parabola's from step to step; NaN where the span is new
            let ratio = self.ratios[element.catenary][element.rest].unwrap_or(f64::NAN);
            let span = element.span(self.settings.axial_stiffness, &[]);
            let pole = span.buckling_force();
            let height = span.first_guess() - pole;
            self.heights.push([pole, height]);
            self.settled[n].force.value = pole + ratio * height;
        }
    }

    /// Notes what a diagonal's end needs of the edges that it follows.
    fn watch(&mut self, diagonal: usize, plane: &PlaneSlope<f64>) {
        for source in plane.source {
            match source {
                SlopeSource::Given(_) => {}
                SlopeSource::Joint(_) => self.wanted[diagonal].derivatives = true,
                SlopeSource::Outcome(edge, end) => {
                    self.wanted[edge].slope[end] = true;
                    self.wanted[diagonal].derivatives |= self.wanted[edge].derivatives;
                }
            }
        }
    }

    fn remember(&mut self) {
        for (n, element) in self.assembly.elements.iter().enumerate() {
            let [pole, height] = self.heights[n];
            let ratio = (self.settled[n].force.value - pole) / height;
            self.ratios[element.catenary][element.rest] =
                (element.state != SpanState::Straight && ratio.is_finite()).then_some(ratio);
        }
        for (joint, slope) in self.assembly.joints.iter().zip(&self.slopes) {
            self.memory[joint.gripper][joint.direction] = *slope;
        }
    }

    /// Settles the elements of a range at the present shared slopes.
    pub(super) fn settle(&mut self, elements: std::ops::Range<usize>) {
        for n in elements {
            let element = self.assembly.elements[n];
            if element.state == SpanState::Straight {
                let slope = if element.run > 0.0 { element.rise / element.run } else { 0.0 };
                self.held[n] = [slope; 2];
                self.settled[n] = Settled::default();
                self.settled[n].slope.iter_mut().for_each(|s| s.value = slope);
                continue;
            }
            let slopes = [0, 1].map(|end| self.slope_at(&element, end));
            // nothing that holds it has moved: keep what is known
            if slopes == self.held[n] && self.settled[n].carried <= SHARP {
                continue;
            }
            let step = [slopes[0] - self.held[n][0], slopes[1] - self.held[n][1]];
            if step[0].abs().max(step[1].abs()) <= SMALL_TURN && self.settled[n].carried <= SHARP {
                self.turn(n, slopes);
                continue;
            }
            let guess = self.predict(n, slopes);
            let span = element.span(self.settings.axial_stiffness, &slopes);
            let wanted = self.wanted[n];
            self.settled[n] = if wanted.derivatives {
                settle::<3, 2>(&span, guess, wanted)
            } else {
                settle_still(&span, guess, wanted)
            };
            self.held[n] = slopes;
        }
    }

    /// The slope that holds an end; 0 where nothing does.
    fn slope_at(&self, element: &Element<f64>, end: usize) -> f64 {
        match element.ends[end] {
            End::Free => 0.0,
            End::Given(slope) => slope,
            End::Joint(joint) => self.slopes[joint],
            End::Plane(plane) => self.plane_slope(&plane),
        }
    }

    fn plane_slope(&self, plane: &PlaneSlope<f64>) -> f64 {
        let slope = |source| match source {
            SlopeSource::Given(slope) => slope,
            SlopeSource::Joint(joint) => self.slopes[joint],
            SlopeSource::Outcome(edge, end) => self.settled[edge].slope[end].value,
        };
        plane.share[0] * slope(plane.source[0]) + plane.share[1] * slope(plane.source[1])
    }

    /// Force at new end slopes by the second-order series about the last ones.
    fn predict(&self, n: usize, slopes: [f64; 2]) -> Option<f64> {
        let jet = &self.settled[n].force;
        if jet.value.is_nan() {
            return None;
        }
        let held = self.held[n];
        if held[0].is_nan() {
            return Some(jet.value);
        }
        Some(series(jet, [slopes[0] - held[0], slopes[1] - held[1]]))
    }

    /// Whether a Newton step of `size` after one of `before` may be the last, taken by series.
    ///
    /// The derivatives must not have been carried a long way.
    pub(super) fn may_finish(&self, size: f64, before: f64) -> bool {
        size <= LAST_STEP && error_after(size, before) <= AIM && self.is_sharp()
    }

    fn is_sharp(&self) -> bool {
        self.settled.iter().all(|settled| settled.carried <= SHARP)
    }

    /// Takes a last small step of the shared slopes by series, without settling anew.
    pub(super) fn finish(&mut self, elements: std::ops::Range<usize>) {
        for n in elements {
            let element = self.assembly.elements[n];
            if element.state == SpanState::Straight {
                continue;
            }
            let slopes = [0, 1].map(|end| self.slope_at(&element, end));
            self.turn(n, slopes);
        }
    }

    /// Carries an element to slightly other end slopes by its second-order series.
    fn turn(&mut self, n: usize, slopes: [f64; 2]) {
        let step = [slopes[0] - self.held[n][0], slopes[1] - self.held[n][1]];
        let Settled { force, slope, curvature, carried, .. } = &mut self.settled[n];
        for jet in [force].into_iter().chain(slope).chain(curvature) {
            jet.value = series(jet, step);
            for i in 0..2 {
                jet.gradient[i] += jet.hessian[i][0] * step[0] + jet.hessian[i][1] * step[1];
            }
        }
        *carried += step[0].abs().max(step[1].abs());
        self.held[n] = slopes;
    }

    /// Writes the outcome of free ends where their slope is reported.
    pub(super) fn read_free_ends(&mut self) {
        for (n, element) in self.assembly.elements.iter().enumerate() {
            if element.state == SpanState::Straight {
                continue;
            }
            let free = element.ends.map(|end| matches!(end, End::Free));
            if free[0] || free[1] {
                let span = element.span(self.settings.axial_stiffness, &self.held[n]);
                let profile = crate::catenary::Profile::new(&span, self.settled[n].force.value);
                for end in 0..2 {
                    if free[end] {
                        self.held[n][end] = profile.end_slope(end);
                    }
                }
            }
        }
    }
}

/// Second-order series of a jet about its point.
fn series(jet: &crate::catenary::Jet<2>, step: [f64; 2]) -> f64 {
    let [a, b] = step;
    let [[aa, ab], [_, bb]] = jet.hessian;
    jet.value
        + jet.gradient[0] * a
        + jet.gradient[1] * b
        + 0.5 * (aa * a * a + bb * b * b)
        + ab * a * b
}
