//! What the library writes as JSON, as dicts and lists.

use pyo3::exceptions::PyValueError;
use pyo3::inspect::PyStaticExpr;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use serde::Serialize;
use serde_json::Value;

/// Keys and values on their way to Python.
pub struct Json(Value);

impl Json {
    /// Anything that can be written.
    pub fn of<T: Serialize>(value: &T) -> PyResult<Self> {
        let fault = |fault: serde_json::Error| PyValueError::new_err(fault.to_string());
        serde_json::to_value(value).map(Json).map_err(fault)
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
        object(py, &self.0)
    }
}

fn object<'py>(py: Python<'py>, value: &Value) -> PyResult<Bound<'py, PyAny>> {
    Ok(match value {
        Value::Null => py.None().into_bound(py),
        Value::Bool(switch) => switch.into_pyobject(py)?.to_owned().into_any(),
        Value::Number(number) => match (number.as_i64(), number.as_u64()) {
            (Some(whole), _) => whole.into_pyobject(py)?.into_any(),
            (_, Some(whole)) => whole.into_pyobject(py)?.into_any(),
            _ => number.as_f64().into_pyobject(py)?,
        },
        Value::String(text) => text.into_pyobject(py)?.into_any(),
        Value::Array(items) => {
            let list = PyList::empty(py);
            for item in items {
                list.append(object(py, item)?)?;
            }
            list.into_any()
        }
        Value::Object(keys) => {
            let dict = PyDict::new(py);
            for (key, value) in keys {
                dict.set_item(key, object(py, value)?)?;
            }
            dict.into_any()
        }
    })
}
