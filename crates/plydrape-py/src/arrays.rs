//! NumPy arrays of a fixed number of axes, in and out. What leaves is handed over, not copied.

use numpy::{AllowTypeChange, Element, PyArray, PyArrayDyn, PyArrayLike, PyArrayMethods};
use numpy::{Ix1, Ix2, Ix3, IxDyn};
use pyo3::inspect::PyStaticExpr;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// `numpy.typing.` followed by a name.
const fn typing(name: &'static str) -> PyStaticExpr {
    PyStaticExpr::Attribute { value: &PyStaticExpr::Name { id: "numpy.typing" }, attr: name }
}

/// `numpy.typing.NDArray` of a type of `numpy`.
macro_rules! array_of {
    ($name:literal) => {
        PyStaticExpr::Subscript {
            value: &typing("NDArray"),
            slice: &PyStaticExpr::Attribute {
                value: &PyStaticExpr::Name { id: "numpy" },
                attr: $name,
            },
        }
    };
}

/// A number that an array holds.
pub trait Number: Element {
    /// Type of the array in Python.
    const ARRAY: PyStaticExpr;
}

impl Number for f64 {
    const ARRAY: PyStaticExpr = array_of!("float64");
}
impl Number for bool {
    const ARRAY: PyStaticExpr = array_of!("bool_");
}
impl Number for u32 {
    const ARRAY: PyStaticExpr = array_of!("uint32");
}
impl Number for i64 {
    const ARRAY: PyStaticExpr = array_of!("int64");
}

/// Numbers on their way to Python, the last axis running fastest.
pub struct Array<T> {
    shape: Vec<usize>,
    values: Vec<T>,
}

impl<T> Array<T> {
    /// Numbers with their shape, whose product is their count.
    pub fn new(shape: &[usize], values: Vec<T>) -> Self {
        Array { shape: shape.to_vec(), values }
    }

    /// Rows of numbers, one after another.
    pub fn rows<const N: usize>(shape: &[usize], rows: impl IntoIterator<Item = [T; N]>) -> Self {
        Array::new(shape, rows.into_iter().flatten().collect())
    }
}

/// Numbers where there are some, else not-a-number.
pub fn or_nan(value: Option<f64>) -> f64 {
    value.unwrap_or(f64::NAN)
}

impl<'py, T: Number> IntoPyObject<'py> for Array<T> {
    type Target = PyArrayDyn<T>;
    type Output = Bound<'py, PyArrayDyn<T>>;
    type Error = PyErr;
    const OUTPUT_TYPE: PyStaticExpr = T::ARRAY;

    fn into_pyobject(self, py: Python<'py>) -> PyResult<Self::Output> {
        PyArray::from_vec(py, self.values).reshape(IxDyn(&self.shape))
    }
}

/// Arrays by name.
pub struct Named(pub Vec<(&'static str, Array<f64>)>);

impl<'py> IntoPyObject<'py> for Named {
    type Target = PyDict;
    type Output = Bound<'py, PyDict>;
    type Error = PyErr;
    const OUTPUT_TYPE: PyStaticExpr = PyStaticExpr::Subscript {
        value: &PyStaticExpr::Name { id: "dict" },
        slice: &PyStaticExpr::Tuple { elts: &[PyStaticExpr::Name { id: "str" }, f64::ARRAY] },
    };

    fn into_pyobject(self, py: Python<'py>) -> PyResult<Self::Output> {
        let out = PyDict::new(py);
        for (name, array) in self.0 {
            out.set_item(name, array)?;
        }
        Ok(out)
    }
}

/// Numbers from Python, read in place where they are floats already: an array or nested lists.
pub struct Numbers<'py, D: numpy::ndarray::Dimension>(
    pub PyArrayLike<'py, f64, D, AllowTypeChange>,
);

/// One axis.
pub type List<'py> = Numbers<'py, Ix1>;
/// Two axes.
pub type Table<'py> = Numbers<'py, Ix2>;
/// Three axes.
pub type Block<'py> = Numbers<'py, Ix3>;

impl<'a, 'py, D: numpy::ndarray::Dimension + 'py> FromPyObject<'a, 'py> for Numbers<'py, D>
where
    PyArrayLike<'py, f64, D, AllowTypeChange>: FromPyObject<'a, 'py, Error = PyErr>,
{
    type Error = PyErr;
    const INPUT_TYPE: PyStaticExpr = typing("ArrayLike");

    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        object.extract().map(Numbers)
    }
}

/// Points as rows of three; `what` names them in the error.
pub fn points(table: &Table, what: &str) -> PyResult<Vec<[f64; 3]>> {
    let view = table.0.as_array();
    let (rows, columns) = view.dim();
    if columns != 3 {
        return Err(wrong_shape(what, "(n, 3)", &[rows, columns]));
    }
    let points: Vec<[f64; 3]> = view.rows().into_iter().map(|p| [p[0], p[1], p[2]]).collect();
    check_finite(what, points.as_flattened())?;
    Ok(points)
}

/// Steps of points, `(steps, points, 3)`.
pub fn steps(block: &Block, what: &str, count: usize) -> PyResult<Vec<Vec<[f64; 3]>>> {
    let view = block.0.as_array();
    let (steps, rows, columns) = view.dim();
    if rows != count || columns != 3 {
        return Err(wrong_shape(what, &format!("(n, {count}, 3)"), &[steps, rows, columns]));
    }
    let mut out = Vec::with_capacity(steps);
    for step in view.outer_iter() {
        let points: Vec<[f64; 3]> = step.rows().into_iter().map(|p| [p[0], p[1], p[2]]).collect();
        check_finite(what, points.as_flattened())?;
        out.push(points);
    }
    Ok(out)
}

/// Numbers of one axis.
pub fn list(list: &List, what: &str) -> PyResult<Vec<f64>> {
    let values = list.0.as_array().to_vec();
    check_finite(what, &values)?;
    Ok(values)
}

/// A fault of an argument's shape.
pub fn wrong_shape(what: &str, wanted: &str, found: &[usize]) -> PyErr {
    let found: Vec<String> = found.iter().map(ToString::to_string).collect();
    let comma = if found.len() == 1 { "," } else { "" };
    pyo3::exceptions::PyValueError::new_err(format!(
        "{what} has the shape ({}{comma}); {wanted} is wanted",
        found.join(", ")
    ))
}

fn check_finite(what: &str, values: &[f64]) -> PyResult<()> {
    match values.iter().find(|value| !value.is_finite()) {
        None => Ok(()),
        Some(value) => Err(pyo3::exceptions::PyValueError::new_err(format!(
            "{what} holds {value}; finite numbers are wanted"
        ))),
    }
}
