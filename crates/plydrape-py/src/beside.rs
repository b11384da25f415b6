//! `plydrape.Drape`: the ply over the steps by one of the models, read by arrays.

use crate::arrays::{Array, Named, or_nan};
use crate::json::Json;
use crate::model;
use plydrape::measure::Name;
use plydrape::outcome::{Gripper, Step, Summary, Unjudged};
use plydrape_io::ResultFile;
use pyo3::prelude::*;
use std::borrow::Cow;
use std::sync::Arc;

/// A drape by the model that does not decide, `Result.also`: grippers, loads and measures of every step, and no verdict.
///
/// Arrays are as those of `Result`.
///
/// Examples
/// --------
/// >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
/// >>> beside = plydrape.simulate(scene, also="catenaries").also
/// >>> beside
/// <plydrape.Drape by the catenaries, 30 steps>
/// >>> beside.loads.shape, "height_mm" in beside.measures
/// ((30, 8, 3), False)
#[pyclass(frozen, module = "plydrape")]
pub struct Drape {
    pub result: Arc<ResultFile>,
    /// Whether it is that of the model that does not decide, where there is one.
    pub beside: bool,
}

impl Drape {
    fn summarized(&self) -> &Summary {
        let also = self.result.also.as_ref().filter(|_| self.beside);
        also.map_or(&self.result.summary, |also| &also.summary)
    }

    fn steps(&self) -> &[Step] {
        let also = self.result.also.as_ref().filter(|_| self.beside);
        also.map_or(&self.result.steps, |also| &also.steps)
    }

    /// Some numbers of each gripper in each step.
    fn grippers<const N: usize>(&self, numbers: impl Fn(&Gripper) -> [f64; N]) -> Array<f64> {
        let shape = [self.steps().len(), self.result.scene.ply.grippers(), N];
        let axes = if N == 1 { 2 } else { 3 };
        let grippers = self.steps().iter().flat_map(|step| &step.grippers);
        Array::rows(&shape[..axes], grippers.map(numbers))
    }
}

#[pymethods]
impl Drape {
    /// The model that draped: "sheet" or "catenaries".
    #[getter]
    fn model(&self) -> &'static str {
        model::name(self.summarized().model)
    }

    /// First step in which the ply touches the mold; None if it does not.
    #[getter]
    fn first_contact_step(&self) -> Option<usize> {
        self.summarized().first_contact_step()
    }

    /// How the drape came out: the `summary` of `also` in result.json.
    #[getter]
    fn summary(&self) -> PyResult<Json> {
        match self.beside {
            true => Json::new(&Unjudged(Cow::Borrowed(self.summarized()))),
            false => Json::new(self.summarized()),
        }
    }

    /// Time of each step (s), shape (steps,).
    #[getter]
    pub fn times(&self) -> Array<f64> {
        let times: Vec<f64> = self.steps().iter().map(|step| step.time).collect();
        Array::new(&[times.len()], times)
    }

    /// Positions of the grippers (m), shape (steps, grippers, 3): where they hold the fabric.
    #[getter]
    pub fn positions(&self) -> Array<f64> {
        self.grippers(|gripper| gripper.position)
    }

    /// Where the robot holds the grippers (m), shape (steps, grippers, 3): their positions where their mounts are rigid.
    #[getter]
    pub fn commanded(&self) -> Array<f64> {
        self.grippers(|gripper| gripper.commanded)
    }

    /// Orientations of the grippers as quaternions x, y, z, w, shape (steps, grippers, 4): z along the ply's normal, x along
    /// u.
    #[getter]
    pub fn quaternions(&self) -> Array<f64> {
        self.grippers(|gripper| gripper.quaternion)
    }

    /// Angles between the ply's normal at the grippers and their stems, which are upright unless a tool turns them (°), shape
    /// (steps, grippers).
    #[getter]
    pub fn tilts_deg(&self) -> Array<f64> {
        self.grippers(|gripper| [gripper.tilt_deg])
    }

    /// Force of the ply on each gripper (N), shape (steps, grippers, 3).
    #[getter]
    pub fn loads(&self) -> Array<f64> {
        self.grippers(|gripper| gripper.force)
    }

    /// The worst value of every measure of the model in each step, by name, each of shape (steps,); nan where it has no meaning in
    /// a step. The unit is part of the name, ratios have none. A measure that the model does not evaluate is not there.
    #[getter]
    pub fn measures(&self) -> Named {
        let steps = self.steps();
        let values = |name: &Name| -> Vec<Option<f64>> {
            steps.iter().map(|step| step.measures.value(*name)).collect()
        };
        let measured = Name::ALL.iter().filter_map(|name| {
            let values = values(name);
            let known = values.iter().any(Option::is_some);
            let numbers = || values.iter().map(|value| or_nan(*value)).collect();
            known.then(|| (name.measure().key(), Array::new(&[steps.len()], numbers())))
        });
        Named(measured.collect())
    }

    fn __repr__(&self) -> String {
        format!("<plydrape.Drape by the {}, {} steps>", self.model(), self.steps().len())
    }
}
