//! `plydrape.Scene`.

use crate::arrays::{Array, Block, List, list, steps};
use crate::json::Json;
use crate::mold::Mold;
use crate::net::Net;
use crate::ply::Ply;
use crate::{error, table};
use plydrape::errors::{Draw, Errors};
use plydrape::scene::Motion;
use plydrape_io::scene::{self, SceneFile};
use plydrape_io::{shown, size};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;
use std::sync::Arc;
use toml::Value;
use toml::map::Map;

/// A checked scene: the ply, its grippers, the mold, and where all of it goes.
///
/// Every argument is a dict with the keys of the table of that name in a scene file; plain numbers are in SI
/// units, a str carries its unit. Arrays may stand for lists. `mold` may also be a `Mold`.
///
/// Args:
///     ply: What hangs between the grippers: `grippers`, `cell`, `material`, `warp`, `overhang`.
///     mold: What the ply is laid on.
///     grippers: Where the grippers start.
///     target: Where the ply shall end.
///     motion: How the grippers move.
///     model: Which model drapes and decides, and its rules.
///     sheet: How the ply is divided and followed as a sheet.
///     contact: How contact is found.
///     limits: What an accepted drape keeps to.
///     plan: How a motion is planned.
///     errors: How far a real cell may be from the scene.
///     release: When the pads let go of the ply.
///     title: Name for reports.
///     base: Folder of files that the tables name.
///
/// Raises:
///     SceneError: If the scene makes no sense; it names the place, the fault and a remedy.
///
/// Example:
///     >>> scene = plydrape.Scene(
///     ...     ply=dict(grippers=[4, 2], cell=[0.1, 0.1], material="krogh2018"),
///     ...     mold=dict(kind="plane"),
///     ...     grippers=dict(spacing=["98 mm", "98 mm"], height="75 mm"),
///     ...     target=dict(origin=[0, 0], direction="20 deg", shear="20 deg"),
///     ... )
///     >>> scene.positions.shape
///     (30, 8, 3)
#[pyclass(frozen, module = "plydrape")]
pub struct Scene(pub Arc<SceneFile>);

/// The tables of a scene, as keyword arguments.
type Table<'a, 'py> = Option<&'a Bound<'py, PyDict>>;

#[pymethods]
impl Scene {
    #[new]
    #[pyo3(signature = (
        *, ply: "dict[str, typing.Any]", mold: "dict[str, typing.Any] | Mold | None" = None,
        grippers: "dict[str, typing.Any] | None" = None, target: "dict[str, typing.Any] | None" = None,
        motion: "dict[str, typing.Any] | None" = None, model: "dict[str, typing.Any] | None" = None,
        sheet: "dict[str, typing.Any] | None" = None, contact: "dict[str, typing.Any] | None" = None,
        limits: "dict[str, typing.Any] | None" = None, plan: "dict[str, typing.Any] | None" = None,
        errors: "dict[str, typing.Any] | None" = None, release: "dict[str, typing.Any] | None" = None,
        title = None, base = PathBuf::new()
    ))]
    #[expect(clippy::too_many_arguments, reason = "the tables of a scene file")]
    fn new(
        py: Python<'_>,
        ply: &Bound<'_, PyDict>,
        mold: Option<&Bound<'_, PyAny>>,
        grippers: Table<'_, '_>,
        target: Table<'_, '_>,
        motion: Table<'_, '_>,
        model: Table<'_, '_>,
        sheet: Table<'_, '_>,
        contact: Table<'_, '_>,
        limits: Table<'_, '_>,
        plan: Table<'_, '_>,
        errors: Table<'_, '_>,
        release: Table<'_, '_>,
        title: Option<String>,
        base: PathBuf,
    ) -> PyResult<Self> {
        let mut keys = Map::new();
        if let Some(title) = title {
            keys.insert("title".into(), Value::String(title));
        }
        keys.insert("ply".into(), Value::Table(table::table(ply, "ply")?));
        let mut given = None;
        match mold {
            None => {}
            Some(mold) => match (mold.cast::<PyDict>(), mold.cast::<Mold>()) {
                (Ok(dict), _) => {
                    keys.insert("mold".into(), Value::Table(table::table(dict, "mold")?));
                }
                (_, Ok(mold)) => given = Some(mold.get().0.clone()),
                _ => {
                    return Err(PyTypeError::new_err("mold is neither a dict nor a plydrape.Mold"));
                }
            },
        }
        let others = [
            ("grippers", grippers),
            ("target", target),
            ("motion", motion),
            ("model", model),
            ("sheet", sheet),
            ("contact", contact),
            ("limits", limits),
            ("plan", plan),
            ("errors", errors),
            ("release", release),
        ];
        for (name, dict) in others {
            if let Some(dict) = dict {
                keys.insert(name.into(), Value::Table(table::table(dict, name)?));
            }
        }
        let text = text_of(&keys)?;
        let scene = py.detach(|| match given {
            None => scene::parse(&text, &base, "scene"),
            Some(mold) => scene::parse_on(mold, &text, &base, "scene"),
        });
        scene.map(Scene::from).map_err(|refused| error::scene(&refused))
    }

    /// Reads and checks a scene file; files it names are relative to its folder.
    ///
    /// Raises:
    ///     SceneError: If it cannot be read or makes no sense.
    ///
    /// Example:
    ///     >>> plydrape.Scene.read("examples/02_hanging_strip/scene.toml").ply.grippers
    ///     (2, 1)
    #[staticmethod]
    fn read(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let scene = py.detach(|| scene::read(&path));
        scene.map(Scene::from).map_err(|refused| error::scene(&refused))
    }

    /// Reads and checks a plybook: the name and the scene of each ply, in the order in which they are laid. The mold of a scene has
    /// the plies on it that the ply lies on.
    ///
    /// Raises:
    ///     SceneError: If it cannot be read or makes no sense.
    ///
    /// Example:
    ///     >>> plies = plydrape.Scene.read_book("examples/15_plybook/plies.toml")
    ///     >>> [(name, scene.mold.kind) for name, scene in plies][:2]
    ///     [('base 0', 'mesh'), ('turned 30', 'layered')]
    #[staticmethod]
    fn read_book(py: Python<'_>, path: PathBuf) -> PyResult<Vec<(String, Self)>> {
        let book = py.detach(|| scene::read_book(&path));
        let book = book.map_err(|refused| error::scene(&refused))?;
        Ok(book.plies.into_iter().map(|ply| (ply.name, Scene::from(ply.scene))).collect())
    }

    /// Reads and checks the text of a scene file.
    ///
    /// Args:
    ///     text: TOML, see the guide and docs/scene.schema.json.
    ///     base: Folder of the files that it names.
    ///     name: What it is called in errors.
    ///
    /// Raises:
    ///     SceneError: If it makes no sense.
    ///
    /// Example:
    ///     >>> plydrape.Scene.parse(plydrape.Scene.template()).mold.kind
    ///     'plane'
    #[staticmethod]
    #[pyo3(signature = (text, *, base = PathBuf::new(), name = "scene.toml"))]
    fn parse(py: Python<'_>, text: &str, base: PathBuf, name: &str) -> PyResult<Self> {
        let scene = py.detach(|| scene::parse(text, &base, name));
        scene.map(Scene::from).map_err(|refused| error::scene(&refused))
    }

    /// The text of a commented scene to start from, as `plydrape new` writes it.
    ///
    /// Example:
    ///     >>> plydrape.Scene.template().startswith("# A scene for plydrape")
    ///     True
    #[staticmethod]
    fn template() -> &'static str {
        scene::TEMPLATE
    }

    /// Its name for reports.
    #[getter]
    fn title(&self) -> &str {
        &self.0.title
    }

    /// The text of its file, or the one that its keyword arguments stand for; None if it was made otherwise.
    #[getter]
    fn text(&self) -> Option<&str> {
        self.0.input.as_deref()
    }

    /// What hangs between the grippers.
    #[getter]
    fn ply(&self) -> Ply {
        Ply(self.0.ply.clone())
    }

    /// What it is laid on, if anything.
    #[getter]
    fn mold(&self) -> Option<Mold> {
        self.0.mold.clone().map(Mold)
    }

    /// The ideal drape that its target is taken from, where there is one.
    #[getter]
    fn net(&self) -> Option<Net> {
        let drape = self.0.target.as_ref()?.drape.clone()?;
        Some(Net(drape))
    }

    /// Time of each step (s), shape (steps,).
    #[getter]
    fn times(&self) -> Array<f64> {
        let times = self.0.motion.times.clone();
        Array::new(&[times.len()], times)
    }

    /// Positions of the grippers in each step (m), shape (steps, grippers, 3), i running fastest.
    #[getter]
    fn positions(&self) -> Array<f64> {
        blocks(&self.0.motion.positions, self.0.ply.grippers())
    }

    /// Where the ideal drape puts the grippers (m), shape (grippers, 3), if the ply is to be draped.
    #[getter]
    fn target(&self) -> Option<Array<f64>> {
        let grippers = &self.0.target.as_ref()?.grippers;
        Some(Array::rows(&[grippers.len(), 3], grippers.iter().copied()))
    }

    /// The same scene along another motion. It has no `text`, as no scene file says it. Where a scene file is refused
    /// if its start stretches the ply, this one is draped: its overstretch says by how much.
    ///
    /// Args:
    ///     times: Time of each step (s), ascending, shape (steps,).
    ///     positions: Positions of the grippers (m), shape (steps, grippers, 3).
    ///     title: Name for reports, unless it stays.
    ///
    /// Raises:
    ///     ValueError: If the shapes do not fit, times do not ascend, a coordinate is not a number up to 10⁶ m, or
    ///         neighbours stand (all but) straight above each other, where the model has no solution.
    ///
    /// Example:
    ///     >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
    ///     >>> higher = scene.with_motion(scene.times, scene.positions + [0, 0, 0.01])
    ///     >>> float((higher.positions - scene.positions).max().round(9))
    ///     0.01
    #[pyo3(signature = (times, positions, *, title = None))]
    fn with_motion(
        &self,
        times: List<'_>,
        positions: Block<'_>,
        title: Option<String>,
    ) -> PyResult<Scene> {
        let times = list(&times, "times")?;
        let positions = steps(&positions, "positions", self.0.ply.grippers())?;
        let motion = Motion { times, positions };
        let fault = self.0.ply.check_motion(&motion);
        fault.map_err(|fault| PyValueError::new_err(fault.to_string()))?;
        size::drape(&self.0.ply, motion.times.len()).map_err(|fault| error::too_large(&fault))?;
        if let Some(found) = title.as_deref().and_then(shown::control) {
            return Err(PyValueError::new_err(format!(
                "title holds the control character {}: remove it, one line of plain text is wanted",
                found.escape_unicode()
            )));
        }
        let mut scene = (*self.0).clone();
        scene.input = None;
        scene.plan_refusal = None;
        if let Some(title) = title {
            scene.title = title;
        }
        scene.motion = motion;
        Ok(scene.into())
    }

    /// How far a real cell may be from the scene, where it says so: its `[errors]` in SI units, each term either
    /// `{"deviation": …}` or `{"bound": …}`.
    ///
    /// Example:
    ///     >>> tables = dict(ply=dict(grippers=[2, 1], cell=[0.1, 0.1], material="krogh2018"))
    ///     >>> tables |= dict(grippers=dict(spacing=["98 mm", "98 mm"], height="75 mm"))
    ///     >>> gripper = dict(position=dict(deviation="0.1 mm"))
    ///     >>> scene = plydrape.Scene(**tables, motion=dict(kind="hold"), errors=dict(gripper=gripper))
    ///     >>> scene.errors["gripper"]["position"]
    ///     {'deviation': 0.0001}
    #[getter]
    fn errors(&self) -> PyResult<Option<Json>> {
        self.0.errors.as_ref().map(Json::of).transpose()
    }

    /// The error of every quantity in one sample of the scene's `errors`, in SI units.
    ///
    /// It depends on the seed of the errors and the number of the sample only.
    ///
    /// Args:
    ///     sample: Its number, from 0.
    ///     factor: How many times as large all errors are.
    ///
    /// Raises:
    ///     ValueError: If the scene has no errors, or the factor is not finite.
    ///
    /// Example:
    ///     >>> tables = dict(ply=dict(grippers=[2, 1], cell=[0.1, 0.1], material="krogh2018"))
    ///     >>> tables |= dict(grippers=dict(spacing=["98 mm", "98 mm"], height="75 mm"))
    ///     >>> frame = dict(position=dict(bound="1 mm"))
    ///     >>> scene = plydrape.Scene(**tables, motion=dict(kind="hold"), errors=dict(frame=frame))
    ///     >>> all(abs(shift) <= 0.001 for shift in scene.draw(0)["frame"]["shift"])
    ///     True
    #[pyo3(signature = (sample, factor = 1.0))]
    fn draw(&self, sample: usize, factor: f64) -> PyResult<Json> {
        Json::of(&self.drawn(sample, factor)?)
    }

    /// The scene of one real cell: the same commands, with every error that `draw` gives for the sample.
    ///
    /// It has no `errors` of its own any more, and no `text`, as no scene file says it. Positions are those of the
    /// fabric points that the scene calls the grippers'.
    ///
    /// Args:
    ///     sample: Its number, from 0.
    ///     factor: How many times as large all errors are.
    ///
    /// Raises:
    ///     ValueError: If the scene has no errors, the factor is not finite, or neighbours would stand (all but)
    ///         straight above each other.
    ///
    /// Example:
    ///     >>> tables = dict(ply=dict(grippers=[2, 1], cell=[0.1, 0.1], material="krogh2018"))
    ///     >>> tables |= dict(grippers=dict(spacing=["98 mm", "98 mm"], height="75 mm"))
    ///     >>> frame = dict(position=dict(bound="1 mm"))
    ///     >>> scene = plydrape.Scene(**tables, motion=dict(kind="hold"), errors=dict(frame=frame))
    ///     >>> real = scene.with_errors(0)
    ///     >>> bool(abs(real.positions - scene.positions).max() <= 0.001), real.errors
    ///     (True, None)
    #[pyo3(signature = (sample, factor = 1.0))]
    fn with_errors(&self, py: Python<'_>, sample: usize, factor: f64) -> PyResult<Scene> {
        let draw = self.drawn(sample, factor)?;
        let real = py.detach(|| draw.apply(&self.0.scene));
        let fault = real.ply.check_motion(&real.motion);
        fault.map_err(|fault| PyValueError::new_err(fault.to_string()))?;
        let mut scene = (*self.0).clone();
        scene.scene = real;
        scene.input = None;
        scene.plan_refusal = None;
        Ok(scene.into())
    }

    fn __repr__(&self) -> String {
        let grid = self.0.ply.grid;
        let steps = self.0.motion.positions.len();
        format!(
            "<plydrape.Scene {:?}, {} × {} grippers, {steps} steps>",
            self.0.title, grid.nu, grid.nv
        )
    }
}

impl Scene {
    /// A sample of the errors, all of them larger by a factor.
    fn drawn(&self, sample: usize, factor: f64) -> PyResult<Draw> {
        let errors: Errors = self.0.errors.ok_or_else(|| {
            PyValueError::new_err(
                "the scene has no errors: give it `errors`, as in errors=dict(gripper=dict(position=dict(deviation=\"0.1 mm\")))",
            )
        })?;
        if !factor.is_finite() {
            return Err(PyValueError::new_err(format!(
                "factor is {factor}: a finite number is wanted"
            )));
        }
        Ok(errors.draw(sample, self.0.ply.grippers()).scaled(factor))
    }
}

impl From<SceneFile> for Scene {
    fn from(scene: SceneFile) -> Self {
        Scene(Arc::new(scene))
    }
}

/// Steps of points as one block, `(steps, points, 3)`.
pub fn blocks(steps: &[Vec<[f64; 3]>], count: usize) -> Array<f64> {
    Array::rows(&[steps.len(), count, 3], steps.iter().flatten().copied())
}

/// The text of tables.
pub fn text_of(keys: &Map<String, Value>) -> PyResult<String> {
    toml::to_string(keys).map_err(|fault| PyValueError::new_err(fault.to_string()))
}

/// Names of the materials that come with plydrape.
///
/// Example:
///     >>> plydrape.materials()
///     ['krogh2018', 'cao2008_plain', 'petrak2025_polyester_twill', 'petrak2025_polyester_plain', 'petrak2025_cotton_twill']
#[pyfunction]
pub fn materials() -> Vec<&'static str> {
    scene::shipped_materials().collect()
}
