//! Many at once, on all cores: `plydrape.batch`.

use crate::arrays::{Array, Numbers};
use crate::drape::{draped, judge_by};
use crate::equilibrium::shear_angles;
use crate::error;
use crate::model::for_models;
use crate::result::Result;
use crate::scene::Scene;
use crate::solver::Solver;
use crate::work::run;
use plydrape::equilibrium::Status;
use plydrape::outcome::Robustness;
use plydrape::ply::{Lines, Ply};
use plydrape_io::scene::SceneFile;
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::sync::Arc;

/// Threads for a batch, as many as there are cores unless given.
fn pool(threads: Option<usize>) -> PyResult<ThreadPool> {
    if let Some(threads) = threads.filter(|threads| !(1..=1024).contains(threads)) {
        let text = format!("threads is {threads}; 1 to 1024 are possible, None is one a core");
        return Err(PyValueError::new_err(text));
    }
    // rayon takes 0 for as many as there are cores
    let made = ThreadPoolBuilder::new().num_threads(threads.unwrap_or(0)).build();
    made.map_err(|fault| PyRuntimeError::new_err(format!("cannot start threads: {fault}")))
}

/// Drapes many scenes along their motions, on all cores.
///
/// Parameters
/// ----------
/// scenes : iterable of Scene
///     The scenes.
/// model : {"sheet", "catenaries"}, optional
///     The model that drapes and decides, instead of that of each scene.
/// also : {"sheet", "catenaries"}, optional
///     The other model, to be draped too and shown beside as `Result.also`; it never judges.
/// threads : int, optional
///     How many at once; one a core unless given. The results do not depend on it.
/// progress : callable, optional
///     Called with (drapes done, drapes, what is done), some 50 times a second.
///
/// Returns
/// -------
/// list of Result
///     One result a scene, in their order.
///
/// Raises
/// ------
/// SceneError, OutputError, ValueError
///     As `simulate`.
///
/// Examples
/// --------
/// >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
/// >>> [result.accepted for result in plydrape.batch.simulate([scene, scene])]
/// [True, True]
#[pyfunction]
#[pyo3(name = "simulate_all", signature = (
    scenes: "typing.Iterable[Scene]", *,
    model: "typing.Literal['sheet', 'catenaries'] | None" = None,
    also: "typing.Literal['sheet', 'catenaries'] | None" = None, threads = None,
    progress: "typing.Callable[[int, int, str], object] | None" = None
))]
pub fn simulate_all(
    py: Python<'_>,
    scenes: &Bound<'_, PyAny>,
    model: Option<&str>,
    also: Option<&str>,
    threads: Option<usize>,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Vec<Result>> {
    let scenes = (scenes.try_iter()?)
        .map(|scene| for_models(scene?.cast::<Scene>()?.get(), model, also))
        .collect::<PyResult<Vec<_>>>()?;
    let pool = pool(threads)?;
    let results = run(py, progress, move |watch| {
        let drape = |scene: &Arc<SceneFile>| {
            let mut result = draped(scene, watch, &|_, _| {})?;
            judge_by(&mut result, &Robustness::of_simulated(scene), watch, &|_, _| {});
            let _ = watch.count(1, scenes.len(), "draping");
            Ok(Result(Arc::new(result)))
        };
        pool.install(|| scenes.par_iter().map(drape).collect::<std::result::Result<Vec<_>, _>>())
    })?;
    results.map_err(|fault| error::scene(&fault))
}

/// What is kept of one equilibrium of many.
#[derive(serde::Serialize, serde::Deserialize)]
pub struct Found {
    pub converged: bool,
    pub iterations: usize,
    #[serde(with = "crate::json::or_null")]
    pub forces: Vec<f64>,
    pub slopes: Vec<[f64; 2]>,
    pub shear: Vec<f64>,
}

/// Many equilibria of one ply. Catenaries are counted as in `Ply`.
///
/// Examples
/// --------
/// >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
/// >>> batch = plydrape.batch.equilibria(plydrape.Solver.of(scene), scene.positions[:20])
/// >>> len(batch), batch.slopes.shape
/// (20, (20, 16, 2))
#[pyclass(frozen, module = "plydrape")]
pub struct Equilibria {
    pub ply: Arc<Ply>,
    pub found: Vec<Found>,
}

impl Equilibria {
    fn lines(&self) -> Arc<Lines> {
        self.ply.lines()
    }

    fn array<const N: usize>(
        &self,
        count: usize,
        numbers: impl Fn(&Found) -> &[[f64; N]],
        axes: &[usize],
    ) -> Array<f64> {
        let shape = [&[self.found.len(), count], axes].concat();
        Array::rows(&shape, self.found.iter().flat_map(|found| numbers(found).iter().copied()))
    }
}

#[pymethods]
impl Equilibria {
    /// Whether each was found, shape (n,).
    #[getter]
    fn converged(&self) -> Array<bool> {
        let converged = self.found.iter().map(|found| found.converged);
        Array::new(&[self.found.len()], converged.collect())
    }

    /// Iterations on the shared slopes, shape (n,).
    #[getter]
    fn iterations(&self) -> Array<i64> {
        let iterations = self.found.iter().map(|found| found.iterations as i64);
        Array::new(&[self.found.len()], iterations.collect())
    }

    /// Horizontal forces (N), shape (n, catenaries); nan of stretched diagonals and straight catenaries.
    #[getter]
    fn forces(&self) -> Array<f64> {
        self.array(self.lines().catenaries(), |found| found.forces.as_chunks::<1>().0, &[])
    }

    /// Slopes at the ends of each catenary, shape (n, catenaries, 2).
    #[getter]
    fn slopes(&self) -> Array<f64> {
        self.array(self.lines().catenaries(), |found| &found.slopes, &[2])
    }

    /// Shear angles (rad), shape (n, cells); 0 where no diagonal is stretched.
    #[getter]
    fn shear(&self) -> Array<f64> {
        self.array(self.lines().cells().len(), |found| found.shear.as_chunks::<1>().0, &[])
    }

    fn __len__(&self) -> usize {
        self.found.len()
    }

    fn __repr__(&self) -> String {
        format!(
            "<plydrape.Equilibria, {} of {} × {} grippers>",
            self.found.len(),
            self.ply.grid.nu,
            self.ply.grid.nv
        )
    }
}

/// Solves for many places of the grippers, on all cores; each from nothing, so that none depends on another.
///
/// Parameters
/// ----------
/// solver : Solver
///     The ply and its rules.
/// positions : array_like
///     Positions of the grippers (m), shape (n, grippers, 3), i running fastest, or of a whole array (n, along u, along v, 3).
/// threads : int, optional
///     How many at once; one a core unless given. The results do not depend on it.
/// progress : callable, optional
///     Called with (equilibria done, equilibria, what is done), some 50 times a second.
///
/// Returns
/// -------
/// Equilibria
///     One equilibrium a row; those not found say so in `converged`.
///
/// Raises
/// ------
/// ValueError
///     If the shape does not fit, a coordinate is not a number up to 10⁶ m, or neighbors are (all but)
///     straight above each other, where the model has no solution; it names the row.
///
/// Examples
/// --------
/// >>> ply = plydrape.Ply(grippers=[4, 1], cell=[0.1, 0.1], material="krogh2018")
/// >>> level = np.array([[0.098 * i, 0, 0] for i in range(4)])
/// >>> batch = plydrape.batch.equilibria(plydrape.Solver(ply), [level, 1.01 * level])
/// >>> batch.forces.shape, batch.converged.all()
/// ((2, 3), np.True_)
#[pyfunction]
#[pyo3(signature = (
    solver, positions, *, threads = None,
    progress: "typing.Callable[[int, int, str], object] | None" = None
))]
pub fn equilibria(
    py: Python<'_>,
    solver: &Solver,
    positions: Numbers<'_>,
    threads: Option<usize>,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Equilibria> {
    let (fresh, ply) = (solver.fresh(), solver.ply());
    let positions = positions.steps("positions", &ply)?;
    for (n, places) in positions.iter().enumerate() {
        let fault = ply.check_places(places);
        fault.map_err(|fault| PyValueError::new_err(format!("positions[{n}]: {fault}")))?;
    }
    let pool = pool(threads)?;
    let (graph, solved) = (ply.lines(), Arc::clone(&ply));
    let found = run(py, progress, move |watch| {
        let contacts = vec![None; graph.catenaries()];
        let solve = |solver: &mut plydrape::equilibrium::Solver, positions: &Vec<[f64; 3]>| {
            solver.forget();
            let equilibrium = solver.solve(positions, &contacts);
            let mut found = Found {
                converged: equilibrium.status == Status::Converged,
                iterations: equilibrium.iterations,
                forces: vec![f64::NAN; graph.catenaries()],
                slopes: (0..graph.catenaries())
                    .map(|n| [straight(&graph, positions, n); 2])
                    .collect(),
                shear: shear_angles(&solved, solver),
            };
            for (n, element) in solver.problem().elements.iter().enumerate() {
                if let Some(force) = solver.force(n) {
                    found.forces[element.catenary] = force;
                    found.slopes[element.catenary] = solver.end_slopes(n);
                }
            }
            found
        };
        // reported and asked once a stretch: a single equilibrium takes microseconds
        const STRETCH: usize = 256;
        let most = positions.len();
        pool.install(|| {
            let stretches = positions.par_chunks(STRETCH).map_init(
                || fresh.clone(),
                |solver, stretch| {
                    let found: Vec<Found> = stretch
                        .iter()
                        .take_while(|_| watch.flow().is_continue())
                        .map(|p| solve(solver, p))
                        .collect();
                    let _ = watch.count(stretch.len(), most, "solving");
                    found
                },
            );
            stretches.flatten_iter().collect()
        })
    })?;
    Ok(Equilibria { ply, found })
}

/// Slope of the straight line between the ends of a catenary; 0 where they are above each other.
fn straight(lines: &Lines, positions: &[[f64; 3]], catenary: usize) -> f64 {
    let [a, b] = lines.ends(catenary).map(|gripper| positions[gripper]);
    let run = ((b[0] - a[0]).powi(2) + (b[1] - a[1]).powi(2)).sqrt();
    if run > 0.0 { (b[2] - a[2]) / run } else { 0.0 }
}
