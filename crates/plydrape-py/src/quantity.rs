//! Quantities as arguments: a plain number is in SI units, a text carries its unit.

use plydrape_io::scene::usual::{self, Usual};
use plydrape_io::scene::{Measured, quantity};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// A quantity as Python gives it.
#[derive(FromPyObject, Clone)]
pub enum Amount {
    /// In SI units.
    Number(f64),
    /// With its unit.
    Text(String),
}

impl Amount {
    /// The value in SI units, a plain number near what is usual; `name` is that of the argument. It is finite, but a force may be infinite.
    pub fn si(&self, name: &str, measured: Measured, usual: &Usual) -> PyResult<f64> {
        let text = match self {
            Amount::Number(value) => &value.to_string().to_lowercase(),
            Amount::Text(text) => text,
        };
        let value = quantity(text, measured, usual).map_err(|refused| {
            PyValueError::new_err(format!("{name}: {}; {}", refused.message(), refused.help()))
        })?;
        match value.is_finite() || measured == Measured::Force {
            true => Ok(value),
            false => Err(refused(name, value, "a finite number")),
        }
    }

    /// As [`Amount::si`], and above zero.
    pub fn positive(&self, name: &str, measured: Measured, usual: &Usual) -> PyResult<f64> {
        let value = self.si(name, measured, usual)?;
        if value > 0.0 { Ok(value) } else { Err(refused(name, value, "a positive number")) }
    }

    /// As [`Amount::si`] of one that may be left out.
    pub fn given(
        amount: Option<Self>,
        name: &str,
        measured: Measured,
        usual: &Usual,
    ) -> PyResult<Option<f64>> {
        amount.map(|amount| amount.si(name, measured, usual)).transpose()
    }

    /// As a scene file has it.
    pub fn toml(&self) -> String {
        match self {
            Amount::Number(value) => format!("{value:?}").replace("NaN", "nan"),
            Amount::Text(text) => serde_json::Value::from(text.as_str()).to_string(),
        }
    }
}

fn refused(name: &str, value: f64, expected: &str) -> PyErr {
    PyValueError::new_err(format!("{name} is {value}; expected {expected}"))
}

/// A quantity in SI units, for what is written in Python: an angle (rad) or a length (m).
#[pyfunction]
#[pyo3(name = "_si", signature = (value: "float | str", measured: "str", name: "str"))]
pub fn si(value: Amount, measured: &str, name: &str) -> PyResult<f64> {
    let measured = match measured {
        "angle" => Measured::Angle,
        _ => Measured::Length,
    };
    value.si(name, measured, &usual::ANY)
}
