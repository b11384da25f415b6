//! `plydrape.Result`: the result file, read by arrays.

use crate::arrays::{Array, Named, Numbers, or_nan};
use crate::beside::Drape;
use crate::error;
use crate::json::Json;
use crate::limits::Limits;
use crate::model;
use crate::mold::{Mold, triangles};
use crate::net::Net;
use crate::ply::Ply;
use crate::quantity::Amount;
use crate::sample::Sample;
use crate::sheet::Sheet;
use crate::surface::Surface;
use crate::work::parallel;
use plydrape::draping::record::{CatenaryState, CatenaryStep, Cell};
use plydrape::layup::Model;
use plydrape::outcome::{Status, Step};
use plydrape::ply::Grid;
use plydrape_io::replan::PlannedResult;
use plydrape_io::result::read;
use plydrape_io::robot::program::{LONGEST_TEMPLATE, Template, Tolerance};
use plydrape_io::scene::{Measured, parse_offset, usual};
use plydrape_io::store::{folder, input};
use plydrape_io::write::mold_patch::mold_patch;
use plydrape_io::write::surface;
use plydrape_io::{Error, ResultFile, export, page};
use pyo3::exceptions::{PyIndexError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::PathBuf;
use std::sync::Arc;

/// A drape: the grippers, loads and measures of every step, and the verdict, by the model that decides.
///
/// What is of one model alone is there wherever that has draped, whether it decides or was asked for beside by `also`: the states
/// of the `sheet`, and of the catenaries `forces`, `slack_mm`, `contact`, `shear_deg`, `lines`, `contact_lines` and `surface`.
/// Arrays are in m, N, s unless the name says otherwise. Grippers are counted with i running fastest, catenaries as in
/// `Ply`. Steps count from 1, the start; −1 is the last.
///
/// Examples
/// --------
/// >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
/// >>> result = plydrape.simulate(scene)
/// >>> result.model, result.positions.shape, result.first_contact_step
/// ('sheet', (30, 8, 3), 22)
#[pyclass(frozen, module = "plydrape")]
#[derive(Clone)]
pub struct Result(pub Arc<ResultFile>);

impl Result {
    /// The drape by the model that decides.
    fn drape(&self) -> Drape {
        Drape { result: Arc::clone(&self.0), beside: false }
    }

    /// The steps of the catenaries, whether they decide or not.
    fn hanging(&self) -> PyResult<&[Step]> {
        self.0.steps_of(Model::Catenaries).ok_or_else(|| {
            PyValueError::new_err(
                "the result has no catenaries, as the sheet alone has draped its scene: drape it with also=\"catenaries\"",
            )
        })
    }

    /// A number of each catenary in each step.
    fn catenaries(&self, number: impl Fn(&CatenaryState) -> f64) -> PyResult<Array<f64>> {
        let steps = self.hanging()?;
        let shape = [steps.len(), self.0.scene.ply.lines().catenaries()];
        let catenaries = steps.iter().filter_map(|step| step.catenaries.as_ref());
        let numbers = catenaries.flat_map(|step| &step.catenaries).map(number);
        Ok(Array::new(&shape, numbers.collect()))
    }
}

/// A step of some by its number, from 1; negative ones count from the end.
fn find(steps: &[Step], step: isize) -> PyResult<&Step> {
    let index = match step {
        1.. => step.unsigned_abs().checked_sub(1),
        0 => None,
        _ => steps.len().checked_sub(step.unsigned_abs()),
    };
    index.and_then(|n| steps.get(n)).ok_or_else(|| {
        PyIndexError::new_err(format!(
            "there is no step {step}; the result has steps 1 to {}, and -1 is the last",
            steps.len()
        ))
    })
}

#[pymethods]
impl Result {
    /// Reads a result.json.
    ///
    /// Parameters
    /// ----------
    /// path : str or path
    ///     The file.
    ///
    /// Returns
    /// -------
    /// Result
    ///     The result.
    ///
    /// Raises
    /// ------
    /// ResultError
    ///     If it cannot be read, or is not, to the last byte, what this version writes. Where there is no such file, it is a
    ///     FileNotFoundError too.
    ///
    /// Examples
    /// --------
    /// >>> import tempfile, pathlib
    /// >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
    /// >>> result = plydrape.simulate(scene)
    /// >>> with tempfile.TemporaryDirectory() as folder:
    /// ...     path = pathlib.Path(folder) / "result.json"
    /// ...     _ = path.write_text(result.to_json())
    /// ...     plydrape.Result.read(path).title == result.title
    /// True
    #[staticmethod]
    fn read(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let result = parallel(py, || read::read(&path));
        result.map(|result| Result(Arc::new(result))).map_err(|fault| error::read(&fault))
    }

    /// Reads the text of a result.json.
    ///
    /// Parameters
    /// ----------
    /// text : str
    ///     The text.
    ///
    /// Returns
    /// -------
    /// Result
    ///     The result.
    ///
    /// Raises
    /// ------
    /// ResultError
    ///     As `read`.
    ///
    /// Examples
    /// --------
    /// >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
    /// >>> result = plydrape.simulate(scene)
    /// >>> plydrape.Result.parse(result.to_json()).accepted
    /// True
    #[staticmethod]
    fn parse(py: Python<'_>, text: &str) -> PyResult<Self> {
        let result = parallel(py, || read::parse(text.as_bytes(), "result.json".as_ref()));
        result.map(|result| Result(Arc::new(result))).map_err(|fault| error::read(&fault))
    }

    /// Title of its scene.
    #[getter]
    fn title(&self) -> &str {
        &self.0.scene.title
    }

    /// Name and version of the program that made it.
    #[getter]
    fn program(&self) -> &str {
        &self.0.program
    }

    /// The text of its scene, where it had one.
    #[getter]
    fn scene_text(&self) -> Option<&str> {
        self.0.scene.input.as_deref()
    }

    /// Grippers along u and v; zeros where they are no whole array along the yarns.
    #[getter]
    fn grid(&self) -> (usize, usize) {
        (self.0.scene.ply.grid.nu, self.0.scene.ply.grid.nv)
    }

    /// The ply that was draped.
    #[getter]
    fn ply(&self) -> Ply {
        Ply(self.0.scene.ply.clone())
    }

    /// Fabric length of a cell along u and v (m).
    #[getter]
    fn cell(&self) -> (f64, f64) {
        self.0.scene.ply.cell.into()
    }

    /// Mold, if any.
    #[getter]
    fn mold(&self) -> Option<Mold> {
        self.0.scene.mold.clone().map(Mold)
    }

    /// The ideal drape, where it is known.
    #[getter]
    fn net(&self) -> Option<Net> {
        self.0.scene.target.as_ref().and_then(|target| target.drape.clone()).map(Net)
    }

    /// The model that decides: "sheet" or "catenaries".
    #[getter]
    fn model(&self) -> &'static str {
        model::name(self.0.model())
    }

    /// Whether every step was done and every limit holds, by the model that decides, and in enough cells of the sample, if there is
    /// one.
    #[getter]
    fn accepted(&self) -> bool {
        self.0.summary.accepted()
    }

    /// The verdict in words, with the world in which it was reached: "accepted", by a sample of cells with errors; "accepted without
    /// errors"; "accepted in an ideal cell, without errors", where mounts are rigid too; or "not accepted". Of catenaries it names what
    /// they do not see of the scene: fabric beyond the outer grippers, and holes of the mold between their lines.
    #[getter]
    fn verdict(&self) -> String {
        self.0.verdict()
    }

    /// Whether every step was solved and the ply is at rest at the end, by the model that decides.
    #[getter]
    fn converged(&self) -> bool {
        let solved = self.0.steps.iter().all(Step::is_solved);
        solved && self.0.summary.status == Status::Converged
    }

    /// First step in which the ply touches the mold, by the model that decides; None if it does not.
    #[getter]
    fn first_contact_step(&self) -> Option<usize> {
        self.0.summary.first_contact_step()
    }

    /// The drape by the model that does not decide, as it was asked for by `also`; None where it was not. It is shown and judges
    /// nothing.
    ///
    /// Examples
    /// --------
    /// >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
    /// >>> plydrape.simulate(scene).also is None
    /// True
    /// >>> beside = plydrape.simulate(scene, also="catenaries").also
    /// >>> beside.model, beside.first_contact_step
    /// ('catenaries', 26)
    #[getter]
    fn also(&self) -> Option<Drape> {
        let result = Arc::clone(&self.0);
        self.0.also.is_some().then_some(Drape { result, beside: true })
    }

    /// The states of the whole ply as a sheet, where it was draped as one; else None.
    ///
    /// Raises
    /// ------
    /// ResultError
    ///     If sheet.npz is not beside the result that was read, or was changed.
    ///
    /// Examples
    /// --------
    /// >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
    /// >>> plydrape.simulate(scene, model="catenaries").sheet is None
    /// True
    /// >>> plydrape.simulate(scene).sheet
    /// <plydrape.Sheet of 341 nodes, 30 states>
    #[getter]
    fn sheet(&self, py: Python<'_>) -> PyResult<Option<Sheet>> {
        parallel(py, || Sheet::from_result(&self.0))
    }

    /// The verdict over a sample of cells with the errors of the scene; None where the scene has none.
    ///
    /// Examples
    /// --------
    /// >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
    /// >>> plydrape.simulate(scene).sample is None
    /// True
    #[getter]
    fn sample(&self) -> Option<Sample> {
        self.0.summary.sample.clone().map(Sample)
    }

    /// What the motion tolerates: a dict with gripper_mm (standard deviation of each gripper's position along each axis),
    /// gripper_at_least (whether it is the largest that was tried), shear and mass (the least and the largest multiple of the ply's shear
    /// stiffness and mass; no shear where the model knows none) and tried (cells by which each error was tried). None where it was not
    /// asked for.
    #[getter]
    fn tolerance(&self) -> PyResult<Option<Json>> {
        self.0.summary.tolerance.as_ref().map(Json::new).transpose()
    }

    /// The outcome by the model that decides: the `summary` of result.json.
    #[getter]
    fn summary(&self) -> PyResult<Json> {
        Json::new(&self.0.summary)
    }

    /// When the pads grip, press and let go, in the order of time; empty where they hold the ply from first to last.
    ///
    /// Each event is a dict: its `time` in the motion (s), its `kind` ("grip", "press" or "release"), and its `grippers` as
    /// [i, j]. The last release comes later than the last step where pads dwell.
    #[getter]
    fn events(&self) -> PyResult<Vec<Json>> {
        self.0.events().iter().map(Json::new).collect()
    }

    /// Every limit, judged by the model that decides, by its name.
    ///
    /// Examples
    /// --------
    /// >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
    /// >>> tilt = plydrape.simulate(scene).limits["tilt"]
    /// >>> round(tilt.value, 1), tilt.limit, tilt.unit, tilt.step, tilt.kept
    /// (28.6, 40.0, '°', 9, True)
    #[getter]
    fn limits(&self) -> PyResult<Limits> {
        Limits::new(&self.0.summary.limits)
    }

    /// The whole result.json as dicts and lists.
    ///
    /// Returns
    /// -------
    /// dict
    ///     The keys of result.json.
    ///
    /// Examples
    /// --------
    /// >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
    /// >>> result = plydrape.simulate(scene)
    /// >>> sorted(result.to_dict())
    /// ['catenaries', 'checksum', 'format', 'plan', 'program', 'scene', 'steps', 'summary', 'version']
    fn to_dict(&self) -> PyResult<Json> {
        Json::new(&*self.0)
    }

    /// The text of result.json, with its check sum.
    ///
    /// Returns
    /// -------
    /// str
    ///     The text.
    ///
    /// Examples
    /// --------
    /// >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
    /// >>> result = plydrape.simulate(scene)
    /// >>> result.to_json()[:28]
    /// '{"format":"plydrape-result",'
    fn to_json(&self, py: Python<'_>) -> PyResult<String> {
        parallel(py, || ResultFile::text(&self.0)).map_err(|fault| error::output(&fault))
    }

    /// Time of each step (s), shape (steps,).
    #[getter]
    fn times(&self) -> Array<f64> {
        self.drape().times()
    }

    /// Positions of the grippers (m), shape (steps, grippers, 3): where they hold the fabric.
    #[getter]
    fn positions(&self) -> Array<f64> {
        self.drape().positions()
    }

    /// Where the robot holds the grippers (m), shape (steps, grippers, 3): their positions where their mounts are rigid.
    #[getter]
    fn commanded(&self) -> Array<f64> {
        self.drape().commanded()
    }

    /// Orientations of the grippers as quaternions x, y, z, w, shape (steps, grippers, 4): z along the ply's normal, x along
    /// u.
    #[getter]
    fn quaternions(&self) -> Array<f64> {
        self.drape().quaternions()
    }

    /// Angles between the ply's normal at the grippers and their stems, which are upright unless a tool turns them (°), shape
    /// (steps, grippers).
    #[getter]
    fn tilts_deg(&self) -> Array<f64> {
        self.drape().tilts_deg()
    }

    /// Force of the ply on each gripper (N), shape (steps, grippers, 3).
    #[getter]
    fn loads(&self) -> Array<f64> {
        self.drape().loads()
    }

    /// The worst value of every measure of the model in each step, by name, each of shape (steps,); nan where it has no meaning in
    /// a step. The unit is part of the name, ratios have none. A measure that the model does not evaluate is not there.
    #[getter]
    fn measures(&self) -> Named {
        self.drape().measures()
    }

    /// Horizontal force of each catenary (N), shape (steps, catenaries): of its free segment that pulls or pushes most; of
    /// a stretched diagonal its shear force. nan where the model gives none.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If no catenaries were draped, as the sheet decides and `also` did not ask for them.
    #[getter]
    fn forces(&self) -> PyResult<Array<f64>> {
        self.catenaries(|c| {
            let forces = c.spans.iter().filter_map(|span| span.force);
            let most = forces.max_by(|a, b| a.abs().total_cmp(&b.abs()));
            or_nan(most.or(c.shear_force_n))
        })
    }

    /// Slack of each catenary (mm), shape (steps, catenaries): all of its free segments.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     As `forces`.
    #[getter]
    fn slack_mm(&self) -> PyResult<Array<f64>> {
        self.catenaries(|c| c.spans.iter().map(|span| span.slack_mm(c.length)).sum())
    }

    /// Fabric length of each catenary that is in contact (m), shape (steps, catenaries).
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     As `forces`.
    #[getter]
    fn contact(&self) -> PyResult<Array<f64>> {
        self.catenaries(|c| c.contact.as_ref().map_or(0.0, |contact| contact.length()))
    }

    /// Shear angle of each cell between catenaries (°), shape (steps, cells along v, cells along u), or (steps, cells) where the
    /// cups are no whole array along the yarns; 0 where no bias line shears.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     As `forces`.
    #[getter]
    fn shear_deg(&self) -> PyResult<Array<f64>> {
        let (steps, lines) = (self.hanging()?, self.0.scene.ply.lines());
        let shape = match lines.whole_array() {
            Some(Grid { nu, nv }) => vec![nv.saturating_sub(1), nu.saturating_sub(1)],
            None => vec![lines.cells().len()],
        };
        let shape = [vec![steps.len()], shape].concat();
        let hanging = steps.iter().filter_map(|step| step.catenaries.as_ref());
        let cells = hanging.flat_map(|step: &CatenaryStep| &step.cells);
        Ok(Array::new(&shape, cells.map(|cell: &Cell| cell.shear_deg).collect()))
    }

    /// Each catenary of a step as a line from gripper to gripper (m), arrays of shape (n, 3).
    ///
    /// Parameters
    /// ----------
    /// step : int
    ///     The step, from 1; −1 is the last.
    ///
    /// Returns
    /// -------
    /// list of ndarray
    ///     An array of points (m), shape (n, 3), for each catenary.
    ///
    /// Raises
    /// ------
    /// IndexError
    ///     If there is no such step.
    /// ValueError
    ///     As `forces`.
    ///
    /// Examples
    /// --------
    /// >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
    /// >>> result = plydrape.simulate(scene, model="catenaries")
    /// >>> len(result.lines(-1)), result.lines(-1)[0].shape[1]
    /// (16, 3)
    fn lines(&self, step: isize) -> PyResult<Vec<Array<f64>>> {
        let (graph, step) = (self.0.scene.ply.lines(), find(self.hanging()?, step)?);
        let curves = self.0.curves(step);
        let line = |(n, (c, curves)): (usize, (&CatenaryState, &Vec<_>))| {
            let ends = graph.ends(n).map(|gripper| step.grippers[gripper].position);
            let points = surface::shape(c, curves, ends);
            Array::rows(&[points.len(), 3], points)
        };
        let catenaries = step.catenaries.iter().flat_map(|step| &step.catenaries);
        Ok(catenaries.zip(&curves).enumerate().map(line).collect())
    }

    /// The lines in which the ply touches the mold in a step (m), one for each catenary that does, arrays of
    /// shape (n, 3).
    ///
    /// Parameters
    /// ----------
    /// step : int
    ///     The step, from 1; −1 is the last.
    ///
    /// Returns
    /// -------
    /// list of ndarray
    ///     An array of points (m), shape (n, 3), for each catenary that touches.
    ///
    /// Raises
    /// ------
    /// IndexError
    ///     If there is no such step.
    /// ValueError
    ///     As `forces`.
    ///
    /// Examples
    /// --------
    /// >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
    /// >>> result = plydrape.simulate(scene, model="catenaries")
    /// >>> len(result.contact_lines(1)), len(result.contact_lines(26))
    /// (0, 3)
    fn contact_lines(&self, step: isize) -> PyResult<Vec<Array<f64>>> {
        let step = find(self.hanging()?, step)?;
        let lines = surface::contact_lines(step, &self.0.curves(step), usize::MAX);
        Ok(lines.into_iter().map(|line| Array::rows(&[line.len(), 3], line)).collect())
    }

    /// The ply between the catenaries of a step as a surface with this many intervals along each side of a cell.
    ///
    /// Parameters
    /// ----------
    /// step : int
    ///     The step, from 1; −1 is the last.
    /// intervals : int, default 8
    ///     Intervals along each side of a cell, 1 to 1000.
    ///
    /// Returns
    /// -------
    /// Surface
    ///     The surface.
    ///
    /// Raises
    /// ------
    /// IndexError
    ///     If there is no such step.
    /// ValueError
    ///     As `forces`, or if there are too many intervals.
    ///
    /// Examples
    /// --------
    /// >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
    /// >>> result = plydrape.simulate(scene, model="catenaries")
    /// >>> surface = result.surface(1, intervals=4)
    /// >>> surface.size, surface.points.shape, surface.triangles.shape
    /// ((13, 5), (65, 3), (96, 3))
    #[pyo3(signature = (step, *, intervals = 8))]
    fn surface(&self, py: Python<'_>, step: isize, intervals: usize) -> PyResult<Surface> {
        if !(1..=1000).contains(&intervals) {
            let text = format!("intervals is {intervals}; 1 to 1000 are possible");
            return Err(PyValueError::new_err(text));
        }
        let step = find(self.hanging()?, step)?;
        Ok(Surface(parallel(py, || surface::Surface::new(&self.0, step, intervals))))
    }

    /// The mold under all steps and the target in about `most` triangles: points (m), shape (n, 3), and corners,
    /// shape (m, 3). None without a mold there.
    ///
    /// Parameters
    /// ----------
    /// most : int, default 20000
    ///     About how many triangles at most; a mold that is no mesh is sampled in a million at most.
    ///
    /// Returns
    /// -------
    /// tuple[ndarray, ndarray] or None
    ///     Points (m), shape (n, 3), and the indices of each triangle's corners, shape (m, 3).
    ///
    /// Examples
    /// --------
    /// >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
    /// >>> result = plydrape.simulate(scene)
    /// >>> points, triangles = result.mold_surface(most=100)
    /// >>> points.shape[1], len(triangles) <= 100
    /// (3, True)
    #[pyo3(signature = (*, most = 20_000))]
    fn mold_surface(&self, py: Python<'_>, most: usize) -> Option<(Array<f64>, Array<u32>)> {
        parallel(py, || mold_patch(&self.0, most)).map(triangles)
    }

    /// The result of this plan for a ply that does not lie where it was planned to be picked up.
    ///
    /// The grippers start where the ply lies, the offset is taken out in the air, and the landing is the planned one. What the motion
    /// changes is judged again, and the motion is slower where it would be too fast.
    ///
    /// Parameters
    /// ----------
    /// offset : dict, optional
    ///     The shift x and y (m, or texts with a unit), the yaw (rad, or a text), and the point (x, y) that the ply is turned
    ///     about, the middle of the grippers at the start unless given.
    /// points : array or sequence of Any, optional
    ///     Instead of it, pairs of where points were planned and where they were seen, two or more, each (x, y) in m: an array of the
    ///     shape (n, 2, 2), or a list of pairs, whose places may be texts with units.
    /// tolerance : float or str, optional
    ///     How far a point may be from where the others put it (m); as far as points of the ply may land from their places unless
    ///     given.
    /// far : bool
    ///     Whether the ply does lie more than 50 mm or 10° from where it was planned, which is refused otherwise.
    ///
    /// Returns
    /// -------
    /// Result
    ///     The result along the motion that was changed.
    ///
    /// Raises
    /// ------
    /// SceneError
    ///     If offset or points cannot be read.
    /// PlanError
    ///     If the result was not planned, or the offset cannot be taken out before the ply meets the mold.
    ///
    /// Examples
    /// --------
    /// >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
    /// >>> plan = plydrape.plan(scene, without_errors=True)
    /// >>> moved = plan.result.replan(offset=dict(x="3 mm", y="-1.5 mm", yaw="0.8 deg"))
    /// >>> moved.accepted, bool((moved.positions[-1] == plan.result.positions[-1]).all())
    /// (True, True)
    #[pyo3(signature = (
        *, offset: "dict[str, float | str | typing.Sequence[float | str]] | None" = None,
        points: "numpy.typing.ArrayLike | typing.Sequence[tuple[typing.Sequence[float | str], typing.Sequence[float | str]]] | None" = None,
        tolerance: "float | str | None" = None, far = false
    ))]
    fn replan(
        &self,
        py: Python<'_>,
        offset: Option<BTreeMap<String, Offset>>,
        points: Option<Points>,
        tolerance: Option<Amount>,
        far: bool,
    ) -> PyResult<Self> {
        let text = Offset::file(offset, points.map(Points::pairs).transpose()?);
        let landed = &usual::Landed::USUAL;
        let tolerance = Amount::given(tolerance, "tolerance", Measured::Length, landed)?;
        let result = parallel(py, || {
            let fault = |error: Error| error::plan(&error::text(&error));
            let planned = PlannedResult::new((*self.0).clone()).map_err(fault)?;
            let tolerance = tolerance.unwrap_or_else(|| planned.tolerance());
            let seen =
                parse_offset(&text, "offset", tolerance).map_err(|fault| error::scene(&fault))?;
            let replanner = planned.replanner().map_err(fault)?;
            let replanned = planned.replan(&replanner, &seen.also_far(far)).map_err(fault)?;
            planned.corrected(replanned, &std::env::temp_dir()).map_err(fault)
        });
        result.map(|result| Result(Arc::new(result)))
    }

    /// Writes result.json, steps.csv, trajectory.csv, report.html, of a plan motion.csv, and of a sheet
    /// sheet.npz, into a folder, all or none, and returns their paths.
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
    /// >>> import tempfile, pathlib
    /// >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
    /// >>> result = plydrape.simulate(scene)
    /// >>> with tempfile.TemporaryDirectory() as folder:
    /// ...     sorted(path.name for path in result.write(folder))
    /// ['report.html', 'result.json', 'steps.csv', 'trajectory.csv']
    fn write(&self, py: Python<'_>, folder: PathBuf) -> PyResult<Vec<PathBuf>> {
        parallel(py, || plydrape_io::write_all(&self.0, &folder))
            .map_err(|fault| error::output(&fault))
    }

    /// Writes files for another program or a machine into a folder, all or none, and returns their paths.
    ///
    /// Parameters
    /// ----------
    /// to : {"vtk", "inp", "ngsolve", "ros2", "rapid", "krl", "urscript", "csv", "pattern", "boundary"}
    ///     One of "vtk", "inp", "ngsolve", "ros2", "rapid", "krl", "urscript", "csv", "pattern" or "boundary"; "abb", "kuka" and "ur"
    ///     mean "rapid", "krl" and "urscript".
    /// folder : str or path
    ///     Where they go; other files there stay.
    /// even_if_rejected : bool, default False
    ///     Write what drives a machine ("ros2", "rapid", "krl", "urscript" and "csv") although the
    ///     result is not accepted; the files say so in their heads.
    /// position_error : float or str, optional
    ///     How far what a robot passes between its points may be from the motion (m); 0.1 mm unless given.
    /// least_way, least_time : float or str, optional
    ///     Least way (m) and time (s) between two points of a robot, whatever error that leaves; 1 mm and 0.1 s
    ///     unless given.
    /// large : bool, default False
    ///     Write what drives a machine also of a motion of more than ten minutes, or with samples of more than 50 MB.
    /// tf : bool, default False
    ///     Write the frames over time (``/tf``) into the bag of "ros2".
    /// mesh : float or str, optional
    ///     Largest side of the quads of "ngsolve" (m); a quarter of the distance of neighboring
    ///     grippers unless given.
    /// tension : float or str, optional
    ///     Tension stiffness per width of "inp" and "ngsolve" (N/m); 2e4 N/m unless given.
    /// templates : sequence of str or path, optional
    ///     Files of templates in place of the shipped ones, for "rapid", "krl" and "urscript".
    ///
    /// Returns
    /// -------
    /// list of Path
    ///     The paths of the files.
    ///
    /// Raises
    /// ------
    /// OutputError
    ///     If that cannot be done.
    /// ValueError
    ///     If there is no such format.
    ///
    /// Examples
    /// --------
    /// >>> import tempfile, pathlib
    /// >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
    /// >>> result = plydrape.simulate(scene)
    /// >>> with tempfile.TemporaryDirectory() as folder:
    /// ...     sorted(path.name for path in result.export("csv", folder))
    /// ['motion_wide.csv', 'steps.csv', 'trajectory.csv']
    #[pyo3(signature = (
        to: "typing.Literal['vtk', 'inp', 'ngsolve', 'ros2', 'rapid', 'krl', 'urscript', 'abb', 'kuka', 'ur', 'csv', 'pattern', 'boundary']",
        folder, *, even_if_rejected = false, position_error: "float | str | None" = None,
        least_way: "float | str | None" = None, least_time: "float | str | None" = None,
        large = false, tf = false,
        mesh: "float | str | None" = None, tension: "float | str | None" = None,
        templates: "typing.Sequence[str | PathLike[str]]" = Vec::new()
    ))]
    #[expect(clippy::too_many_arguments, reason = "they are keywords in Python")]
    fn export(
        &self,
        py: Python<'_>,
        to: &str,
        folder: PathBuf,
        even_if_rejected: bool,
        position_error: Option<Amount>,
        least_way: Option<Amount>,
        least_time: Option<Amount>,
        large: bool,
        tf: bool,
        mesh: Option<Amount>,
        tension: Option<Amount>,
        templates: Vec<PathBuf>,
    ) -> PyResult<Vec<PathBuf>> {
        let format = export::Format::named(to).ok_or_else(|| {
            PyValueError::new_err(format!(
                "there is no export to {to:?}: vtk, inp, ngsolve, ros2, rapid, krl, urscript, csv, pattern and boundary are possible"
            ))
        })?;

        // numbers are in SI units, texts have their unit
        let mut tolerance = Tolerance::default();
        let length = (Measured::Length, &usual::PositionError::USUAL);
        for (name, given, (measured, usual), to) in [
            ("position_error", position_error, length, &mut tolerance.position),
            ("least_way", least_way, length, &mut tolerance.least_way),
            ("least_time", least_time, (Measured::Time, &usual::ANY), &mut tolerance.least_time),
        ] {
            *to = Amount::given(given, name, measured, usual)?.unwrap_or(*to);
        }
        let mesh = Amount::given(mesh, "mesh", Measured::Length, &usual::Mesh::USUAL)?;
        let per_length = Measured::ForcePerLength;
        let tension = Amount::given(tension, "tension", per_length, &usual::Tension::USUAL)?;

        // templates are read before anything is written
        let read = |path: &PathBuf| -> PyResult<Template> {
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            let text =
                input::text(path, LONGEST_TEMPLATE).map_err(|fault| error::unread(path, &fault))?;
            Ok(Template { name, text })
        };

        let options = export::Options {
            even_if_rejected,
            tolerance,
            large,
            tf,
            mesh,
            tension,
            templates: templates.iter().map(read).collect::<PyResult<_>>()?,
        };
        parallel(py, || export::write(&self.0, format, &options, &folder))
            .map_err(|fault| error::output(&fault))
    }

    /// The page of `plydrape report`: one HTML file for any browser.
    ///
    /// Returns
    /// -------
    /// str
    ///     The text of the page.
    ///
    /// Examples
    /// --------
    /// >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
    /// >>> result = plydrape.simulate(scene)
    /// >>> result.html()[:15]
    /// '<!doctype html>'
    fn html(&self, py: Python<'_>) -> PyResult<String> {
        parallel(py, || page::html(&self.0)).map_err(|fault| error::output(&fault))
    }

    /// Writes the page into a file and returns its path.
    ///
    /// Parameters
    /// ----------
    /// path : str or path
    ///     The file.
    ///
    /// Returns
    /// -------
    /// Path
    ///     The same path.
    ///
    /// Raises
    /// ------
    /// OutputError
    ///     If that cannot be done; a file that plydrape did not write is never overwritten.
    ///
    /// Examples
    /// --------
    /// >>> import tempfile, pathlib
    /// >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
    /// >>> result = plydrape.simulate(scene)
    /// >>> with tempfile.TemporaryDirectory() as folder:
    /// ...     result.report(pathlib.Path(folder) / "page.html").name
    /// 'page.html'
    fn report(&self, py: Python<'_>, path: PathBuf) -> PyResult<PathBuf> {
        let Some(name) = path.file_name().and_then(|name| name.to_str()) else {
            return Err(PyValueError::new_err(format!("{} names no file", path.display())));
        };
        let text = self.html(py)?;
        let place = path.parent().filter(|dir| !dir.as_os_str().is_empty());
        let place = place.map_or_else(|| PathBuf::from("."), PathBuf::from);
        folder::add(&place, "report", &[(name, text.as_bytes())], &self.0.files)
            .map_err(|fault| error::output(&fault))?;
        Ok(path)
    }

    /// A figure for a paper, by Matplotlib: see `plydrape.plot`. Needs Matplotlib.
    ///
    /// Parameters
    /// ----------
    /// kind : {"steps", "measures", "shear", "sheet"}, default "steps"
    ///     "steps", "measures", "shear" or "sheet".
    /// **options
    ///     Those of `steps`, `measures`, `shear_map` or `sheet` in `plydrape.plot`.
    ///
    /// Returns
    /// -------
    /// matplotlib.figure.Figure
    ///     The figure.
    ///
    /// Examples
    /// --------
    /// >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
    /// >>> result = plydrape.simulate(scene)
    /// >>> figure = result.plot("measures")
    #[pyo3(signature = (
        kind: "typing.Literal['steps', 'measures', 'shear', 'sheet']" = "steps", **options: "typing.Any"
    ) -> "matplotlib.figure.Figure")]
    fn plot<'py>(
        slf: &Bound<'py, Self>,
        kind: &str,
        options: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("plydrape.plot")?.getattr("plot")?.call((slf, kind), options)
    }

    /// The page of the result inside a notebook.
    ///
    /// Parameters
    /// ----------
    /// height : int, default 640
    ///     Height of the frame (pixels).
    ///
    /// Returns
    /// -------
    /// Page
    ///     The page; a notebook shows it as the last value of a cell.
    ///
    /// Examples
    /// --------
    /// >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
    /// >>> result = plydrape.simulate(scene)
    /// >>> page = result.show(height=400)
    #[pyo3(signature = (*, height = 640) -> "plydrape.notebook.Page")]
    fn show<'py>(slf: &Bound<'py, Self>, height: usize) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("plydrape.notebook")?.getattr("show")?.call1((slf, height))
    }

    /// A tidy table of numbers: one row for each thing in each step. Needs pandas.
    ///
    /// Column names end in the unit where it is not SI, as the names of the properties do.
    ///
    /// Parameters
    /// ----------
    /// table : {"measures", "grippers", "catenaries", "limits"}, default "measures"
    ///     "measures", one row a step; "grippers", one row a step and gripper; "limits", one row a limit, all of the model that
    ///     decides; "catenaries", one row a step and catenary, where catenaries were draped.
    ///
    /// Returns
    /// -------
    /// pandas.DataFrame
    ///     The table, with a plain index.
    ///
    /// Raises
    /// ------
    /// ExtraError
    ///     If pandas is not installed.
    /// ValueError
    ///     If there is no such table, or no catenaries were draped for theirs.
    ///
    /// Examples
    /// --------
    /// >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
    /// >>> frame = plydrape.simulate(scene).to_pandas("grippers")
    /// >>> list(frame.columns[:5])
    /// ['step', 'time', 'gripper', 'i', 'j']
    #[pyo3(signature = (
        table: "typing.Literal['measures', 'grippers', 'catenaries', 'limits']" = "measures"
    ) -> "pandas.DataFrame")]
    fn to_pandas<'py>(slf: &Bound<'py, Self>, table: &str) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("plydrape._tables")?.getattr("result_frame")?.call1((slf, table))
    }

    /// Everything over the steps as one labeled data set. Needs xarray.
    ///
    /// The dimensions are `step`, `u` and `v` of the grippers (or `gripper` where they are no whole array) and `xyz`, and where
    /// catenaries were draped `catenary`, `cell_u` and `cell_v`; every variable has its `units` and `long_name`. Names and units are
    /// those of the properties.
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
    /// >>> data = plydrape.simulate(scene).to_xarray()
    /// >>> data["positions"].dims, data["positions"].attrs["units"]
    /// (('step', 'u', 'v', 'xyz'), 'm')
    #[pyo3(signature = () -> "xarray.Dataset")]
    fn to_xarray<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("plydrape._tables")?.getattr("result_dataset")?.call1((slf,))
    }

    /// A step as meshes of PyVista with their numbers, in m. Needs PyVista.
    ///
    /// Parameters
    /// ----------
    /// step : int, default -1
    ///     Which step; −1 is the last.
    ///
    /// Returns
    /// -------
    /// pyvista.MultiBlock
    ///     The blocks "mold" and "grippers", "ply" and "catenaries" where catenaries were draped, "sheet" where the sheet was, as far
    ///     as there are such.
    ///
    /// Raises
    /// ------
    /// ExtraError
    ///     If PyVista is not installed.
    /// ValueError
    ///     If there is no such step.
    ///
    /// Examples
    /// --------
    /// >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
    /// >>> blocks = plydrape.simulate(scene).to_pyvista()
    /// >>> blocks.keys()
    /// ['mold', 'grippers', 'sheet']
    /// >>> blocks["sheet"].array_names
    /// ['height_mm', 'contact', 'landing_step', 'shear_deg']
    #[pyo3(signature = (step = -1) -> "pyvista.MultiBlock")]
    fn to_pyvista<'py>(slf: &Bound<'py, Self>, step: isize) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("plydrape._meshes")?.getattr("meshes")?.call1((slf, step))
    }

    fn __repr__(&self) -> String {
        let verdict = self.0.verdict();
        format!("<plydrape.Result of {:?}, {} steps, {verdict}>", self.title(), self.0.steps.len())
    }
}

/// A value of an offset.
#[derive(FromPyObject)]
pub enum Offset {
    /// A shift or an angle.
    Amount(Amount),
    /// A place.
    Place([Amount; 2]),
}

/// Pairs of places: where points were planned, and where they were seen.
#[derive(FromPyObject)]
pub enum Points<'py> {
    /// Each by itself, as numbers or texts.
    Pairs(Vec<Pair>),
    /// As an array.
    Array(Numbers<'py>),
}

/// Where a point was planned and where it was seen.
type Pair = ([Amount; 2], [Amount; 2]);

impl Points<'_> {
    fn pairs(self) -> PyResult<Vec<Pair>> {
        let array = match self {
            Points::Pairs(pairs) => return Ok(pairs),
            Points::Array(array) => array,
        };
        let (shape, places) = array.points::<2>("points")?;
        match shape[..] {
            [_, 2] => {
                let place = |place: &[f64; 2]| place.map(Amount::Number);
                let pairs = places.chunks_exact(2).map(|pair| (place(&pair[0]), place(&pair[1])));
                Ok(pairs.collect())
            }
            _ => Err(PyValueError::new_err(
                "expected points of the shape (n, 2, 2): where each was planned, and where it was seen",
            )),
        }
    }
}

impl Offset {
    /// The text of an offset's file with these values.
    fn file(offset: Option<BTreeMap<String, Offset>>, points: Option<Vec<Pair>>) -> String {
        let place = |[x, y]: &[Amount; 2]| format!("[{}, {}]", x.toml(), y.toml());
        let mut text = String::new();
        if let Some(offset) = offset {
            text += "[offset]\n";
            for (key, value) in offset {
                let value = match value {
                    Offset::Amount(value) => value.toml(),
                    Offset::Place(value) => place(&value),
                };
                let _ = writeln!(text, "{} = {value}", Amount::Text(key).toml());
            }
        }
        for (planned, seen) in points.into_iter().flatten() {
            let (planned, seen) = (place(&planned), place(&seen));
            let _ = writeln!(text, "[[point]]\nplanned = {planned}\nseen = {seen}");
        }
        text
    }
}
