//! What the library writes as JSON, as dicts and lists.

use crate::error;
use plydrape_io::json;
use pyo3::inspect::PyStaticExpr;
use pyo3::prelude::*;
use serde::Serialize;

/// Keys and values on their way to Python.
pub struct Json(String);

impl Json {
    /// Anything that can be written.
    pub fn of<T: Serialize>(value: &T) -> PyResult<Self> {
        json::of(value).map(Json).map_err(|fault| error::output(&fault.into()))
    }
}

impl<'py> IntoPyObject<'py> for Json {
    type Target = PyAny;
    type Output = Bound<'py, PyAny>;
    type Error = PyErr;
    const OUTPUT_TYPE: PyStaticExpr = PyStaticExpr::Subscript {
        value: &PyStaticExpr::Name { id: "dict" },
        slice: &PyStaticExpr::Tuple {
            elts: &[
                PyStaticExpr::Name { id: "str" },
                PyStaticExpr::Attribute {
                    value: &PyStaticExpr::Name { id: "typing" },
                    attr: "Any",
                },
            ],
        },
    };

    fn into_pyobject(self, py: Python<'py>) -> PyResult<Self::Output> {
        py.import("json")?.call_method1("loads", (self.0,))
    }
}
