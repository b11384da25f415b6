//! The stepwise planner of Krogh et al. 2018: in each step the grippers move so as to make the most of it.
//!
//! One loop: differentiate the solved ply ([`super::sensitivity`]), put up the quadratic program of one step
//! (`step`, `program`), move the true model, halve the step where the model disagrees (the move limit is the
//! radius of a trust region), and let the landing front (`front`) go on. What touches stays, so a step cannot
//! be taken back: the method is greedy.

mod bounds;
mod front;
mod judgement;
mod outcome;
mod settle;
mod stage;
mod step;

pub use outcome::{Outcome, Stepwise, Stray};

use super::sensitivity::Sensitivity;
use crate::draping::Draping;
use crate::draping::spans::{Point, Shape};
use crate::mold::distance;
use crate::mold::vector::sub;
use crate::scene::Scene;
use front::Front;
use judgement::Judgement;
use stage::Stage;
use std::ops::ControlFlow;
use step::Step;

/// Times that a step is halved.
const HALVINGS: usize = 6;

/// Moves that take out slack at the end.
const SETTLINGS: usize = 3;

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
    let count = scene.ply.grid.grippers();
    let target = scene.target.as_ref().filter(|target| target.grippers.len() == count);
    let Some(target) = target.filter(|_| start.len() == count) else {
        return Stepwise { positions: vec![start], outcome: Outcome::NoTarget };
    };
    Plan::new(scene, &target.grippers, start).run(progress)
}

/// A plan under way.
struct Plan<'a> {
    scene: &'a Scene,
    targets: &'a [Point],
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
        let all = way + front.hover + front.drop(front.farthest());
        let reach = scene.plan.move_limit.unwrap_or(2.0 * all / scene.plan.steps.max(2) as f64);
        let count = start.len();
        Plan {
            scene,
            targets,
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
        let most = self.scene.plan.steps.max(1);
        let lacks = self.lacks((most - 1) as f64 * self.reach);
        let mut done = |plan: &Self| progress(plan.positions.len()).is_break();
        let mut broken = done(&self);
        while !broken && self.positions.len() < most && self.stray().distance > 0.0 {
            self.advance_front(most - self.positions.len());
            self.step();
            broken = done(&self);
        }
        let outcome = match (self.stray(), lacks) {
            (stray, _) if stray.distance == 0.0 => Outcome::Arrived,
            _ if broken => Outcome::Interrupted,
            (_, Some(lacks)) => Outcome::OutOfReach(lacks),
            (stray, None) => Outcome::OutOfSteps(stray),
        };
        for _ in 0..SETTLINGS {
            let room = !broken && self.positions.len() < most;
            if outcome != Outcome::Arrived || !room || !self.settle() {
                break;
            }
            broken = done(&self);
        }
        Stepwise { positions: self.positions, outcome }
    }

    /// The gripper that lacks most of its way with all steps at their farthest, `reach` (m) together.
    fn lacks(&self, reach: f64) -> Option<Stray> {
        let stray = self.stray();
        let lack = stray.distance - reach;
        (lack > 0.0).then_some(Stray { distance: lack, ..stray })
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

    /// One step: the program, the true model, half of it where that disagrees.
    fn step(&mut self) {
        let landing = self.draping.contacts.iter().any(Option::is_some);
        for n in 0..self.targets.len() {
            self.arrived[n] |=
                self.draping.positions[n] == self.targets[n] && self.front.height(n) <= 0.0;
        }
        let (positions, contacts) = (self.draping.positions.clone(), self.draping.contacts.clone());
        let look = Sensitivity::new(
            self.scene,
            &mut self.draping.solver,
            &self.shape,
            &positions,
            &contacts,
        );
        let mut reach = self.reach;
        let before = Judgement::of(self.scene, &self.draping, &self.shape);
        let mut best: Option<(Draping<'a>, Shape)> = None;
        for trial in 0..HALVINGS {
            let step = Step {
                scene: self.scene,
                targets: self.targets,
                front: &self.front,
                positions: &positions,
                arrived: &self.arrived,
                before: &self.moves,
                landing,
                reach,
                firm: trial < HALVINGS / 2,
            };
            let Some(moves) = step.moves(&look) else {
                reach *= 0.5;
                continue;
            };
            let goal: Vec<Point> = (0..positions.len())
                .map(|n| self.landed_place(n, [0, 1, 2].map(|k| positions[n][k] + moves[n][k])))
                .collect();
            let mut trial = self.draping.clone();
            let shape = trial.move_to(&goal);
            let good = Judgement::of(self.scene, &trial, &shape).is_sound(self.scene, &before);
            best = Some((trial, shape));
            if good {
                break;
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

    /// The last move, if it leaves the ply better than it lies; whether it does.
    fn settle(&mut self) -> bool {
        let Some(goal) = settle::settled(self.scene, &self.draping, &self.shape, self.targets)
        else {
            return false;
        };
        let mut trial = self.draping.clone();
        let shape = trial.move_to(&goal);
        let found = Judgement::of(self.scene, &trial, &shape);
        let far =
            goal.iter().zip(&self.draping.positions).any(|(a, b)| distance(*a, *b) > self.reach);
        let better = !far && found.converged && found.stretch <= self.scene.limits.overstretch;
        if better {
            (self.draping, self.shape) = (trial, shape);
            self.positions.push(goal);
        }
        better
    }

    /// Where a gripper goes that should be at `place` (m): on its target once it is all but there.
    fn landed_place(&self, gripper: usize, place: Point) -> Point {
        let target = self.targets[gripper];
        let down = self.front.height(gripper) <= 0.0
            && distance(self.draping.positions[gripper], target) <= self.reach;
        if down && distance(place, target) <= SNAP { target } else { place }
    }
}
