//! The solver: one [`Problem`] after the other, each with a warm start from the one before.
//!
//! [`Solver::solve`] is the paper's section 3: state the problem, iterate on the shared slopes by one of
//! the two rules, read off the forces. Where that fails, as it may for stiff plies in compression, the ply is made
//! limp and stiffened step by step. The last attempt takes whole Newton steps without a line search.

use super::min_force::MinForce;
use super::moment_balance::MomentBalance;
use super::newton::{Newton, StepLength};
use super::problem::{Circumstances, End, Factors, Problem, heading};
use super::rule::Rule;
use super::state::State;
use super::status::{Solved, Status};
use super::tuning::EquilibriumTuning;
use super::warm_start::WarmStart;
use crate::catenary::{Span, SpanState};
use crate::layup::{Settings, SlopeRule};
use crate::ply::{ContactSegment, Lines, Ply};
use std::sync::Arc;

/// Finds equilibria, one after the other.
#[derive(Debug, Clone)]
pub struct Solver {
    ply: Ply,
    lines: Arc<Lines>,
    settings: Settings,
    tuning: EquilibriumTuning,
    problem: Problem<f64>,
    state: State,
    rule: SceneRule,
    newton: Newton,
    warm_start: WarmStart,
    /// Finds the same ply's equilibrium without constraints, where its slopes count.
    unconstrained: Option<Box<Solver>>,
    /// Slopes at both ends of every element there; empty where they do not count.
    free: Vec<[f64; 2]>,
    /// Whether shearing cells constrain slopes.
    constrained: bool,
}

/// The rule that a scene asks for, with its buffers.
#[derive(Debug, Clone)]
pub enum SceneRule {
    /// Least forces.
    MinForce(Box<MinForce>),
    /// Balanced moments.
    MomentBalance(MomentBalance),
}

impl SceneRule {
    fn new(rule: SlopeRule) -> SceneRule {
        match rule {
            SlopeRule::MinForce => SceneRule::MinForce(Box::default()),
            SlopeRule::MomentBalance => SceneRule::MomentBalance(MomentBalance::default()),
        }
    }

    /// The rule itself.
    pub fn get(&mut self) -> &mut dyn Rule {
        match self {
            SceneRule::MinForce(rule) => rule.as_mut(),
            SceneRule::MomentBalance(rule) => rule,
        }
    }
}

impl Solver {
    /// A solver for a ply under the rules of a scene, without earlier solutions.
    #[must_use]
    pub fn new(ply: &Ply, settings: &Settings) -> Solver {
        let tuning = EquilibriumTuning::default();
        Solver {
            ply: ply.clone(),
            lines: ply.lines(),
            settings: *settings,
            tuning,
            problem: Problem::default(),
            state: State::new(settings.axial_stiffness, tuning),
            rule: SceneRule::new(settings.slopes),
            newton: Newton::default(),
            warm_start: WarmStart::new(&ply.lines()),
            unconstrained: None,
            free: Vec::new(),
            constrained: true,
        }
    }

    /// This solver with other tuning constants.
    #[must_use]
    pub fn with_tuning(mut self, tuning: EquilibriumTuning) -> Solver {
        self.tuning = tuning;
        self.state = State::new(self.settings.axial_stiffness, tuning);
        self.unconstrained = None;
        self
    }

    /// The tuning constants.
    #[must_use]
    pub(crate) fn tuning(&self) -> &EquilibriumTuning {
        &self.tuning
    }

    /// Removes earlier solutions: the next solve starts cold.
    pub fn forget(&mut self) {
        self.warm_start.clear();
        if let Some(unconstrained) = &mut self.unconstrained {
            unconstrained.forget();
        }
    }

    /// Solves the equilibrium at gripper positions (m), in the order of [`crate::ply::Ply::index`],
    /// with the contact segment of each catenary.
    ///
    /// Where a cell has just begun to shear, the ply is solved without constraints first: those slopes are mixed
    /// with the plane's.
    pub fn solve(&mut self, positions: &[[f64; 3]], contacts: &[Option<ContactSegment>]) -> Solved {
        self.free.clear();
        self.state_problem(positions, contacts, 1.0);
        if !self.problem.is_partly_constrained() {
            return self.follow(positions, contacts);
        }
        let mut solver = self.unconstrained.take().unwrap_or_else(|| {
            let mut solver = Solver::new(&self.ply, &self.settings).with_tuning(self.tuning);
            solver.constrained = false;
            Box::new(solver)
        });
        let first = solver.solve(positions, contacts);
        self.free.extend(solver.state.all_end_slopes());
        self.unconstrained = Some(solver);
        self.state_problem(positions, contacts, 1.0);
        first.and(self.follow(positions, contacts))
    }

    /// Solves the stated problem directly, or where that fails by continuation in the stiffness, which follows the
    /// hanging state to its like, or at last by whole Newton steps from where the line search ended.
    fn follow(&mut self, positions: &[[f64; 3]], contacts: &[Option<ContactSegment>]) -> Solved {
        let direct = self.attempt(StepLength::LineSearch);
        if direct.status == Status::Converged {
            return direct;
        }
        let EquilibriumTuning { limp, mut growth, smallest_growth, .. } = self.tuning;
        let mut counted = direct;
        let mut stiffened = |solver: &mut Solver, stiffness: f64| {
            solver.state_problem(positions, contacts, stiffness);
            counted = counted.then(solver.attempt(StepLength::LineSearch));
            counted
        };
        self.warm_start.clear();
        let mut done = limp;
        stiffened(self, limp);
        while growth > smallest_growth {
            let before = self.warm_start.clone();
            let next = f64::min(growth * done, 1.0);
            let outcome = stiffened(self, next);
            if outcome.status != Status::Converged {
                self.warm_start = before;
                growth = growth.sqrt();
            } else if next >= 1.0 {
                return outcome;
            } else {
                done = next;
            }
        }
        self.warm_start.clear();
        let cold = stiffened(self, 1.0);
        if cold.status == Status::Converged {
            return cold;
        }
        // a line search ends where the objective jumps at a fold, and whole steps cross it; if they find nothing, the state
        // of the line search stays
        let (state, warm_start) = (self.state.clone(), self.warm_start.clone());
        let crossed = cold.then(self.attempt(StepLength::Whole));
        if crossed.status == Status::Converged {
            return crossed;
        }
        (self.state, self.warm_start) = (state, warm_start);
        let Solved { iterations, early_ends, .. } = crossed;
        Solved { iterations, early_ends, ..cold }
    }

    /// States the problem, with the flexural rigidity multiplied by `stiffness`.
    fn state_problem(
        &mut self,
        positions: &[[f64; 3]],
        contacts: &[Option<ContactSegment>],
        stiffness: f64,
    ) {
        self.problem.rebuild(&Circumstances {
            ply: &self.ply,
            lines: &self.lines,
            settings: &self.settings,
            tuning: &self.tuning,
            positions,
            contacts,
            factors: Factors { length: [1.0; 3], weight: [1.0; 3], rigidity: [stiffness; 3] },
            free: &self.free,
            constrained: self.constrained,
        });
    }

    /// Solves the stated problem from the warm start.
    fn attempt(&mut self, step_length: StepLength) -> Solved {
        let bound = self.bound();
        let Solver { problem, state, rule, tuning, .. } = self;
        self.warm_start.start(problem, bound, state);
        let outcome = self.newton.solve(rule.get(), problem, state, bound, step_length, tuning);
        self.warm_start.store(problem, state);
        outcome
    }

    /// The problem of the last solve.
    #[must_use]
    pub fn problem(&self) -> &Problem<f64> {
        &self.problem
    }

    /// The last solved state.
    pub(super) fn state(&self) -> &State {
        &self.state
    }

    /// The rule for the shared slopes.
    pub(super) fn rule(&self) -> SceneRule {
        self.rule.clone()
    }

    /// Largest slope of a ball joint.
    pub(super) fn bound(&self) -> f64 {
        self.settings.max_tilt.tan()
    }

    /// The solver without constraints, where its slopes count.
    pub(super) fn unconstrained(&self) -> Option<&Solver> {
        self.unconstrained.as_deref().filter(|_| !self.free.is_empty())
    }

    /// The circumstances of the last solve, with other positions and factors.
    pub(super) fn circumstances<'a, T>(
        &'a self,
        positions: &'a [[T; 3]],
        contacts: &'a [Option<ContactSegment>],
        factors: Factors<T>,
        free: &'a [[T; 2]],
    ) -> Circumstances<'a, T> {
        let Solver { ply, lines, settings, tuning, constrained, .. } = self;
        Circumstances {
            ply,
            lines,
            settings,
            tuning,
            positions,
            contacts,
            factors,
            free,
            constrained: *constrained,
        }
    }

    /// The lines of the ply.
    pub(crate) fn lines(&self) -> &Lines {
        &self.lines
    }

    /// Shared slopes of the last solve, one each of [`Problem::shared_slopes`].
    #[must_use]
    pub fn slopes(&self) -> &[f64] {
        self.state.slopes()
    }

    /// Horizontal force (N) of an element; `None` for a straight inextensible or vertical one.
    #[must_use]
    pub fn force(&self, element: usize) -> Option<f64> {
        let hangs = self.problem.elements[element].state != SpanState::Straight;
        hangs.then(|| self.state.element(element).force.value)
    }

    /// Slopes at both ends of an element.
    #[must_use]
    pub fn end_slopes(&self, element: usize) -> [f64; 2] {
        self.state.end_slopes(element)
    }

    /// Slope of the ply at a gripper along a direction (0: u, 1: v), see [`Problem::gripper_slope`]; `positions` (m) are
    /// those of the last solve.
    #[must_use]
    pub fn gripper_slope(
        &self,
        positions: &[[f64; 3]],
        gripper: usize,
        direction: usize,
    ) -> Option<f64> {
        let heading = heading(&self.lines, positions, gripper, direction)?;
        let held = |element: usize| Some(self.state.end_slopes(element));
        let free = |element: usize| self.free.get(element).copied();
        self.problem.gripper_slope(gripper, direction, heading, free, held)
    }

    /// Which ends of an element have a prescribed slope.
    #[must_use]
    pub fn holds(&self, element: usize) -> [bool; 2] {
        self.problem.elements[element].ends.map(|end| !matches!(end, End::Free))
    }

    /// The span of an element, as solved.
    #[must_use]
    pub fn span(&self, element: usize) -> Span {
        let slopes = self.state.end_slopes(element);
        self.problem.elements[element].span(self.settings.axial_stiffness, &slopes)
    }
}
