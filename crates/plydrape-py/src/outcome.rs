//! `plydrape.outcome`: how a drape comes out, and how that changes with where its grippers end.

use crate::arrays::Array;
use crate::error;
use crate::result::Result;
use crate::scene::Scene;
use crate::work::run;
use plydrape::planner::sensitivity::{self, Quantity};
use plydrape_io::{ResultFile, size};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::sync::Arc;

/// The last step of a drape with its derivatives to where the grippers are in it.
///
/// Fabric in contact by then is held: the derivatives are those of the outcome to the grippers' targets as
/// long as a slightly different last step catches nothing more, and exact where the state is smooth.
///
/// Example:
///     >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
///     >>> outcome = plydrape.outcome(scene)
///     >>> worst = outcome.overstretch.argmax()
///     >>> outcome.overstretch_jacobian[worst].shape
///     (8, 3)
#[pyclass(frozen, module = "plydrape")]
pub struct Outcome {
    result: Result,
    grippers: usize,
    overstretch: Vec<Option<Quantity>>,
    force: Vec<Option<Quantity>>,
    shear: Vec<Option<Quantity>>,
    tilt: Vec<Option<Quantity>>,
}

/// Drapes a scene along its motion and differentiates where the ply has come to.
///
/// Args:
///     scene: The scene.
///     progress: As that of `simulate`.
///
/// Raises:
///     ValueError: If the drape has no steps, or the derivatives would take more memory than allowed.
///
/// Example:
///     >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
///     >>> outcome = plydrape.outcome(scene)
///     >>> outcome.overstretch.shape, outcome.overstretch_jacobian.shape
///     ((1,), (1, 2, 3))
#[pyfunction]
#[pyo3(signature = (
    scene, *, progress: "typing.Callable[[int, int, str], object] | None" = None
))]
pub fn outcome(
    py: Python<'_>,
    scene: &Bound<'_, Scene>,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Outcome> {
    let scene = Arc::clone(&scene.get().0);
    size::derivatives(&scene.ply).map_err(|fault| error::too_large(&fault))?;
    let (steps, grippers) = (scene.motion.positions.len(), scene.ply.grippers());
    let found = run(py, progress, move |watch| {
        let found = sensitivity::outcome(&scene, |done| watch.tell(done, steps, "draping"))?;
        let result = ResultFile::new(&scene, scene.input.clone(), found.drape.clone());
        Some((found, result))
    })?;
    let (found, result) = found.ok_or_else(|| PyValueError::new_err("the motion has no steps"))?;
    Ok(Outcome {
        result: Result(Arc::new(result)),
        grippers,
        overstretch: found.overstretch.into_iter().map(Some).collect(),
        force: found.force,
        shear: found.shear,
        tilt: found.tilt.into_iter().map(Some).collect(),
    })
}

fn values(quantities: &[Option<Quantity>]) -> Array<f64> {
    let value = |q: &Option<Quantity>| q.as_ref().map_or(f64::NAN, |q| q.value);
    Array::new(&[quantities.len()], quantities.iter().map(value).collect())
}

impl Outcome {
    fn gradients(&self, quantities: &[Option<Quantity>]) -> Array<f64> {
        let width = 3 * self.grippers;
        let mut values = Vec::with_capacity(quantities.len() * width);
        for quantity in quantities {
            match quantity {
                Some(quantity) => values.extend(quantity.gradient.dense(width)),
                None => values.resize(values.len() + width, f64::NAN),
            }
        }
        Array::new(&[quantities.len(), self.grippers, 3], values)
    }
}

#[pymethods]
impl Outcome {
    /// The drape.
    #[getter]
    fn result(&self) -> Result {
        self.result.clone()
    }

    /// Taut path of each catenary's tightest free segment beyond its fabric (m), negative where it is slack, shape
    /// (catenaries,): straight where it hangs, along the mold where it lies.
    #[getter]
    fn overstretch(&self) -> Array<f64> {
        values(&self.overstretch)
    }

    /// Its derivatives to the grippers' positions, shape (catenaries, grippers, 3).
    #[getter]
    fn overstretch_jacobian(&self) -> Array<f64> {
        self.gradients(&self.overstretch)
    }

    /// Horizontal force of each catenary (N), shape (catenaries,); nan where there is none.
    #[getter]
    fn forces(&self) -> Array<f64> {
        values(&self.force)
    }

    /// Its derivatives to the grippers' positions (N/m), shape (catenaries, grippers, 3).
    #[getter]
    fn forces_jacobian(&self) -> Array<f64> {
        self.gradients(&self.force)
    }

    /// Shear angle of each cell (rad), shape (cells,), those along u first; nan where it does not shear.
    #[getter]
    fn shear(&self) -> Array<f64> {
        values(&self.shear)
    }

    /// Its derivatives to the grippers' positions (rad/m), shape (cells, grippers, 3).
    #[getter]
    fn shear_jacobian(&self) -> Array<f64> {
        self.gradients(&self.shear)
    }

    /// Angle between the ply's normal at each gripper and the vertical (rad), shape (grippers,).
    #[getter]
    fn tilts(&self) -> Array<f64> {
        values(&self.tilt)
    }

    /// Its derivatives to the grippers' positions (rad/m), shape (grippers, grippers, 3); 0 at a level gripper.
    #[getter]
    fn tilts_jacobian(&self) -> Array<f64> {
        self.gradients(&self.tilt)
    }

    fn __repr__(&self) -> String {
        format!("<plydrape.Outcome of {} grippers>", self.grippers)
    }
}
