//! What of each class goes to another process, and what is made of it there.
//!
//! A state is a text, JSON, and of a sheet the bytes of its file. It is whole: no file is read when it comes back. Texts of one
//! version are read by that version. `python/plydrape/_values.py` gives the classes pickling, copies and comparison by it.

use crate::batch::{Equilibria, Found};
use crate::beside::Drape;
use crate::drape::Plan;
use crate::equilibrium::State;
use crate::error;
use crate::measure::{Measure, measures};
use crate::mold::{ClosestPoints, Mold};
use crate::net::Net;
use crate::outcome::{Outcome, Quantities};
use crate::ply::{Material, Ply};
use crate::result::Result;
use crate::sample::Sample;
use crate::scene::{Origin, Scene};
use crate::sheet::Sheet;
use crate::solver::Solver;
use crate::span::Span;
use crate::surface::Surface;
use plydrape::catenary::{self, EndCondition};
use plydrape::elastica::Bending;
use plydrape::layup::{Layup, Settings};
use plydrape::material::MomentCurve;
use plydrape::mold::{self as molds, Raised, Waves};
use plydrape::motion::Motion;
use plydrape::ply as plies;
use plydrape::scene as scenes;
use plydrape_io::Diagnostic;
use plydrape_io::result::SceneEcho;
use plydrape_io::result::read;
use plydrape_io::result::sheet::{SheetFile, SheetKept};
use plydrape_io::scene::SceneFile;
use plydrape_io::store::json;
use plydrape_io::write::surface;
use plydrape_io::{Content, ResultFile, plan as plan_file};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::sync::{Arc, Mutex};

/// The state of an object: all of it, or what it is compared by.
#[pyfunction]
#[pyo3(name = "_state")]
pub fn state<'py>(
    value: &Bound<'py, PyAny>,
    whole: bool,
) -> PyResult<(String, Option<Bound<'py, PyBytes>>)> {
    // objects with a result, whose sheet is kept as bytes beside the text
    let py = value.py();
    if let Ok(result) = value.cast::<Result>() {
        return of_result(py, &result.get().0, whole);
    }
    if let Ok(sheet) = value.cast::<Sheet>() {
        return of_result(py, &sheet.get().result, whole);
    }
    if let Ok(drape) = value.cast::<Drape>() {
        return of_result(py, &drape.get().result, whole);
    }
    if let Ok(plan) = value.cast::<Plan>() {
        let plan = plan.get();
        let (result, file) = of_result(py, &plan.result, whole)?;
        let checkpoint = text(plan_file::text(&plan.checkpoint, &plan.result.scene))?;
        let Plan { decisions, time_over, .. } = *plan;
        let state = PlanState { result, checkpoint, decisions, time_over };
        return Ok((text(json::to_text(&state))?, file));
    }
    if let Ok(outcome) = value.cast::<Outcome>() {
        let Outcome { result, quantities } = outcome.get();
        let (result, file) = of_result(py, &result.0, whole)?;
        let state = OutcomeState { result, quantities: quantities.clone() };
        return Ok((text(json::to_text(&state))?, file));
    }

    // all other objects are a text
    let state = if let Ok(scene) = value.cast::<Scene>() {
        text(json::to_text(&SceneState::new(scene.get(), whole)))?
    } else if let Ok(ply) = value.cast::<Ply>() {
        text(json::to_text(&ply.get().0))?
    } else if let Ok(material) = value.cast::<Material>() {
        text(json::to_text(&material.get().0))?
    } else if let Ok(mold) = value.cast::<Mold>() {
        text(json::to_text(&MoldState::new(Some(&mold.get().0))))?
    } else if let Ok(net) = value.cast::<Net>() {
        text(json::to_text(&*net.get().0))?
    } else if let Ok(sample) = value.cast::<Sample>() {
        text(json::to_text(&sample.get().0))?
    } else if let Ok(measure) = value.cast::<Measure>() {
        measure.get().key().to_owned()
    } else if let Ok(surface) = value.cast::<Surface>() {
        let surface::Surface { size, vertices, gap } = surface.get().0.clone();
        text(json::to_text(&SurfaceState { size, vertices, gap }))?
    } else if let Ok(closest) = value.cast::<ClosestPoints>() {
        text(json::to_text(&ClosestState::new(closest.get())))?
    } else if let Ok(span) = value.cast::<Span>() {
        text(json::to_text(&SpanState::new(span.get())))?
    } else if let Ok(solver) = value.cast::<Solver>() {
        let solver = solver.get();
        let state = solver.state();
        text(json::to_text(&SolverState { ply: (*state.ply).clone(), settings: state.settings }))?
    } else if let Ok(equilibria) = value.cast::<Equilibria>() {
        let Equilibria { ply, found } = equilibria.get();
        text(json::to_text(&EquilibriaState { ply, found }))?
    } else {
        return Err(PyTypeError::new_err(format!(
            "cannot pickle plydrape.{}: it holds the state of its solver; keep its arrays, pickle the Solver and solve again, or solve many with plydrape.batch.equilibria, whose result can be pickled",
            value.get_type().name()?
        )));
    };
    Ok((state, None))
}

/// The object of a class with a state.
#[pyfunction]
#[pyo3(name = "_restore", signature = (name, state, file))]
pub fn restore<'py>(
    py: Python<'py>,
    name: &str,
    state: &str,
    file: Option<&[u8]>,
) -> PyResult<Bound<'py, PyAny>> {
    let any = match name {
        // what holds a result: its text, and the file of its sheet where there is one
        "Result" => Bound::new(py, Result(Arc::new(result(state, file)?)))?.into_any(),
        "Sheet" => {
            Sheet::from_result(&Arc::new(result(state, file)?))?.into_pyobject(py)?.into_any()
        }
        "Drape" => {
            let result = Arc::new(result(state, file)?);
            Bound::new(py, Drape { result, beside: true })?.into_any()
        }
        "Plan" => Bound::new(py, plan(state, file)?)?.into_any(),
        "Outcome" => {
            let state: OutcomeState = from(state)?;
            let result = Result(Arc::new(result(&state.result, file)?));
            Bound::new(py, Outcome { result, quantities: state.quantities })?.into_any()
        }
        // what is a text alone
        "Scene" => Bound::new(py, from::<SceneState>(state)?.scene())?.into_any(),
        "Ply" => Bound::new(py, Ply(from(state)?))?.into_any(),
        "Material" => Bound::new(py, Material(from(state)?))?.into_any(),
        "Mold" => from::<MoldState>(state)?.mold().map(Mold).into_pyobject(py)?.into_any(),
        "Net" => Bound::new(py, Net(Arc::new(from(state)?)))?.into_any(),
        "Sample" => Bound::new(py, Sample(from(state)?))?.into_any(),
        // one of the measures that there are, by its key
        "Measure" => {
            measures().into_iter().find(|one| one.key() == state).into_pyobject(py)?.into_any()
        }
        "Surface" => {
            let SurfaceState { size, vertices, gap } = from(state)?;
            Bound::new(py, Surface(surface::Surface { size, vertices, gap }))?.into_any()
        }
        "ClosestPoints" => Bound::new(py, from::<ClosestState>(state)?.points())?.into_any(),
        // a span is solved anew, a solver starts anew, and of many equilibria what was found is kept
        "Span" => {
            let state: SpanState = from(state)?;
            Bound::new(py, Span::solved(state.span(), state.exact())?)?.into_any()
        }
        "Solver" => {
            let SolverState { ply, settings } = from(state)?;
            Bound::new(py, Solver(Mutex::new(State::new(&ply, &settings))))?.into_any()
        }
        "Equilibria" => {
            let EquilibriaState { ply, found } =
                from::<EquilibriaState<plies::Ply, Vec<Found>>>(state)?;
            Bound::new(py, Equilibria { ply: Arc::new(ply), found })?.into_any()
        }
        other => return Err(PyTypeError::new_err(format!("nothing pickles as a {other}"))),
    };
    Ok(any)
}

/// A text, or why there is none: of a wavy mold for instance.
fn text(made: std::result::Result<String, plydrape_io::Error>) -> PyResult<String> {
    made.map_err(|fault| PyTypeError::new_err(format!("this cannot be pickled: {fault}")))
}

fn from<T: DeserializeOwned>(state: &str) -> PyResult<T> {
    serde_json::from_str(state).map_err(|fault| PyValueError::new_err(fault.to_string()))
}

fn of_result<'py>(
    py: Python<'py>,
    result: &ResultFile,
    whole: bool,
) -> PyResult<(String, Option<Bound<'py, PyBytes>>)> {
    let state = text(ResultFile::text(result))?;
    let Some(states) = result.sheet_states.as_ref().filter(|_| whole) else {
        return Ok((state, None));
    };
    let mut bytes = Vec::new();
    states.write(&mut bytes).map_err(PyErr::from)?;
    Ok((state, Some(PyBytes::new(py, &bytes))))
}

/// A result, with the file of its sheet in the folder for temporary files.
fn result(state: &str, file: Option<&[u8]>) -> PyResult<ResultFile> {
    let mut result = read::parse(state.as_bytes(), "result.json".as_ref())
        .map_err(|fault| error::read(&fault))?;
    if let Some(bytes) = file {
        let file = SheetFile::of_bytes(bytes, &std::env::temp_dir())?;
        if result.sheet_states.as_ref().map(SheetKept::seal) != Some(file.seal()) {
            return Err(PyValueError::new_err("the file of the sheet is not that of the result"));
        }
        result.sheet_states = Some(SheetKept::made(file));
    }
    Ok(result)
}

#[derive(Serialize, Deserialize)]
struct PlanState {
    result: String,
    checkpoint: String,
    decisions: usize,
    time_over: bool,
}

fn plan(state: &str, file: Option<&[u8]>) -> PyResult<Plan> {
    let state: PlanState = from(state)?;
    let result = result(&state.result, file)?;
    let fault = |what: &dyn std::fmt::Display| PyValueError::new_err(what.to_string());
    let record = result.plan.clone().ok_or_else(|| fault(&"the result was not planned"))?;
    let motion = record.motion().map_err(|found| fault(&found))?;
    let checkpoint =
        plan_file::read(&state.checkpoint, &result.scene).map_err(|found| fault(&found))?;
    let PlanState { decisions, time_over, .. } = state;
    Ok(Plan { result: Arc::new(result), record, motion, checkpoint, decisions, time_over })
}

#[derive(Serialize, Deserialize)]
struct OutcomeState {
    result: String,
    quantities: Quantities,
}

/// A mold: a wavy one as its waves and what they are on.
#[derive(Serialize, Deserialize)]
struct MoldState {
    #[serde(with = "plydrape_io::result::mold")]
    mold: Option<molds::Mold>,
    waves: Option<WavesState>,
}

#[derive(Serialize, Deserialize)]
struct WavesState {
    amplitude: f64,
    wavelength: f64,
    headings: [f64; 6],
    phases: [f64; 6],
}

impl MoldState {
    fn new(mold: Option<&molds::Mold>) -> Self {
        match mold {
            Some(molds::Mold::Wavy(wavy)) => {
                let Waves { amplitude, wavelength, headings, phases } = wavy.relief;
                let waves = WavesState { amplitude, wavelength, headings, phases };
                MoldState { mold: Some(wavy.mold.clone()), waves: Some(waves) }
            }
            _ => MoldState { mold: mold.cloned(), waves: None },
        }
    }

    fn mold(self) -> Option<molds::Mold> {
        match (self.mold, self.waves) {
            (Some(mold), Some(waves)) => {
                let WavesState { amplitude, wavelength, headings, phases } = waves;
                let relief = Waves { amplitude, wavelength, headings, phases };
                Some(molds::Mold::Wavy(Arc::new(Raised { mold, relief })))
            }
            (mold, _) => mold,
        }
    }
}

/// A scene: what a result keeps of it, its motion and its plan.
#[derive(Serialize, Deserialize)]
struct SceneState {
    scene: SceneEcho,
    mold: MoldState,
    times: Vec<f64>,
    positions: Vec<Vec<[f64; 3]>>,
    plan: scenes::PlanSettings,
    also: bool,
    thickness: Option<f64>,
    origin: Option<Origin>,
    refusal: Option<Box<Diagnostic>>,
}

impl SceneState {
    /// What a scene is; as a whole also the text that it came from.
    fn new(scene: &Scene, whole: bool) -> Self {
        let Scene(file, origin) = scene;
        let SceneFile { scene, input, thickness, plan_refusal, .. } = &**file;
        SceneState {
            mold: MoldState::new(scene.layup.mold.as_ref()),
            scene: SceneEcho {
                mold: None,
                ..SceneEcho::new(scene, input.clone().filter(|_| whole))
            },
            times: scene.layup.motion.times.clone(),
            positions: scene.layup.motion.positions.clone(),
            plan: scene.plan,
            also: scene.also,
            thickness: *thickness,
            origin: whole.then(|| origin.clone()),
            refusal: plan_refusal.clone().filter(|_| whole),
        }
    }

    fn scene(self) -> Scene {
        // the echo has no mold: the state keeps it beside the echo, with its waves
        let SceneEcho {
            title,
            book_ply,
            input,
            ply,
            mold: _,
            target,
            settings,
            limits,
            bodies,
            errors,
            tool,
            release,
            pick_up,
        } = self.scene;

        // the scene, put together again
        let motion = Motion { times: self.times, positions: self.positions };
        let layup = Layup {
            ply,
            mold: self.mold.mold(),
            motion,
            target,
            settings,
            bodies,
            tool,
            release,
            pick_up,
        };
        let (plan, also) = (self.plan, self.also);
        let scene = scenes::Scene { title, layup, limits, plan, errors, also, book_ply };

        // what was found while files were read is not kept
        let file = SceneFile {
            scene,
            input,
            files: Vec::new(),
            mesh: None,
            cups: None,
            drawn: None,
            cell: None,
            thickness: self.thickness,
            notices: Vec::new(),
            plan_refusal: self.refusal,
        };
        Scene(Arc::new(file), self.origin.unwrap_or_default())
    }
}

#[derive(Serialize, Deserialize)]
struct SurfaceState {
    size: [usize; 2],
    vertices: Vec<[f64; 3]>,
    gap: Option<Vec<f64>>,
}

#[derive(Serialize, Deserialize)]
struct ClosestState {
    axes: Vec<usize>,
    found: Vec<([f64; 3], [f64; 3], f64, bool)>,
}

impl ClosestState {
    fn new(closest: &ClosestPoints) -> Self {
        let found = closest.found.iter().map(|p| (p.point, p.normal, p.distance, p.beyond));
        ClosestState { axes: closest.axes.clone(), found: found.collect() }
    }

    fn points(self) -> ClosestPoints {
        let found = self.found.into_iter().map(|(point, normal, distance, beyond)| {
            molds::ClosestPoint { point, normal, distance, beyond }
        });
        ClosestPoints { axes: self.axes, found: found.collect() }
    }
}

/// What a span is solved from; an axial stiffness that is infinite is none.
#[derive(Serialize, Deserialize)]
struct SpanState {
    run: f64,
    rise: f64,
    length: f64,
    slopes: [Option<f64>; 2],
    weight: f64,
    flexural_rigidity: f64,
    axial_stiffness: Option<f64>,
    /// By the exact theory; with a curve of the moment, or by the rigidity.
    exact: bool,
    moment: Option<MomentCurve>,
}

impl SpanState {
    fn new(solved: &Span) -> Self {
        let slope = |end: EndCondition| match end {
            EndCondition::Free => None,
            EndCondition::Slope(slope) => Some(slope),
        };
        let catenary::Span { run, rise, length, ends, weight, flexural_rigidity, axial_stiffness } =
            solved.span;
        let moment = match &solved.exact {
            Some(Bending::Curve(curve)) => Some(curve.clone()),
            Some(Bending::Rigidity(_)) | None => None,
        };
        SpanState {
            run,
            rise,
            length,
            slopes: ends.map(slope),
            weight,
            flexural_rigidity,
            axial_stiffness: Some(axial_stiffness).filter(|ea| ea.is_finite()),
            exact: solved.exact.is_some(),
            moment,
        }
    }

    fn exact(&self) -> Option<Bending> {
        let rigidity = Bending::Rigidity(self.flexural_rigidity);
        self.exact.then(|| self.moment.clone().map_or(rigidity, Bending::Curve))
    }

    fn span(&self) -> catenary::Span {
        catenary::Span {
            run: self.run,
            rise: self.rise,
            length: self.length,
            ends: self.slopes.map(|end| end.map_or(EndCondition::Free, EndCondition::Slope)),
            weight: self.weight,
            flexural_rigidity: self.flexural_rigidity,
            axial_stiffness: self.axial_stiffness.unwrap_or(f64::INFINITY),
        }
    }
}

#[derive(Serialize, Deserialize)]
struct SolverState {
    ply: plies::Ply,
    settings: Settings,
}

#[derive(Serialize, Deserialize)]
struct EquilibriaState<P, F> {
    ply: P,
    found: F,
}
