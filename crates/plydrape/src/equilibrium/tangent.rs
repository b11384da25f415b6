//! Exact derivatives of the solved state, by the implicit function theorem, eq. (11) of
//! `docs/theory/equilibrium.md`.
//!
//! A direction of change of positions, lengths or material is carried as a dual number through the
//! same assembly and the same rule; what it does to the rule's residual at fixed slopes gives the slopes'
//! response through the matrix of the last Newton step, and a second pass gives every force.

use super::assembly::{Assembly, Build, End, Factors, SlopeSource, heading};
use super::direction::Direction;
use super::element::{Evaluated, Wanted, evaluate};
use super::hessian::assemble;
use super::min_force::{self, Response};
use super::moment_balance;
use super::solver::{Solver, Work};
use crate::catenary::{Jet, SpanState};
use crate::ply::Laid;
use crate::scene::SlopeRule;
use num_dual::Dual64;

/// How the solved state changes along a [`Direction`].
#[derive(Debug, Clone, PartialEq)]
pub struct StateTangent {
    /// Change of each shared slope, one a joint of the assembly.
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

/// A jet along the direction: its value and gradient to the end slopes as dual numbers.
fn along(jet: &Jet<7>, x: &[f64; 7]) -> (Dual64, [Dual64; 2]) {
    let dot = |row: &[f64; 7]| row.iter().zip(x).map(|(a, b)| a * b).sum::<f64>();
    let gradient = [0, 1].map(|k| Dual64::new(jet.gradient[k], dot(&jet.hessian[k])));
    (Dual64::new(jet.value, dot(&jet.gradient)), gradient)
}

/// Every element's response along a direction, the shared slopes changing by a given amount.
#[derive(Debug, Default)]
struct Pass {
    responses: Vec<Response<Dual64>>,
    curvatures: Vec<[Dual64; 2]>,
    held: Vec<[Dual64; 2]>,
}

/// The last solved state of a [`Solver`], ready to be differentiated along any number of directions.
///
/// What does not depend on the direction is done once: every element's derivatives and the matrix of
/// the slopes. Where slopes are mixed with those of the unconstrained ply, that ply is differentiated first.
#[derive(Debug)]
pub struct Linearized<'a> {
    solver: &'a mut Solver,
    positions: &'a [[f64; 3]],
    laid: &'a [Option<Laid>],
    own: Linearization,
    unconstrained: Option<Linearization>,
    sound: bool,
}

impl Linearized<'_> {
    /// How the state changes along a direction.
    pub fn along(&mut self, direction: &Direction) -> StateTangent {
        let mut free: &[[Dual64; 2]] = &[];
        let mut sound = true;
        if let (Some(linearization), Some(solver)) =
            (&mut self.unconstrained, &mut self.solver.unconstrained)
        {
            let state = linearization.along(solver, self.positions, self.laid, direction, &[]);
            sound = state.is_sound;
            free = &linearization.pass.held;
        }
        let mut state = self.own.along(self.solver, self.positions, self.laid, direction, free);
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
#[derive(Debug)]
struct Linearization {
    jets: Vec<Evaluated<7>>,
    moving: Vec<[Dual64; 3]>,
    assembly: Assembly<Dual64>,
    pass: Pass,
    gradient: Vec<Dual64>,
    adjoint: Vec<[Dual64; 2]>,
    change: Vec<f64>,
}

impl Linearization {
    /// Of a solver's last state.
    fn new(solver: &mut Solver) -> Linearization {
        let jets: Vec<Evaluated<7>> =
            (0..solver.assembly.elements.len()).map(|n| solver.all_jets(n)).collect();
        solver.refresh(&jets);
        if solver.settings.slopes == SlopeRule::MinForce {
            assemble(solver);
        }
        Linearization {
            jets,
            moving: Vec::new(),
            assembly: Assembly::default(),
            pass: Pass::default(),
            gradient: Vec::new(),
            adjoint: Vec::new(),
            change: Vec::new(),
        }
    }

    /// How the state changes along a direction; `free` are the end slopes of the unconstrained ply, where they count.
    fn along(
        &mut self,
        solver: &mut Solver,
        positions: &[[f64; 3]],
        laid: &[Option<Laid>],
        direction: &Direction,
        free: &[[Dual64; 2]],
    ) -> StateTangent {
        self.moving.clear();
        let moved = positions.iter().zip(&direction.grippers);
        self.moving.extend(moved.map(|(p, v)| [0, 1, 2].map(|n| Dual64::new(p[n], v[n]))));
        let factors = |changes: [f64; 3]| changes.map(|change| Dual64::new(1.0, change));
        self.assembly.rebuild(&Build {
            ply: &solver.ply,
            settings: &solver.settings,
            positions: &self.moving,
            laid,
            factors: Factors {
                length: factors(direction.length),
                weight: factors(direction.weight),
                rigidity: factors(direction.rigidity),
            },
            full_constraint: solver.tuning.full_constraint,
            free,
            constrained: solver.constrained,
        });

        // what the direction does to the rule at fixed slopes
        let joints = solver.slopes.len();
        let mut slopes = vec![0.0; joints];
        self.pass.run(solver, &self.assembly, &self.jets, &slopes);
        let (assembly, pass) = (&self.assembly, &self.pass);
        self.change.clear();
        match solver.settings.slopes {
            SlopeRule::MinForce => {
                self.gradient.resize(joints, Dual64::from(0.0));
                self.adjoint.resize(assembly.elements.len(), [Dual64::from(0.0); 2]);
                let response = |n: usize| pass.responses[n];
                min_force::gradient(assembly, response, &mut self.gradient, &mut self.adjoint);
                self.change.extend(self.gradient.iter().map(|g| g.eps));
            }
            SlopeRule::MomentBalance => {
                let curvature = |e: usize, end: usize| pass.curvatures[e][end];
                let jump = |j| moment_balance::jump(assembly, j, curvature).eps;
                self.change.extend((0..joints).map(jump));
            }
        }
        // what the slopes answer, and with it everything else
        let is_sound = match solver.settings.slopes {
            SlopeRule::MinForce => min_force::respond(solver, &self.change, &mut slopes),
            SlopeRule::MomentBalance => moment_balance::respond(solver, &self.change, &mut slopes),
        };
        self.pass.run(solver, &self.assembly, &self.jets, &slopes);
        let (assembly, pass, moving) = (&self.assembly, &self.pass, &self.moving);
        let gripper_slope = |gripper: usize, direction: usize| {
            let heading = heading(solver.ply.grid, moving, gripper, direction)?;
            assembly.gripper_slope(gripper, direction, heading, [free, &pass.held])
        };
        let gripper = |n| [0, 1].map(|d| gripper_slope(n, d).map_or(0.0, |slope| slope.eps));
        StateTangent {
            slopes,
            force: pass.responses.iter().map(|r| r.force.0.eps).collect(),
            end_slopes: pass.held.iter().map(|h| h.map(|s| s.eps)).collect(),
            spans: (assembly.elements.iter())
                .map(|e| [e.run.eps, e.rise.eps, e.length.eps])
                .collect(),
            loads: assembly.elements.iter().map(|e| [e.weight.eps, e.rigidity.eps]).collect(),
            paths: assembly.shearing.iter().map(|s| s.map_or(0.0, |(path, _)| path.eps)).collect(),
            grippers: (0..positions.len()).map(gripper).collect(),
            is_sound,
        }
    }
}

impl Solver {
    /// Derivative of the last solved state along a direction.
    ///
    /// `positions` and `laid` must be those of the last [`Solver::solve`]. Exact wherever the state is
    /// differentiable: not where a diagonal just begins to shear or a slope just reaches its limit.
    pub fn tangent(
        &mut self,
        positions: &[[f64; 3]],
        laid: &[Option<Laid>],
        direction: &Direction,
    ) -> StateTangent {
        self.linearize(positions, laid).along(direction)
    }

    /// Prepares the derivatives of the last solved state, for many directions.
    ///
    /// `positions` and `laid` must be those of the last [`Solver::solve`].
    pub fn linearize<'a>(
        &'a mut self,
        positions: &'a [[f64; 3]],
        laid: &'a [Option<Laid>],
    ) -> Linearized<'a> {
        let own = Linearization::new(self);
        let unconstrained = match &mut self.unconstrained {
            Some(solver) if !self.free.is_empty() => Some(Linearization::new(solver)),
            _ => None,
        };
        Linearized { solver: self, positions, laid, own, unconstrained, sound: true }
    }

    /// An element with derivatives to everything it depends on.
    fn all_jets(&self, n: usize) -> Evaluated<7> {
        let element = &self.assembly.elements[n];
        if element.state == SpanState::Straight {
            return Evaluated::default();
        }
        let span = element.span(self.settings.axial_stiffness, &self.held[n]);
        let wanted = Wanted { slope: [true; 2], curvature: [true; 2], derivatives: true };
        evaluate::<8, 7>(&span, Some(self.evaluated[n].force.value), wanted)
    }

    /// Puts exact derivatives at the solution where the last step was taken by series.
    fn refresh(&mut self, jets: &[Evaluated<7>]) {
        let small = |jet: &Jet<7>| Jet {
            value: jet.value,
            gradient: [jet.gradient[0], jet.gradient[1]],
            hessian: [0, 1].map(|i| [jet.hessian[i][0], jet.hessian[i][1]]),
        };
        for (evaluated, jets) in self.evaluated.iter_mut().zip(jets) {
            evaluated.force = small(&jets.force);
            for end in 0..2 {
                evaluated.slope[end] = small(&jets.slope[end]);
                evaluated.curvature[end] = small(&jets.curvature[end]);
            }
        }
        // the adjoint of the free ends, for the Hessian
        let evaluated = &self.evaluated;
        let response = |n: usize| Response {
            force: (evaluated[n].force.value, evaluated[n].force.gradient),
            slope: evaluated[n].slope.map(|s| (s.value, s.gradient)),
        };
        self.work.gradient.resize(self.slopes.len(), 0.0);
        self.work.adjoint.resize(self.assembly.elements.len(), [0.0; 2]);
        match self.settings.slopes {
            SlopeRule::MinForce => {
                let Work { gradient, adjoint, .. } = &mut self.work;
                min_force::gradient(&self.assembly, response, gradient, adjoint);
            }
            SlopeRule::MomentBalance => {
                for (n, out) in self.work.gradient.iter_mut().enumerate() {
                    let curvature = |e: usize, end: usize| evaluated[e].curvature[end].value;
                    *out = moment_balance::jump(&self.assembly, n, curvature);
                }
            }
        }
        self.mark_active();
    }
}

impl Pass {
    /// Carries the direction in `assembly` through every element, the shared slopes changing by `slopes`.
    fn run(
        &mut self,
        solver: &Solver,
        assembly: &Assembly<Dual64>,
        jets: &[Evaluated<7>],
        slopes: &[f64],
    ) {
        let zero = Dual64::from(0.0);
        self.responses.clear();
        self.curvatures.clear();
        self.held.clear();
        let joint = |j: usize| Dual64::new(solver.slopes[j], slopes[j]);
        for (n, element) in assembly.elements.iter().enumerate() {
            if element.state == SpanState::Straight {
                let slope = if element.run.re > 0.0 { element.rise / element.run } else { zero };
                self.responses
                    .push(Response { force: (zero, [zero; 2]), slope: [(slope, [zero; 2]); 2] });
                self.curvatures.push([zero; 2]);
                self.held.push([slope; 2]);
                continue;
            }
            let held = element.ends.map(|end| match end {
                End::Free => None,
                End::Given(slope) => Some(slope),
                End::Joint(j) => Some(joint(j)),
                End::Plane(plane) => {
                    let [u, v] = plane.source.map(|source| match source {
                        SlopeSource::Given(slope) => slope,
                        SlopeSource::Joint(j) => joint(j),
                        SlopeSource::Outcome(edge, end) => {
                            let response: &Response<Dual64> = &self.responses[edge];
                            response.slope[end].0
                        }
                    });
                    Some(plane.share[0] * u + plane.share[1] * v)
                }
            });
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
            let jets = &jets[n];
            let slope = [0, 1].map(|end| along(&jets.slope[end], &x));
            self.responses.push(Response { force: along(&jets.force, &x), slope });
            self.curvatures.push([0, 1].map(|end| along(&jets.curvature[end], &x).0));
            self.held.push([0, 1].map(|end| held[end].unwrap_or(slope[end].0)));
        }
    }
}
