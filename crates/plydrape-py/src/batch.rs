//! Many at once, on all cores: `plydrape.batch`.

use crate::result::Result;
use crate::scene::Scene;
use crate::work::run;
use plydrape::draping;
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::sync::Arc;

/// Threads for a batch, as many as there are cores unless given.
fn pool(threads: Option<usize>) -> PyResult<ThreadPool> {
    let threads = threads.unwrap_or(0);
    if threads > 1024 {
        let text = format!("threads is {threads}; 1 to 1024 are possible, None is one a core");
        return Err(PyValueError::new_err(text));
    }
    let made = ThreadPoolBuilder::new().num_threads(threads).build();
    made.map_err(|fault| PyRuntimeError::new_err(format!("cannot start threads: {fault}")))
}

/// Drapes many scenes along their motions, on all cores.
///
/// Args:
///     scenes: The scenes.
///     threads: How many at once; one a core unless given. The results do not depend on it.
///     progress: Called with (drapes done, drapes, what is done), some 50 times a second.
///
/// Returns:
///     One result a scene, in their order.
///
/// Example:
///     >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
///     >>> [result.accepted for result in plydrape.batch.simulate([scene, scene])]
///     [True, True]
#[pyfunction]
#[pyo3(name = "simulate_all", signature = (
    scenes: "typing.Iterable[Scene]", *, threads = None,
    progress: "typing.Callable[[int, int, str], object] | None" = None
))]
pub fn simulate_all(
    py: Python<'_>,
    scenes: &Bound<'_, PyAny>,
    threads: Option<usize>,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Vec<Result>> {
    let scenes = (scenes.try_iter()?)
        .map(|scene| Ok(Arc::clone(&scene?.cast::<Scene>()?.get().0)))
        .collect::<PyResult<Vec<_>>>()?;
    let pool = pool(threads)?;
    run(py, progress, move |watch| {
        let drape = |scene: &Arc<_>| {
            let drape = draping::simulate(scene, |_| watch.flow());
            let _ = watch.count(scenes.len(), "draping");
            Result(Arc::new(drape.result))
        };
        pool.install(|| scenes.par_iter().map(drape).collect())
    })
}
