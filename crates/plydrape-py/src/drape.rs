//! `plydrape.simulate` and `plydrape.plan`.

use crate::arrays::{Array, Named, Numbers};
use crate::error;
use crate::json::Json;
use crate::model::for_models;
use crate::quantity::Amount;
use crate::result::Result;
use crate::scene::{SceneArgument, blocks, warn};
use crate::work::{Watch, parallel, run};
use plydrape::motion::TimedMotion;
use plydrape::outcome::{self, Robustness};
use plydrape::planner::infeasible_limits::with_spring_back;
use plydrape::planner::{self, Checkpoint, PlanRecord, Progress};
use plydrape::scene::PlanMethod;
use plydrape_io::plan as plan_file;
use plydrape_io::result::{SceneEcho, sheet};
use plydrape_io::scene::{Measured, SceneFile, usual};
use plydrape_io::text::forecast;
use plydrape_io::text::foreseen::{foreseen, infeasible};
use plydrape_io::{Error, ResultFile};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::borrow::Cow;
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Drapes the ply of a scene along its motion, as `plydrape simulate` does.
///
/// One model drapes and decides. Other threads of Python run on meanwhile, and Ctrl-C ends it. A scene with errors is judged by a
/// sample of its cells too.
///
/// Parameters
/// ----------
/// scene : Scene
///     The scene.
/// model : {"sheet", "catenaries"}, optional
///     The model that drapes and decides, instead of the scene's.
/// also : {"sheet", "catenaries"}, optional
///     The other model, to be draped too and shown beside as `Result.also`; it never judges.
/// without_errors : bool, default False
///     Whether the errors of the scene are left out.
/// progress : callable, optional
///     Called with (steps done, steps, what is done) as the drape gets on, some 50 times a second.
///
/// Returns
/// -------
/// Result
///     The result; a drape that breaks limits is a result all the same.
///
/// Raises
/// ------
/// SceneError
///     If a model cannot drape the scene: its material lacks a stiffness that the sheet needs, for instance.
/// OutputError
///     If the states of the sheet cannot be kept in the folder for temporary files.
/// ValueError
///     If there is no such model.
///
/// Examples
/// --------
/// >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
/// >>> plydrape.simulate(scene).accepted
/// True
/// >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
/// >>> result = plydrape.simulate(scene, also="catenaries")
/// >>> result.model, result.also.model
/// ('sheet', 'catenaries')
#[pyfunction]
#[pyo3(signature = (
    scene, *, model: "typing.Literal['sheet', 'catenaries'] | None" = None,
    also: "typing.Literal['sheet', 'catenaries'] | None" = None, without_errors = false,
    progress: "typing.Callable[[int, int, str], object] | None" = None
))]
pub fn simulate(
    py: Python<'_>,
    scene: SceneArgument<'_>,
    model: Option<&str>,
    also: Option<&str>,
    without_errors: bool,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Result> {
    let scene = for_models(scene.get(), model, also)?;
    let steps = scene.layup.motion.positions.len();
    let result = run(py, progress, move |watch| {
        let report = |done, stage| {
            let _ = watch.tell(done, steps, stage);
        };
        let mut result = draped(&scene, watch, &report)?;
        if !without_errors {
            judge_errors(&mut result, &Robustness::of_simulated(&scene), watch);
        }
        Ok(result)
    })?;
    result.map(|result| Result(Arc::new(result))).map_err(|fault| error::scene(&fault))
}

/// The drape of a scene by the model that decides, and by the other one if the scene asks for it, with the states of a sheet in the folder
/// for temporary files. `told` hears of the steps that are done, and of what.
pub fn draped(
    scene: &SceneFile,
    watch: &Watch,
    told: &dyn Fn(usize, &'static str),
) -> std::result::Result<ResultFile, Error> {
    let (model, dir) = (scene.layup.settings.model, std::env::temp_dir());
    let drape = sheet::drape(scene, model, &dir, &watch.stop(), |done| told(done, "draping"))?;
    let mut result = ResultFile::new(scene, scene.input.clone(), drape);
    show_also(&mut result, scene, watch, told)?;
    Ok(result)
}

/// Shows the model that does not decide beside a result, if the scene asks for it.
fn show_also(
    result: &mut ResultFile,
    scene: &plydrape::Scene,
    watch: &Watch,
    told: &dyn Fn(usize, &'static str),
) -> std::result::Result<(), Error> {
    if scene.also && !result.summary.interrupted() {
        let (model, dir) = (result.model().other(), std::env::temp_dir());
        let beside = |done| told(done, "draping by the other model");
        result.show_also(sheet::drape(scene, model, &dir, &watch.stop(), beside)?);
    }
    Ok(())
}

/// Judges a result with errors, until the work shall end.
fn judge_errors(result: &mut ResultFile, robustness: &Robustness, watch: &Watch) {
    let report = |done, most| {
        let _ = watch.tell(done, most, "draping with errors");
    };
    judge_by(result, robustness, watch, &report);
}

/// Judges a result with errors, until the work shall end; `done` hears of the cells that are draped.
pub fn judge_by(
    result: &mut ResultFile,
    robustness: &Robustness,
    watch: &Watch,
    done: &(dyn Fn(usize, usize) + Sync),
) {
    let watch = outcome::Watch { stop: &watch.stop(), done };
    if robustness.judge_sample(&mut result.summary, &watch) {
        robustness.judge_tolerance(&mut result.summary, &watch);
    }
}

/// Finds a motion that lays the ply of a scene on its mold, as `plydrape plan` does.
///
/// The scene's model drapes and decides. A start at which the ply would hang into the mold is raised first, and a warning says so.
///
/// The search ends with a plan that keeps all limits with a margin. Other threads of Python run on meanwhile. Ctrl-C raises
/// KeyboardInterrupt at once; to stop early and keep the best so far, give the search a `time`, or fewer `evaluations`
/// in the scene's `plan`.
///
/// The plan is then judged with errors: by a sample of cells where the scene has `errors`, and what it tolerates is found. That takes
/// those of the sample and some more, forty-six on the dome, which `time` does not bound.
///
/// Parameters
/// ----------
/// scene : Scene
///     The scene, with mold and target.
/// method : {"path", "stepwise"}, optional
///     "path" or "stepwise", instead of the scene's.
/// seed : int, optional
///     Seed of the search, instead of the scene's: the same seed, the same plan.
/// improve : bool, optional
///     Whether to go on improving a plan that keeps all limits with a margin, until the `evaluations` of the scene's
///     `plan` are used up or the time is over, instead of what the scene says.
/// time : float or str, optional
///     Time after which the search ends with the best plan so far, in seconds or with a unit, as "5 min"; what
///     follows it ends after as much again, and a plan whose drape or sample is not complete then is not accepted.
/// checkpoint : str, optional
///     Text of the plan.json of an earlier search, from which to continue: see `Plan.checkpoint`.
/// also : {"sheet", "catenaries"}, optional
///     The model that does not decide, to be draped along the plan too and shown beside as `Result.also`; it never judges.
/// without_errors : bool, default False
///     Whether the plan is looked for and judged without errors: a quick look.
/// progress : callable, optional
///     Called with (candidates draped, most, what is done), some 50 times a second. While the sheet decides on a plan, the last one
///     says how long that will take in all, as "deciding: 961 nodes, about 4 s".
///
/// Returns
/// -------
/// Plan
///     The best plan found, whether or not it is accepted.
///
/// Raises
/// ------
/// PlanError
///     If the scene has no mold or target, or `checkpoint` is not of its ply.
/// SceneError
///     If its motion has a `duration`, which a plan would ignore, or if a model cannot drape it.
/// ValueError
///     If there is no such method, `time` is no time above zero, or `checkpoint` is no plan.json.
///
/// Examples
/// --------
/// >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
/// >>> plan = plydrape.plan(scene, without_errors=True)
/// >>> plan.method, plan.result.accepted
/// ('path', True)
#[pyfunction]
#[pyo3(signature = (
    scene, *, method: "typing.Literal['path', 'stepwise'] | None" = None, seed = None, improve = None,
    time: "float | str | None" = None, checkpoint = None,
    also: "typing.Literal['sheet', 'catenaries'] | None" = None, without_errors = false,
    progress: "typing.Callable[[int, int, str], object] | None" = None
))]
#[expect(clippy::too_many_arguments, reason = "they are keywords in Python")]
pub fn plan(
    py: Python<'_>,
    scene: SceneArgument<'_>,
    method: Option<&str>,
    seed: Option<u64>,
    improve: Option<bool>,
    time: Option<Amount>,
    checkpoint: Option<&str>,
    also: Option<&str>,
    without_errors: bool,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Plan> {
    // what the arguments say replaces what the scene says
    let mut scene = (*for_models(scene.get(), None, also)?).clone();
    match method {
        None => {}
        Some("path") => scene.plan.method = PlanMethod::Path,
        Some("stepwise") => scene.plan.method = PlanMethod::Stepwise,
        Some(other) => {
            let text = format!("method is {other:?}; expected \"path\" or \"stepwise\"");
            return Err(PyValueError::new_err(text));
        }
    }
    scene.plan.seed = seed.unwrap_or(scene.plan.seed);
    scene.plan.improve = improve.unwrap_or(scene.plan.improve);
    let time = time.map(|time| duration(&time)).transpose()?;

    // a checkpoint is read against the scene, because it holds for that scene only
    let echo = SceneEcho::new(&scene, None);
    let checkpoint: Option<Checkpoint> =
        checkpoint.map(|text| plan_file::read(text, &echo)).transpose().map_err(|fault| {
            PyValueError::new_err(format!(
                "checkpoint is no plan.json of this version: {fault}; plan anew"
            ))
        })?;

    // a scene that cannot be planned is refused; what only hinders a plan is a warning
    if let Some(refusal) = &scene.plan_refusal {
        return Err(error::diagnostic(refusal));
    }
    let hinders = || {
        let limits = with_spring_back(&scene, !without_errors, &|| false);
        [infeasible(&limits), foreseen(&scene)].concat()
    };
    for sentence in py.detach(hinders) {
        warn(py, &sentence)?;
    }

    // the search ends once its time is over, except while it finishes the plan it has found
    let planned = run(py, progress, move |watch| {
        let began = Instant::now();
        if let Some(time) = time {
            watch.end_after(time.saturating_mul(2));
        }
        let errors = scene.errors.filter(|errors| errors.is_drawn() && !without_errors);
        let cells = errors.map_or(0, |errors| errors.samples);
        let plan = if without_errors { planner::plan_without_errors } else { planner::plan };
        let planned = plan(&scene, checkpoint.as_ref(), &mut |progress: &Progress| {
            let over = time.is_some_and(|time| began.elapsed() >= time);
            let takes = progress.forecast.map(|takes| match progress.sample {
                Some(cells) => forecast::sample(&takes, None, cells),
                None => forecast::decision(&takes, None, cells),
            });
            let stage = match takes {
                Some(takes) => format!("{}: {takes}", progress.stage).into(),
                None => Cow::Borrowed(progress.stage),
            };
            match watch.tell(progress.candidates, progress.most, stage) {
                ControlFlow::Continue(()) if over && !progress.finishing => ControlFlow::Break(()),
                flow => flow,
            }
        });
        planned.map(|planned| judged(&scene, planned, without_errors, watch))
    })?;

    planned.map_err(no_plan)?.map_err(|fault| error::scene(&fault))
}

/// What becomes of a planned motion: its result, with the other model beside if the scene asks for it, judged with errors unless these are
/// left out.
fn judged(
    scene: &SceneFile,
    planned: planner::Planned,
    without_errors: bool,
    watch: &Watch,
) -> std::result::Result<Plan, Error> {
    let (record, motion) = (planned.record.clone(), planned.motion.clone());
    let (checkpoint, decisions) = (planned.checkpoint.clone(), planned.decisions);
    let time_over = planned.interrupted;
    let along = planner::along(scene, &motion);
    let (dir, steps) = (std::env::temp_dir(), along.layup.motion.positions.len());
    let mut result = ResultFile::planned(scene, scene.input.clone(), planned, &dir)?;
    let report = |done, stage| {
        let _ = watch.tell(done, steps, stage);
    };
    show_also(&mut result, &along, watch, &report)?;
    if !without_errors {
        judge_errors(&mut result, &Robustness::of_planned(scene, motion.steps()), watch);
    }
    Ok(Plan { result: Arc::new(result), record, motion, checkpoint, decisions, time_over })
}

/// Why there is no plan; a scene that its model cannot drape is refused as such.
fn no_plan(cause: plydrape::Error) -> PyErr {
    use plydrape::Error::{CheckpointNumbers, CheckpointOtherPly, Layup, NoMold, NoTarget};
    match cause {
        NoMold | NoTarget | CheckpointOtherPly { .. } | CheckpointNumbers | Layup(_) => {
            error::plan(&cause)
        }
        cause => error::scene(&cause.into()),
    }
}

/// A time above zero.
fn duration(time: &Amount) -> PyResult<Duration> {
    let seconds = time.si("time", Measured::Time, &usual::ANY)?;
    Duration::try_from_secs_f64(seconds).ok().filter(|time| !time.is_zero()).ok_or_else(|| {
        let text = format!("time is {seconds} s; expected a time above zero, e.g. \"5 min\"");
        PyValueError::new_err(text)
    })
}

/// A planned motion, and the drape along it.
///
/// Examples
/// --------
/// >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
/// >>> plan = plydrape.plan(scene, without_errors=True)
/// >>> plan.accepted, plan.positions.shape[1:]
/// (True, (8, 3))
#[pyclass(frozen, module = "plydrape")]
pub struct Plan {
    pub result: Arc<ResultFile>,
    pub record: PlanRecord,
    pub motion: TimedMotion,
    pub checkpoint: Checkpoint,
    pub decisions: usize,
    pub time_over: bool,
}

#[pymethods]
impl Plan {
    /// The drape along the planned motion, with all limits judged.
    #[getter]
    fn result(&self) -> Result {
        Result(Arc::clone(&self.result))
    }

    /// The planner: "path" or "stepwise".
    #[getter]
    fn method(&self) -> &'static str {
        match self.record.method {
            PlanMethod::Path => "path",
            PlanMethod::Stepwise => "stepwise",
        }
    }

    /// Drapes that the search took; of the stepwise planner, steps.
    #[getter]
    fn evaluations(&self) -> usize {
        self.record.evaluations
    }

    /// How many of these drapes decided on a plan, with the mesh of the scene where the sheet decides; the others ranked
    /// candidates.
    #[getter]
    fn decisions(&self) -> usize {
        self.decisions
    }

    /// How many plans the sample of cells with errors refused in the search.
    #[getter]
    fn refused(&self) -> usize {
        self.record.refused.unwrap_or(0)
    }

    /// Of a plan that is not accepted, the changes of its scene that were tried, what helps most first: dicts with change, near (limit, kept and
    /// cells) and helps, as in result.json.
    #[getter]
    fn tried(&self) -> PyResult<Vec<Json>> {
        self.record.tried.iter().map(Json::new).collect()
    }

    /// Whether the search ended because its time was over.
    #[getter]
    fn time_over(&self) -> bool {
        self.time_over
    }

    /// Whether every limit is kept, by the model that decides, and in enough cells of the sample where the scene has errors.
    #[getter]
    fn accepted(&self) -> bool {
        self.result.summary.accepted()
    }

    /// How long the motion takes (s).
    #[getter]
    fn duration(&self) -> f64 {
        self.motion.duration()
    }

    /// What limits the time of the motion, that of the longest time first.
    ///
    /// Each limit is a dict: its `name`, for how long it is the one that is nearest to its limit (`time_s`), and the `gripper` with
    /// which it is that for the longest as [i, j], None of the frame of a tool.
    #[getter]
    fn limited_by(&self) -> PyResult<Vec<Json>> {
        self.record.limited_by.iter().map(Json::new).collect()
    }

    /// Time of each planned step (s), shape (steps,).
    #[getter]
    fn times(&self) -> Array<f64> {
        let times = self.motion.times().to_vec();
        Array::new(&[times.len()], times)
    }

    /// Planned positions of the grippers (m), shape (steps, grippers, 3): control points of the smooth motion.
    #[getter]
    fn positions(&self) -> Array<f64> {
        blocks(self.motion.positions(), self.motion.grippers())
    }

    /// The grippers at any times of the motion.
    ///
    /// Parameters
    /// ----------
    /// times : array_like
    ///     Times (s), shape (n,).
    ///
    /// Returns
    /// -------
    /// dict[str, ndarray]
    ///     "positions", "velocities", "accelerations" and "jerks" (m, s), each of shape (n, grippers, 3).
    ///
    /// Examples
    /// --------
    /// >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
    /// >>> plan = plydrape.plan(scene, without_errors=True)
    /// >>> motion = plan.motion(np.linspace(0, plan.duration, 101))
    /// >>> speeds = np.linalg.norm(motion["velocities"], axis=2)
    /// >>> bool(speeds.max() < 0.25), bool(speeds[[0, -1]].max() < 1e-9)
    /// (True, True)
    fn motion(&self, times: Numbers<'_>) -> PyResult<Named> {
        let times = times.list("times")?;
        let motion = &self.motion;
        let every = |at: &dyn Fn(f64) -> Vec<[f64; 3]>| {
            let steps: Vec<_> = times.iter().map(|t| at(*t)).collect();
            blocks(&steps, motion.grippers())
        };
        Ok(Named(vec![
            ("positions", every(&|t| motion.at(t))),
            ("velocities", every(&|t| motion.velocity(t))),
            ("accelerations", every(&|t| motion.acceleration(t))),
            ("jerks", every(&|t| motion.jerk(t))),
        ]))
    }

    /// The checkpoint from which a later search continues: the text of plan.json.
    #[getter]
    fn checkpoint(&self) -> PyResult<String> {
        plan_file::text(&self.checkpoint, &self.result.scene).map_err(|fault| error::output(&fault))
    }

    /// Writes result.json, steps.csv, trajectory.csv, motion.csv, report.html, plan.json, and of a sheet sheet.npz, into a
    /// folder, all or none, and returns their paths.
    ///
    /// Parameters
    /// ----------
    /// folder : str or path
    ///     The folder; it is made where there is none.
    ///
    /// Returns
    /// -------
    /// list of Path
    ///     The paths of the files.
    ///
    /// Raises
    /// ------
    /// OutputError
    ///     If that cannot be done; a file that plydrape did not write is never overwritten.
    ///
    /// Examples
    /// --------
    /// >>> import tempfile
    /// >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
    /// >>> plan = plydrape.plan(scene, without_errors=True)
    /// >>> with tempfile.TemporaryDirectory() as folder:
    /// ...     sorted(path.name for path in plan.write(folder))
    /// ['motion.csv', 'plan.json', 'report.html', 'result.json', ...]
    fn write(&self, py: Python<'_>, folder: PathBuf) -> PyResult<Vec<PathBuf>> {
        let write = || plan_file::write_all(&self.result, &self.checkpoint, &folder);
        parallel(py, write).map_err(|fault| error::output(&fault))
    }

    fn __repr__(&self) -> String {
        let verdict = self.result.verdict();
        format!(
            "<plydrape.Plan of {:?}, {verdict}, {:.1} s>",
            self.result.scene.title,
            self.duration()
        )
    }
}
