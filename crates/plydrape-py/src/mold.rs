//! `plydrape.Mold`.

use crate::arrays::{Array, Table};
use numpy::{AllowTypeChange, Ix2, PyArrayLike};
use plydrape::mold::{self, Mesh, patch::patch};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::sync::Arc;

/// What a ply is laid on. Scenes have one; triangles of your own make one.
///
/// Example:
///     >>> mold = plydrape.Scene.read("examples/04_dome/scene.toml").mold
///     >>> mold.kind
///     'sphere'
#[pyclass(frozen, module = "plydrape")]
#[derive(Clone)]
pub struct Mold(pub mold::Mold);

/// What lies closest to points.
///
/// Example:
///     >>> mold = plydrape.Scene.read("examples/04_dome/scene.toml").mold
///     >>> closest = mold.closest_points([[0, 0, 0.1]])
///     >>> bool(np.isclose(np.linalg.norm(closest.points - [0, 0, 0.1]), abs(closest.distances[0])))
///     True
#[pyclass(frozen, module = "plydrape")]
pub struct ClosestPoints(Vec<mold::ClosestPoint>);

#[pymethods]
impl ClosestPoints {
    /// The closest points of the mold (m), shape (n, 3).
    #[getter]
    fn points(&self) -> Array<f64> {
        Array::rows(&[self.0.len(), 3], self.0.iter().map(|closest| closest.point))
    }

    /// Smooth unit normals of the mold there, out of it, shape (n, 3).
    #[getter]
    fn normals(&self) -> Array<f64> {
        Array::rows(&[self.0.len(), 3], self.0.iter().map(|closest| closest.normal))
    }

    /// Distances (m), negative inside the mold, shape (n,).
    #[getter]
    fn distances(&self) -> Array<f64> {
        Array::new(&[self.0.len()], self.0.iter().map(|closest| closest.distance).collect())
    }

    /// Where a point is off to the side of an open boundary: there is no mold, shape (n,).
    #[getter]
    fn beyond(&self) -> Array<bool> {
        Array::new(&[self.0.len()], self.0.iter().map(|closest| closest.beyond).collect())
    }
}

#[pymethods]
impl Mold {
    /// A mold of triangles, such as a mesher or a CAD reader makes them; vertices at one place are merged and
    /// triangles turned to one side.
    ///
    /// Args:
    ///     points: Corners (m), shape (n, 3).
    ///     triangles: Indices of each triangle's corners, shape (m, 3).
    ///
    /// Raises:
    ///     ValueError: If the triangles are no mold: empty, without area, or not a surface.
    ///
    /// Example:
    ///     >>> square = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    ///     >>> mold = plydrape.Mold.triangles(square, [[0, 1, 2], [0, 2, 3]])
    ///     >>> mold.heights([[0.5, 0.25]])
    ///     array([0.])
    #[staticmethod]
    #[pyo3(signature = (points, triangles: "numpy.typing.ArrayLike"))]
    fn triangles(
        points: Table<'_>,
        triangles: PyArrayLike<'_, i64, Ix2, AllowTypeChange>,
    ) -> PyResult<Self> {
        let vertices = crate::arrays::points(&points, "points")?;
        let view = triangles.as_array();
        let (rows, columns) = view.dim();
        if columns != 3 {
            return Err(crate::arrays::wrong_shape("triangles", "(m, 3)", &[rows, columns]));
        }
        let mut corners = Vec::with_capacity(rows);
        for row in view.rows() {
            let mut triangle = [0; 3];
            for (to, from) in triangle.iter_mut().zip(row) {
                *to = u32::try_from(*from)
                    .ok()
                    .filter(|n| (*n as usize) < vertices.len())
                    .ok_or_else(|| {
                        PyValueError::new_err(format!(
                            "triangles holds {from}; there are {} points, counted from 0",
                            vertices.len()
                        ))
                    })?;
            }
            corners.push(triangle);
        }
        let made = Mesh::of_triangles(vertices, &corners);
        let (mesh, _) = made.map_err(|fault| PyValueError::new_err(fault.to_string()))?;
        Ok(Mold(mold::Mold::Mesh(Arc::new(mesh))))
    }

    /// Its kind: "plane", "cylinder", "sphere", "torus", "graph" or "mesh"; "wavy" where the errors
    /// of a scene laid waves on it.
    #[getter]
    fn kind(&self) -> &'static str {
        match &self.0 {
            mold::Mold::Plane(_) => "plane",
            mold::Mold::Cylinder(_) => "cylinder",
            mold::Mold::Sphere(_) => "sphere",
            mold::Mold::Torus(_) => "torus",
            mold::Mold::Graph(_) => "graph",
            mold::Mold::Mesh(_) => "mesh",
            mold::Mold::Wavy(_) => "wavy",
            mold::Mold::Layered(_) => "layered",
        }
    }

    /// What lies closest to points (m), shape (n, 3).
    ///
    /// Example:
    ///     >>> mold = plydrape.Scene.read("examples/03_tilted_plane/scene.toml").mold
    ///     >>> closest = mold.closest_points([[0, 0, 1]])
    ///     >>> closest.points.shape, closest.distances.shape
    ///     ((1, 3), (1,))
    #[pyo3(signature = (points))]
    fn closest_points(&self, py: Python<'_>, points: Table<'_>) -> PyResult<ClosestPoints> {
        let points = crate::arrays::points(&points, "points")?;
        Ok(ClosestPoints(py.detach(|| points.iter().map(|p| self.0.closest_point(*p)).collect())))
    }

    /// Height of its highest point over places of the plan (m), nan where there is none.
    ///
    /// Args:
    ///     places: x and y (m), shape (n, 2).
    ///
    /// Example:
    ///     >>> mold = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml").mold
    ///     >>> mold.heights([[0, 0], [0.3, 0.1]])
    ///     array([0., 0.])
    fn heights(&self, py: Python<'_>, places: Table<'_>) -> PyResult<Array<f64>> {
        let view = places.0.as_array();
        let (rows, columns) = view.dim();
        if columns != 2 {
            return Err(crate::arrays::wrong_shape("places", "(n, 2)", &[rows, columns]));
        }
        let at: Vec<[f64; 2]> = view.rows().into_iter().map(|p| [p[0], p[1]]).collect();
        let height = |p: &[f64; 2]| self.0.highest_point(*p).map_or(f64::NAN, |point| point[2]);
        Ok(Array::new(&[rows], py.detach(|| at.iter().map(height).collect())))
    }

    /// The mold over a rectangle of the plan as triangles.
    ///
    /// Args:
    ///     low: Lowest x and y (m).
    ///     high: Highest x and y (m).
    ///     most: About how many triangles at most.
    ///
    /// Returns:
    ///     Points (m), shape (n, 3), and the indices of each triangle's corners, shape (m, 3).
    ///
    /// Example:
    ///     >>> mold = plydrape.Scene.read("examples/04_dome/scene.toml").mold
    ///     >>> points, triangles = mold.patch((-0.1, -0.1), (0.1, 0.1), most=200)
    ///     >>> points.shape[1], triangles.shape[1], len(triangles) <= 200
    ///     (3, 3, True)
    #[pyo3(signature = (low, high, *, most = 20_000))]
    fn patch(
        &self,
        py: Python<'_>,
        low: [f64; 2],
        high: [f64; 2],
        most: usize,
    ) -> (Array<f64>, Array<u32>) {
        triangles(py.detach(|| patch(&self.0, low, high, most)))
    }

    fn __repr__(&self) -> String {
        format!("<plydrape.Mold, {}>", self.kind())
    }
}

/// Triangles as two arrays.
pub fn triangles(found: mold::patch::Triangles) -> (Array<f64>, Array<u32>) {
    (
        Array::rows(&[found.vertices.len(), 3], found.vertices),
        Array::rows(&[found.triangles.len(), 3], found.triangles),
    )
}
