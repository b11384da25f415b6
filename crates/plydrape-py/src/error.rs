//! Errors of the library as the exceptions of `plydrape.errors`, with the same words.

use plydrape_io::{Diagnostic, Error};
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

/// The error about a file that the file system refused, which is also the exception that Python has for that.
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

/// A refused scene: with its place, and as the exception that Python has where the file system refused a file.
pub fn diagnostic(fault: &Diagnostic) -> PyErr {
    Python::attach(|py| {
        let fields = || -> PyResult<Bound<'_, PyDict>> {
            let fields = PyDict::new(py);
            let (line, column) = fault.line_column().unzip();
            fields.set_item("file", &fault.file)?;
            fields.set_item("line", line)?;
            fields.set_item("column", column)?;
            fields.set_item("message", &fault.message)?;
            fields.set_item("help", &fault.help)?;
            Ok(fields)
        };
        let raised = match fields() {
            Ok(fields) => raise(py, "SceneError", fault, &fields),
            Err(error) => return error,
        };
        match &fault.unread {
            Some((path, kind)) => of_file(py, raised, path, *kind),
            None => raised,
        }
    })
}

/// A scene of which no place is at fault.
pub fn refused(message: &(impl Display + ?Sized), help: &str) -> Diagnostic {
    Diagnostic::new("scene", message.to_string(), help)
}

/// What was wrong and what would help, in one line.
pub fn text(error: &Error) -> String {
    match error.help() {
        "" => error.to_string(),
        help => format!("{}; {help}", error.message()),
    }
}

/// A refused scene as such, and another error as an exception of `plydrape.errors` by its name.
fn other(name: &str, error: &Error) -> PyErr {
    if let Some(fault) = error.diagnostic() {
        return diagnostic(fault);
    }
    match error.refused_path() {
        Some((path, kind)) => plain_of_file(name, &text(error), path, kind),
        None => plain(name, &text(error)),
    }
}

/// A scene that cannot be used, or was not draped.
pub fn scene(error: &Error) -> PyErr {
    match error {
        Error::NotPossible { .. } | Error::TooLarge { .. } => {
            diagnostic(&refused(&error.message(), error.help()))
        }
        _ => other("OutputError", error),
    }
}

/// Work that would take too much memory, or numbers of a test that say no law.
pub fn value(error: &Error) -> PyErr {
    match error.diagnostic() {
        Some(fault) => diagnostic(fault),
        None => PyValueError::new_err(text(error)),
    }
}

/// A scene without a plan.
pub fn plan(error: &dyn Display) -> PyErr {
    plain("PlanError", error)
}

/// A result file that is none.
pub fn read(error: &Error) -> PyErr {
    other("ResultError", error)
}

/// Results that could not be written.
pub fn output(error: &Error) -> PyErr {
    other("OutputError", error)
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
