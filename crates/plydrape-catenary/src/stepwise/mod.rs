//! The stepwise planner of Krogh et al. 2018: each step is the solution of a quadratic program.
//!
//! One loop: advance the front (`stage`, `front`), differentiate the solved ply ([`crate::sensitivity`]), solve the
//! program of one step (`step`, `constraints`), move the true model, and halve the step where the model does not accept
//! it (`evaluation`): the move limit is the radius of a trust region. At the end, slack is removed (`slack`). What is
//! in contact stays in contact, so a step cannot be taken back: the method is greedy.

mod constraints;
mod evaluation;
mod front;
mod outcome;
mod program;
mod slack;
mod stage;
mod step;
mod task;
#[cfg(test)]
pub(crate) mod tests;
pub mod tuning;

pub use outcome::{PositionError, Stepwise, StepwiseEnd};
pub use task::{Limits, Task};

use crate::draping::Draping;
use crate::draping::spans::{Equilibrium, Point};
use crate::geometry::vector::sub;
use crate::mold::distance;
use crate::motion::farthest;
use crate::sensitivity::{self, Sensitivity};
use evaluation::Evaluation;
use front::Front;
use stage::Stage;
use std::ops::ControlFlow;
use step::Step;
use tuning::TUNING;

/// Plans the gripper positions of a task, step by step.
///
/// The first step is the start, `task.layup.start()`; the last are `task.layup.target.grippers` where the
/// grippers get there. Each takes at most [`Task::steps`] steps of [`Task::move_limit`]. `progress`
/// receives the number of steps after each step; when it breaks, the plan ends there. How it ended is data:
/// [`Stepwise::outcome`].
pub fn stepwise(task: &Task, progress: &mut dyn FnMut(usize) -> ControlFlow<()>) -> Stepwise {
    let start = task.layup.start().to_vec();
    let count = task.layup.ply.grid.grippers();
    let target = task.layup.target.as_ref().filter(|target| target.grippers.len() == count);
    let Some(target) = target.filter(|_| start.len() == count) else {
        return Stepwise { positions: vec![start], outcome: StepwiseEnd::NoTarget };
    };
    StepwisePlanner::new(task, &target.grippers, start).run(progress)
}

/// The state of a plan after some steps.
struct StepwisePlanner<'a> {
    task: &'a Task<'a>,
    targets: &'a [Point],
    draping: Draping<'a>,
    shape: Equilibrium,
    front: Front,
    stage: Stage,
    reach: f64,
    moves: Vec<[f64; 3]>,
    arrived: Vec<bool>,
    positions: Vec<Vec<Point>>,
}

impl<'a> StepwisePlanner<'a> {
    fn new(task: &'a Task<'a>, targets: &'a [Point], start: Vec<Point>) -> Self {
        let mut draping = Draping::new(task.layup);
        let shape = draping.move_to(&start);
        let mut front = Front::new(task, targets);
        // as low as the lowest gripper is above its height in the form that the ply will take
        let above = |n: usize| {
            let height = task
                .layup
                .mold
                .as_ref()
                .map_or(start[n][2] - targets[n][2], |mold| mold.signed_distance(start[n]));
            height - front.lift(n, 0.0)
        };
        front.base = (0..start.len())
            .map(above)
            .fold(f64::INFINITY, f64::min)
            .max(TUNING.base * task.layup.ply.shorter_side());
        let all = farthest(&start, targets) + front.base + front.drop(front.farthest());
        let reach = task.move_limit.unwrap_or(2.0 * all / task.steps.max(2) as f64);
        let count = start.len();
        StepwisePlanner {
            task,
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
        let most = self.task.steps.max(1);
        let shortfall = self.shortfall((most - 1) as f64 * self.reach);
        let mut done = |plan: &Self| progress(plan.positions.len()).is_break();
        let mut broken = done(&self);
        while !broken && self.positions.len() < most && self.largest_error().distance > 0.0 {
            self.advance_front(most - self.positions.len());
            self.step();
            broken = done(&self);
        }
        let outcome = match (self.largest_error(), shortfall) {
            (error, _) if error.distance == 0.0 => StepwiseEnd::Arrived,
            _ if broken => StepwiseEnd::Interrupted,
            (_, Some(shortfall)) => StepwiseEnd::OutOfReach(shortfall),
            (error, None) => StepwiseEnd::OutOfSteps(error),
        };
        for _ in 0..TUNING.slack.moves {
            let room = !broken && self.positions.len() < most;
            if outcome != StepwiseEnd::Arrived || !room || !self.remove_slack() {
                break;
            }
            broken = done(&self);
        }
        Stepwise { positions: self.positions, outcome }
    }

    /// What the farthest gripper still lacks (m) after the longest moves, `reach` (m) in all; `None` if it arrives.
    fn shortfall(&self, reach: f64) -> Option<PositionError> {
        let error = self.largest_error();
        let distance = error.distance - reach;
        (distance > 0.0).then_some(PositionError { distance, ..error })
    }

    /// The gripper farthest from its target.
    fn largest_error(&self) -> PositionError {
        let mut largest = PositionError { gripper: [0, 0], distance: 0.0 };
        for (n, target) in self.targets.iter().enumerate() {
            let distance = distance(self.draping.positions[n], *target);
            if distance > largest.distance {
                largest = PositionError { gripper: self.task.layup.ply.grid.id(n), distance };
            }
        }
        largest
    }

    fn height(&self, gripper: usize) -> f64 {
        let p = self.draping.positions[gripper];
        match &self.task.layup.mold {
            Some(mold) => mold.signed_distance(p),
            None => {
                let (n, way) = (self.front.normal[gripper], sub(p, self.targets[gripper]));
                n[0] * way[0] + n[1] * way[1] + n[2] * way[2]
            }
        }
    }

    /// One step: the program, then the true model; with half the move limit where the model does not accept it.
    fn step(&mut self) {
        // grippers that stand on their targets once the front is down have arrived for good
        let landing = self.draping.contacts.iter().any(Option::is_some);
        for n in 0..self.targets.len() {
            self.arrived[n] |=
                self.draping.positions[n] == self.targets[n] && self.front.height(n) <= 0.0;
        }

        // derivatives of the equilibrium from which the step starts
        let (positions, contacts) = (self.draping.positions.clone(), self.draping.contacts.clone());
        let sensitivity = Sensitivity::new(
            self.task.layup,
            &mut self.draping.solver,
            &self.shape,
            &positions,
            &contacts,
            sensitivity::tuning::TUNING.negligible,
        );

        // a trial must keep the limits, or not make worse what exceeded them before
        let mut reach = self.reach;
        let before = Evaluation::new(self.task, &self.draping, &self.shape);
        let mut best: Option<(Draping<'a>, Equilibrium)> = None;

        for trial in 0..TUNING.halvings {
            // moves by the linear program; later trials let grippers come down beside their targets
            let step = Step {
                task: self.task,
                targets: self.targets,
                front: &self.front,
                positions: &positions,
                arrived: &self.arrived,
                before: &self.moves,
                landing,
                reach,
                firm: trial < TUNING.halvings / 2,
            };
            let Some(moves) = step.moves(&sensitivity) else {
                reach *= 0.5;
                continue;
            };

            // the true model judges them
            let goal: Vec<Point> = (0..positions.len())
                .map(|n| self.snapped(n, [0, 1, 2].map(|k| positions[n][k] + moves[n][k])))
                .collect();
            let mut trial = self.draping.clone();
            let shape = trial.move_to(&goal);
            let acceptable =
                Evaluation::new(self.task, &trial, &shape).is_acceptable(self.task, &before);
            best = Some((trial, shape));
            if acceptable {
                break;
            }
            reach *= 0.5;
        }

        // the last trial is taken even if it was not accepted, so that the plan goes on
        if let Some((draping, shape)) = best {
            for n in 0..positions.len() {
                self.moves[n] = sub(draping.positions[n], positions[n]);
            }
            (self.draping, self.shape) = (draping, shape);
        }

        self.positions.push(self.draping.positions.clone());
    }

    /// Moves the grippers so that slack is removed, if the true model accepts the move; whether it does.
    fn remove_slack(&mut self) -> bool {
        let Some(goal) = slack::removal(self.task, &self.draping, &self.shape, self.targets) else {
            return false;
        };
        let mut trial = self.draping.clone();
        let shape = trial.move_to(&goal);
        let after = Evaluation::new(self.task, &trial, &shape);
        let far = farthest(&goal, &self.draping.positions) > self.reach;
        let acceptable = !far && after.converged && after.stretch <= self.task.limits.overstretch;
        if acceptable {
            (self.draping, self.shape) = (trial, shape);
            self.positions.push(goal);
        }
        acceptable
    }

    /// Where a gripper goes that should be at `place` (m): on its target if that is very near.
    fn snapped(&self, gripper: usize, place: Point) -> Point {
        let target = self.targets[gripper];
        let down = self.front.height(gripper) <= 0.0
            && distance(self.draping.positions[gripper], target) <= self.reach;
        if down && distance(place, target) <= TUNING.snap * self.task.layup.ply.shorter_side() {
            target
        } else {
            place
        }
    }
}
