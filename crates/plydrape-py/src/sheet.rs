//! `plydrape.Sheet`: the ply as a sheet over the steps, read by arrays.

use crate::arrays::Array;
use crate::error;
use crate::json::Json;
use crate::work::parallel;
use plydrape::layup::Model;
use plydrape::outcome::Status;
use plydrape_io::ResultFile;
use plydrape_io::result::sheet::{SheetState, SheetStates};
use pyo3::prelude::*;
use std::sync::{Arc, Mutex, PoisonError};

/// The whole ply as a sheet: its states over the steps that were kept. Measures and the verdict are those of its result.
///
/// Nodes lie where lines of the fabric cross; segments join two neighbors along a line, cells are between four nodes.
/// Arrays are in m, N, rad, s unless the name says otherwise. Each access reads the states of sheet.npz once, one at a time.
///
/// Examples
/// --------
/// >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
/// >>> sheet = plydrape.simulate(scene).sheet
/// >>> sheet.positions.shape, sheet.summary["first_contact_step"]
/// ((30, 341, 3), 22)
#[pyclass(frozen, module = "plydrape")]
pub struct Sheet {
    pub result: Arc<ResultFile>,
    states: Mutex<SheetStates>,
}

impl Sheet {
    /// The sheet of a result, if it was draped.
    pub fn from_result(result: &Arc<ResultFile>) -> PyResult<Option<Self>> {
        let Some(states) = &result.sheet_states else { return Ok(None) };
        let states = Mutex::new(states.open().map_err(|fault| error::read(&fault))?);
        Ok(Some(Sheet { result: Arc::clone(result), states }))
    }

    fn with<T: Send>(&self, py: Python<'_>, take: impl FnOnce(&mut SheetStates) -> T + Send) -> T {
        parallel(py, || take(&mut self.states.lock().unwrap_or_else(PoisonError::into_inner)))
    }

    /// Some numbers of each state, one state after the other.
    fn states<T: Send>(
        &self,
        py: Python<'_>,
        axes: impl FnOnce(&SheetStates) -> Vec<usize> + Send,
        take: impl Fn(&SheetState<'_>, &mut Vec<T>) + Send + Sync,
    ) -> PyResult<Array<T>> {
        let read = self.with(py, |states| {
            let shape = [vec![states.states()], axes(states)].concat();
            let mut values = Vec::with_capacity(shape.iter().product());
            for n in 0..states.states() {
                if let Some(state) = states.state(n)? {
                    take(&state, &mut values);
                }
            }
            Ok(Array::new(&shape, values))
        });
        read.map_err(|fault| error::read(&fault))
    }
}

/// Nodes of a sheet.
fn nodes(states: &SheetStates) -> usize {
    states.mesh().places.len()
}

#[pymethods]
impl Sheet {
    /// The steps that were kept, shape (states,): they count from 1, the start. The state after a release is of the last step too.
    #[getter]
    fn steps(&self, py: Python<'_>) -> PyResult<Array<i64>> {
        self.states(py, |_| vec![], |state, out| out.push(i64::from(state.step)))
    }

    /// Time of each state (s), shape (states,).
    #[getter]
    fn times(&self, py: Python<'_>) -> PyResult<Array<f64>> {
        self.states(py, |_| vec![], |state, out| out.push(state.time))
    }

    /// Fabric coordinates u, v of the nodes (m), shape (nodes, 2).
    #[getter]
    fn places(&self, py: Python<'_>) -> Array<f64> {
        self.with(py, |states| Array::rows(&[nodes(states), 2], states.mesh().places.to_vec()))
    }

    /// Fabric area that belongs to each node (m²), shape (nodes,).
    #[getter]
    fn areas(&self, py: Python<'_>) -> Array<f64> {
        self.with(py, |states| Array::new(&[nodes(states)], states.mesh().areas.to_vec()))
    }

    /// Nodes at both ends of each yarn segment, shape (segments, 2), those along u first.
    #[getter]
    fn segments(&self, py: Python<'_>) -> Array<u32> {
        self.with(py, |states| {
            let segments = states.mesh().segments.to_vec();
            Array::rows(&[segments.len(), 2], segments)
        })
    }

    /// Nodes at the corners of each cell, in order around it, shape (cells, 4).
    #[getter]
    fn cells(&self, py: Python<'_>) -> Array<u32> {
        self.with(py, |states| {
            let cells = states.mesh().cells.to_vec();
            Array::rows(&[cells.len(), 4], cells)
        })
    }

    /// Step in which each node came to the mold and stayed, shape (nodes,); 0 of one that did not.
    #[getter]
    fn landing_step(&self, py: Python<'_>) -> Array<i64> {
        self.with(py, |states| {
            let steps: Vec<i64> = states.landing_step().iter().map(|n| i64::from(*n)).collect();
            Array::new(&[steps.len()], steps)
        })
    }

    /// Positions of the nodes (m), shape (states, nodes, 3).
    #[getter]
    fn positions(&self, py: Python<'_>) -> PyResult<Array<f64>> {
        self.states(
            py,
            |states| vec![nodes(states), 3],
            |state, out| out.extend_from_slice(state.positions.as_flattened()),
        )
    }

    /// Height of the nodes over the mold (m), shape (states, nodes); nan where there is no mold, and in the last state at nodes that hang beside it.
    #[getter]
    fn heights(&self, py: Python<'_>) -> PyResult<Array<f64>> {
        self.states(
            py,
            |states| vec![nodes(states)],
            |state, out| out.extend_from_slice(&state.height),
        )
    }

    /// Whether each node is in contact with the mold, shape (states, nodes).
    #[getter]
    fn contact(&self, py: Python<'_>) -> PyResult<Array<bool>> {
        self.states(
            py,
            |states| vec![nodes(states)],
            |state, out| out.extend_from_slice(&state.contact),
        )
    }

    /// Shear angle of the cells (rad), shape (states, cells).
    #[getter]
    fn shear(&self, py: Python<'_>) -> PyResult<Array<f64>> {
        self.states(
            py,
            |states| vec![states.mesh().cells.len()],
            |state, out| out.extend_from_slice(&state.shear),
        )
    }

    /// Tension of the segments per width (N/m), shape (states, segments).
    #[getter]
    fn tension(&self, py: Python<'_>) -> PyResult<Array<f64>> {
        self.states(
            py,
            |states| vec![states.mesh().segments.len()],
            |state, out| out.extend_from_slice(&state.tension),
        )
    }

    /// Positions of the grippers' pads (m), shape (states, grippers, 3).
    #[getter]
    fn grippers(&self, py: Python<'_>) -> PyResult<Array<f64>> {
        self.states(
            py,
            |states| vec![states.mesh().grippers, 3],
            |state, out| out.extend_from_slice(state.grippers.as_flattened()),
        )
    }

    /// Force of the ply on each pad (N), shape (states, grippers, 3).
    #[getter]
    fn pad_forces(&self, py: Python<'_>) -> PyResult<Array<f64>> {
        self.states(
            py,
            |states| vec![states.mesh().grippers, 3],
            |state, out| out.extend_from_slice(state.pad_forces.as_flattened()),
        )
    }

    /// Orientations of the pads as quaternions x, y, z, w, shape (states, grippers, 4): z along the pad's normal, x along u.
    #[getter]
    fn pad_quaternions(&self, py: Python<'_>) -> PyResult<Array<f64>> {
        self.states(
            py,
            |states| vec![states.mesh().grippers, 4],
            |state, out| out.extend_from_slice(state.pad_rotation.as_flattened()),
        )
    }

    /// Whether each pad holds the ply, shape (states, grippers). Where pads let go, the last step has two states: one held, and one
    /// at rest after the release.
    #[getter]
    fn pad_holds(&self, py: Python<'_>) -> PyResult<Array<bool>> {
        self.states(
            py,
            |states| vec![states.mesh().grippers],
            |state, out| match &state.pad_holds {
                Some(holds) => out.extend_from_slice(holds),
                None => out.extend(state.grippers.iter().map(|_| true)),
            },
        )
    }

    /// What the sheet says beside its measures: `sheet` in its `summary` in result.json.
    #[getter]
    fn summary(&self) -> PyResult<Json> {
        let summary = self.result.summary_of(Model::Sheet);
        Json::new(&summary.and_then(|summary| summary.sheet.as_ref()))
    }

    /// Whether every step was solved and the ply is at rest at the end.
    #[getter]
    fn converged(&self) -> bool {
        let summary = self.result.summary_of(Model::Sheet);
        summary.is_some_and(|summary| summary.status == Status::Converged)
    }

    /// All states as one labeled data set. Needs xarray.
    ///
    /// The dimensions are `state`, `node`, `segment`, `cell`, `gripper` and `xyz`; every variable has its `units` and `long_name`.
    /// Names and units are those of the properties.
    ///
    /// Returns
    /// -------
    /// xarray.Dataset
    ///     The data set.
    ///
    /// Raises
    /// ------
    /// ExtraError
    ///     If xarray is not installed.
    ///
    /// Examples
    /// --------
    /// >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
    /// >>> data = plydrape.simulate(scene).sheet.to_xarray()
    /// >>> data["heights"].dims, data["heights"].attrs["units"]
    /// (('state', 'node'), 'm')
    #[pyo3(signature = () -> "xarray.Dataset")]
    fn to_xarray<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("plydrape._tables")?.getattr("sheet_dataset")?.call1((slf,))
    }

    /// The sheet of a step as a mesh of PyVista with its numbers. Needs PyVista.
    ///
    /// Parameters
    /// ----------
    /// step : int, default -1
    ///     Which step, from 1; −1 is the last that was kept.
    ///
    /// Returns
    /// -------
    /// pyvista.PolyData
    ///     Its cells, with numbers at nodes and in cells.
    ///
    /// Raises
    /// ------
    /// ExtraError
    ///     If PyVista is not installed.
    /// ValueError
    ///     If no state of such a step was kept.
    ///
    /// Examples
    /// --------
    /// >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
    /// >>> mesh = plydrape.simulate(scene).sheet.to_pyvista()
    /// >>> mesh.n_points, mesh.array_names
    /// (341, ['height_mm', 'contact', 'landing_step', 'shear_deg'])
    #[pyo3(signature = (step = -1) -> "pyvista.PolyData")]
    fn to_pyvista<'py>(slf: &Bound<'py, Self>, step: isize) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("plydrape._meshes")?.getattr("sheet_mesh")?.call1((slf, step))
    }

    fn __repr__(&self, py: Python<'_>) -> String {
        let (nodes, states) = self.with(py, |states| (nodes(states), states.states()));
        format!("<plydrape.Sheet of {nodes} nodes, {states} states>")
    }
}
