//! `plydrape.Scene`.

use crate::arrays::{Array, Numbers};
use crate::json::Json;
use crate::mold::Mold;
use crate::net::Net;
use crate::ply::Ply;
use crate::work::parallel;
use crate::{error, table};
use plydrape::errors::{Draw, Errors};
use plydrape::measure::Name;
use plydrape::motion::Motion;
use plydrape_io::scene::{self, SceneFile, slow_in_seconds};
use plydrape_io::store::{shown, size};
use pyo3::exceptions::{PyTypeError, PyUserWarning, PyValueError};
use pyo3::inspect::PyStaticExpr;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde::{Deserialize, Serialize};
use std::ffi::CString;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use toml::Value;
use toml::map::Map;

/// A checked scene: the ply, its grippers, the mold, and where all of it goes.
///
/// Every argument is a dict with the keys of the table of that name in a scene file; plain numbers are in SI
/// units, a str carries its unit. Arrays may stand for lists. `mold` may also be a `Mold`.
///
/// Parameters
/// ----------
/// ply : dict
///     What hangs between the grippers: `grippers`, `cell`, `material`, `warp`, `overhang`.
/// mold : dict or Mold, optional
///     What the ply is laid on; also `points` and `triangles` of a mesh, as arrays.
/// grippers : dict, optional
///     Where the grippers start.
/// target : dict, optional
///     Where the ply shall end.
/// motion : dict, optional
///     How the grippers move; also `times` (s), shape (steps,), and `positions` (m), as `with_motion` takes them.
/// model : dict, optional
///     Which model drapes and decides, and its rules.
/// sheet : dict, optional
///     How the ply is divided and followed as a sheet.
/// contact : dict, optional
///     How contact is found.
/// limits : dict, optional
///     What an accepted drape keeps to.
/// plan : dict, optional
///     How a motion is planned.
/// cell : dict, optional
///     What holds the ply and how far it may be off, where `grippers` and `errors` do not say so.
/// errors : dict, optional
///     How far a real cell may be from the scene.
/// robot : dict, optional
///     The arm that carries the tool.
/// pick_up : dict, optional
///     How the ply is picked up from a table.
/// release : dict, optional
///     When the pads let go of the ply.
/// tool : dict, optional
///     What carries the grippers.
/// bodies : sequence of dict, optional
///     What moves with grippers and robot, a list of dicts.
/// obstacles : sequence of dict, optional
///     What stands in the cell, a list of dicts.
/// title : str, optional
///     Name for reports.
/// base : str or path, optional
///     Folder of files that the tables name.
///
/// Raises
/// ------
/// SceneError
///     If the scene makes no sense; it names the place, the fault and a remedy.
///
/// Examples
/// --------
/// >>> scene = plydrape.Scene(
/// ...     ply=dict(grippers=[4, 2], cell=[0.1, 0.1], material="krogh2018"),
/// ...     mold=dict(kind="plane"),
/// ...     grippers=dict(spacing=["98 mm", "98 mm"], height="75 mm"),
/// ...     target=dict(origin=[0, 0], direction="20 deg", shear="20 deg"),
/// ... )
/// >>> scene.positions.shape
/// (30, 8, 3)
#[pyclass(frozen, module = "plydrape")]
pub struct Scene(pub Arc<SceneFile>, pub Origin);

/// What a scene was made from.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub struct Origin {
    /// The text of its tables; `None` where no tables say it.
    pub tables: Option<Arc<str>>,
    /// Folder of the files that they name.
    pub base: PathBuf,
    /// Whether its mold was given beside the tables.
    pub mold: bool,
    /// Whether its motion was given beside the tables.
    pub motion: bool,
}

impl Origin {
    /// Tables with the folder of their files.
    fn new(scene: &SceneFile, base: &Path) -> Self {
        Origin { tables: scene.input.clone(), base: base.into(), ..Origin::default() }
    }
}

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
        cell: "dict[str, typing.Any] | None" = None, errors: "dict[str, typing.Any] | None" = None, robot: "dict[str, typing.Any] | None" = None, pick_up: "dict[str, typing.Any] | None" = None,
        release: "dict[str, typing.Any] | None" = None,
        tool: "dict[str, typing.Any] | None" = None,
        bodies: "typing.Sequence[dict[str, typing.Any]] | None" = None,
        obstacles: "typing.Sequence[dict[str, typing.Any]] | None" = None,
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
        cell: Table<'_, '_>,
        errors: Table<'_, '_>,
        robot: Table<'_, '_>,
        pick_up: Table<'_, '_>,
        release: Table<'_, '_>,
        tool: Table<'_, '_>,
        bodies: Option<&Bound<'_, PyAny>>,
        obstacles: Option<&Bound<'_, PyAny>>,
        title: Option<String>,
        base: PathBuf,
    ) -> PyResult<Self> {
        // the arguments become the keys of a scene file, so that both are checked by the same code
        let mut keys = Map::new();
        if let Some(title) = title {
            keys.insert("title".into(), Value::String(title));
        }
        keys.insert("ply".into(), Value::Table(table::table(ply, "ply")?));

        // a mold of triangles or an object is passed on as it is, a dict as a table
        let mut given = None;
        match mold {
            None => {}
            Some(mold) => match (mold.cast::<PyDict>(), mold.cast::<Mold>()) {
                (Ok(dict), _) if dict.contains("points")? => given = Some(of_triangles(dict)?),
                (Ok(dict), _) => {
                    keys.insert("mold".into(), Value::Table(table::table(dict, "mold")?));
                }
                (_, Ok(mold)) => given = Some(mold.get().0.clone()),
                _ => {
                    return Err(PyTypeError::new_err("mold is neither a dict nor a plydrape.Mold"));
                }
            },
        }

        // a motion given as arrays comes in once the scene is checked; until then the grippers hold
        let way = motion.map(Way::new).transpose()?.flatten();
        if way.is_some() {
            let hold = Map::from_iter([("kind".into(), Value::String("hold".into()))]);
            keys.insert("motion".into(), Value::Table(hold));
        }

        // the other tables have the names of the arguments
        let others = [
            ("grippers", grippers),
            ("target", target),
            ("motion", motion.filter(|_| way.is_none())),
            ("model", model),
            ("sheet", sheet),
            ("contact", contact),
            ("limits", limits),
            ("plan", plan),
            ("cell", cell),
            ("errors", errors),
            ("robot", robot),
            ("pick_up", pick_up),
            ("release", release),
            ("tool", tool),
        ];
        for (name, dict) in others {
            if let Some(dict) = dict {
                keys.insert(name.into(), Value::Table(table::table(dict, name)?));
            }
        }
        for (name, list) in [("bodies", bodies), ("obstacles", obstacles)] {
            if let Some(list) = list {
                keys.insert(name.into(), table::value(list, name)?);
            }
        }

        // the scene is read from its text as a file would be, without the lock of Python
        let text = table::text(&keys)?;
        let mold = given.is_some();
        let scene = parallel(py, || scene::parse_for(&text, &base, "scene", given, None, None));
        let scene = scene.map_err(|refused| error::scene(&refused))?;
        warn_of_notices(py, &scene)?;

        // the tables are kept, because a changed copy is made from them
        let tables = Some(text.as_str().into());
        let origin = Origin { tables, base, mold, motion: false };
        let scene = Scene(Arc::new(scene), origin);
        match way {
            None => Ok(scene),
            Some(Way { times, positions }) => scene.with_motion(times, positions, None, false),
        }
    }

    /// Reads and checks a scene file; files it names are relative to its folder.
    ///
    /// Parameters
    /// ----------
    /// path : str or path
    ///     The file.
    ///
    /// Returns
    /// -------
    /// Scene
    ///     The scene.
    ///
    /// Raises
    /// ------
    /// SceneError
    ///     If it cannot be read or makes no sense. Where there is no such file, or none that may be read, it is a FileNotFoundError or
    ///     PermissionError too.
    ///
    /// Examples
    /// --------
    /// >>> plydrape.Scene.read("examples/02_hanging_strip/scene.toml").ply.grippers
    /// (2, 1)
    #[staticmethod]
    fn read(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let scene =
            parallel(py, || scene::read(&path)).map_err(|refused| error::scene(&refused))?;
        warn_of_notices(py, &scene)?;
        let whole = std::path::absolute(&path).unwrap_or(path);
        let origin = Origin::new(&scene, whole.parent().unwrap_or(Path::new("")));
        Ok(Scene(Arc::new(scene), origin))
    }

    /// Reads and checks a plybook: the name and the scene of each ply, in the order in which they are laid. The mold of a scene has
    /// the plies on it that the ply lies on.
    ///
    /// Parameters
    /// ----------
    /// path : str or path
    ///     The file.
    ///
    /// Returns
    /// -------
    /// list of tuple[str, Scene]
    ///     Name and scene of each ply.
    ///
    /// Raises
    /// ------
    /// SceneError
    ///     If it cannot be read or makes no sense. Where there is no such file, or none that may be read, it is a FileNotFoundError or
    ///     PermissionError too.
    ///
    /// Examples
    /// --------
    /// >>> plies = plydrape.Scene.read_book("examples/15_plybook/plies.toml")
    /// >>> [(name, scene.mold.kind) for name, scene in plies][:2]
    /// [('base 0', 'mesh'), ('turned 30', 'layered')]
    #[staticmethod]
    fn read_book(py: Python<'_>, path: PathBuf) -> PyResult<Vec<(String, Self)>> {
        let book = parallel(py, || scene::read_book(&path));
        let book = book.map_err(|refused| error::scene(&refused))?;
        book.plies.iter().try_for_each(|ply| warn_of_notices(py, &ply.scene))?;
        let made = |scene| Scene(Arc::new(scene), Origin::default());
        Ok(book.plies.into_iter().map(|ply| (ply.name, made(ply.scene))).collect())
    }

    /// Reads and checks the text of a scene file.
    ///
    /// Parameters
    /// ----------
    /// text : str
    ///     TOML, see the guide and docs/scene.schema.json.
    /// base : str or path, optional
    ///     Folder of the files that it names.
    /// name : str, default "scene.toml"
    ///     What it is called in errors.
    ///
    /// Returns
    /// -------
    /// Scene
    ///     The scene.
    ///
    /// Raises
    /// ------
    /// SceneError
    ///     If it makes no sense.
    ///
    /// Examples
    /// --------
    /// >>> plydrape.Scene.parse(plydrape.Scene.template()).mold.kind
    /// 'plane'
    #[staticmethod]
    #[pyo3(signature = (text, *, base = PathBuf::new(), name = "scene.toml"))]
    fn parse(py: Python<'_>, text: &str, base: PathBuf, name: &str) -> PyResult<Self> {
        let scene = parallel(py, || scene::parse(text, &base, name));
        let scene = scene.map_err(|refused| error::scene(&refused))?;
        warn_of_notices(py, &scene)?;
        let origin = Origin::new(&scene, &base);
        Ok(Scene(Arc::new(scene), origin))
    }

    /// The scene that `to_dict` wrote.
    ///
    /// Parameters
    /// ----------
    /// tables : dict
    ///     Keyword arguments of a scene.
    ///
    /// Returns
    /// -------
    /// Scene
    ///     The scene, checked as any other.
    ///
    /// Raises
    /// ------
    /// SceneError
    ///     If it makes no sense.
    ///
    /// Examples
    /// --------
    /// >>> scene = plydrape.Scene.read("examples/04_dome/scene.toml")
    /// >>> plydrape.Scene.from_dict(scene.to_dict()) == scene
    /// True
    #[staticmethod]
    #[pyo3(signature = (tables: "typing.Mapping[str, typing.Any]") -> "Scene")]
    fn from_dict<'py>(
        #[pyo3(from_py_with = keywords)] tables: Bound<'py, PyDict>,
    ) -> PyResult<Bound<'py, PyAny>> {
        tables.py().get_type::<Scene>().call((), Some(&tables))
    }

    /// The scene as keyword arguments of plain values, which JSON and TOML can carry: `Scene(**scene.to_dict())` is the same scene.
    ///
    /// Of a scene that was read, `base` is the folder of its file, in which the files are that it names. A motion or a mesh that was
    /// given as arrays is in it as lists.
    ///
    /// Returns
    /// -------
    /// dict
    ///     The tables of its scene file, with `title` and `base`.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If no tables say it: a scene `with_errors`, a ply of a book, or one on a `Mold` that is no mesh. Pickle it.
    ///
    /// Examples
    /// --------
    /// >>> scene = plydrape.Scene.read("examples/04_dome/scene.toml")
    /// >>> scene.to_dict()["mold"]["kind"]
    /// 'sphere'
    #[pyo3(signature = () -> "dict[str, typing.Any]")]
    fn to_dict<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("plydrape._scene")?.getattr("to_dict")?.call1((slf,))
    }

    /// The tables of the scene as they were given; a mold or a motion that was given beside them as objects.
    #[pyo3(signature = () -> "dict[str, typing.Any]")]
    fn _tables<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let Some(text) = &self.1.tables else {
            return Err(PyValueError::new_err(
                "no tables say this scene, because it was drawn with errors or is a ply of a book: pickle it, or change the scene that it was made from",
            ));
        };
        let keys: Map<String, Value> =
            toml::from_str(text).map_err(|fault| PyValueError::new_err(fault.to_string()))?;
        let out = table::dict(py, &keys)?;
        out.set_item("title", &self.0.title)?;
        if !self.1.base.as_os_str().is_empty() {
            out.set_item("base", self.1.base.to_string_lossy())?;
        }
        if self.1.mold {
            out.set_item("mold", self.mold())?;
        }
        if self.1.motion {
            let motion = PyDict::new(py);
            motion.set_item("times", self.times())?;
            motion.set_item("positions", self.positions())?;
            out.set_item("motion", motion)?;
        }
        Ok(out)
    }

    /// This scene with other values: keyword arguments as those of a scene, of which only those that change are needed.
    ///
    /// A dict is merged into the table of that name, key by key; None takes a table or a key away. A table with another `kind` is
    /// taken whole. The scene itself stays as it is, and comments of its file are not in the `text` of the new one.
    ///
    /// Parameters
    /// ----------
    /// **changes
    ///     Tables, `title` and `base`, as those of a new scene.
    ///
    /// Returns
    /// -------
    /// Scene
    ///     The new scene, checked as any other.
    ///
    /// Raises
    /// ------
    /// SceneError
    ///     If it makes no sense.
    /// TypeError
    ///     If there is no table of a name.
    /// ValueError
    ///     As `to_dict`.
    ///
    /// Examples
    /// --------
    /// >>> scene = plydrape.Scene.read("examples/04_dome/scene.toml")
    /// >>> higher = scene.replace(grippers={"height": "80 mm"}, title="From higher up")
    /// >>> higher.title, float((higher.positions - scene.positions)[0, 0, 2].round(3))
    /// ('From higher up', 0.03)
    #[pyo3(signature = (**changes: "typing.Any") -> "Scene")]
    fn replace<'py>(
        slf: &Bound<'py, Self>,
        changes: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("plydrape._scene")?.getattr("replace")?.call((slf,), changes)
    }

    /// The text of a commented scene to start from, as `plydrape new` writes it.
    ///
    /// Returns
    /// -------
    /// str
    ///     The text.
    ///
    /// Examples
    /// --------
    /// >>> plydrape.Scene.template().startswith("# A scene for plydrape")
    /// True
    #[staticmethod]
    fn template() -> &'static str {
        scene::TEMPLATE
    }

    /// Name for reports.
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
        Ply(self.0.layup.ply.clone())
    }

    /// What it is laid on, if anything.
    #[getter]
    fn mold(&self) -> Option<Mold> {
        self.0.layup.mold.clone().map(Mold)
    }

    /// The ideal drape that its target is taken from, where there is one.
    #[getter]
    fn net(&self) -> Option<Net> {
        let drape = self.0.layup.target.as_ref()?.drape.clone()?;
        Some(Net(drape))
    }

    /// Time of each step (s), shape (steps,).
    #[getter]
    fn times(&self) -> Array<f64> {
        let times = self.0.layup.motion.times.clone();
        Array::new(&[times.len()], times)
    }

    /// Positions of the grippers in each step (m), shape (steps, grippers, 3), i running fastest.
    #[getter]
    fn positions(&self) -> Array<f64> {
        blocks(&self.0.layup.motion.positions, self.0.layup.ply.grippers())
    }

    /// Where the ideal drape puts the grippers (m), shape (grippers, 3), if the ply is to be draped.
    #[getter]
    fn target(&self) -> Option<Array<f64>> {
        let grippers = &self.0.layup.target.as_ref()?.grippers;
        Some(Array::rows(&[grippers.len(), 3], grippers.iter().copied()))
    }

    /// This scene along another motion. It has no `text`, as no scene file says it. Where a scene file is refused
    /// if its start stretches the ply, this one is draped: its overstretch says by how much.
    ///
    /// Parameters
    /// ----------
    /// times : array_like
    ///     Time of each step (s), from 0, each a microsecond after the one before at least, shape (steps,).
    /// positions : array_like
    ///     Positions of the grippers (m), shape (steps, grippers, 3), i running fastest, or (steps, along u, along v, 3).
    /// title : str, optional
    ///     Name for reports, unless it stays.
    /// slow : bool
    ///     Whether the grippers are slower than 1 mm/s; times at which they would be are refused otherwise if they look like
    ///     milliseconds.
    ///
    /// Returns
    /// -------
    /// Scene
    ///     The new scene.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If the shapes do not fit, times do not ascend from 0, a coordinate is not a number up to 10⁶ m, or
    ///     neighbors are (all but) straight above each other, where the model has no solution.
    ///
    /// Examples
    /// --------
    /// >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
    /// >>> higher = scene.with_motion(scene.times, scene.positions + [0, 0, 0.01])
    /// >>> float((higher.positions - scene.positions).max().round(9))
    /// 0.01
    #[pyo3(signature = (times, positions, *, title = None, slow = false))]
    fn with_motion(
        &self,
        times: Numbers<'_>,
        positions: Numbers<'_>,
        title: Option<String>,
        slow: bool,
    ) -> PyResult<Scene> {
        let times = times.list("times")?;
        let positions = positions.steps("positions", &self.0.layup.ply)?;
        let motion = Motion { times, positions };
        let fault = self.0.layup.ply.check_motion(&motion);
        fault.map_err(|fault| PyValueError::new_err(fault.to_string()))?;
        if let (Some(speed), false) = (slow_in_seconds(&motion), slow) {
            return Err(PyValueError::new_err(format!(
                "times are in seconds, and no gripper would be faster than {:.2e} mm/s: did you mean ms? Divide by 1000, or give slow=True if they are that slow",
                1e3 * speed
            )));
        }
        size::drape(&self.0.layup.ply, motion.times.len()).map_err(|fault| error::value(&fault))?;
        if let Some(found) = title.as_deref().and_then(shown::control) {
            return Err(PyValueError::new_err(format!(
                "title holds the control character {}; expected one line of plain text",
                found.escape_unicode()
            )));
        }
        let mut scene = (*self.0).clone();
        scene.input = None;
        scene.plan_refusal = None;
        if let Some(title) = title {
            scene.title = title;
        }
        scene.layup.motion = motion;
        // where the lift ends is known of the scene's own motion alone
        if let Some(pick_up) = &mut scene.layup.pick_up {
            pick_up.lift_steps = 0;
        }
        Ok(Scene(Arc::new(scene), Origin { motion: true, ..self.1.clone() }))
    }

    /// This scene where the arm of its robot follows the motion best.
    ///
    /// Places of the scene in the robot's world are tried, on a grid in units of the arm's reach, with the motion that the scene has; the bodies of the
    /// arm stay clear of mold and obstacles.
    ///
    /// Returns
    /// -------
    /// Scene
    ///     The same scene with another `world` in its `tool`.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If no arm is known, or it follows from no place.
    ///
    /// Examples
    /// --------
    /// >>> tables = dict(ply=dict(grippers=[2, 2], cell=[0.1, 0.1], material="prepreg_warm"))
    /// >>> tables |= dict(grippers=dict(spacing=["98 mm", "98 mm"], height="75 mm"))
    /// >>> tables |= dict(motion=dict(kind="hold"), tool=dict(world=dict(position=[9, 0, 0])))
    /// >>> tables |= dict(model=dict(kind="catenaries"))
    /// >>> scene = plydrape.Scene(**tables, robot=dict(arm="ur20"))
    /// >>> [plydrape.simulate(at).limits["arm_miss"].kept for at in (scene, scene.placed())]
    /// [False, True]
    #[pyo3(signature = () -> "Scene")]
    fn placed<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        let py = slf.py();
        let scene = &slf.get().0;
        if scene.layup.tool.as_ref().is_none_or(|tool| tool.arm.is_none()) {
            return Err(PyValueError::new_err(
                "no arm is known: say it in robot, as in robot=dict(arm=\"ur20\"), beside a tool",
            ));
        }
        let clearance = scene.limits.least(Name::Clearance);
        let Some(placement) = py.detach(|| scene.layup.placement(clearance)) else {
            return Err(PyValueError::new_err(
                "the arm follows from the start to the target from no place; take one with a longer reach, or ask less of it in robot",
            ));
        };
        // as tables, so that they say where the scene stands
        let world = PyDict::new(py);
        world.set_item("position", placement.world.position)?;
        world.set_item("rotation", [0.0, 0.0, placement.yaw])?;
        let changes = PyDict::new(py);
        let tool = PyDict::new(py);
        tool.set_item("world", world)?;
        changes.set_item("tool", tool)?;
        Self::replace(slf, Some(&changes))
    }

    /// How far a real cell may be from the scene, where it says so: its `[errors]` in SI units, each term one of
    /// `{"deviation": …}`, `{"bound": …}` and, of the ply, `{"factor": …}`.
    ///
    /// Examples
    /// --------
    /// >>> tables = dict(ply=dict(grippers=[2, 1], cell=[0.1, 0.1], material="krogh2018"))
    /// >>> tables |= dict(grippers=dict(spacing=["98 mm", "98 mm"], height="75 mm"))
    /// >>> gripper = dict(position=dict(deviation="0.1 mm"))
    /// >>> scene = plydrape.Scene(**tables, motion=dict(kind="hold"), errors=dict(gripper=gripper))
    /// >>> scene.errors["gripper"]["position"]
    /// {'deviation': 0.0001}
    #[getter]
    fn errors(&self) -> PyResult<Option<Json>> {
        self.0.errors.as_ref().map(Json::new).transpose()
    }

    /// The error of every quantity in one sample of the scene's `errors`, in SI units.
    ///
    /// It depends on the seed of the errors and the number of the sample only.
    ///
    /// Parameters
    /// ----------
    /// sample : int
    ///     Its number, from 0.
    /// factor : float, default 1.0
    ///     How many times as large all errors are.
    ///
    /// Returns
    /// -------
    /// dict
    ///     The errors by the names of the tables of `errors`.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If the scene has no errors, or the factor is not finite.
    ///
    /// Examples
    /// --------
    /// >>> tables = dict(ply=dict(grippers=[2, 1], cell=[0.1, 0.1], material="krogh2018"))
    /// >>> tables |= dict(grippers=dict(spacing=["98 mm", "98 mm"], height="75 mm"))
    /// >>> frame = dict(position=dict(bound="1 mm"))
    /// >>> scene = plydrape.Scene(**tables, motion=dict(kind="hold"), errors=dict(frame=frame))
    /// >>> all(abs(shift) <= 0.001 for shift in scene.draw(0)["frame"]["shift"])
    /// True
    #[pyo3(signature = (sample, factor = 1.0))]
    fn draw(&self, sample: usize, factor: f64) -> PyResult<Json> {
        Json::new(&self.drawn(sample, factor)?)
    }

    /// The scene of one real cell: the same commands, with every error that `draw` gives for the sample.
    ///
    /// It has no `errors` of its own any more, and no `text`, as no scene file says it. An error of the
    /// pick-up moves no gripper: the ply is as flat as it would have been, and its `position` and `fiber_angle` are
    /// those of the fabric that is there instead.
    ///
    /// Parameters
    /// ----------
    /// sample : int
    ///     Its number, from 0.
    /// factor : float, default 1.0
    ///     How many times as large all errors are.
    ///
    /// Returns
    /// -------
    /// Scene
    ///     The new scene.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If the scene has no errors, the factor is not finite, or neighbors would be (all but)
    ///     straight above each other.
    ///
    /// Examples
    /// --------
    /// >>> tables = dict(ply=dict(grippers=[2, 1], cell=[0.1, 0.1], material="krogh2018"))
    /// >>> tables |= dict(grippers=dict(spacing=["98 mm", "98 mm"], height="75 mm"))
    /// >>> frame = dict(position=dict(bound="1 mm"))
    /// >>> scene = plydrape.Scene(**tables, motion=dict(kind="hold"), errors=dict(frame=frame))
    /// >>> real = scene.with_errors(0)
    /// >>> bool(abs(real.positions - scene.positions).max() <= 0.001), real.errors
    /// (True, None)
    #[pyo3(signature = (sample, factor = 1.0))]
    fn with_errors(&self, py: Python<'_>, sample: usize, factor: f64) -> PyResult<Scene> {
        let draw = self.drawn(sample, factor)?;
        let real = parallel(py, || draw.apply(&self.0.layup));
        let fault = real.ply.check_motion(&real.motion);
        fault.map_err(|fault| PyValueError::new_err(fault.to_string()))?;
        let mut scene = (*self.0).clone();
        scene.layup = real;
        scene.errors = None;
        scene.input = None;
        scene.plan_refusal = None;
        Ok(Scene(Arc::new(scene), Origin::default()))
    }

    fn __repr__(&self) -> String {
        let grid = self.0.layup.ply.grid;
        let steps = self.0.layup.motion.positions.len();
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
                "factor is {factor}: expected a finite number"
            )));
        }
        Ok(errors.draw(sample, self.0.layup.ply.grippers()).scaled(factor))
    }
}

/// Warns of keys that have a new name, and of limits that are not measured.
fn warn_of_notices(py: Python<'_>, scene: &SceneFile) -> PyResult<()> {
    scene.notices.iter().try_for_each(|notice| warn(py, notice))
}

/// Warns of what is hardly meant.
pub fn warn(py: Python<'_>, text: &str) -> PyResult<()> {
    PyErr::warn(py, &py.get_type::<PyUserWarning>(), &CString::new(text)?, 1)
}

/// A motion that a program has made.
struct Way<'py> {
    times: Numbers<'py>,
    positions: Numbers<'py>,
}

impl<'py> Way<'py> {
    /// The motion of a table that has positions.
    fn new(table: &Bound<'py, PyDict>) -> PyResult<Option<Self>> {
        if !table.contains("positions")? {
            return Ok(None);
        }
        let [times, positions] = both(table, "motion", ["times", "positions"])?;
        Ok(Some(Way { times: times.extract()?, positions: positions.extract()? }))
    }
}

/// The mesh of a table that has its points.
fn of_triangles(table: &Bound<'_, PyDict>) -> PyResult<plydrape::mold::Mold> {
    let [points, triangles] = both(table, "mold", ["points", "triangles"])?;
    Ok(Mold::triangles(points.extract()?, triangles.extract()?)?.0)
}

/// The values of both keys of a table that has no other ones.
fn both<'py>(
    table: &Bound<'py, PyDict>,
    name: &str,
    keys: [&str; 2],
) -> PyResult<[Bound<'py, PyAny>; 2]> {
    let [a, b] = keys;
    match (table.get_item(a)?, table.get_item(b)?, table.len()) {
        (Some(first), Some(second), 2) => Ok([first, second]),
        _ => Err(PyValueError::new_err(format!(
            "{name} has the keys {}; with {a:?} or {b:?} among them, expected these two alone",
            table.keys()
        ))),
    }
}

/// A mapping of keyword arguments.
fn keywords<'py>(tables: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyDict>> {
    let dict = tables.py().get_type::<PyDict>().call1((tables,))?;
    Ok(dict.cast_into()?)
}

/// Steps of points as one block, `(steps, points, 3)`.
pub fn blocks(steps: &[Vec<[f64; 3]>], count: usize) -> Array<f64> {
    Array::rows(&[steps.len(), count, 3], steps.iter().flatten().copied())
}

/// A scene as an argument of a function; of anything else the error says how to read one.
pub struct SceneArgument<'py>(Bound<'py, Scene>);

impl<'a, 'py> FromPyObject<'a, 'py> for SceneArgument<'py> {
    type Error = PyErr;
    const INPUT_TYPE: PyStaticExpr = <Bound<'py, Scene> as FromPyObject<'a, 'py>>::INPUT_TYPE;

    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(scene) = object.cast::<Scene>() {
            return Ok(SceneArgument(scene.to_owned()));
        }
        let remedy = "Scene.read(\"scene.toml\") reads one from a file";
        let kind = object.get_type().name()?;
        Err(PyTypeError::new_err(format!("a {kind} is no Scene: {remedy}")))
    }
}

impl SceneArgument<'_> {
    /// The scene.
    pub fn get(&self) -> &Scene {
        self.0.get()
    }
}

/// Names of the materials that come with plydrape.
///
/// Returns
/// -------
/// list of str
///     The names.
///
/// Examples
/// --------
/// >>> plydrape.materials()[:4]
/// ['krogh2018', 'dry_carbon', 'prepreg_cold', 'prepreg_warm']
#[pyfunction]
pub fn materials() -> Vec<&'static str> {
    scene::shipped_materials().collect()
}
