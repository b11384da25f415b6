//! Stations: points along free spans at equal parts of their runs.

use plydrape::draping::spans::FreeSpan;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// Points of spans at equal parts of their runs, end to end: `count` of each, two or more.
pub fn every_station(spans: &[FreeSpan], count: usize) -> impl Iterator<Item = (&FreeSpan, f64)> {
    let last = (count - 1) as f64;
    spans.iter().flat_map(move |span| (0..count).map(move |k| (span, k as f64 / last)))
}

/// A number of points that makes sense; `name` is that of the argument.
pub fn at_least_two(name: &str, count: usize) -> PyResult<usize> {
    match count {
        2..=100_000 => Ok(count),
        _ => Err(PyValueError::new_err(format!("{name} is {count}; 2 to 100 000 are possible"))),
    }
}
