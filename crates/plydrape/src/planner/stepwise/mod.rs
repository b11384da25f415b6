//! The stepwise planner of Krogh et al. 2018: in each step the grippers move so as to make the most of it.
//!
//! One loop: differentiate the solved ply ([`super::sensitivity`]), put up the quadratic program of one step
//! (`step`, `program`), move the true model, halve the step where the model disagrees (the move limit is the
//! radius of a trust region), and let the landing front (`front`) go on. What touches stays, so a step cannot
//! be taken back: the method is greedy.

mod front;
mod outcome;
mod step;

pub use outcome::{Outcome, Stepwise, Stray};

use super::sensitivity::Sensitivity;
use crate::draping::spans::{Point, Shape};
use crate::draping::{Draping, fit, lying_rests};
use crate::equilibrium::Status;
use crate::mold::distance;
use crate::mold::vector::sub;
use crate::scene::Scene;
use front::Front;
use std::ops::ControlFlow;
use step::Step;

/// Share of the move limit by which the front means to move the grippers.
const PACE: f64 = 0.7;

/// Times that a step is halved.
const HALVINGS: usize = 6;

/// Distance (m) from its place at which a gripper that has landed is put there.
const SNAP: f64 = 5e-5;

/// Plans the gripper positions of a scene, step by step.
///
/// The first step is the start, `scene.motion.positions[0]`; the last are `scene.target.grippers` where the
/// grippers get there. Each takes at most `scene.plan.steps` steps of `scene.plan.move_limit` (m). `progress`
/// is told after each step how many are done; when it breaks, the plan ends there. How it ended is data:
/// [`Stepwise::outcome`].
pub fn stepwise(scene: &Scene, progress: &mut dyn FnMut(usize) -> ControlFlow<()>) -> Stepwise {
    let start = scene.motion.positions.first().cloned().unwrap_or_default();
    let Some(target) = &scene.target else {
        return Stepwise { positions: vec![start], outcome: Outcome::NoTarget };
    };
    Plan::new(scene, &target.grippers, start).run(progress)
}

/// What the front does.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Stage {
    /// The ply takes its form above the mold.
    Form,
    /// It comes down.
    Lower,
    /// It is rolled on.
    Roll,
}

/// A plan under way.
struct Plan<'a> {
    scene: &'a Scene,
    targets: &'a [Point],
    /// Where the grippers come down before the last move.
    aims: Vec<Point>,
    draping: Draping<'a>,
    shape: Shape,
    front: Front,
    stage: Stage,
    reach: f64,
    moves: Vec<[f64; 3]>,
    arrived: Vec<bool>,
    positions: Vec<Vec<Point>>,
}

impl<'a> Plan<'a> {
    fn new(scene: &'a Scene, targets: &'a [Point], start: Vec<Point>) -> Self {
        let mut draping = Draping::new(scene);
        let shape = draping.move_to(&start);
        let mut front = Front::new(scene, targets);
        // as low as the lowest gripper hangs over its place in the form that the ply will take
        let over = |n: usize| {
            let height = scene
                .mold
                .as_ref()
                .map_or(start[n][2] - targets[n][2], |mold| mold.signed_distance(start[n]));
            height - front.lift(n, 0.0)
        };
        front.hover = (0..start.len()).map(over).fold(f64::INFINITY, f64::min).max(0.01);
        let way = start.iter().zip(targets).map(|(a, b)| distance(*a, *b)).fold(0.0, f64::max);
        let all = way + front.hover + front.lift(0, 0.0).max(front.drop(front.farthest()));
        let reach = scene.plan.move_limit.unwrap_or(2.0 * all / scene.plan.steps.max(2) as f64);
        let count = start.len();
        Plan {
            scene,
            targets,
            aims: front.aims(scene, targets),
            draping,
            shape,
            front,
            stage: Stage::Form,
            reach,
            moves: vec![[0.0; 3]; count],
            arrived: vec![false; count],
            positions: vec![start],
        }
    }

    fn run(mut self, progress: &mut dyn FnMut(usize) -> ControlFlow<()>) -> Stepwise {
        let mut outcome = Outcome::OutOfSteps(self.stray());
        let most = self.scene.plan.steps.max(1);
        if progress(1).is_break() {
            return self.end(Outcome::Interrupted);
        }
        while self.positions.len() < most {
            if self.stray().distance == 0.0 {
                outcome = Outcome::Arrived;
                break;
            }
            self.advance_front(most - self.positions.len());
            if self.draping.positions == self.aims {
                self.arrived.fill(false);
                self.aims = self.targets.to_vec();
            }
            self.step();
            outcome = Outcome::OutOfSteps(self.stray());
            if progress(self.positions.len()).is_break() {
                return self.end(Outcome::Interrupted);
            }
        }
        if self.stray().distance == 0.0 {
            outcome = Outcome::Arrived;
        }
        self.end(outcome)
    }

    fn end(self, outcome: Outcome) -> Stepwise {
        Stepwise { positions: self.positions, outcome }
    }

    /// The gripper farthest from its target.
    fn stray(&self) -> Stray {
        let mut stray = Stray { gripper: [0, 0], distance: 0.0 };
        for (n, target) in self.targets.iter().enumerate() {
            let distance = distance(self.draping.positions[n], *target);
            if distance > stray.distance {
                stray = Stray { gripper: self.scene.ply.grid.id(n), distance };
            }
        }
        stray
    }

    fn height(&self, gripper: usize) -> f64 {
        let p = self.draping.positions[gripper];
        match &self.scene.mold {
            Some(mold) => mold.signed_distance(p),
            None => {
                let (n, way) = (self.front.normal[gripper], sub(p, self.targets[gripper]));
                n[0] * way[0] + n[1] * way[1] + n[2] * way[2]
            }
        }
    }

    /// Moves the front on, as far as the grippers can follow.
    fn advance_front(&mut self, remaining: usize) {
        let late = (0..self.targets.len())
            .map(|n| (self.height(n) - self.front.height(n)).abs())
            .fold(0.0, f64::max);
        let pace = PACE * self.reach;
        if self.stage == Stage::Form {
            // form: heights reached, edges as long as they should be
            let slack = self.slack();
            if (late < 1e-4 && slack < 2e-4) || self.positions.len() > self.scene.plan.steps / 2 {
                self.stage = Stage::Lower;
            }
        }
        if late > self.reach && self.stage != Stage::Form {
            return;
        }
        if self.stage == Stage::Lower {
            self.front.hover = (self.front.hover - pace).max(0.0);
            if self.front.hover == 0.0 {
                self.stage = Stage::Roll;
                return;
            }
        }
        if self.stage == Stage::Roll {
            let end = self.front.farthest() + 1e-3;
            let left = end - self.front.radius;
            let mut grow = left / (remaining.saturating_sub(5).max(1)) as f64;
            if self.front.rise == 0.0 {
                grow = left;
            }
            for _ in 0..30 {
                if self.front.drop(self.front.radius + grow) <= pace {
                    break;
                }
                grow *= 0.8;
            }
            self.front.radius += grow.min(left);
        }
    }

    /// Largest difference of a hanging edge from the length that it should have (m).
    fn slack(&self) -> f64 {
        let edges = self.scene.ply.grid.edges();
        self.shape
            .spans
            .iter()
            .filter(|span| span.catenary < edges)
            .map(|span| span.length - span.chord() + step::wanted_stretch(self.scene, span))
            .fold(0.0, |most, slack| most.max(slack.abs()))
    }

    /// One step: the program, the true model, half of it where that disagrees.
    fn step(&mut self) {
        let landing = self.draping.laid.iter().any(Option::is_some);
        for n in 0..self.targets.len() {
            self.arrived[n] |=
                self.draping.positions[n] == self.aims[n] && self.front.height(n) <= 0.0;
        }
        let (positions, laid) = (self.draping.positions.clone(), self.draping.laid.clone());
        let look =
            Sensitivity::new(self.scene, &mut self.draping.solver, &self.shape, &positions, &laid);
        let mut reach = self.reach;
        let before = self.worst_stretch(&self.draping, &self.shape);
        let mut best: Option<(Draping<'a>, Shape)> = None;
        for _ in 0..HALVINGS {
            let step = Step {
                scene: self.scene,
                targets: &self.aims,
                front: &self.front,
                positions: &positions,
                arrived: &self.arrived,
                before: &self.moves,
                landing,
                reach,
            };
            let Some(moves) = step.moves(&look) else {
                if std::env::var("DBG").is_ok() {
                    println!("no qp at step {}", self.positions.len());
                }
                reach *= 0.5;
                continue;
            };
            let goal: Vec<Point> = (0..positions.len())
                .map(|n| self.landed_place(n, [0, 1, 2].map(|k| positions[n][k] + moves[n][k])))
                .collect();
            let mut trial = self.draping.clone();
            let shape = trial.move_to(&goal);
            let stretch = self.worst_stretch(&trial, &shape);
            let good = shape.equilibrium.status == Status::Converged
                && stretch <= (0.5 * self.scene.limits.overstretch).max(before);
            best = Some((trial, shape));
            if good {
                break;
            }
            if std::env::var("DBG").is_ok() {
                println!(
                    "halved at step {} stretch {stretch:.2e} before {before:.2e} {:?}",
                    self.positions.len(),
                    best.as_ref().unwrap().1.equilibrium.status
                );
            }
            reach *= 0.5;
        }
        if let Some((draping, shape)) = best {
            for n in 0..positions.len() {
                self.moves[n] = sub(draping.positions[n], positions[n]);
            }
            (self.draping, self.shape) = (draping, shape);
        }
        self.positions.push(self.draping.positions.clone());
    }

    /// Where a gripper goes that should be at `place` (m): on its target once it is all but there.
    fn landed_place(&self, gripper: usize, place: Point) -> Point {
        let target = self.aims[gripper];
        let down = self.front.height(gripper) <= 0.0;
        if down && distance(place, target) <= SNAP { target } else { place }
    }

    /// Largest overstretch of an edge, as a share of the whole edge.
    fn worst_stretch(&self, draping: &Draping, shape: &Shape) -> f64 {
        let (ply, edges) = (&self.scene.ply, self.scene.ply.grid.edges());
        let length = |catenary: usize| ply.flat_length(ply.grid.catenary(catenary).kind);
        let mut worst = 0.0_f64;
        for span in shape.spans.iter().filter(|span| span.catenary < edges) {
            worst = worst.max(fit(span).overstretch() / length(span.catenary));
        }
        let Some(mold) = &self.scene.mold else {
            return worst;
        };
        for (n, laid) in draping.laid.iter().enumerate().take(edges) {
            let Some(laid) = laid else { continue };
            let c = ply.grid.catenary(n);
            let ends = [c.from, c.to].map(|g| draping.positions[ply.grid.index(g)]);
            for rest in lying_rests(laid, ends, mold, self.scene.settings.contact.tolerance) {
                worst = worst.max(rest.fit.overstretch() / length(n));
            }
        }
        worst
    }
}
