//! Keyword arguments as the scene file that a user would have written.
//!
//! So a scene from Python is checked by the same rules, refused in the same words, and kept in its results.

use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyString};
use toml::Value;
use toml::map::Map;

/// Deepest nesting of dicts and lists.
const DEEPEST: usize = 16;

/// A dict as a TOML table; keys that are `None` are left out. `place` names it in errors.
pub fn table(dict: &Bound<'_, PyDict>, place: &str) -> PyResult<Map<String, Value>> {
    dict_at(dict, place, DEEPEST)
}

/// Any value of a table. `place` names it in errors.
pub fn value(value: &Bound<'_, PyAny>, place: &str) -> PyResult<Value> {
    value_at(value, place, DEEPEST)
}

/// The text of tables.
pub fn text(keys: &Map<String, Value>) -> PyResult<String> {
    toml::to_string(keys).map_err(|fault| PyValueError::new_err(fault.to_string()))
}

/// A TOML table as a dict.
pub fn dict<'py>(py: Python<'py>, table: &Map<String, Value>) -> PyResult<Bound<'py, PyDict>> {
    let out = PyDict::new(py);
    for (key, value) in table {
        out.set_item(key, object(py, value)?)?;
    }
    Ok(out)
}

fn object<'py>(py: Python<'py>, value: &Value) -> PyResult<Bound<'py, PyAny>> {
    Ok(match value {
        Value::String(text) => PyString::new(py, text).into_any(),
        Value::Integer(number) => number.into_pyobject(py)?.into_any(),
        Value::Float(number) => PyFloat::new(py, *number).into_any(),
        Value::Boolean(flag) => PyBool::new(py, *flag).to_owned().into_any(),
        // no scene has one
        Value::Datetime(time) => PyString::new(py, &time.to_string()).into_any(),
        Value::Array(items) => {
            let items = items.iter().map(|item| object(py, item)).collect::<PyResult<Vec<_>>>()?;
            PyList::new(py, items)?.into_any()
        }
        Value::Table(table) => dict(py, table)?.into_any(),
    })
}

fn dict_at(dict: &Bound<'_, PyDict>, place: &str, depth: usize) -> PyResult<Map<String, Value>> {
    let mut out = Map::new();
    for (key, value) in dict {
        let Ok(key) = key.extract::<String>() else {
            return Err(PyTypeError::new_err(format!("{place} has the key {key}; expected a str")));
        };
        if !value.is_none() {
            let value = value_at(&value, &format!("{place}[{key:?}]"), depth)?;
            out.insert(key, value);
        }
    }
    Ok(out)
}

fn value_at(value: &Bound<'_, PyAny>, place: &str, depth: usize) -> PyResult<Value> {
    let Some(deeper) = depth.checked_sub(1) else {
        return Err(PyValueError::new_err(format!("{place} is nested too deeply for a scene")));
    };
    if let Ok(dict) = value.cast::<PyDict>() {
        return Ok(Value::Table(dict_at(dict, place, deeper)?));
    }
    if let Ok(text) = value.cast::<PyString>() {
        return Ok(Value::String(text.to_str()?.to_owned()));
    }
    if value.is_instance_of::<PyBool>() {
        return Ok(Value::Boolean(value.extract()?));
    }
    if value.is_instance_of::<PyInt>() {
        return Ok(Value::Integer(value.extract()?));
    }
    if value.is_instance_of::<PyFloat>() {
        return Ok(Value::Float(value.extract()?));
    }
    // arrays and numbers of NumPy say themselves what they are
    if value.hasattr("tolist")? {
        return value_at(&value.call_method0("tolist")?, place, deeper);
    }
    // paths
    if value.hasattr("__fspath__")? {
        return value_at(&value.call_method0("__fspath__")?, place, deeper);
    }
    let Ok(items) = value.try_iter() else {
        return Err(PyTypeError::new_err(format!(
            "{place} is of type {}; expected a number, str, bool, dict, list or array",
            value.get_type().name()?
        )));
    };
    let items =
        items.enumerate().map(|(n, item)| value_at(&item?, &format!("{place}[{n}]"), deeper));
    Ok(Value::Array(items.collect::<PyResult<_>>()?))
}
