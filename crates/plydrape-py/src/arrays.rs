//! NumPy arrays, in and out. What leaves is handed over, not copied; what comes may be any numbers that NumPy makes an array
//! of: lists, views that are not contiguous, integers, single precision.

use numpy::{Element, IxDyn, PyArray, PyArrayDyn, PyArrayMethods};
use plydrape::ply::Ply;
use pyo3::exceptions::{PyTypeError, PyValueError};
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

/// What Python gives for an array: an array or nested lists of numbers.
pub struct Numbers<'py>(Bound<'py, PyAny>);

impl<'a, 'py> FromPyObject<'a, 'py> for Numbers<'py> {
    type Error = PyErr;
    const INPUT_TYPE: PyStaticExpr = typing("ArrayLike");

    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        Ok(Numbers(object.to_owned()))
    }
}

/// Finite numbers with their shape, the last axis running fastest.
pub struct Read {
    pub shape: Vec<usize>,
    pub values: Vec<f64>,
}

impl Numbers<'_> {
    /// The numbers; `what` names them in errors, `wanted` is their shape in words.
    fn read(&self, what: &str, wanted: &str) -> PyResult<Read> {
        let (shape, values) = self.of_type::<f64>("float64", what, wanted)?;
        let read = Read { shape, values };
        read.check_finite(what)?;
        Ok(read)
    }

    /// Whole numbers of two axes, of which the second one has a length.
    pub fn indices<const N: usize>(&self, what: &str, wanted: &str) -> PyResult<Vec<[i64; N]>> {
        let (shape, values) = self.of_type::<i64>("int64", what, wanted)?;
        match shape[..] {
            [_, columns] if columns == N => Ok(values.as_chunks().0.to_vec()),
            _ => Err(wrong_shape(what, wanted, &shape)),
        }
    }

    /// The array that NumPy makes of it, if that holds numbers, none of which is masked; else why it is none.
    fn array(&self, whole: bool) -> PyResult<Result<Bound<'_, PyAny>, String>> {
        let numpy = self.0.py().import("numpy")?;
        let array = numpy.call_method1("asanyarray", (&self.0,))?;
        if numpy.getattr("ma")?.call_method1("is_masked", (&array,))?.is_truthy()? {
            return Ok(Err("some of it is masked; leave that out, or fill it in".into()));
        }
        let held = match array.getattr("dtype")?.getattr("kind")?.extract::<char>()? {
            'b' | 'i' | 'u' => return Ok(Ok(array)),
            'f' if !whole || array.getattr("size")?.extract::<usize>()? == 0 => {
                return Ok(Ok(array));
            }
            'f' => "numbers that are not whole; make them so with .astype(int)",
            'c' => "complex numbers; take their real part",
            'U' | 'S' => "texts; make them numbers with .astype(float)",
            'M' | 'm' => "times of a calendar; make them seconds",
            _ => "objects of Python; make them numbers with .astype(float)",
        };
        Ok(Err(format!("it holds {held}")))
    }

    fn of_type<T: Element + Copy>(
        &self,
        name: &str,
        what: &str,
        wanted: &str,
    ) -> PyResult<(Vec<usize>, Vec<T>)> {
        // what is no array of numbers is refused; the rest gets one type
        let py = self.0.py();
        let keywords = PyDict::new(py);
        keywords.set_item("dtype", name)?;
        let none = |said: &str| {
            format!(
                "{what} is no array of numbers ({said}); expected numbers of the shape {wanted}"
            )
        };
        let array = self.array(name == "int64").and_then(|array| match array {
            Ok(array) => py.import("numpy")?.call_method("asarray", (array,), Some(&keywords)),
            Err(why) => Err(PyTypeError::new_err(why)),
        });

        // the error says what was expected, and keeps the fault of NumPy as its cause
        let array = array.map_err(|fault| {
            let text = none(&fault.value(py).to_string());
            let made = match fault.is_instance_of::<PyTypeError>(py) {
                true => PyTypeError::new_err(text),
                false => PyValueError::new_err(text),
            };
            made.set_cause(py, Some(fault));
            made
        })?;

        // the shape, and the numbers with the last axis running fastest
        let array = array.cast_into::<PyArrayDyn<T>>()?.readonly();
        let view = array.as_array();
        Ok((view.shape().to_vec(), view.iter().copied().collect()))
    }

    /// Numbers of one axis.
    pub fn list(&self, what: &str) -> PyResult<Vec<f64>> {
        let read = self.read(what, "(n,)")?;
        match read.shape.len() {
            1 => Ok(read.values),
            _ => Err(wrong_shape(what, "(n,)", &read.shape)),
        }
    }

    /// Numbers of any shape.
    pub fn any(&self, what: &str) -> PyResult<Read> {
        self.read(what, "(…)")
    }

    /// Points of any number of axes, the last of which has their N coordinates: the other axes, and the points.
    pub fn points<const N: usize>(&self, what: &str) -> PyResult<(Vec<usize>, Vec<[f64; N]>)> {
        let wanted = format!("(n, {N}) or (…, {N})");
        let mut read = self.read(what, &wanted)?;
        match read.shape.pop() {
            Some(last) if last == N && !read.shape.is_empty() => {
                Ok((read.shape, read.values.as_chunks().0.to_vec()))
            }
            last => {
                read.shape.extend(last);
                Err(wrong_shape(what, &wanted, &read.shape))
            }
        }
    }

    /// Positions of a ply's grippers: (grippers, 3), or of a whole array (along u, along v, 3).
    pub fn places(&self, what: &str, ply: &Ply) -> PyResult<Vec<[f64; 3]>> {
        let wanted = shapes(ply, "");
        let read = self.read(what, &wanted)?;
        let places = read.steps(ply, 1).and_then(|mut steps| steps.pop());
        places.ok_or_else(|| wrong_shape(what, &wanted, &read.shape))
    }

    /// Positions of a ply's grippers in steps: (steps, grippers, 3), or of a whole array (steps, along u, along v, 3).
    pub fn steps(&self, what: &str, ply: &Ply) -> PyResult<Vec<Vec<[f64; 3]>>> {
        let wanted = shapes(ply, "steps, ");
        let Read { shape, values } = self.read(what, &wanted)?;
        let found = match &shape[..] {
            [steps, step @ ..] => Read { shape: step.to_vec(), values }.steps(ply, *steps),
            [] => None,
        };
        found.ok_or_else(|| wrong_shape(what, &wanted, &shape))
    }
}

/// Shapes that positions of a ply's grippers can have.
fn shapes(ply: &Ply, before: &str) -> String {
    let one = format!("({before}{}, 3)", ply.grippers());
    let grid = ply.grid;
    match grid.nu * grid.nv == ply.grippers() {
        true => format!("{one} or ({before}{}, {}, 3)", grid.nu, grid.nv),
        false => one,
    }
}

impl Read {
    /// The positions of a number of steps; `None` if the shape of a step is no other.
    fn steps(&self, ply: &Ply, steps: usize) -> Option<Vec<Vec<[f64; 3]>>> {
        let (count, grid) = (ply.grippers(), ply.grid);
        let points = self.values.as_chunks::<3>().0;
        let by_step = points.chunks_exact(count.max(1));
        let found: Vec<Vec<[f64; 3]>> = match self.shape[..] {
            [rows, 3] if rows == count => by_step.map(<[_]>::to_vec).collect(),
            // i along u is the first axis here, and runs fastest there
            [nu, nv, 3] if [nu, nv] == [grid.nu, grid.nv] && nu * nv == count => by_step
                .map(|step| (0..count).map(|n| step[(n % nu) * nv + n / nu]).collect())
                .collect(),
            _ => return None,
        };
        (found.len() == steps).then_some(found)
    }

    fn check_finite(&self, what: &str) -> PyResult<()> {
        let Some(index) = self.values.iter().position(|value| !value.is_finite()) else {
            return Ok(());
        };
        let mut rest = index;
        let mut place: Vec<String> = Vec::new();
        for length in self.shape.iter().rev() {
            place.push((rest % length).to_string());
            rest /= length;
        }
        place.reverse();
        let place = if place.is_empty() {
            what.to_owned()
        } else {
            format!("{what}[{}]", place.join(", "))
        };
        Err(PyValueError::new_err(format!(
            "{place} is {}; expected finite numbers",
            self.values[index]
        )))
    }
}

/// A fault of an argument's shape.
fn wrong_shape(what: &str, wanted: &str, found: &[usize]) -> PyErr {
    let found: Vec<String> = found.iter().map(ToString::to_string).collect();
    let comma = if found.len() == 1 { "," } else { "" };
    PyValueError::new_err(format!(
        "{what} has the shape ({}{comma}); expected {wanted}",
        found.join(", ")
    ))
}
