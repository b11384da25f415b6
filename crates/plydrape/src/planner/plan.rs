//! From a scene to a motion: a planner finds positions, they become a motion in time, and the ply is draped
//! along it once more.

use super::board::{Board, Watcher};
use super::judge;
use super::memory::Memory;
use super::obstacles::obstacles;
use super::path::{self, Strategy};
use super::stepwise::{Outcome, stepwise};
use crate::draping::record::PlanRecord;
use crate::draping::spans::Point;
use crate::draping::{Drape, simulate};
use crate::measure::{Name, Site, Verdict, Worst};
use crate::motion::{Attitudes, Bounds, MotionError, Peak, TimedMotion};
use crate::scene::{PlanMethod, Scene};
use std::ops::ControlFlow;

/// How much faster grippers may turn between two steps of a plan than over the whole of both, within which the limit of the tilt rate is to
/// hold for finer samples of the motion too.
const RATE_MARGIN: f64 = 1.5;

/// A finished plan.
#[derive(Debug, Clone)]
pub struct Planned {
    /// The drape along the planned motion, step-cutting on, with all limits judged.
    pub drape: Drape,
    /// What the motion is made from again.
    pub record: PlanRecord,
    /// The motion in time.
    pub motion: TimedMotion,
    /// How the grippers are turned in it.
    pub attitudes: Attitudes,
    /// Whether the search was broken off.
    pub interrupted: bool,
    /// For another search to go on from.
    pub memory: Memory,
}

/// Why there is no plan.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PlanError {
    /// Nothing to lay the ply on.
    #[error("the scene has no mold to lay the ply on")]
    NoMold,
    /// Nowhere to go.
    #[error("the scene has no target: a plan needs to know where the ply shall end")]
    NoTarget,
    /// A plan for other grippers or other fabric.
    #[error(
        "the earlier plan is for {earlier_u} × {earlier_v} grippers or other cells, the scene has {nu} × {nv}: plan anew"
    )]
    OtherPly {
        /// Grippers of the earlier plan along u.
        earlier_u: usize,
        /// Grippers of the earlier plan along v.
        earlier_v: usize,
        /// Grippers of the scene along u.
        nu: usize,
        /// Grippers of the scene along v.
        nv: usize,
    },
    /// Numbers that no search leaves.
    #[error(
        "the earlier plan holds a strategy or positions that no search can have left: plan anew"
    )]
    Numbers,
    /// Positions that are no motion.
    #[error(transparent)]
    Motion(#[from] MotionError),
}

/// What a planner hands over.
struct Found {
    positions: Vec<Vec<Point>>,
    evaluations: usize,
    strategy: Option<Strategy>,
    /// Limits of the planner itself.
    limits: Vec<Verdict>,
}

/// Plans the gripper motion of a scene, from where it starts to its target.
///
/// `memory` is that of an earlier search for the same ply, to go on from. `watcher` is told how the search gets
/// on; when it breaks, the best so far is finished. A plan that keeps not all limits is a plan all the same: the
/// verdict says which, where and by how much.
///
/// # Errors
/// [`PlanError`] if the scene has no mold or target, or the memory is not of its ply.
pub fn plan(
    scene: &Scene,
    memory: Option<&Memory>,
    watcher: Watcher,
) -> Result<Planned, PlanError> {
    if scene.mold.is_none() {
        return Err(PlanError::NoMold);
    }
    if scene.target.is_none() {
        return Err(PlanError::NoTarget);
    }
    if let Some(memory) = memory {
        memory.check(scene)?;
    }
    let most = match scene.plan.method {
        PlanMethod::Path => scene.plan.evaluations,
        PlanMethod::Stepwise => scene.plan.steps,
    };
    let board = Board::new(most, watcher);
    let found = match scene.plan.method {
        PlanMethod::Path => by_path(scene, memory, &board)?,
        PlanMethod::Stepwise => by_steps(scene, &board),
    };
    let interrupted = board.is_stopped();

    let bounds = Bounds::from(&scene.limits);
    let mut motion = TimedMotion::new(&found.positions, &bounds)?;
    let follow = |motion: &TimedMotion| {
        let followed = judge::with_motion(scene, motion.steps());
        simulate(&followed, |_| ControlFlow::Continue(()))
    };
    let mut drape = follow(&motion);
    // the shapes of the ply do not depend on time: where a gripper would turn too fast, all of it takes longer
    let fastest = drape.summary.worst.value(Name::TiltRate).unwrap_or(0.0);
    let slowed = (RATE_MARGIN * fastest / scene.limits.tilt_rate.to_degrees()).max(1.0);
    if slowed > 1.0 {
        motion = motion.slowed(slowed);
        drape = follow(&motion);
    }
    // what no plan can keep comes first
    let summary = &mut drape.summary;
    let judged = std::mem::take(&mut summary.limits);
    summary.judge_also(obstacles(scene));
    summary.limits.extend(judged);
    summary.judge_also(found.limits.into_iter().chain(rates(&motion, &bounds, scene)));
    let record = PlanRecord {
        method: scene.plan.method,
        evaluations: found.evaluations,
        rate: scene.plan.rate,
        slowed,
        path: found.positions.clone(),
    };
    let attitudes = Attitudes::of(&drape.steps)?;
    let before = memory.map_or(0, |memory| memory.evaluations);
    let memory = Memory::new(scene, before + found.evaluations, found.strategy, found.positions);
    Ok(Planned { drape, record, motion, attitudes, interrupted, memory })
}

fn by_path(scene: &Scene, memory: Option<&Memory>, board: &Board) -> Result<Found, PlanError> {
    let best = path::search(scene, memory, board).ok_or(PlanError::NoTarget)?;
    Ok(Found {
        positions: best.positions,
        evaluations: board.evaluations(),
        strategy: Some(best.strategy),
        limits: Vec::new(),
    })
}

fn by_steps(scene: &Scene, board: &Board) -> Found {
    board.enter("step by step");
    let plan = stepwise(scene, &mut |done| {
        board.count(done);
        board.tick()
    });
    let limits = match plan.outcome {
        Outcome::OutOfSteps(stray) | Outcome::OutOfReach(stray) => {
            let gripper = scene.ply.grid.index(stray.gripper);
            let at = Site::Gripper(gripper).label(scene.ply.grid);
            let worst = Worst {
                value: stray.distance * 1e3,
                at: format!("{at}, short of its target"),
                place: plan.positions.last().map(|step| step[gripper]),
            };
            vec![Verdict::of(Name::Steps, worst, 0.0, Some(plan.positions.len()))]
        }
        Outcome::Arrived | Outcome::Interrupted | Outcome::NoTarget => Vec::new(),
    };
    Found { evaluations: plan.positions.len(), positions: plan.positions, strategy: None, limits }
}

/// Largest speed, acceleration and jerk of the motion against their limits.
fn rates(motion: &TimedMotion, bounds: &Bounds, scene: &Scene) -> Vec<Verdict> {
    let peaks = motion.peaks();
    let verdict = |name: Name, peak: Peak, limit: f64| {
        let step = motion.times().partition_point(|t| *t < peak.time) + 1;
        let worst = Worst {
            value: peak.value,
            at: Site::Gripper(peak.gripper).label(scene.ply.grid),
            place: Some(motion.at(peak.time)[peak.gripper]),
        };
        Verdict::of(name, worst, limit, Some(step.min(motion.times().len())))
    };
    vec![
        verdict(Name::Speed, peaks.speed, bounds.speed),
        verdict(Name::Acceleration, peaks.acceleration, bounds.acceleration),
        verdict(Name::Jerk, peaks.jerk, bounds.jerk),
    ]
}
