//! Errors of the library as the exceptions of `plydrape.errors`, with the same words.

use plydrape_io::OutputError;
use plydrape_io::result::read::ReadError;
use plydrape_io::scene::SceneError;
use plydrape_io::sheet::SheetDrapeError;
use plydrape_io::size::SizeError;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::fmt::Display;

/// An exception of `plydrape.errors` by its name, with fields.
fn raise(py: Python<'_>, name: &str, text: &dyn Display, fields: &Bound<'_, PyDict>) -> PyErr {
    let made = || -> PyResult<PyErr> {
        let class = py.import("plydrape.errors")?.getattr(name)?;
        Ok(PyErr::from_value(class.call((text.to_string(),), Some(fields))?))
    };
    made().unwrap_or_else(|error| error)
}

fn plain(name: &str, text: &dyn Display) -> PyErr {
    Python::attach(|py| raise(py, name, text, &PyDict::new(py)))
}

/// A refused scene.
pub fn scene(error: &SceneError) -> PyErr {
    Python::attach(|py| {
        let fields = || -> PyResult<Bound<'_, PyDict>> {
            let fields = PyDict::new(py);
            let (line, column) = error.line_column().unzip();
            fields.set_item("file", &error.file)?;
            fields.set_item("line", line)?;
            fields.set_item("column", column)?;
            fields.set_item("message", &error.message)?;
            fields.set_item("help", &error.help)?;
            Ok(fields)
        };
        match fields() {
            Ok(fields) => raise(py, "SceneError", error, &fields),
            Err(error) => error,
        }
    })
}

/// A scene whose sheet was not draped.
pub fn sheet(fault: &SheetDrapeError) -> PyErr {
    match fault {
        SheetDrapeError::States(_) => plain("OutputError", &format!("{fault}; {}", fault.remedy())),
        SheetDrapeError::Sheet(_) | SheetDrapeError::Size(_) => scene(&SceneError {
            file: "scene".into(),
            text: "".into(),
            span: None,
            message: fault.to_string(),
            help: fault.remedy().into(),
        }),
    }
}

/// Work that would take too much memory.
pub fn too_large(fault: &SizeError) -> PyErr {
    PyValueError::new_err(format!("{fault}; {}", fault.remedy()))
}

/// A scene without a plan.
pub fn plan(error: &dyn Display) -> PyErr {
    plain("PlanError", error)
}

/// A result file that is none.
pub fn read(error: &ReadError) -> PyErr {
    plain("ResultError", &format!("{error}; {}", error.remedy()))
}

/// Results that could not be written.
pub fn output(error: &OutputError) -> PyErr {
    plain("OutputError", error)
}

/// An equilibrium or a span without a solution.
pub fn solve(text: &str, status: &str, iterations: usize, residual: f64) -> PyErr {
    Python::attach(|py| {
        let fields = || -> PyResult<Bound<'_, PyDict>> {
            let fields = PyDict::new(py);
            fields.set_item("status", status)?;
            fields.set_item("iterations", iterations)?;
            fields.set_item("residual", residual)?;
            Ok(fields)
        };
        match fields() {
            Ok(fields) => raise(py, "SolveError", &text, &fields),
            Err(error) => error,
        }
    })
}
