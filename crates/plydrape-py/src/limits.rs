//! Judged limits as `plydrape.limits.Limits`.

use crate::json::Json;
use plydrape::measure::Verdict;
use pyo3::inspect::PyStaticExpr;
use pyo3::prelude::*;

/// Verdicts on their way to Python.
pub struct Limits(Vec<Json>);

impl Limits {
    /// Some verdicts, each of another measure.
    pub fn new<'a>(verdicts: impl IntoIterator<Item = &'a Verdict>) -> PyResult<Self> {
        verdicts.into_iter().map(Json::new).collect::<PyResult<_>>().map(Limits)
    }
}

impl<'py> IntoPyObject<'py> for Limits {
    type Target = PyAny;
    type Output = Bound<'py, PyAny>;
    type Error = PyErr;
    const OUTPUT_TYPE: PyStaticExpr = PyStaticExpr::Attribute {
        value: &PyStaticExpr::Name { id: "plydrape.limits" },
        attr: "Limits",
    };

    fn into_pyobject(self, py: Python<'py>) -> PyResult<Self::Output> {
        py.import("plydrape.limits")?.getattr("Limits")?.call_method1("of", (self.0,))
    }
}
