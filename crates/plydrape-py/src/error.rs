//! Errors of the library as the exceptions of `plydrape.errors`, with the same words.

use plydrape::ModelError;
use plydrape_io::result::sheet::{SheetDrapeError, model_remedy};
use plydrape_io::scene::{SceneError, Unread};
use plydrape_io::store::size::SizeError;
use plydrape_io::{OutputError, ReadError};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::fmt::Display;
use std::io;
use std::path::Path;

/// An exception of `plydrape.errors` by its name, with fields.
fn raise(py: Python<'_>, name: &str, text: &dyn Display, fields: &Bound<'_, PyDict>) -> PyErr {
    let made = || -> PyResult<PyErr> {
        let class = py.import("plydrape.errors")?.getattr(name)?;
        Ok(PyErr::from_value(class.call((text.to_string(),), Some(fields))?))
    };
    made().unwrap_or_else(|error| error)
}

/// The same about a file that the file system refused: also the exception that Python has for that.
fn of_file(py: Python<'_>, error: PyErr, path: &Path, kind: io::ErrorKind) -> PyErr {
    let kind = match kind {
        io::ErrorKind::NotFound => "FileNotFoundError",
        io::ErrorKind::PermissionDenied => "PermissionError",
        io::ErrorKind::IsADirectory => "IsADirectoryError",
        _ => "OSError",
    };
    let made = || -> PyResult<PyErr> {
        let make = py.import("plydrape.errors")?.getattr("of_file")?;
        Ok(PyErr::from_value(make.call1((error.value(py), kind, path))?))
    };
    made().unwrap_or_else(|error| error)
}

fn plain(name: &str, text: &dyn Display) -> PyErr {
    Python::attach(|py| raise(py, name, text, &PyDict::new(py)))
}

fn plain_of_file(name: &str, text: &dyn Display, path: &Path, kind: io::ErrorKind) -> PyErr {
    Python::attach(|py| of_file(py, plain(name, text), path, kind))
}

/// A file beside the scene, such as a template, that cannot be read.
pub fn unread(path: &Path, fault: &io::Error) -> PyErr {
    let text = format!("{} cannot be read: {fault}", path.display());
    plain_of_file("OutputError", &text, path, fault.kind())
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
        match (fields(), error.unread.as_deref()) {
            (Ok(fields), Some(Unread { path, kind })) => {
                of_file(py, raise(py, "SceneError", error, &fields), path, *kind)
            }
            (Ok(fields), None) => raise(py, "SceneError", error, &fields),
            (Err(error), _) => error,
        }
    })
}

/// A refused scene, of which no place is at fault.
pub fn refused(message: &(impl Display + ?Sized), help: &str) -> SceneError {
    SceneError {
        file: "scene".into(),
        text: "".into(),
        span: None,
        message: message.to_string(),
        help: help.into(),
        unread: None,
    }
}

/// A scene that a model cannot drape.
pub fn model(fault: &ModelError) -> PyErr {
    scene(&refused(fault, model_remedy(fault)))
}

/// A scene that was not draped.
pub fn sheet(fault: &SheetDrapeError) -> PyErr {
    match fault {
        SheetDrapeError::States(_) => plain("OutputError", &format!("{fault}; {}", fault.remedy())),
        SheetDrapeError::Model(_) | SheetDrapeError::Size(_) => {
            scene(&refused(fault, fault.remedy()))
        }
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
    let text = format!("{error}; {}", error.remedy());
    match error {
        ReadError::Unreadable { path, source } => {
            plain_of_file("ResultError", &text, path, source.kind())
        }
        _ => plain("ResultError", &text),
    }
}

/// Results that could not be written.
pub fn output(error: &OutputError) -> PyErr {
    match error {
        OutputError::Io { path, source, .. } => {
            plain_of_file("OutputError", error, path, source.kind())
        }
        _ => plain("OutputError", error),
    }
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
