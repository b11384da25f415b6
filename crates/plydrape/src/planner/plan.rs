//! From a scene to a motion: a planner finds positions, which become a motion in time, and the model that decides drapes
//! along it. Catenaries drape along it in any case.

use super::checkpoint::Checkpoint;
use super::decision::{Decision, PlannedSheet};
use super::evaluation;
use super::infeasible_limits::infeasible_limits;
use super::path;
use super::quickest::{Quickest, quickest};
use super::search_state::{SearchState, Watcher};
use super::stepwise::{Outcome, Stepwise, stepwise};
use crate::draping::record::{LimitedBy, PlanRecord, Summary};
use crate::draping::{Drape, simulate};
use crate::measure::{Name, Site, Verdict, Worst};
use crate::motion::{Attitudes, Bounds, MotionError, Peak, TimedMotion};
use crate::scene::{PlanMethod, Scene};
use crate::tool::{Tool, ToolPeaks};
use std::ops::ControlFlow;

/// A finished plan.
#[derive(Debug, Clone)]
pub struct Planned {
    /// The drape by catenaries along the planned motion, step-cutting on, with the verdicts of all limits.
    pub drape: Drape,
    /// The drape by the sheet along it, where the sheet decides.
    pub sheet: Option<PlannedSheet>,
    /// The data from which the motion is made again.
    pub record: PlanRecord,
    /// The motion in time.
    pub motion: TimedMotion,
    /// How the grippers are turned in it.
    pub attitudes: Attitudes,
    /// How many of the drapes that the search took decided on a plan, in the time of its motion and where the sheet decides with
    /// the mesh of the scene; the others ranked candidates.
    pub decisions: usize,
    /// Whether the watcher ended the search.
    pub interrupted: bool,
    /// The result of the search, from which another search continues.
    pub checkpoint: Checkpoint,
}

/// Why there is no plan.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PlanError {
    /// The scene has no mold.
    #[error("the scene has no mold to lay the ply on")]
    NoMold,
    /// The scene has no target.
    #[error("the scene has no target: a plan needs to know where the ply shall end")]
    NoTarget,
    /// A plan for other grippers or other fabric.
    #[error(
        "the earlier plan is for {earlier} grippers, or for other places in the fabric, and the scene has {now}: plan anew"
    )]
    OtherPly {
        /// Grippers of the earlier plan.
        earlier: usize,
        /// Grippers of the scene.
        now: usize,
    },
    /// A checkpoint with numbers that no search writes.
    #[error(
        "the earlier plan holds a strategy or positions that no search can have left: plan anew"
    )]
    Numbers,
    /// The positions cannot become a motion.
    #[error(transparent)]
    Motion(#[from] MotionError),
}

/// Plans the gripper motion of a scene, from where it starts to its target.
///
/// The search continues from `checkpoint`, that of an earlier search for the same ply. `watcher` receives the progress;
/// when it breaks, the best plan so far is finished. A plan that does not keep all limits is a plan all the same: its
/// verdicts say which limits, where and by how much.
///
/// # Errors
/// [`PlanError`] if the scene has no mold or target, or the checkpoint is not of its ply.
pub fn plan(
    scene: &Scene,
    checkpoint: Option<&Checkpoint>,
    watcher: Watcher,
) -> Result<Planned, PlanError> {
    if scene.mold.is_none() {
        return Err(PlanError::NoMold);
    }
    if scene.target.is_none() {
        return Err(PlanError::NoTarget);
    }
    if let Some(checkpoint) = checkpoint {
        checkpoint.check(scene)?;
    }
    let most = match scene.plan.method {
        PlanMethod::Path => scene.plan.evaluations,
        PlanMethod::Stepwise => scene.plan.steps,
    };
    let state = SearchState::new(most, watcher);
    let (mut decision, own_limits) = match scene.plan.method {
        PlanMethod::Path => by_path(scene, checkpoint, &state)?,
        PlanMethod::Stepwise => by_steps(scene, &state)?,
    };
    state.finish();

    let Followed { drape, limited_by } = follow(scene, &mut decision, own_limits, &state);
    let Decision { strategy, positions, motion, sheet, .. } = decision;
    let evaluations = match scene.plan.method {
        PlanMethod::Path => state.candidates() + state.decisions(),
        PlanMethod::Stepwise => state.candidates(),
    };
    let (method, rate) = (scene.plan.method, scene.plan.rate);
    let record = PlanRecord::of(method, evaluations, rate, positions.clone(), &motion, limited_by);
    let attitudes = Attitudes::of(&drape.steps)?;
    let before = checkpoint.map_or(0, |checkpoint| checkpoint.evaluations);
    let checkpoint = Checkpoint::new(scene, before + evaluations, strategy, positions);
    let interrupted = state.is_interrupted();
    let decisions = state.decisions();
    Ok(Planned { drape, sheet, record, motion, attitudes, decisions, interrupted, checkpoint })
}

/// What follows from a decision.
pub(super) struct Followed {
    /// The drape by catenaries along its motion, with the verdicts of all limits but those of the sheet.
    pub drape: Drape,
    /// What limits the time of the motion.
    pub limited_by: Vec<LimitedBy>,
}

/// Drapes by catenaries along the motion of a decision, which gets the least time under all limits.
pub(super) fn follow(
    scene: &Scene,
    decision: &mut Decision,
    own_limits: Vec<Verdict>,
    state: &SearchState,
) -> Followed {
    let along = |motion: &TimedMotion| {
        let followed = evaluation::with_motion(scene, motion.steps());
        simulate(&followed, |_| ControlFlow::Continue(()))
    };
    let mut drape = along(&decision.motion);
    // the shapes of the ply do not depend on time: only how fast everything goes does
    let Quickest { motion, limited_by } = quickest(scene, &decision.motion, &drape);
    if motion != decision.motion {
        decision.retimed(scene, motion, state);
        drape = along(&decision.motion);
    }
    if let (Some(asked), Some(made)) = (&decision.asked, drape.summary.tool.take()) {
        drape.summary.follow_tool(scene, made.with_residual_of(asked));
    }
    // limits that no plan can keep come first
    let summary = &mut drape.summary;
    let verdicts = std::mem::take(&mut summary.limits);
    summary.judge_also(infeasible_limits(scene));
    summary.limits.extend(verdicts);
    if let Ok(attitudes) = Attitudes::of(&drape.steps)
        && let Some(whole) = evaluation::clearance_of_motion(scene, &decision.motion, &attitudes)
    {
        judge_whole(summary, whole);
    }
    let bounds = Bounds::from(&scene.limits);
    summary.judge_also(own_limits.into_iter().chain(rates(&decision.motion, &bounds, scene)));
    if let Some(tool) = &scene.tool
        && let Ok(peaks) = tool.peaks(&decision.motion, scene.plan.rate)
    {
        summary.judge_also(tool_rates(tool, &peaks, &decision.motion, scene));
    }
    Followed { drape, limited_by }
}

/// Judges a drape by the whole of its motion in time where that is worse than straight ways from step to step.
pub(super) fn judge_whole(summary: &mut Summary, whole: Verdict) {
    summary.accepted &= whole.ok;
    // what no plan can keep stands before what was measured
    match summary
        .limits
        .iter_mut()
        .rfind(|verdict| verdict.name == whole.name && verdict.step.is_some())
    {
        Some(verdict) if whole.ratio() > verdict.ratio() => *verdict = whole,
        Some(_) => {}
        None => summary.limits.push(whole),
    }
}

/// A decision, and limits of the planner itself.
type Found = (Decision, Vec<Verdict>);

fn by_path(
    scene: &Scene,
    checkpoint: Option<&Checkpoint>,
    state: &SearchState,
) -> Result<Found, PlanError> {
    let best = path::search(scene, checkpoint, state)?.ok_or(PlanError::NoTarget)?;
    Ok((best, Vec::new()))
}

fn by_steps(scene: &Scene, state: &SearchState) -> Result<Found, PlanError> {
    state.begin("step by step");
    let plan = stepwise(scene, &mut |done| {
        state.set_steps(done);
        state.report()
    });
    let limits = unreached(scene, &plan);
    state.finish();
    Ok((Decision::on(scene, None, plan.positions, state)?, limits))
}

/// The limit that a stepwise plan breaks which does not reach its target.
pub(super) fn unreached(scene: &Scene, plan: &Stepwise) -> Vec<Verdict> {
    match plan.outcome {
        Outcome::OutOfSteps(error) | Outcome::OutOfReach(error) => {
            let gripper = scene.ply.index(error.gripper).unwrap_or_default();
            let at = Site::Gripper(gripper).label(scene);
            let worst = Worst {
                value: error.distance * 1e3,
                at: format!("{at}, short of its target"),
                place: plan.positions.last().map(|step| step[gripper]),
            };
            vec![Verdict::of(Name::Steps, worst, 0.0, Some(plan.positions.len()))]
        }
        Outcome::Arrived | Outcome::Interrupted | Outcome::NoTarget => Vec::new(),
    }
}

/// How fast a tool turns and its axes move, against their limits.
pub(super) fn tool_rates(
    tool: &Tool,
    peaks: &ToolPeaks,
    motion: &TimedMotion,
    scene: &Scene,
) -> Vec<Verdict> {
    let ToolPeaks { turn_rate, turn_acceleration, axis_share, axis } = *peaks;
    let [turn_rate, turn_acceleration] =
        [turn_rate, turn_acceleration].map(|peak| Peak { value: peak.value.to_degrees(), ..peak });
    let moved = tool.axes.get(axis).map(|axis| {
        let gripper = Site::Gripper(axis_share.gripper).label(scene);
        (Name::AxisSpeed, axis_share, format!("axis {} of {gripper}", axis.name))
    });
    let frame = || "frame of the tool".to_owned();
    [
        Some((Name::ToolTurnRate, turn_rate, frame())),
        Some((Name::ToolTurnAcceleration, turn_acceleration, frame())),
        moved,
    ]
    .into_iter()
    .flatten()
    .filter_map(|(name, peak, at)| {
        let step = motion.times().partition_point(|t| *t < peak.time) + 1;
        let worst = Worst { value: peak.value, at, place: None };
        let limit = name.measure().limit(scene)?;
        Some(Verdict::of(name, worst, limit, Some(step.min(motion.times().len()))))
    })
    .collect()
}

/// Largest speed, acceleration and jerk of the motion against their limits.
pub(super) fn rates(motion: &TimedMotion, bounds: &Bounds, scene: &Scene) -> Vec<Verdict> {
    let peaks = motion.peaks();
    let verdict = |name: Name, peak: Peak, limit: f64| {
        let step = motion.times().partition_point(|t| *t < peak.time) + 1;
        let worst = Worst {
            value: peak.value,
            at: Site::Gripper(peak.gripper).label(scene),
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
