//! `plydrape.Solver`, `plydrape.Equilibrium` and `plydrape.Jacobian`.
//!
//! A ply hung from grippers, without contact. What a ply does on a mold is a drape: `plydrape.simulate`.

use crate::arrays::{Array, Table, or_nan, points};
use crate::error;
use crate::ply::Ply;
use crate::scene::Scene;
use plydrape::draping::spans::{FreeSpan, Shape, shape};
use plydrape::equilibrium::{self, Direction, Property, StateTangent, Status};
use plydrape::ply::{self, Laid, shear};
use plydrape::scene::{Contact, Settings, SlopeRule};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::f64::consts::FRAC_PI_2;
use std::sync::{Arc, Mutex, PoisonError};

/// Finds equilibria of a hanging ply, one after another: each starts from the last one.
///
/// Args:
///     ply: What hangs.
///     slopes: How shared slopes are found: "moment-balance", or "min-force" as in Krogh et al. 2018.
///     axial_stiffness: EA of a line of ply (N); infinite for an inextensible ply.
///     gravity: Acceleration of gravity (m/s²).
///     max_tilt: Limit of the ball joints (rad).
///
/// Raises:
///     ValueError: If a number makes no sense.
///
/// Example:
///     >>> ply = plydrape.Ply(grippers=[4, 1], cell=[0.1, 0.1], material="krogh2018")
///     >>> solver = plydrape.Solver(ply)
///     >>> equilibrium = solver.solve([[0.098 * i, 0, 0] for i in range(4)])
///     >>> equilibrium.status
///     'converged'
///     >>> bool((equilibrium.forces > 0).all())
///     True
#[pyclass(frozen, module = "plydrape")]
pub struct Solver(Mutex<State>);

/// A solver with what it solves for.
#[derive(Clone)]
struct State {
    solver: equilibrium::Solver,
    ply: Arc<ply::Ply>,
    laid: Arc<[Option<Laid>]>,
}

impl State {
    fn new(ply: &ply::Ply, settings: &Settings) -> Self {
        State {
            solver: equilibrium::Solver::new(ply, settings),
            ply: Arc::new(ply.clone()),
            laid: vec![None; ply.grid.catenaries()].into(),
        }
    }
}

impl Solver {
    fn state(&self) -> std::sync::MutexGuard<'_, State> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// A solver that remembers nothing, for another thread.
    pub fn fresh(&self) -> equilibrium::Solver {
        let mut solver = self.state().solver.clone();
        solver.forget();
        solver
    }

    /// What it solves for.
    pub fn ply(&self) -> Arc<ply::Ply> {
        Arc::clone(&self.state().ply)
    }
}

#[pymethods]
impl Solver {
    #[new]
    #[pyo3(signature = (
        ply, *, slopes: "typing.Literal['moment-balance', 'min-force']" = "moment-balance",
        axial_stiffness = 1e5, gravity = 9.81, max_tilt = 40_f64.to_radians()
    ))]
    fn new(
        ply: &Ply,
        slopes: &str,
        axial_stiffness: f64,
        gravity: f64,
        max_tilt: f64,
    ) -> PyResult<Self> {
        let slopes = match slopes {
            "moment-balance" => SlopeRule::MomentBalance,
            "min-force" => SlopeRule::MinForce,
            other => {
                let text =
                    format!("slopes is {other:?}; \"moment-balance\" or \"min-force\" is wanted");
                return Err(PyValueError::new_err(text));
            }
        };
        for (name, value, most) in [
            ("axial_stiffness", axial_stiffness, f64::INFINITY),
            ("gravity", gravity, f64::MAX),
            ("max_tilt", max_tilt, FRAC_PI_2 * (1.0 - f64::EPSILON)),
        ] {
            if !(value > 0.0 && value <= most) {
                let below = if name == "max_tilt" { " below π/2" } else { "" };
                let text = format!("{name} is {value}; a positive number{below} is wanted");
                return Err(PyValueError::new_err(text));
            }
        }
        let contact = Contact::default();
        let settings = Settings { slopes, axial_stiffness, gravity, max_tilt, contact };
        Ok(Solver(Mutex::new(State::new(&ply.0, &settings))))
    }

    /// A solver for the ply of a scene, by its rules.
    ///
    /// Example:
    ///     >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
    ///     >>> plydrape.Solver.of(scene).solve(scene.positions[0]).forces.shape
    ///     (16,)
    #[staticmethod]
    fn of(scene: &Scene) -> Self {
        Solver(Mutex::new(State::new(&scene.0.ply, &scene.0.settings)))
    }

    /// Forgets the last equilibrium: the next one starts from nothing.
    ///
    /// Example:
    ///     >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
    ///     >>> solver = plydrape.Solver.of(scene)
    ///     >>> first = solver.solve(scene.positions[0]).forces
    ///     >>> solver.forget()
    ///     >>> bool((solver.solve(scene.positions[0]).forces == first).all())
    ///     True
    fn forget(&self) {
        self.state().solver.forget();
    }

    /// Solves for the grippers where they are.
    ///
    /// Args:
    ///     positions: Positions of the grippers (m), shape (grippers, 3), i running fastest.
    ///     check: Whether an equilibrium that was not found is an error, or just says so in its `status`.
    ///
    /// Raises:
    ///     ValueError: If the shape does not fit or a number is not finite.
    ///     SolveError: If no equilibrium was found.
    ///
    /// Example:
    ///     >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
    ///     >>> plydrape.Solver.of(scene).solve([[0, 0, 0], [0.098, 0, 0]]).status
    ///     'converged'
    #[pyo3(signature = (positions, *, check = true))]
    fn solve(&self, positions: Table<'_>, check: bool) -> PyResult<Equilibrium> {
        let positions = points(&positions, "positions")?;
        let mut state = self.state();
        let count = state.ply.grid.grippers();
        if positions.len() != count {
            let text =
                format!("there are {} positions; the ply has {count} grippers", positions.len());
            return Err(PyValueError::new_err(text));
        }
        let laid = Arc::clone(&state.laid);
        let outcome = state.solver.solve(&positions, &laid);
        if check && outcome.status != Status::Converged {
            let (status, residual) = (outcome.status.name(), outcome.residual);
            let text = format!(
                "no equilibrium was found ({status} after {} iterations, a Newton step of {residual:.1e} still to go); \
                 look at the ply with check=False, or move the grippers less far apart",
                outcome.iterations
            );
            return Err(error::solve(&text, status, outcome.iterations, residual));
        }
        let state = state.clone();
        let shape = shape(&state.ply, &state.solver, outcome, &positions, &laid);
        Ok(Equilibrium { state: Mutex::new(state), positions, shape })
    }
}

/// A ply that hangs: forces, slopes, shape, and how they change.
///
/// Catenaries are counted as in `Ply`.
///
/// Example:
///     >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
///     >>> equilibrium = plydrape.Solver.of(scene).solve(scene.positions[0])
///     >>> equilibrium.forces.round(4)
///     array([0.4177])
#[pyclass(frozen, module = "plydrape")]
pub struct Equilibrium {
    state: Mutex<State>,
    positions: Vec<[f64; 3]>,
    shape: Shape,
}

impl Equilibrium {
    fn ply(&self) -> Arc<ply::Ply> {
        Arc::clone(&self.state.lock().unwrap_or_else(PoisonError::into_inner).ply)
    }
}

/// Shear angle of each cell (rad), 0 where no diagonal is stretched.
pub fn shear_angles(ply: &ply::Ply, solver: &equilibrium::Solver) -> Vec<f64> {
    let stretched = solver.assembly().shearing.iter();
    stretched.map(|s| s.map_or(0.0, |(path, _)| shear::angle(ply.cell, path))).collect()
}

/// Points of spans at equal parts of their runs, end to end.
fn stations(spans: &[FreeSpan], count: usize) -> impl Iterator<Item = (&FreeSpan, f64)> {
    let last = (count - 1).max(1) as f64;
    spans.iter().flat_map(move |span| (0..count).map(move |k| (span, k as f64 / last)))
}

fn at_least_two(count: usize) -> PyResult<usize> {
    match count {
        2..=100_000 => Ok(count),
        _ => Err(PyValueError::new_err(format!("stations is {count}; 2 to 100 000 are possible"))),
    }
}

#[pymethods]
impl Equilibrium {
    /// How the solve ended: "converged", "stalled" or "iteration-limit".
    #[getter]
    fn status(&self) -> &'static str {
        self.shape.equilibrium.status.name()
    }

    /// Iterations on the shared slopes.
    #[getter]
    fn iterations(&self) -> usize {
        self.shape.equilibrium.iterations
    }

    /// Newton step of the slopes still to go.
    #[getter]
    fn residual(&self) -> f64 {
        self.shape.equilibrium.residual
    }

    /// Positions of the grippers (m), shape (grippers, 3).
    #[getter]
    fn positions(&self) -> Array<f64> {
        Array::rows(&[self.positions.len(), 3], self.positions.iter().copied())
    }

    /// Horizontal force of each catenary (N), shape (catenaries,); nan of a stretched diagonal or a straight one.
    #[getter]
    fn forces(&self) -> Array<f64> {
        let forces: Vec<f64> = self.shape.spans.iter().map(|span| or_nan(span.force)).collect();
        Array::new(&[forces.len()], forces)
    }

    /// Slopes at the ends of each catenary, shape (catenaries, 2).
    #[getter]
    fn slopes(&self) -> Array<f64> {
        let spans = &self.shape.spans;
        Array::rows(&[spans.len(), 2], spans.iter().map(|span| span.slopes))
    }

    /// Shear angle of each cell (rad), shape (cells,), those along u first; 0 where no diagonal is stretched.
    #[getter]
    fn shear(&self) -> Array<f64> {
        let state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        let angles = shear_angles(&state.ply, &state.solver);
        Array::new(&[angles.len()], angles)
    }

    /// Points along each catenary (m) at equal parts of its run, shape (catenaries, stations, 3).
    ///
    /// Example:
    ///     >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
    ///     >>> equilibrium = plydrape.Solver.of(scene).solve([[0, 0, 0], [0.098, 0, 0]])
    ///     >>> lowest = equilibrium.points(5)[0, 2]
    ///     >>> (lowest * 1e3).round(1)
    ///     array([49. ,  0. , -8.7])
    #[pyo3(signature = (stations = 17))]
    fn points(&self, stations: usize) -> PyResult<Array<f64>> {
        let (spans, count) = (&self.shape.spans, at_least_two(stations)?);
        let points = self::stations(spans, count).map(|(span, t)| span.point(t));
        Ok(Array::rows(&[spans.len(), count, 3], points))
    }

    /// Exact derivatives of the equilibrium, by the implicit function theorem.
    ///
    /// They hold where the equilibrium is smooth: not where a diagonal just begins to shear, or a slope just
    /// reaches its limit.
    ///
    /// Args:
    ///     wrt: To what: "grippers", their positions (m), axes (grippers, 3); "lengths", the fabric of a cell along
    ///         u and v (m), axis (2,); "material", its `names`, axis (names,): mass and rigidities in SI units.
    ///
    /// Raises:
    ///     ValueError: If there is no such `wrt`.
    ///     SolveError: If the equilibrium was not found, or a rigidity is zero: it has no neighbourhood.
    ///
    /// Example:
    ///     >>> ply = plydrape.Ply(grippers=[2, 1], cell=[0.1, 0.1], material="krogh2018")
    ///     >>> equilibrium = plydrape.Solver(ply).solve([[0, 0, 0], [0.098, 0, 0]])
    ///     >>> jacobian = equilibrium.jacobian(wrt="grippers")
    ///     >>> jacobian.forces.shape, jacobian.points(5).shape
    ///     ((1, 2, 3), (1, 5, 3, 2, 3))
    #[pyo3(signature = (*, wrt: "typing.Literal['grippers', 'lengths', 'material']"))]
    fn jacobian(&self, py: Python<'_>, wrt: &str) -> PyResult<Jacobian> {
        let ply = self.ply();
        let grippers = self.positions.len();
        let (axes, names, directions): (Vec<usize>, Vec<String>, Vec<Direction>) = match wrt {
            "grippers" => {
                let axis = |n: usize, k: usize| Direction::gripper(&ply, n, k);
                let directions =
                    (0..grippers).flat_map(|n| (0..3).map(move |k| axis(n, k))).collect();
                (vec![grippers, 3], ["x", "y", "z"].map(String::from).to_vec(), directions)
            }
            "lengths" => {
                let directions = vec![Direction::cell(&ply, 0), Direction::cell(&ply, 1)];
                (vec![2], ["u", "v"].map(String::from).to_vec(), directions)
            }
            "material" => {
                let properties = Property::of(&ply.material);
                let names: Vec<_> = properties.iter().map(|p| p.key().to_owned()).collect();
                let directions: Option<Vec<_>> =
                    properties.iter().map(|p| Direction::property(&ply, *p)).collect();
                let Some(directions) = directions else {
                    let text = "a rigidity of the material is zero: with any at all the ply follows another equation, and there is no derivative";
                    return Err(error::solve(
                        text,
                        self.status(),
                        self.iterations(),
                        self.residual(),
                    ));
                };
                (vec![properties.len()], names, directions)
            }
            other => {
                let text = format!(
                    "wrt is {other:?}; \"grippers\", \"lengths\" or \"material\" is wanted"
                );
                return Err(PyValueError::new_err(text));
            }
        };
        if self.shape.equilibrium.status != Status::Converged {
            let text = "the equilibrium was not found, so it has no derivative";
            return Err(error::solve(text, self.status(), self.iterations(), self.residual()));
        }
        let tangents = py.detach(|| {
            let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
            let State { solver, laid, .. } = &mut *state;
            let mut linearized = solver.linearize(&self.positions, laid);
            directions.iter().map(|direction| linearized.along(direction)).collect()
        });
        let state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        let stretched = state.solver.assembly().shearing.iter().map(|s| s.map(|(path, _)| path));
        Ok(Jacobian {
            axes,
            names,
            stretched: stretched.collect(),
            spans: self.shape.spans.clone(),
            ply: Arc::clone(&ply),
            directions,
            tangents,
        })
    }

    fn __repr__(&self) -> String {
        let grid = self.ply().grid;
        format!("<plydrape.Equilibrium of {} × {} grippers, {}>", grid.nu, grid.nv, self.status())
    }
}

/// Derivatives of an `Equilibrium`: each array has the axes of what is differentiated, then those of `wrt`.
///
/// Example:
///     >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
///     >>> equilibrium = plydrape.Solver.of(scene).solve(scene.positions[0])
///     >>> jacobian = equilibrium.jacobian(wrt="lengths")
///     >>> jacobian.names, jacobian.forces.shape, jacobian.slopes.shape
///     (['u', 'v'], (1, 2), (1, 2, 2))
#[pyclass(frozen, module = "plydrape")]
pub struct Jacobian {
    axes: Vec<usize>,
    names: Vec<String>,
    stretched: Vec<Option<f64>>,
    spans: Vec<FreeSpan>,
    ply: Arc<ply::Ply>,
    directions: Vec<Direction>,
    tangents: Vec<StateTangent>,
}

impl Jacobian {
    /// Rows of derivatives: `of(tangent, column)` gives what all rows do along a direction.
    fn block(&self, rows: &[usize], of: impl Fn(usize) -> Vec<f64>) -> Array<f64> {
        let columns: Vec<Vec<f64>> = (0..self.tangents.len()).map(of).collect();
        let count: usize = rows.iter().product();
        let values = (0..count).flat_map(|row| columns.iter().map(move |column| column[row]));
        Array::new(&[rows, &self.axes].concat(), values.collect())
    }

    /// How the ends of a span move along a direction.
    fn ends(&self, span: &FreeSpan, column: usize) -> [[f64; 3]; 2] {
        let c = self.ply.grid.catenary(span.catenary);
        [c.from, c.to].map(|g| self.directions[column].grippers[self.ply.grid.index(g)])
    }
}

#[pymethods]
impl Jacobian {
    /// What the last axis stands for: "x", "y", "z"; "u", "v"; or keys of the material.
    #[getter]
    fn names(&self) -> Vec<String> {
        self.names.clone()
    }

    /// Derivatives of the forces (N), shape (catenaries, …); nan where there is no force.
    #[getter]
    fn forces(&self) -> Array<f64> {
        self.block(&[self.spans.len()], |column| {
            let force = |span: &FreeSpan| {
                span.force.and(span.element).map(|n| self.tangents[column].force[n])
            };
            self.spans.iter().map(|span| or_nan(force(span))).collect()
        })
    }

    /// Derivatives of the end slopes, shape (catenaries, 2, …).
    #[getter]
    fn slopes(&self) -> Array<f64> {
        self.block(&[self.spans.len(), 2], |column| {
            let slopes = |span: &FreeSpan| match (span.element, &span.profile) {
                (Some(n), Some(_)) => self.tangents[column].end_slopes[n],
                _ => [self.straight(span, column); 2],
            };
            self.spans.iter().flat_map(slopes).collect()
        })
    }

    /// Derivatives of the shear angles (rad), shape (cells, …); 0 where no diagonal is stretched.
    #[getter]
    fn shear(&self) -> Array<f64> {
        self.block(&[self.stretched.len()], |column| {
            let [a, b] = self.ply.cell;
            let [along_u, along_v, _] = self.directions[column].length;
            let paths = &self.tangents[column].paths;
            let rate = |(path, change): (&Option<f64>, &f64)| match path {
                Some(path) => {
                    shear::angle_tangent([a, b], *path, [a * along_u, b * along_v, *change])
                }
                None => 0.0,
            };
            self.stretched.iter().zip(paths).map(rate).collect()
        })
    }

    /// Derivatives of the points (m) at fixed parts of the runs, shape (catenaries, stations, 3, …).
    ///
    /// Example:
    ///     >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
    ///     >>> equilibrium = plydrape.Solver.of(scene).solve([[0, 0, 0], [0.098, 0, 0]])
    ///     >>> equilibrium.jacobian(wrt="material").points(5).shape
    ///     (1, 5, 3, 2)
    #[pyo3(signature = (stations = 17))]
    fn points(&self, stations: usize) -> PyResult<Array<f64>> {
        let count = at_least_two(stations)?;
        Ok(self.block(&[self.spans.len(), count, 3], |column| {
            let tangent = &self.tangents[column];
            let point = |(span, t): (&FreeSpan, f64)| {
                span.point_tangent(t, self.ends(span, column), tangent)
            };
            self::stations(&self.spans, count).flat_map(point).collect()
        }))
    }
}

impl Jacobian {
    /// How the slope of a straight line changes.
    fn straight(&self, span: &FreeSpan, column: usize) -> f64 {
        let ([a, b], run, [x, y]) = (self.ends(span, column), span.run(), span.heading());
        let longer = (b[0] - a[0]) * x + (b[1] - a[1]) * y;
        if run > 0.0 { (b[2] - a[2] - span.slope(0.0) * longer) / run } else { 0.0 }
    }
}
