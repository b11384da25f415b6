//! `plydrape.Jacobian`: the derivatives of an equilibrium as arrays.

use crate::arrays::{Array, or_nan};
use crate::stations::{at_least_two, every_station};
use plydrape::draping::spans::FreeSpan;
use plydrape::equilibrium::{Direction, StateTangent};
use plydrape::ply::{self, shear};
use pyo3::prelude::*;
use std::sync::Arc;

/// Derivatives of an `Equilibrium`: each array has the axes of what is differentiated, then those of `wrt`.
///
/// Examples
/// --------
/// >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
/// >>> equilibrium = plydrape.Solver.of(scene).solve(scene.positions[0])
/// >>> jacobian = equilibrium.jacobian(wrt="lengths")
/// >>> jacobian.names, jacobian.forces.shape, jacobian.slopes.shape
/// (['u', 'v'], (1, 2), (1, 2, 2))
#[pyclass(frozen, module = "plydrape")]
pub struct Jacobian {
    pub axes: Vec<usize>,
    pub names: Vec<String>,
    pub stretched: Vec<Option<f64>>,
    pub spans: Vec<FreeSpan>,
    pub ply: Arc<ply::Ply>,
    pub directions: Vec<Direction>,
    pub tangents: Vec<StateTangent>,
}

impl Jacobian {
    /// Derivatives of numbers with the axes `rows`; `derivatives` gives those of all of them along a direction, by its index.
    fn block(&self, rows: &[usize], derivatives: impl Fn(usize) -> Vec<f64>) -> Array<f64> {
        let columns: Vec<Vec<f64>> = (0..self.tangents.len()).map(derivatives).collect();
        let count: usize = rows.iter().product();
        let values = (0..count).flat_map(|row| columns.iter().map(move |column| column[row]));
        Array::new(&[rows, &self.axes].concat(), values.collect())
    }

    /// How the ends of a span move along a direction.
    fn ends(&self, span: &FreeSpan, column: usize) -> [[f64; 3]; 2] {
        let velocity = |gripper: usize| self.directions[column].grippers[gripper];
        self.ply.lines().ends(span.catenary).map(velocity)
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
            let [a, b] = self.ply.fabric_cell();
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
    /// Parameters
    /// ----------
    /// stations : int, default 17
    ///     How many points on each catenary, 2 or more.
    ///
    /// Returns
    /// -------
    /// ndarray
    ///     The derivatives, shape (catenaries, stations, 3, …).
    ///
    /// Examples
    /// --------
    /// >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
    /// >>> equilibrium = plydrape.Solver.of(scene).solve([[0, 0, 0], [0.098, 0, 0]])
    /// >>> equilibrium.jacobian(wrt="material").points(5).shape
    /// (1, 5, 3, 2)
    #[pyo3(signature = (stations = 17))]
    fn points(&self, stations: usize) -> PyResult<Array<f64>> {
        let count = at_least_two("stations", stations)?;
        Ok(self.block(&[self.spans.len(), count, 3], |column| {
            let tangent = &self.tangents[column];
            let point = |(span, t): (&FreeSpan, f64)| {
                span.point_tangent(t, self.ends(span, column), tangent)
            };
            every_station(&self.spans, count).flat_map(point).collect()
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
