//! `plydrape.Equilibrium`: a ply that hangs.

use crate::arrays::{Array, or_nan};
use crate::error;
use crate::jacobian::Jacobian;
use crate::stations::{at_least_two, every_station};
use crate::work::parallel;
use plydrape::draping::spans;
use plydrape::equilibrium::{self, Direction, EarlyEnds, Property, Status};
use plydrape::layup::Settings;
use plydrape::ply::{self, ContactSegment, shear};
use plydrape_io::store::size;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

/// A ply that hangs: forces, slopes, shape, and how they change.
///
/// Catenaries are counted as in `Ply`.
///
/// Examples
/// --------
/// >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
/// >>> equilibrium = plydrape.Solver.of(scene).solve(scene.positions[0])
/// >>> equilibrium.forces.round(4)
/// array([0.4177])
#[pyclass(frozen, module = "plydrape")]
pub struct Equilibrium {
    pub state: Mutex<State>,
    pub positions: Vec<[f64; 3]>,
    pub shape: spans::Equilibrium,
}

impl Equilibrium {
    fn ply(&self) -> Arc<ply::Ply> {
        Arc::clone(&self.state.lock().unwrap_or_else(PoisonError::into_inner).ply)
    }
}

/// A solver with what it solves for.
#[derive(Clone)]
pub struct State {
    pub solver: equilibrium::Solver,
    pub ply: Arc<ply::Ply>,
    pub settings: Settings,
    pub contacts: Arc<[Option<ContactSegment>]>,
}

impl State {
    pub fn new(ply: &ply::Ply, settings: &Settings) -> Self {
        State {
            solver: equilibrium::Solver::new(ply, settings),
            ply: Arc::new(ply.clone()),
            settings: *settings,
            contacts: vec![None; ply.lines().catenaries()].into(),
        }
    }
}

#[pymethods]
impl Equilibrium {
    /// How the solve ended: "converged", "stalled", "iteration-limit" or "length-not-met".
    #[getter]
    fn status(&self) -> &'static str {
        self.shape.solved.status.name()
    }

    /// Iterations on the shared slopes.
    #[getter]
    fn iterations(&self) -> usize {
        self.shape.solved.iterations
    }

    /// What is left of the rule of the slopes, scaled to a slope.
    #[getter]
    fn residual(&self) -> f64 {
        self.shape.solved.residual
    }

    /// Largest error of a fabric length, as a share of it.
    #[getter]
    fn length_residual(&self) -> f64 {
        self.shape.solved.length_residual
    }

    /// How often a part of the solve ended early or was replaced, by name; all zero in a plain solve.
    #[getter]
    fn early_ends(&self) -> BTreeMap<&'static str, u32> {
        let EarlyEnds {
            line_searches,
            linear_solves,
            negative_curvatures,
            active_sets,
            damping_limits,
            continuation,
        } = self.shape.solved.early_ends;
        BTreeMap::from([
            ("line_searches", line_searches),
            ("linear_solves", linear_solves),
            ("negative_curvatures", negative_curvatures),
            ("active_sets", active_sets),
            ("damping_limits", damping_limits),
            ("continuation", continuation),
        ])
    }

    /// Positions of the grippers (m), shape (grippers, 3).
    #[getter]
    fn positions(&self) -> Array<f64> {
        Array::rows(&[self.positions.len(), 3], self.positions.iter().copied())
    }

    /// Horizontal force of each catenary (N), shape (catenaries,); nan of a stretched diagonal or a straight one.
    #[getter]
    fn forces(&self) -> Array<f64> {
        let forces: Vec<f64> = self.shape.forces().map(or_nan).collect();
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
    /// Parameters
    /// ----------
    /// stations : int, default 17
    ///     How many points on each catenary, 2 or more.
    ///
    /// Returns
    /// -------
    /// ndarray
    ///     The points (m), shape (catenaries, stations, 3).
    ///
    /// Examples
    /// --------
    /// >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
    /// >>> equilibrium = plydrape.Solver.of(scene).solve([[0, 0, 0], [0.098, 0, 0]])
    /// >>> lowest = equilibrium.points(5)[0, 2]
    /// >>> (lowest * 1e3).round(1)
    /// array([49. ,  0. , -8.7])
    #[pyo3(signature = (stations = 17))]
    fn points(&self, stations: usize) -> PyResult<Array<f64>> {
        let (spans, count) = (&self.shape.spans, at_least_two("stations", stations)?);
        let points = every_station(spans, count).map(|(span, t)| span.point(t));
        Ok(Array::rows(&[spans.len(), count, 3], points))
    }

    /// Exact derivatives of the equilibrium, by the implicit function theorem.
    ///
    /// They hold where the equilibrium is smooth: not where a diagonal just begins to shear, or a slope just
    /// reaches its limit.
    ///
    /// Parameters
    /// ----------
    /// wrt : {"grippers", "lengths", "material"}
    ///     To what: "grippers", their positions (m), axes (grippers, 3); "lengths", the fabric of a cell along
    ///     u and v (m), axis (2,); "material", its `names`, axis (names,): mass and rigidities in SI units.
    ///
    /// Returns
    /// -------
    /// Jacobian
    ///     The derivatives.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If there is no such `wrt`, or the derivatives would take more memory than allowed.
    /// SolveError
    ///     If the equilibrium was not found, or a rigidity is zero: it has no neighborhood.
    ///
    /// Examples
    /// --------
    /// >>> ply = plydrape.Ply(grippers=[2, 1], cell=[0.1, 0.1], material="krogh2018")
    /// >>> equilibrium = plydrape.Solver(ply).solve([[0, 0, 0], [0.098, 0, 0]])
    /// >>> jacobian = equilibrium.jacobian(wrt="grippers")
    /// >>> jacobian.forces.shape, jacobian.points(5).shape
    /// ((1, 2, 3), (1, 5, 3, 2, 3))
    #[pyo3(signature = (*, wrt: "typing.Literal['grippers', 'lengths', 'material']"))]
    fn jacobian(&self, py: Python<'_>, wrt: &str) -> PyResult<Jacobian> {
        // the directions of the derivatives, with the axes of their arrays and the names of these
        let ply = self.ply();
        let grippers = self.positions.len();
        let (axes, names, directions): (Vec<usize>, Vec<String>, Vec<Direction>) = match wrt {
            "grippers" => {
                size::derivatives(&ply).map_err(|fault| error::value(&fault))?;
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
                let properties = Property::of_material(&ply.material);
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
                let text =
                    format!("wrt is {other:?}; expected \"grippers\", \"lengths\" or \"material\"");
                return Err(PyValueError::new_err(text));
            }
        };

        // only an equilibrium that was found has a derivative
        if self.shape.solved.status != Status::Converged {
            let text = "the equilibrium was not found, so it has no derivative";
            return Err(error::solve(text, self.status(), self.iterations(), self.residual()));
        }

        // all directions share one linearization, solved without the lock of Python
        let tangents = parallel(py, || {
            let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
            let State { solver, contacts, .. } = &mut *state;
            let mut linearized = solver.linearize(&self.positions, contacts);
            directions.iter().map(|direction| linearized.along(direction)).collect()
        });

        let state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        let stretched = state.solver.problem().shearing.iter().map(|s| s.map(|(path, _)| path));
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

/// Shear angle of each cell (rad), 0 where no diagonal is stretched.
pub fn shear_angles(ply: &ply::Ply, solver: &equilibrium::Solver) -> Vec<f64> {
    let lines = ply.lines();
    let angle = |(cell, path): (&ply::LineCell, f64)| {
        shear::angle(cell.trellis.map(|side| side * ply.length_factor), path)
    };
    let stretched = lines.cells().iter().zip(&solver.problem().shearing);
    stretched.map(|(cell, s)| s.map_or(0.0, |(path, _)| angle((cell, path)))).collect()
}
