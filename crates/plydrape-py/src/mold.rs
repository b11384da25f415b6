//! `plydrape.Mold`.

use crate::arrays::{Array, Numbers};
use crate::quantity::Amount;
use crate::work::parallel;
use plydrape::layup::ContactSettings;
use plydrape::mold::{self, Mesh, patch::patch};
use plydrape_io::scene::{Measured, usual};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::sync::Arc;

/// What a ply is laid on. Scenes have one; triangles of your own make one.
///
/// Examples
/// --------
/// >>> mold = plydrape.Scene.read("examples/04_dome/scene.toml").mold
/// >>> mold.kind
/// 'sphere'
#[pyclass(frozen, module = "plydrape")]
#[derive(Clone)]
pub struct Mold(pub mold::Mold);

/// What lies closest to points.
///
/// Examples
/// --------
/// >>> mold = plydrape.Scene.read("examples/04_dome/scene.toml").mold
/// >>> closest = mold.closest_points([[0, 0, 0.1]])
/// >>> bool(np.isclose(np.linalg.norm(closest.points - [0, 0, 0.1]), abs(closest.distances[0])))
/// True
#[pyclass(frozen, module = "plydrape")]
pub struct ClosestPoints {
    pub axes: Vec<usize>,
    pub found: Vec<mold::ClosestPoint>,
}

impl ClosestPoints {
    fn vectors(&self, vector: impl Fn(&mold::ClosestPoint) -> [f64; 3]) -> Array<f64> {
        Array::rows(&[&self.axes[..], &[3]].concat(), self.found.iter().map(vector))
    }
}

#[pymethods]
impl ClosestPoints {
    /// The closest points of the mold (m), shape (n, 3).
    #[getter]
    fn points(&self) -> Array<f64> {
        self.vectors(|closest| closest.point)
    }

    /// Smooth unit normals of the mold there, out of it, shape (n, 3).
    #[getter]
    fn normals(&self) -> Array<f64> {
        self.vectors(|closest| closest.normal)
    }

    /// Distances (m), negative inside the mold, shape (n,).
    #[getter]
    fn distances(&self) -> Array<f64> {
        Array::new(&self.axes, self.found.iter().map(|closest| closest.distance).collect())
    }

    /// Where a point is off to the side of an open boundary: there is no mold, shape (n,).
    #[getter]
    fn beyond(&self) -> Array<bool> {
        Array::new(&self.axes, self.found.iter().map(|closest| closest.beyond).collect())
    }
}

#[pymethods]
impl Mold {
    /// A mold of triangles, such as a mesher or a CAD reader makes them; vertices at one place are merged and
    /// triangles turned to one side.
    ///
    /// Parameters
    /// ----------
    /// points : array_like
    ///     Corners (m), shape (n, 3).
    /// triangles : array_like
    ///     Indices of each triangle's corners, shape (m, 3).
    ///
    /// Returns
    /// -------
    /// Mold
    ///     The mold.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If the triangles are no mold: empty, without area, or not a surface.
    ///
    /// Examples
    /// --------
    /// >>> square = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    /// >>> mold = plydrape.Mold.triangles(square, [[0, 1, 2], [0, 2, 3]])
    /// >>> mold.heights([[0.5, 0.25]])
    /// array([0.])
    #[staticmethod]
    pub fn triangles(points: Numbers<'_>, triangles: Numbers<'_>) -> PyResult<Self> {
        let (_, vertices) = points.points::<3>("points")?;
        let rows = triangles.indices::<3>("triangles", "(m, 3)")?;
        let mut corners = Vec::with_capacity(rows.len());
        for row in &rows {
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
        // the faces of a body that were meshed one by one are a mold only if they are stitched
        let made = Mesh::of_triangles(vertices.clone(), &corners)
            .or_else(|_| Mesh::of_faces(vertices, &corners, ContactSettings::default().tolerance));
        let (mesh, _) = made.map_err(|fault| PyValueError::new_err(fault.to_string()))?;
        Ok(Mold(mold::Mold::Mesh(Arc::new(mesh))))
    }

    /// Kind: "plane", "cylinder", "sphere", "torus", "graph" or "mesh"; "wavy" where the errors
    /// of a scene laid waves on it; "layered" where plies of a book lie on it.
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
    /// Parameters
    /// ----------
    /// points : array_like
    ///     Points (m), shape (n, 3) or (…, 3).
    ///
    /// Returns
    /// -------
    /// ClosestPoints
    ///     What is closest to each, in arrays with the same axes.
    ///
    /// Examples
    /// --------
    /// >>> mold = plydrape.Scene.read("examples/03_tilted_plane/scene.toml").mold
    /// >>> closest = mold.closest_points([[0, 0, 1]])
    /// >>> closest.points.shape, closest.distances.shape
    /// ((1, 3), (1,))
    fn closest_points(&self, py: Python<'_>, points: Numbers<'_>) -> PyResult<ClosestPoints> {
        let (axes, points) = points.points::<3>("points")?;
        let found = parallel(py, || points.iter().map(|p| self.0.closest_point(*p)).collect());
        Ok(ClosestPoints { axes, found })
    }

    /// Height of its highest point over places of the plan (m), nan where there is none.
    ///
    /// Parameters
    /// ----------
    /// places : array_like
    ///     x and y (m), shape (n, 2) or (…, 2).
    ///
    /// Returns
    /// -------
    /// ndarray
    ///     Heights (m), shape (n,) or (…).
    ///
    /// Examples
    /// --------
    /// >>> mold = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml").mold
    /// >>> mold.heights([[0, 0], [0.3, 0.1]])
    /// array([0., 0.])
    fn heights(&self, py: Python<'_>, places: Numbers<'_>) -> PyResult<Array<f64>> {
        let (axes, at) = places.points::<2>("places")?;
        let height = |p: &[f64; 2]| self.0.highest_point(*p).map_or(f64::NAN, |point| point[2]);
        Ok(Array::new(&axes, parallel(py, || at.iter().map(height).collect())))
    }

    /// The triangles that a mold of kind "mesh" is made of; None of another kind.
    ///
    /// Returns
    /// -------
    /// tuple[ndarray, ndarray] or None
    ///     Points (m), shape (n, 3), and the indices of each triangle's corners, shape (m, 3).
    ///
    /// Examples
    /// --------
    /// >>> mold = plydrape.Mold.triangles([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    /// >>> points, triangles = mold.mesh()
    /// >>> points.shape, triangles
    /// ((3, 3), array([[0, 1, 2]], dtype=uint32))
    fn mesh(&self) -> Option<(Array<f64>, Array<u32>)> {
        let mold::Mold::Mesh(mesh) = &self.0 else { return None };
        let (points, corners) = (mesh.vertices(), mesh.triangles());
        Some((
            Array::rows(&[points.len(), 3], points.iter().copied()),
            Array::rows(&[corners.len(), 3], corners.iter().copied()),
        ))
    }

    /// The mold over a rectangle of the plan as triangles.
    ///
    /// Parameters
    /// ----------
    /// low : sequence of float or str
    ///     Lowest x and y (m, or texts with a unit).
    /// high : sequence of float or str
    ///     Highest x and y (m, or texts with a unit).
    /// most : int, default 20000
    ///     About how many triangles at most; a mold that is no mesh is sampled in a million at most.
    ///
    /// Returns
    /// -------
    /// tuple of ndarray, ndarray
    ///     Points (m), shape (n, 3), and the indices of each triangle's corners, shape (m, 3).
    ///
    /// Examples
    /// --------
    /// >>> mold = plydrape.Scene.read("examples/04_dome/scene.toml").mold
    /// >>> points, triangles = mold.patch((-0.1, -0.1), (0.1, 0.1), most=200)
    /// >>> points.shape[1], triangles.shape[1], len(triangles) <= 200
    /// (3, 3, True)
    #[pyo3(signature = (
        low: "typing.Sequence[float | str]", high: "typing.Sequence[float | str]", *, most = 20_000
    ))]
    fn patch(
        &self,
        py: Python<'_>,
        low: [Amount; 2],
        high: [Amount; 2],
        most: usize,
    ) -> PyResult<(Array<f64>, Array<u32>)> {
        let place = |name: &str, [x, y]: &[Amount; 2]| -> PyResult<[f64; 2]> {
            let place = |side: &Amount| side.si(name, Measured::Length, &usual::Coordinate::USUAL);
            Ok([place(x)?, place(y)?])
        };
        let (low, high) = (place("low", &low)?, place("high", &high)?);
        Ok(triangles(parallel(py, || patch(&self.0, low, high, most))))
    }

    /// Surface as a mesh of PyVista, over a rectangle of the plan. Needs PyVista.
    ///
    /// Parameters
    /// ----------
    /// low : sequence of float or str
    ///     Lowest x and y (m, or texts with a unit).
    /// high : sequence of float or str
    ///     Highest x and y (m, or texts with a unit).
    /// most : int, default 20000
    ///     About how many triangles at most; a mold that is no mesh is sampled in a million at most.
    ///
    /// Returns
    /// -------
    /// pyvista.PolyData
    ///     The triangles.
    ///
    /// Examples
    /// --------
    /// >>> mold = plydrape.Scene.read("examples/04_dome/scene.toml").mold
    /// >>> mold.to_pyvista(("-10 cm", "-10 cm"), ("10 cm", "10 cm"), most=200).n_cells <= 200
    /// True
    #[pyo3(signature = (
        low: "typing.Sequence[float | str]", high: "typing.Sequence[float | str]", *, most = 20_000
    ) -> "pyvista.PolyData")]
    fn to_pyvista<'py>(
        slf: &Bound<'py, Self>,
        low: &Bound<'py, PyAny>,
        high: &Bound<'py, PyAny>,
        most: usize,
    ) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("plydrape._meshes")?.getattr("mold_mesh")?.call1((slf, low, high, most))
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
