//! From a scene to a motion: a planner finds positions, which become a motion in time, and the model that decides drapes
//! along it.

use super::checkpoint::Checkpoint;
use super::decision::{Decided, Decision};
use super::evaluation;
use super::path::{self, LowStart};
use super::record::PlanRecord;
use super::search_state::{SearchState, Watcher};
use super::stepwise::{Stepwise, StepwiseEnd, stepwise};
use super::tried::{TRYING, tried};
use crate::Error;
use crate::layup::Model;
use crate::measure::{Name, Verdict, Worst};
use crate::motion::{Attitudes, TimedMotion};
use crate::outcome::{self, Outcome};
use crate::scene::{PlanMethod, Scene};
use crate::state::Site;

/// A finished plan.
#[derive(Debug, Clone)]
pub struct Planned {
    /// The drape along the planned motion by the model that decides, with the verdicts of all limits.
    pub outcome: Outcome,
    /// The data from which the motion is made again.
    pub record: PlanRecord,
    /// The motion in time.
    pub motion: TimedMotion,
    /// How the grippers are turned in it, by the model that decides.
    pub attitudes: Attitudes,
    /// How many of the drapes that the search took decided on a plan, in the time of its motion and where the sheet decides with
    /// the mesh of the scene; the others ranked candidates.
    pub decisions: usize,
    /// Whether the watcher ended the search.
    pub interrupted: bool,
    /// The result of the search, from which another search continues.
    pub checkpoint: Checkpoint,
}

impl Planned {
    /// Whether the plan keeps every limit by the model that decides, and in as many cells with the errors of the scene as must.
    #[must_use]
    pub fn accepted(&self) -> bool {
        self.outcome.accepted()
    }
}

/// Plans the gripper motion of a scene, from where it starts, or higher if that is too low ([`LowStart`]), to its target, and judges it by the
/// model that decides, with the errors of the scene if it has any. To drape by the other model ([`outcome::also`]) is left to the caller.
///
/// The search continues from `checkpoint`, that of an earlier search for the same ply; one that was cut off must be of the same scene, or else
/// without its judgments ([`Checkpoint::finished`]), because these are taken as they are. `watcher` receives the progress;
/// when it breaks, the best plan so far is finished. A plan that does not keep all limits is a plan all the same: its
/// verdicts say which limits, where and by how much.
///
/// # Errors
/// [`Error::NoMold`] or [`Error::NoTarget`]; [`Error::CheckpointOtherPly`] or [`Error::CheckpointNumbers`] if the checkpoint is not of its
/// ply; those of [`outcome::check_model`] if the model that decides cannot drape it; [`Error::Layup`] if positions cannot become a motion.
pub fn plan(
    scene: &Scene,
    checkpoint: Option<&Checkpoint>,
    watcher: Watcher,
) -> Result<Planned, Error> {
    searched(scene, checkpoint, true, watcher)
}

/// Plans as [`plan`], but ranks and judges without errors: a quick look, at whose plan a sample of the scene may fail.
///
/// # Errors
/// As [`plan`].
pub fn plan_without_errors(
    scene: &Scene,
    checkpoint: Option<&Checkpoint>,
    watcher: Watcher,
) -> Result<Planned, Error> {
    searched(scene, checkpoint, false, watcher)
}

/// A plan, judged by the sample of the scene or not.
fn searched(
    scene: &Scene,
    checkpoint: Option<&Checkpoint>,
    sampled: bool,
    watcher: Watcher,
) -> Result<Planned, Error> {
    if scene.layup.mold.is_none() {
        return Err(Error::NoMold);
    }
    if scene.layup.target.is_none() {
        return Err(Error::NoTarget);
    }
    outcome::check_model(&scene.layup, scene.layup.settings.model)?;
    let raised = LowStart::find(scene).map(|low| low.raised(scene));
    let scene = raised.as_ref().unwrap_or(scene);
    if let Some(checkpoint) = checkpoint {
        checkpoint.check(scene)?;
    }
    // a plan that goes on begins with the journal of the one before
    let most = match scene.plan.method {
        PlanMethod::Path => path::most_candidates(scene),
        PlanMethod::Stepwise => scene.plan.steps,
    };
    let (checkpoint, journal) =
        checkpoint.map_or_else(Default::default, |checkpoint| checkpoint.origin(scene));
    let state = SearchState::new(most, watcher).going_on(scene, checkpoint, journal);
    let state = if sampled { state } else { state.without_cells() };
    let (mut decision, own_limits) = match scene.plan.method {
        PlanMethod::Path => by_path(scene, checkpoint, sampled, &state)?,
        PlanMethod::Stepwise => by_steps(scene, &state)?,
    };
    state.finish();

    // the motion in time, with its own limits, judged as it is driven
    decision.finish(scene, own_limits, &state, true)?;
    decision.decided.drape.summary.judge_rest(&scene.layup, &scene.limits);
    if sampled {
        decision.sample(scene, &state)?;
    }
    let interrupted = state.is_interrupted();
    let tried = match scene.plan.method {
        PlanMethod::Path if !decision.decided.drape.summary.accepted() => {
            state.begin(TRYING);
            tried(scene, decision.strategy, sampled, &state)
        }
        PlanMethod::Path | PlanMethod::Stepwise => Vec::new(),
    };
    let whole = decision.whole_motion()?;
    let Decision { strategy, mut positions, motion, cycle, decided, limited_by, slowed, .. } =
        decision;
    let Decided { drape, attitudes, .. } = decided;
    let evaluations = match scene.plan.method {
        PlanMethod::Path => state.candidates() + state.decisions(),
        PlanMethod::Stepwise => state.candidates(),
    };
    let decisions = state.decisions();
    let (method, rate) = (scene.plan.method, whole.fitting_rate(scene.plan.rate));
    let limited_by = limited_by.unwrap_or_default();
    let record = PlanRecord {
        refused: Some(state.refusals()).filter(|refused| *refused > 0),
        slowed: Some(slowed).filter(|slowed| *slowed != 1.0),
        cycle,
        tried,
        ..PlanRecord::new(method, evaluations, rate, positions.clone(), &motion, limited_by)
    };
    // a search begins where the ply hangs
    positions.drain(..scene.layup.pick_up.map_or(0, |pick_up| pick_up.lift_steps));
    let before = checkpoint.map_or(0, |checkpoint| checkpoint.evaluations);
    let own = Checkpoint::new(scene, before + evaluations, strategy, positions);
    let checkpoint = match scene.plan.method {
        PlanMethod::Path if interrupted => own.cut_off(scene, checkpoint, state.into_journal()),
        PlanMethod::Path | PlanMethod::Stepwise => own,
    };
    let outcome = Outcome { drape, also: None };
    Ok(Planned { outcome, record, motion: whole, attitudes, decisions, interrupted, checkpoint })
}

/// The scene along a planned motion, as plans are draped.
#[must_use]
pub fn along(scene: &Scene, motion: &TimedMotion) -> Scene {
    Scene { layup: evaluation::along_motion(&scene.layup, motion.steps()), ..scene.clone() }
}

/// A decision, and limits of the planner itself.
type Found = (Decision, Vec<Verdict>);

fn by_path(
    scene: &Scene,
    checkpoint: Option<&Checkpoint>,
    sampled: bool,
    state: &SearchState,
) -> Result<Found, Error> {
    let best = path::search(scene, checkpoint, sampled, state)?.ok_or(Error::NoTarget)?;
    Ok((best, Vec::new()))
}

fn by_steps(scene: &Scene, state: &SearchState) -> Result<Found, Error> {
    outcome::check_catenaries(&scene.layup, Model::Catenaries)?;
    state.begin("step by step");
    let plan = stepwise(scene, &mut |done| {
        state.set_steps(done);
        state.report()
    });
    let limits = unreached(scene, &plan);
    state.finish();
    Ok((Decision::on(scene, None, plan.positions, None, state)?, limits))
}

/// The limit that a stepwise plan breaks which does not reach its target.
pub(super) fn unreached(scene: &Scene, plan: &Stepwise) -> Vec<Verdict> {
    match plan.outcome {
        StepwiseEnd::OutOfSteps(error) | StepwiseEnd::OutOfReach(error) => {
            let gripper = scene.layup.ply.index(error.gripper).unwrap_or_default();
            let at = Site::Gripper(gripper).label(&scene.layup);
            let worst = Worst {
                value: error.distance * 1e3,
                at: format!("{at}, short of its target"),
                place: plan.positions.last().map(|step| step[gripper]),
            };
            vec![Verdict::new(Name::Steps, worst, 0.0, Some(plan.positions.len()))]
        }
        StepwiseEnd::Arrived | StepwiseEnd::Interrupted | StepwiseEnd::NoTarget => Vec::new(),
    }
}
