//! `plydrape.Sample`: the verdict over a sample of cells with errors.

use crate::arrays::{Array, or_nan};
use crate::json::Json;
use crate::limits::Limits;
use plydrape::outcome::{CellVerdict, SampleVerdict};
use pyo3::prelude::*;

/// The verdict over a sample of cells, each with errors of its own: complete drapes along the same motion, up to the cell that decides.
///
/// Examples
/// --------
/// >>> tables = dict(
/// ...     ply=dict(grippers=[2, 2], cell=["100 mm", "100 mm"], material="krogh2018"),
/// ...     grippers=dict(spacing=["98 mm", "98 mm"], height="75 mm"),
/// ...     model=dict(kind="catenaries"),
/// ... )
/// >>> errors = dict(samples=8, gripper=dict(position=dict(bound="0.1 mm")))
/// >>> scene = plydrape.Scene(**tables, motion=dict(kind="hold"), errors=errors)
/// >>> plydrape.simulate(scene).sample
/// <plydrape.Sample of 8 cells, 8 accepted, accepted>
#[pyclass(frozen, module = "plydrape")]
pub struct Sample(pub SampleVerdict);

impl Sample {
    /// A number of each cell.
    fn cells(&self, number: impl Fn(&CellVerdict) -> f64) -> Array<f64> {
        Array::new(&[self.0.cells.len()], self.0.cells.iter().map(number).collect())
    }
}

#[pymethods]
impl Sample {
    /// How many cells keep every limit.
    #[getter]
    fn accepted(&self) -> usize {
        self.0.accepted()
    }

    /// How many cells of at most `errors.samples` must keep every limit.
    #[getter]
    fn needed(&self) -> usize {
        self.0.needed
    }

    /// Whether enough of them do, or as many without a failure as give 95 % confidence.
    #[getter]
    fn ok(&self) -> bool {
        self.0.ok
    }

    /// Confidence, from 0 to 1, that the share of all possible cells keeps every limit if `ok`, and that fewer do if not.
    #[getter]
    fn confidence(&self) -> f64 {
        self.0.confidence
    }

    /// Whether each cell keeps every limit, shape (cells,).
    #[getter]
    fn kept(&self) -> Array<bool> {
        Array::new(&[self.0.cells.len()], self.0.cells.iter().map(|cell| cell.accepted).collect())
    }

    /// The largest height of each cell's sheet at the end (mm), shape (cells,); nan where its drape has no end, and of
    /// catenaries.
    #[getter]
    fn heights_mm(&self) -> Array<f64> {
        self.cells(|cell| or_nan(cell.height_mm))
    }

    /// The largest height (mm) that the share of the cells keeps which must keep the limits; None of catenaries, or where
    /// fewer drapes have an end.
    #[getter]
    fn height_mm(&self) -> Option<f64> {
        self.0.height_mm()
    }

    /// The largest ratio of a measure to its limit in each cell, shape (cells,): above 1 it is not kept.
    #[getter]
    fn ratios(&self) -> Array<f64> {
        self.cells(|cell| cell.ratio)
    }

    /// Every limit, judged by the value that the share of the cells keeps, by its name, as in `Result.limits`.
    #[getter]
    fn limits(&self) -> PyResult<Limits> {
        Limits::new(&self.0.limits)
    }

    /// Where the sheet is highest by the height that the share of the cells keeps there: a dict with height_mm, uv_mm, line and
    /// gripper. None of catenaries.
    #[getter]
    fn highest(&self) -> PyResult<Option<Json>> {
        self.0.highest.as_ref().map(Json::new).transpose()
    }

    /// The height at each node of the sheet that the share of the cells keeps (mm), shape (nodes,), in four digits; empty of
    /// catenaries.
    #[getter]
    fn spread_mm(&self) -> Array<f64> {
        Array::new(&[self.0.spread_mm.len()], self.0.spread_mm.clone())
    }

    fn __len__(&self) -> usize {
        self.0.cells.len()
    }

    fn __repr__(&self) -> String {
        let (cells, accepted) = (self.0.cells.len(), self.0.accepted());
        let verdict = if self.0.ok { "accepted" } else { "not accepted" };
        format!("<plydrape.Sample of {cells} cells, {accepted} accepted, {verdict}>")
    }
}
