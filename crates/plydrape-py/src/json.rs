//! What the library writes as JSON, as dicts and lists.

use crate::error;
use plydrape_io::store::json;
use pyo3::inspect::PyStaticExpr;
use pyo3::prelude::*;
use serde::Serialize;

/// Keys and values on their way to Python.
pub struct Json(String);

impl Json {
    /// Anything that can be written.
    pub fn new<T: Serialize>(value: &T) -> PyResult<Self> {
        json::to_text(value).map(Json).map_err(|fault| error::output(&fault))
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

/// Numbers of which some are not-a-number, which JSON does not have.
pub mod or_null {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub fn serialize<S: Serializer>(numbers: &[f64], to: S) -> Result<S::Ok, S::Error> {
        let numbers: Vec<_> = numbers.iter().map(|x| Some(*x).filter(|x| !x.is_nan())).collect();
        numbers.serialize(to)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<f64>, D::Error> {
        let numbers = Vec::<Option<f64>>::deserialize(from)?;
        Ok(numbers.into_iter().map(|x| x.unwrap_or(f64::NAN)).collect())
    }
}
