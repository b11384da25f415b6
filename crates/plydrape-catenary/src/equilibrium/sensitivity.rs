//! Exact derivatives of the solved state, by the implicit function theorem, eq. (11) of
//! `docs/theory/equilibrium.md`.
//!
//! A direction of change of positions, lengths or material goes as a dual number through the
//! same problem and the same rule; what it does to the rule's residual at fixed slopes gives the slopes'
//! response through the matrix of the last Newton step, and a second pass gives every force.

use super::direction::Direction;
use super::force::Evaluated;
use super::newton::mark_active;
use super::problem::{End, Factors, Problem, SlopeSource, heading};
use super::rule::Response;
use super::solver::{SceneRule, Solver};
use super::state::State;
use crate::catenary::{Jet, SpanState};
use crate::ply::ContactSegment;
use num_dual::Dual64;

/// How the solved state changes along a [`Direction`].
#[derive(Debug, Clone, PartialEq)]
pub struct StateTangent {
    /// Change of each shared slope, one each of [`Problem::shared_slopes`].
    pub slopes: Vec<f64>,
    /// Change of each element's horizontal force (N); 0 where it has none.
    pub force: Vec<f64>,
    /// Change of the slopes at both ends of each element.
    pub end_slopes: Vec<[f64; 2]>,
    /// Change of each element's run, rise and fabric length (m).
    pub spans: Vec<[f64; 3]>,
    /// Change of each element's weight per length (N/m) and flexural rigidity (N·m²).
    pub loads: Vec<[f64; 2]>,
    /// Change of the taut path of each cell's stretched diagonal (m); 0 where none is.
    pub paths: Vec<f64>,
    /// Change of the slopes of the ply at each gripper along u and v, see [`Solver::gripper_slope`]; 0 where it has
    /// none.
    pub grippers: Vec<[f64; 2]>,
    /// Whether the linear systems of the slopes were solved. Where they were not, the state is no strict minimum (or
    /// no stable balance) and the other fields are no derivatives.
    pub is_sound: bool,
}

/// The last solved state of a [`Solver`], ready to be differentiated along any number of directions.
///
/// What does not depend on the direction is done once: every element's derivatives and the matrix of
/// the slopes. Where slopes are mixed with those of the unconstrained ply, that ply is differentiated first.
pub struct Linearized<'a> {
    positions: &'a [[f64; 3]],
    contacts: &'a [Option<ContactSegment>],
    own: Linearization<'a>,
    unconstrained: Option<Linearization<'a>>,
    sound: bool,
}

impl Linearized<'_> {
    /// How the state changes along a direction.
    pub fn along(&mut self, direction: &Direction) -> StateTangent {
        let (mut free, mut sound): (&[[Dual64; 2]], bool) = (&[], true);
        if let Some(linearization) = &mut self.unconstrained {
            let state = linearization.along(self.positions, self.contacts, direction, &[]);
            sound = state.is_sound;
            free = &linearization.pass.held;
        }
        let mut state = self.own.along(self.positions, self.contacts, direction, free);
        state.is_sound &= sound;
        self.sound &= state.is_sound;
        state
    }

    /// Whether every derivative taken so far is one: see [`StateTangent::is_sound`].
    #[must_use]
    pub fn is_sound(&self) -> bool {
        self.sound
    }
}

/// What does not depend on the direction, and buffers.
struct Linearization<'a> {
    solver: &'a Solver,
    /// Every element with derivatives to everything it depends on.
    jets: Vec<Evaluated<7>>,
    /// The rule, linearized at the solution.
    rule: SceneRule,
    active: Vec<bool>,
    moving: Vec<[Dual64; 3]>,
    problem: Problem<Dual64>,
    pass: Pass,
}

impl<'a> Linearization<'a> {
    /// The linearization at a solver's last state.
    fn new(solver: &'a Solver) -> Linearization<'a> {
        let (problem, state) = (solver.problem(), solver.state());
        let elements = 0..problem.elements.len();
        let jets: Vec<_> = elements.map(|n| state.differentiate(problem, n)).collect();
        // exact derivatives at the solution, where the last step was taken by series
        let state: State = state.refined(&jets);
        let (mut rule, mut active) = (solver.rule(), Vec::new());
        let mut residual = vec![0.0; state.slopes().len()];
        rule.get().residual(problem, &state, &mut residual);
        rule.get().linearize(problem, &state);
        mark_active(solver.bound(), state.slopes(), &residual, &mut active);
        let (moving, pass) = (Vec::new(), Pass::default());
        Linearization { solver, jets, rule, active, moving, problem: Problem::default(), pass }
    }

    /// How the state changes along a direction; `free` are the end slopes of the unconstrained ply, where they count.
    fn along(
        &mut self,
        positions: &[[f64; 3]],
        contacts: &[Option<ContactSegment>],
        direction: &Direction,
        free: &[[Dual64; 2]],
    ) -> StateTangent {
        let Linearization { solver, jets, rule, active, moving, problem, pass } = self;
        moving.clear();
        let moved = positions.iter().zip(&direction.grippers);
        moving.extend(moved.map(|(p, v)| [0, 1, 2].map(|n| Dual64::new(p[n], v[n]))));
        let factors = |changes: [f64; 3]| changes.map(|change| Dual64::new(1.0, change));
        let factors = Factors {
            length: factors(direction.length),
            weight: factors(direction.weight),
            rigidity: factors(direction.rigidity),
        };
        problem.rebuild(&solver.circumstances(moving, contacts, factors, free));

        // what the direction does to the rule at fixed slopes
        let solved = solver.slopes();
        pass.run(problem, jets, solved, &vec![0.0; solved.len()]);
        let change = rule.get().residual_change(problem, &pass.responses);
        // what the slopes answer, and with it everything else
        let (slopes, is_sound) = rule.get().respond(&change, active, solver.tuning());
        pass.run(problem, jets, solved, &slopes);
        let gripper_slope = |gripper: usize, direction: usize| {
            let heading = heading(solver.lines(), moving, gripper, direction)?;
            let free = |n: usize| free.get(n).copied();
            problem.gripper_slope(gripper, direction, heading, free, |n| Some(pass.held[n]))
        };
        let gripper = |n| [0, 1].map(|d| gripper_slope(n, d).map_or(0.0, |slope| slope.eps));
        let elements = &problem.elements;
        StateTangent {
            slopes,
            force: pass.responses.iter().map(|r| r.force.0.eps).collect(),
            end_slopes: pass.held.iter().map(|h| h.map(|s| s.eps)).collect(),
            spans: elements.iter().map(|e| [e.run.eps, e.rise.eps, e.length.eps]).collect(),
            loads: elements.iter().map(|e| [e.weight.eps, e.rigidity.eps]).collect(),
            paths: problem.shearing.iter().map(|s| s.map_or(0.0, |(path, _)| path.eps)).collect(),
            grippers: (0..positions.len()).map(gripper).collect(),
            is_sound,
        }
    }
}

impl Solver {
    /// Prepares the derivatives of the last solved state, for many directions.
    ///
    /// `positions` and `contacts` must be those of the last [`Solver::solve`]. Exact wherever the state is
    /// differentiable: not where a diagonal just begins to shear or a slope just reaches its limit.
    #[must_use]
    pub fn linearize<'a>(
        &'a self,
        positions: &'a [[f64; 3]],
        contacts: &'a [Option<ContactSegment>],
    ) -> Linearized<'a> {
        let own = Linearization::new(self);
        let unconstrained = self.unconstrained().map(Linearization::new);
        Linearized { positions, contacts, own, unconstrained, sound: true }
    }
}

/// A jet along the direction: its value and gradient to the end slopes as dual numbers.
fn along(jet: &Jet<7>, x: &[f64; 7]) -> (Dual64, [Dual64; 2]) {
    let dot = |row: &[f64; 7]| row.iter().zip(x).map(|(a, b)| a * b).sum::<f64>();
    let gradient = [0, 1].map(|k| Dual64::new(jet.gradient[k], dot(&jet.hessian[k])));
    (Dual64::new(jet.value, dot(&jet.gradient)), gradient)
}

/// Every element's response along a direction, the shared slopes changing by a given amount.
#[derive(Default)]
struct Pass {
    responses: Vec<Response<Dual64>>,
    held: Vec<[Dual64; 2]>,
}

impl Pass {
    /// Propagates the direction in `problem` through every element, the shared `slopes` changing by `change`.
    fn run(
        &mut self,
        problem: &Problem<Dual64>,
        jets: &[Evaluated<7>],
        slopes: &[f64],
        change: &[f64],
    ) {
        self.responses.clear();
        self.held.clear();
        let shared = |n: usize| Dual64::new(slopes[n], change[n]);
        for (element, jets) in problem.elements.iter().zip(jets) {
            // a straight element has the slope of its chord, and no force
            if element.state == SpanState::Straight {
                let slope = element.chord_slope();
                self.responses.push(Response::straight(slope));
                self.held.push([slope; 2]);
                continue;
            }

            // the slopes that hold the ends; edges come first, so a diagonal knows the slopes of its edges
            let held = element.ends.map(|end| match end {
                End::Free => None,
                End::Prescribed(slope) => Some(slope),
                End::Shared(n) => Some(shared(n)),
                End::Plane(plane) => Some(plane.slope(|source| match source {
                    SlopeSource::Prescribed(slope) => slope,
                    SlopeSource::Shared(n) => shared(n),
                    SlopeSource::Outcome(edge, end) => self.responses[edge].slope[end].0,
                })),
            });

            // how all that the element depends on changes along the direction
            let eps = |slope: Option<Dual64>| slope.map_or(0.0, |s| s.eps);
            let x = [
                eps(held[0]),
                eps(held[1]),
                element.run.eps,
                element.rise.eps,
                element.weight.eps,
                element.rigidity.eps,
                element.length.eps,
            ];

            // force, end slopes and end curvatures follow from the jets; a free end has the slope that comes out
            let slope = [0, 1].map(|end| along(&jets.slope[end], &x));
            let curvature = [0, 1].map(|end| along(&jets.curvature[end], &x).0);
            self.responses.push(Response { force: along(&jets.force, &x), slope, curvature });
            self.held.push([0, 1].map(|end| held[end].unwrap_or(slope[end].0)));
        }
    }
}
