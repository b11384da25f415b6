//! `plydrape.outcome`: how a drape comes out, and how that changes with where its grippers end.

use crate::arrays::Array;
use crate::error;
use crate::model::for_models;
use crate::result::Result;
use crate::scene::SceneArgument;
use crate::work::run;
use plydrape::planner::sensitivity::{self, Quantity};
use plydrape_io::ResultFile;
use plydrape_io::result::sheet::keep;
use plydrape_io::store::size;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// The last step of a drape with its derivatives to where the grippers are in it.
///
/// Fabric in contact by then is held: the derivatives are those of the outcome to the grippers' targets as
/// long as a slightly different last step catches nothing more, and exact where the state is smooth.
///
/// Examples
/// --------
/// >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
/// >>> outcome = plydrape.outcome(scene)
/// >>> worst = outcome.overstretch.argmax()
/// >>> outcome.overstretch_jacobian[worst].shape
/// (8, 3)
#[pyclass(frozen, module = "plydrape")]
pub struct Outcome {
    pub result: Result,
    pub quantities: Quantities,
}

/// What is differentiated.
#[derive(Clone, Serialize, Deserialize)]
pub struct Quantities {
    grippers: usize,
    overstretch: Rows,
    force: Rows,
    shear: Rows,
    tilt: Rows,
}

/// Values with their derivatives to the positions of all grippers; nan where there is none.
#[derive(Clone, Serialize, Deserialize)]
struct Rows {
    #[serde(with = "crate::json::or_null")]
    values: Vec<f64>,
    #[serde(with = "crate::json::or_null")]
    gradients: Vec<f64>,
}

impl Rows {
    fn new(quantities: &[Option<Quantity>], grippers: usize) -> Self {
        let width = 3 * grippers;
        let value = |quantity: &Option<Quantity>| quantity.as_ref().map_or(f64::NAN, |q| q.value);
        let gradient = |quantity: &Option<Quantity>| match quantity {
            Some(quantity) => quantity.gradient.dense(width),
            None => vec![f64::NAN; width],
        };
        let values = quantities.iter().map(value).collect();
        Rows { values, gradients: quantities.iter().flat_map(gradient).collect() }
    }

    fn values(&self) -> Array<f64> {
        Array::new(&[self.values.len()], self.values.clone())
    }

    fn gradients(&self, grippers: usize) -> Array<f64> {
        Array::new(&[self.values.len(), grippers, 3], self.gradients.clone())
    }
}

/// Drapes a scene along its motion by catenaries, whatever its model is, and differentiates where the ply has come to.
///
/// Parameters
/// ----------
/// scene : Scene
///     The scene.
/// progress : callable, optional
///     As that of `simulate`.
///
/// Returns
/// -------
/// Outcome
///     The last step with its derivatives.
///
/// Raises
/// ------
/// SceneError
///     If catenaries cannot drape the scene.
/// ValueError
///     If the drape has no steps, or the derivatives would take more memory than allowed.
///
/// Examples
/// --------
/// >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
/// >>> outcome = plydrape.outcome(scene)
/// >>> outcome.overstretch.shape, outcome.overstretch_jacobian.shape
/// ((1,), (1, 2, 3))
#[pyfunction]
#[pyo3(signature = (
    scene, *, progress: "typing.Callable[[int, int, str], object] | None" = None
))]
pub fn outcome(
    py: Python<'_>,
    scene: SceneArgument<'_>,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Outcome> {
    let mut scene = (*for_models(scene.get(), Some("catenaries"), None)?).clone();
    scene.also = false;
    let layup = &scene.layup;
    size::derivatives(&layup.ply).map_err(|fault| error::value(&fault))?;
    let (steps, grippers) = (layup.motion.positions.len(), layup.ply.grippers());
    let found = run(py, progress, move |watch| {
        let found = sensitivity::outcome(&scene, |done| watch.tell(done, steps, "draping"))?;
        let drape = keep(found.drape.clone(), &std::env::temp_dir());
        Some(drape.map(|drape| (found, ResultFile::new(&scene, scene.input.clone(), drape))))
    })?;
    let found = found.ok_or_else(|| PyValueError::new_err("the motion has no steps"))?;
    let (found, result) = found.map_err(|fault| error::scene(&fault))?;
    let [overstretch, tilt] = [found.last_step.overstretch, found.last_step.tilt]
        .map(|all| all.into_iter().map(Some).collect::<Vec<_>>());
    let rows = |quantities: &[Option<Quantity>]| Rows::new(quantities, grippers);
    let quantities = Quantities {
        grippers,
        overstretch: rows(&overstretch),
        force: rows(&found.last_step.force),
        shear: rows(&found.last_step.shear),
        tilt: rows(&tilt),
    };
    Ok(Outcome { result: Result(Arc::new(result)), quantities })
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
        self.quantities.overstretch.values()
    }

    /// Derivatives to the grippers' positions, shape (catenaries, grippers, 3).
    #[getter]
    fn overstretch_jacobian(&self) -> Array<f64> {
        self.quantities.overstretch.gradients(self.quantities.grippers)
    }

    /// Horizontal force of each catenary (N), shape (catenaries,); nan where there is none.
    #[getter]
    fn forces(&self) -> Array<f64> {
        self.quantities.force.values()
    }

    /// Derivatives to the grippers' positions (N/m), shape (catenaries, grippers, 3).
    #[getter]
    fn forces_jacobian(&self) -> Array<f64> {
        self.quantities.force.gradients(self.quantities.grippers)
    }

    /// Shear angle of each cell (rad), shape (cells,), those along u first; nan where it does not shear.
    #[getter]
    fn shear(&self) -> Array<f64> {
        self.quantities.shear.values()
    }

    /// Derivatives to the grippers' positions (rad/m), shape (cells, grippers, 3).
    #[getter]
    fn shear_jacobian(&self) -> Array<f64> {
        self.quantities.shear.gradients(self.quantities.grippers)
    }

    /// Angle between the ply's normal at each gripper and the vertical (rad), shape (grippers,).
    #[getter]
    fn tilts(&self) -> Array<f64> {
        self.quantities.tilt.values()
    }

    /// Derivatives to the grippers' positions (rad/m), shape (grippers, grippers, 3); 0 at a level gripper.
    #[getter]
    fn tilts_jacobian(&self) -> Array<f64> {
        self.quantities.tilt.gradients(self.quantities.grippers)
    }

    fn __repr__(&self) -> String {
        format!("<plydrape.Outcome of {} grippers>", self.quantities.grippers)
    }
}
