//! `plydrape.Surface`: the ply between its catenaries.

use crate::arrays::Array;
use plydrape_io::write::surface;
use pyo3::prelude::*;

/// The ply of one step as a surface.
///
/// Examples
/// --------
/// >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
/// >>> result = plydrape.simulate(scene, model="catenaries")
/// >>> bool((result.surface(1).gap > 0).all())
/// True
#[pyclass(frozen, module = "plydrape")]
pub struct Surface(pub surface::Surface);

#[pymethods]
impl Surface {
    /// The surface as a structured grid of PyVista, of a strip as a line, with `gap_mm` at its points. Needs PyVista.
    ///
    /// Returns
    /// -------
    /// pyvista.StructuredGrid
    ///     The grid, u running fastest.
    ///
    /// Raises
    /// ------
    /// ExtraError
    ///     If PyVista is not installed.
    ///
    /// Examples
    /// --------
    /// >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
    /// >>> result = plydrape.simulate(scene, model="catenaries")
    /// >>> grid = result.surface(-1, intervals=4).to_pyvista()
    /// >>> grid.dimensions, grid.array_names
    /// ((13, 5, 1), ['gap_mm'])
    #[pyo3(signature = () -> "pyvista.StructuredGrid")]
    fn to_pyvista<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("plydrape._meshes")?.getattr("surface_mesh")?.call1((slf,))
    }

    /// Points along u and along v.
    #[getter]
    fn size(&self) -> (usize, usize) {
        self.0.size.into()
    }

    /// Points (m), shape (points, 3), u running fastest.
    #[getter]
    fn points(&self) -> Array<f64> {
        Array::rows(&[self.0.vertices.len(), 3], self.0.vertices.iter().copied())
    }

    /// Corners of its triangles, shape (triangles, 3); none for a strip.
    #[getter]
    fn triangles(&self) -> Array<u32> {
        let corners = self.0.triangles();
        Array::rows(&[corners.len(), 3], corners)
    }

    /// Distance of each point from the mold (m), negative inside it, shape (points,); nan without a mold.
    #[getter]
    fn gap(&self) -> Array<f64> {
        let points = self.0.vertices.len();
        Array::new(&[points], self.0.gap.clone().unwrap_or_else(|| vec![f64::NAN; points]))
    }
}
