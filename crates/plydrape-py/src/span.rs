//! `plydrape.Span`.

use crate::arrays::{Array, List, list};
use crate::error;
use plydrape::catenary::{self, EndCondition, Profile, SpanState};
use plydrape::equilibrium::Status;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// One free span of ply between two ends in a vertical plane, solved: a catenary with bending stiffness.
///
/// Args:
///     run: Horizontal distance of the ends (m).
///     rise: Height of the second end above the first (m).
///     length: Fabric length between them (m).
///     weight: Weight per length (N/m).
///     flexural_rigidity: EI (N·m²); slopes can be prescribed only if it is positive.
///     axial_stiffness: EA (N); infinite for an inextensible ply.
///     slopes: Prescribed slope at each end, None where it is free.
///
/// Raises:
///     ValueError: If a number makes no sense.
///     SolveError: If no force was found.
///
/// Example:
///     A limp span hangs as a parabola, whose sag is nearly run·√(3/8·(length/run − 1)):
///
///     >>> span = plydrape.Span(run=0.1, length=0.101, weight=3.0, flexural_rigidity=1e-9)
///     >>> round(span.sag * 1e3, 2), round(1e2 * (3 / 8 * 0.01) ** 0.5, 2)
///     (6.15, 6.12)
#[pyclass(frozen, module = "plydrape")]
pub struct Span {
    span: catenary::Span,
    profile: Option<Profile>,
    state: SpanState,
}

#[pymethods]
impl Span {
    #[new]
    #[pyo3(signature = (
        *, run, length, weight, flexural_rigidity, rise = 0.0, axial_stiffness = 1e5,
        slopes = (None, None)
    ))]
    fn new(
        run: f64,
        length: f64,
        weight: f64,
        flexural_rigidity: f64,
        rise: f64,
        axial_stiffness: f64,
        slopes: (Option<f64>, Option<f64>),
    ) -> PyResult<Self> {
        let positive = [
            ("run", run, run.is_finite()),
            ("length", length, length.is_finite()),
            ("weight", weight, weight.is_finite()),
            ("axial_stiffness", axial_stiffness, true),
        ];
        let fault = |text: String| Err(PyValueError::new_err(text));
        for (name, value, finite) in positive {
            if !(value > 0.0 && finite) {
                return fault(format!("{name} is {value}; a positive number is wanted"));
            }
        }
        if !(flexural_rigidity >= 0.0 && flexural_rigidity.is_finite()) {
            return fault(format!("flexural_rigidity is {flexural_rigidity}; 0 or more is wanted"));
        }
        let given = [slopes.0, slopes.1];
        if flexural_rigidity == 0.0 && given.iter().any(Option::is_some) {
            return fault(
                "slopes are prescribed; without flexural_rigidity they must be free".into(),
            );
        }
        if !(rise.is_finite() && given.iter().flatten().all(|slope| slope.is_finite())) {
            return fault("rise and slopes must be finite".into());
        }
        let ends = given.map(|slope| slope.map_or(EndCondition::Free, EndCondition::Slope));
        let span =
            catenary::Span { run, rise, length, ends, weight, flexural_rigidity, axial_stiffness };
        let root = span.solve(None);
        if root.residual > 1e-8 {
            let text = format!(
                "no force gives the span its length: an error of {:.1e} of it is left",
                root.residual
            );
            let status = Status::LengthNotMet.name();
            return Err(error::solve(&text, status, root.evaluations, root.residual));
        }
        let profile = root.force.map(|force| Profile::new(&span, force));
        Ok(Span { span, profile, state: root.state })
    }

    /// Horizontal force H (N), negative in compression; None for a straight inextensible span.
    #[getter]
    fn force(&self) -> Option<f64> {
        self.profile.as_ref().map(Profile::force)
    }

    /// How it holds its length: "hanging", "overstretched" or "straight".
    #[getter]
    fn state(&self) -> &'static str {
        match self.state {
            SpanState::Hanging => "hanging",
            SpanState::Overstretched => "overstretched",
            SpanState::Straight => "straight",
        }
    }

    /// Slopes at both ends.
    #[getter]
    fn slopes(&self) -> (f64, f64) {
        let slope = |end| self.profile.as_ref().map_or(self.chord_slope(), |p| p.end_slope(end));
        (slope(0), slope(1))
    }

    /// Largest vertical distance below its chord (m).
    #[getter]
    fn sag(&self) -> f64 {
        self.profile.as_ref().map_or(0.0, |profile| profile.sag().0)
    }

    /// Height above the first end (m) at horizontal distances from it (m), shape (n,).
    ///
    /// Raises:
    ///     ValueError: If a distance is not between 0 and `run`.
    ///
    /// Example:
    ///     >>> span = plydrape.Span(run=0.1, length=0.101, weight=3.0, flexural_rigidity=1e-5)
    ///     >>> (span.heights([0, 0.05, 0.1]) * 1e3).round(2) + 0.0
    ///     array([ 0.  , -6.18,  0.  ])
    fn heights(&self, x: List<'_>) -> PyResult<Array<f64>> {
        let x = self.places(&x)?;
        let height = |x: f64| match &self.profile {
            Some(profile) => profile.station(x).z,
            None => self.chord_slope() * x,
        };
        Ok(Array::new(&[x.len()], x.iter().map(|x| height(*x)).collect()))
    }

    fn __repr__(&self) -> String {
        format!(
            "<plydrape.Span, {}, run {} m, length {} m>",
            self.state(),
            self.span.run,
            self.span.length
        )
    }
}

impl Span {
    fn chord_slope(&self) -> f64 {
        self.span.rise / self.span.run
    }

    fn places(&self, x: &List<'_>) -> PyResult<Vec<f64>> {
        let (x, run) = (list(x, "x")?, self.span.run);
        match x.iter().find(|x| !(0.0..=run).contains(*x)) {
            None => Ok(x),
            Some(x) => Err(PyValueError::new_err(format!(
                "x holds {x} m; 0 to the run of {run} m is wanted"
            ))),
        }
    }
}
