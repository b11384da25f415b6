//! The solver: one [`Assembly`], its forces and slopes, and the memory that makes the next step cheap.
//!
//! [`Solver::solve`] is the paper's section 3: build the assembly, iterate on the shared slopes by one of
//! the two rules, read off the forces. Between calls it remembers forces and slopes by place, so an assembly
//! that has gained or lost a span still starts warm. The iteration allocates nothing.

use super::assembly::{
    Assembly, Build, Element, End, Factors, PlaneSlope, SlopeSource, class, heading,
};
use super::element::{Evaluated, Wanted, evaluate, evaluate_still, length_residual, meet_length};
use super::status::{EarlyEnds, Equilibrium, Status};
use super::tuning::Tuning;
use super::{min_force, moment_balance};
use crate::catenary::SpanState;
use crate::ply::{Laid, Ply};
use crate::scene::{Settings, SlopeRule};

/// Change of an element's end slopes that its series takes: the force to its cube, the derivatives to its square,
/// 1e-10 of themselves.
const SMALL_TURN: f64 = 1e-5;

/// Multiple of its height above the buckling force beyond which a force's rounding is looked at.
const ROUGH: f64 = 1e3;

/// Finds equilibria, one after the other.
#[derive(Debug, Clone)]
pub struct Solver {
    pub(super) ply: Ply,
    pub(super) settings: Settings,
    pub(super) tuning: Tuning,
    pub(super) assembly: Assembly<f64>,
    /// Shared slopes, one a joint.
    pub(super) slopes: Vec<f64>,
    /// Slopes that hold both ends of each element; a free end's is its outcome.
    pub(super) held: Vec<[f64; 2]>,
    /// Each element's force with its derivatives.
    pub(super) evaluated: Vec<Evaluated<2>>,
    /// What is needed of each element's ends.
    pub(super) wanted: Vec<Wanted>,
    pub(super) work: Work,
    /// Height of each span's force above buckling, as a multiple of the parabola's.
    ratios: Vec<[Option<f64>; 2]>,
    /// Buckling force of each element with free ends, and the height of the parabola's force above it.
    heights: Vec<[f64; 2]>,
    memory: Vec<[f64; 2]>,
    /// The last solution of each span, by catenary and rest: one that has not moved needs no other.
    kept: Vec<[Option<Kept>; 2]>,
    /// What each element was evaluated with.
    known: Vec<Wanted>,
    /// Ratio of a force to its parabola's, found last for a span of the same kind with the same ends.
    alike: [Option<f64>; 12],
    /// Finds the same ply's equilibrium without constraints, where its slopes count.
    pub(super) unconstrained: Option<Box<Solver>>,
    /// Slopes at both ends of every element there; empty where they do not count.
    pub(super) free: Vec<[f64; 2]>,
    /// Whether shearing cells constrain slopes.
    pub(super) constrained: bool,
    /// Whether the assembly is that of the positions to solve for.
    is_built: bool,
}

/// A span as it was solved.
#[derive(Debug, Clone, Copy)]
struct Kept {
    element: Element<f64>,
    held: [f64; 2],
    evaluated: Evaluated<2>,
    known: Wanted,
}

impl Kept {
    /// Whether an element is the same span, whatever slopes hold it.
    fn is(&self, element: &Element<f64>) -> bool {
        let numbers = |e: &Element<f64>| [e.run, e.rise, e.length, e.weight, e.rigidity];
        let free = |e: &Element<f64>| e.ends.map(|end| matches!(end, End::Free));
        numbers(&self.element) == numbers(element)
            && free(&self.element) == free(element)
            && self.element.state == element.state
    }
}

/// Buffers of the iteration.
#[derive(Debug, Clone, Default)]
pub(super) struct Work {
    pub gradient: Vec<f64>,
    pub step: Vec<f64>,
    pub trial: Vec<f64>,
    pub active: Vec<bool>,
    pub diagonal: Vec<f64>,
    pub vectors: [Vec<f64>; 4],
    pub start: Vec<f64>,
    pub right: Vec<f64>,
    pub product: Vec<f64>,
    pub free: Vec<f64>,
    pub blocks: Vec<[[f64; 2]; 2]>,
    pub adjoint: Vec<[f64; 2]>,
    pub rows: Vec<[[(usize, f64); 2]; 2]>,
    pub early_ends: EarlyEnds,
}

impl Solver {
    /// A solver for a ply under given rules, with nothing remembered.
    #[must_use]
    pub fn new(ply: &Ply, settings: &Settings) -> Solver {
        Solver {
            ply: ply.clone(),
            settings: *settings,
            tuning: Tuning::default(),
            assembly: Assembly::default(),
            slopes: Vec::new(),
            held: Vec::new(),
            evaluated: Vec::new(),
            wanted: Vec::new(),
            work: Work::default(),
            ratios: vec![[None; 2]; ply.grid.catenaries()],
            heights: Vec::new(),
            memory: vec![[0.0; 2]; ply.grid.grippers()],
            kept: vec![[None; 2]; ply.grid.catenaries()],
            known: Vec::new(),
            alike: [None; 12],
            unconstrained: None,
            free: Vec::new(),
            constrained: true,
            is_built: false,
        }
    }

    /// The same solver with other tuning constants.
    #[must_use]
    pub fn with_tuning(mut self, tuning: Tuning) -> Solver {
        self.tuning = tuning;
        self.unconstrained = None;
        self
    }

    /// The tuning constants.
    #[must_use]
    pub fn tuning(&self) -> &Tuning {
        &self.tuning
    }

    /// Forgets earlier solutions: the next solve starts cold.
    pub fn forget(&mut self) {
        self.ratios.fill([None; 2]);
        self.kept.fill([None; 2]);
        self.memory.fill([0.0; 2]);
        if let Some(unconstrained) = &mut self.unconstrained {
            unconstrained.forget();
        }
    }

    /// Solves the equilibrium at gripper positions (m), in the order of [`crate::ply::Grid::index`],
    /// with what the mold has caught of each catenary.
    ///
    /// Where a cell has just begun to shear, the ply is solved without constraints first: those slopes are mixed
    /// with the plane's.
    pub fn solve(&mut self, positions: &[[f64; 3]], laid: &[Option<Laid>]) -> Equilibrium {
        self.free.clear();
        self.rebuild(positions, laid, 1.0);
        self.is_built = true;
        let mut auxiliary = None;
        if self.assembly.is_partly_constrained() {
            let mut solver = self.unconstrained.take().unwrap_or_else(|| {
                let mut solver = Solver::new(&self.ply, &self.settings).with_tuning(self.tuning);
                solver.constrained = false;
                Box::new(solver)
            });
            auxiliary = Some(solver.follow(positions, laid));
            self.free.extend_from_slice(&solver.held);
            self.is_built = false;
            self.unconstrained = Some(solver);
        }
        let outcome = self.follow(positions, laid);
        match auxiliary {
            None => outcome,
            Some(first) => Equilibrium {
                status: if first.status == Status::Converged {
                    outcome.status
                } else {
                    first.status
                },
                iterations: first.iterations + outcome.iterations,
                residual: outcome.residual.max(first.residual),
                length_residual: outcome.length_residual.max(first.length_residual),
                early_ends: first.early_ends.plus(outcome.early_ends),
            },
        }
    }

    /// Solves directly, or where that fails, as it may for stiff plies in compression, by continuation: the ply is
    /// made limp and stiffened step by step, which follows the hanging state to its like.
    fn follow(&mut self, positions: &[[f64; 3]], laid: &[Option<Laid>]) -> Equilibrium {
        let direct = self.attempt(positions, laid, 1.0);
        if direct.status == Status::Converged {
            return direct;
        }
        let Tuning { limp, growth, smallest_growth, .. } = self.tuning;
        let (mut iterations, mut early_ends) = (direct.iterations, direct.early_ends);
        let mut count = |outcome: &Equilibrium| {
            iterations += outcome.iterations;
            early_ends = early_ends.plus(outcome.early_ends);
            early_ends.continuation += 1;
            (iterations, early_ends)
        };
        self.forget_own();
        let (mut done, mut growth) = (limp, growth);
        count(&self.attempt(positions, laid, done));
        while growth > smallest_growth {
            let memory = (self.ratios.clone(), self.memory.clone());
            let next = f64::min(growth * done, 1.0);
            let outcome = self.attempt(positions, laid, next);
            let (iterations, early_ends) = count(&outcome);
            if outcome.status != Status::Converged {
                (self.ratios, self.memory) = memory;
                growth = growth.sqrt();
            } else if next >= 1.0 {
                return Equilibrium { iterations, early_ends, ..outcome };
            } else {
                done = next;
            }
        }
        self.forget_own();
        let outcome = self.attempt(positions, laid, 1.0);
        let (iterations, early_ends) = count(&outcome);
        Equilibrium { iterations, early_ends, ..outcome }
    }

    fn forget_own(&mut self) {
        self.ratios.fill([None; 2]);
        self.kept.fill([None; 2]);
        self.memory.fill([0.0; 2]);
    }

    fn rebuild(&mut self, positions: &[[f64; 3]], laid: &[Option<Laid>], stiffness: f64) {
        self.assembly.rebuild(&Build {
            ply: &self.ply,
            settings: &self.settings,
            positions,
            laid,
            factors: Factors { length: [1.0; 3], weight: [1.0; 3], rigidity: [stiffness; 3] },
            full_constraint: self.tuning.full_constraint,
            free: &self.free,
            constrained: self.constrained,
        });
    }

    /// Solves with the flexural rigidity multiplied by `stiffness`.
    fn attempt(
        &mut self,
        positions: &[[f64; 3]],
        laid: &[Option<Laid>],
        stiffness: f64,
    ) -> Equilibrium {
        if stiffness != 1.0 || !std::mem::take(&mut self.is_built) {
            self.rebuild(positions, laid, stiffness);
        }
        self.work.early_ends = EarlyEnds::default();
        self.recall();
        let outcome = match self.settings.slopes {
            SlopeRule::MinForce => min_force::solve(self),
            SlopeRule::MomentBalance => moment_balance::solve(self),
        };
        let length_residual = self.measure_lengths();
        self.remember();
        // a span that could not meet its length spoils the whole
        let met = length_residual <= self.tuning.length_tolerance;
        let status = if met { outcome.status } else { Status::LengthNotMet };
        Equilibrium { status, length_residual, early_ends: self.work.early_ends, ..outcome }
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
        hangs.then(|| self.evaluated[element].force.value)
    }

    /// Slopes at both ends of an element.
    #[must_use]
    pub fn end_slopes(&self, element: usize) -> [f64; 2] {
        self.held[element]
    }

    /// Slope of the ply at a gripper along a direction (0: u, 1: v), see [`Assembly::gripper_slope`]; `positions` (m) are
    /// those of the last solve.
    #[must_use]
    pub fn gripper_slope(
        &self,
        positions: &[[f64; 3]],
        gripper: usize,
        direction: usize,
    ) -> Option<f64> {
        let heading = heading(self.ply.grid, positions, gripper, direction)?;
        self.assembly.gripper_slope(gripper, direction, heading, [&self.free, &self.held])
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
        self.evaluated.clear();
        self.evaluated.resize(count, Evaluated::default());
        self.wanted.clear();
        self.wanted.resize(count, Wanted::default());
        self.known.clear();
        self.known.resize(count, Wanted::default());
        for n in 0..count {
            for end in self.assembly.elements[n].ends {
                match end {
                    End::Joint(_) => self.wanted[n].derivatives = true,
                    End::Plane(plane) => self.watch(n, &plane),
                    End::Free | End::Given(_) => {}
                }
            }
        }
        self.alike = [None; 12];
        self.heights.clear();
        for (n, element) in self.assembly.elements.iter().enumerate() {
            // the force follows the parabola's from step to step; NaN where the span is new
            let ratio = self.ratios[element.catenary][element.rest].unwrap_or(f64::NAN);
            let span = element.span(self.settings.axial_stiffness, &[]);
            let pole = span.buckling_force();
            let height = span.first_guess() - pole;
            self.heights.push([pole, height]);
            self.evaluated[n].force.value = pole + ratio * height;
            let kept = self.kept[element.catenary][element.rest].filter(|kept| kept.is(element));
            if let Some(kept) = kept {
                (self.held[n], self.evaluated[n], self.known[n]) =
                    (kept.held, kept.evaluated, kept.known);
            }
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
            // a free end's slope is an outcome, and holds nothing
            let held = |end: usize| match element.ends[end] {
                End::Free => 0.0,
                _ => self.held[n][end],
            };
            self.kept[element.catenary][element.rest] = Some(Kept {
                element: *element,
                held: [held(0), held(1)],
                evaluated: self.evaluated[n],
                known: self.known[n],
            });
            let [pole, height] = self.heights[n];
            let ratio = (self.evaluated[n].force.value - pole) / height;
            self.ratios[element.catenary][element.rest] =
                (element.state != SpanState::Straight && ratio.is_finite()).then_some(ratio);
        }
        for (joint, slope) in self.assembly.joints.iter().zip(&self.slopes) {
            self.memory[joint.gripper][joint.direction] = *slope;
        }
    }

    /// Evaluates the elements of a range at the present shared slopes.
    pub(super) fn evaluate_elements(&mut self, elements: std::ops::Range<usize>) {
        for n in elements {
            let element = self.assembly.elements[n];
            if element.state == SpanState::Straight {
                let slope = if element.run > 0.0 { element.rise / element.run } else { 0.0 };
                self.held[n] = [slope; 2];
                self.evaluated[n] = Evaluated::default();
                self.evaluated[n].slope.iter_mut().for_each(|s| s.value = slope);
                continue;
            }
            let slopes = [0, 1].map(|end| self.slope_at(&element, end));
            // nothing that holds it has moved: keep what is known
            let known = self.known[n].covers(self.wanted[n]);
            if known && slopes == self.held[n] && self.evaluated[n].carried <= self.tuning.carried {
                continue;
            }
            if known && self.wanted[n].derivatives && self.turn(n, slopes) {
                continue;
            }
            let guess = self.predict(n, slopes);
            let span = element.span(self.settings.axial_stiffness, &slopes);
            let wanted = self.wanted[n];
            self.evaluated[n] = if wanted.derivatives {
                evaluate::<3, 2>(&span, guess, wanted)
            } else {
                evaluate_still(&span, guess, wanted)
            };
            self.held[n] = slopes;
            self.known[n] = wanted;
            let [pole, height] = self.heights[n];
            self.alike[self.likeness(&element)] =
                Some((self.evaluated[n].force.value - pole) / height).filter(|r| r.is_finite());
        }
    }

    /// Carries an element to very slightly other end slopes by its second-order series, if they are that close;
    /// its length is measured at the end.
    fn turn(&mut self, n: usize, slopes: [f64; 2]) -> bool {
        let step = [slopes[0] - self.held[n][0], slopes[1] - self.held[n][1]];
        let Evaluated { force, slope, curvature, carried, length_residual } =
            &mut self.evaluated[n];
        let size = step[0].abs().max(step[1].abs());
        if !(size <= SMALL_TURN && *carried <= self.tuning.carried) {
            return false;
        }
        for jet in [force].into_iter().chain(slope).chain(curvature) {
            jet.value = series(jet, step);
            for i in 0..2 {
                jet.gradient[i] += jet.hessian[i][0] * step[0] + jet.hessian[i][1] * step[1];
            }
        }
        *carried += size;
        *length_residual = f64::NAN;
        self.held[n] = slopes;
        true
    }

    /// Whether no element's derivatives were carried far; if not, the next evaluation renews them.
    pub(super) fn is_sharp(&self) -> bool {
        self.evaluated.iter().all(|element| element.carried <= self.tuning.carried)
    }

    /// Largest relative error of a length, measured at the forces that are returned; slopes of free ends are
    /// read off on the way.
    fn measure_lengths(&mut self) -> f64 {
        let mut largest: f64 = 0.0;
        for (n, element) in self.assembly.elements.iter().enumerate() {
            if element.state == SpanState::Straight {
                continue;
            }
            let span = element.span(self.settings.axial_stiffness, &self.held[n]);
            let found = &mut self.evaluated[n];
            let near = 0.1 * self.tuning.length_tolerance;
            if found.length_residual.is_nan() || found.length_residual > near {
                (found.force.value, found.length_residual) =
                    meet_length(&span, Some(found.force.value));
            }
            // close to buckling the rounding of the force itself moves the length
            let [pole, _] = self.heights[n];
            if pole.abs() > ROUGH * (found.force.value - pole).abs() {
                found.length_residual = length_residual(&span, found.force.value);
            }
            let residual = found.length_residual;
            largest = largest.max(if residual.is_finite() { residual } else { f64::INFINITY });
            let free = element.ends.map(|end| matches!(end, End::Free));
            if free[0] || free[1] {
                let profile = crate::catenary::Profile::new(&span, found.force.value);
                for end in 0..2 {
                    if free[end] {
                        self.held[n][end] = profile.end_slope(end);
                    }
                }
            }
        }
        largest
    }

    /// Which spans are alike: of one kind, with the same ends free.
    fn likeness(&self, element: &Element<f64>) -> usize {
        let kind = class(self.ply.grid.catenary(element.catenary).kind);
        let [first, second] = element.ends.map(|end| usize::from(matches!(end, End::Free)));
        4 * kind + 2 * first + second
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
            SlopeSource::Outcome(edge, end) => self.evaluated[edge].slope[end].value,
        };
        plane.share[0] * slope(plane.source[0]) + plane.share[1] * slope(plane.source[1])
    }

    /// Force at new end slopes by the second-order series about the last ones.
    fn predict(&self, n: usize, slopes: [f64; 2]) -> Option<f64> {
        let jet = &self.evaluated[n].force;
        if jet.value.is_nan() {
            let [pole, height] = self.heights[n];
            let ratio = self.alike[self.likeness(&self.assembly.elements[n])];
            return ratio.map(|ratio| pole + ratio * height);
        }
        let held = self.held[n];
        if held[0].is_nan() {
            return Some(jet.value);
        }
        Some(series(jet, [slopes[0] - held[0], slopes[1] - held[1]]))
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
