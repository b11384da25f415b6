//! `plydrape.Net`.

use crate::arrays::{Array, or_nan};
use crate::error;
use crate::work::parallel;
use plydrape::net;
use plydrape_io::scene;
use pyo3::prelude::*;
use std::path::PathBuf;
use std::sync::Arc;

/// The ideal drape: the fabric as a pin-jointed net on the mold.
///
/// Examples
/// --------
/// >>> net = plydrape.Net.read("examples/hemisphere_net/scene.toml")
/// >>> net.nodes.shape
/// (24, 24, 3)
#[pyclass(frozen, module = "plydrape")]
#[derive(Clone)]
pub struct Net(pub Arc<net::Net>);

#[pymethods]
impl Net {
    /// Lays the ply of a scene file on its mold, whether or not grippers could bring it there, as `plydrape net`
    /// does.
    ///
    /// Parameters
    /// ----------
    /// path : str or path
    ///     The scene file.
    ///
    /// Returns
    /// -------
    /// Net
    ///     The ideal drape.
    ///
    /// Raises
    /// ------
    /// SceneError
    ///     If the file has no `[ply]`, `[mold]` and `[target]` that make sense.
    ///
    /// Examples
    /// --------
    /// >>> net = plydrape.Net.read("examples/hemisphere_net/scene.toml")
    /// >>> float(net.shear_deg.max().round(3))
    /// 38.005
    #[staticmethod]
    fn read(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let drape = parallel(py, || scene::read_ideal_drape(&path));
        drape.map(|drape| Net(Arc::new(drape.net))).map_err(|refused| error::scene(&refused))
    }

    /// Places of the nodes (m), shape (along u, along v, 3); nan where a node has no place on the mold.
    #[getter]
    fn nodes(&self) -> Array<f64> {
        let [nu, nv] = self.0.placement.nodes;
        let node = |i: usize, j: usize| self.0.nodes[j * nu + i].unwrap_or([f64::NAN; 3]);
        Array::rows(&[nu, nv, 3], (0..nu).flat_map(|i| (0..nv).map(move |j| node(i, j))))
    }

    /// Shear angle of each cell (°), shape (along u − 1, along v − 1); nan where a corner has no place, and in cells of which
    /// less than half is on the ply.
    #[getter]
    fn shear_deg(&self) -> Array<f64> {
        let [nu, nv] = self.0.placement.nodes.map(|n| n - 1);
        let cell = |i, j| or_nan(self.0.cell_shear([i, j]).map(|s| s.angle.to_degrees()));
        Array::new(&[nu, nv], (0..nu).flat_map(|i| (0..nv).map(move |j| cell(i, j))).collect())
    }

    /// Whether each node is on the ply, shape (along u, along v); the net of a ply that is cut covers the box around it.
    #[getter]
    fn on_ply(&self) -> Array<bool> {
        let ([nu, nv], coverage) = (self.0.placement.nodes, self.0.coverage());
        let node = |i: usize, j: usize| coverage.node([i, j]);
        Array::new(
            &[nu, nv],
            (0..nu).flat_map(|i| (0..nv).map(move |j| [i, j])).map(|[i, j]| node(i, j)).collect(),
        )
    }

    /// Fabric between neighboring nodes along u and v (m).
    #[getter]
    fn mesh(&self) -> (f64, f64) {
        self.0.placement.mesh.into()
    }

    /// Why each node of the ply without a place has none, those closest to the seed first: indices and reason.
    #[getter]
    fn missing(&self) -> Vec<((usize, usize), String)> {
        self.0.missing.iter().map(|m| (m.node.into(), m.to_string())).collect()
    }

    /// Largest error of a length between neighboring nodes (m).
    #[getter]
    fn largest_edge_error(&self) -> f64 {
        self.0.report.largest_edge_error
    }

    fn __repr__(&self) -> String {
        let [nu, nv] = self.0.placement.nodes;
        format!("<plydrape.Net of {nu} × {nv} nodes>")
    }
}
