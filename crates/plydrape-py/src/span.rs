//! `plydrape.Span`.

use crate::arrays::{Array, Numbers};
use crate::error;
use crate::quantity::Amount;
use crate::stations::at_least_two;
use plydrape::catenary::{self, EndCondition, Profile, SpanState};
use plydrape::elastica::{Bending, HeavyStrip, Shape};
use plydrape::equilibrium::Status;
use plydrape::material::MomentCurve;
use plydrape_io::scene::{Measured, usual};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// One free span of ply between two ends in a vertical plane, solved: a catenary with bending stiffness, by the theory of small
/// sag or as the exact elastica.
///
/// Plain numbers are in SI units, a str carries its unit.
///
/// Parameters
/// ----------
/// run : float or str
///     Horizontal distance of the ends (m).
/// length : float or str
///     Fabric length between them (m).
/// weight : float or str
///     Weight per length (N/m).
/// flexural_rigidity : float or str, default 0.0
///     EI (N·m²); slopes can be prescribed only if it is positive.
/// rise : float or str, default 0.0
///     Height of the second end above the first (m).
/// axial_stiffness : float or str, optional
///     EA (N); infinite for an inextensible ply. 1e5 unless given; the exact theory has no stretch.
/// slopes : tuple of float or None, float, optional
///     Prescribed slope at each end, None where it is free.
/// theory : {"small-sag", "exact"}
///     "small-sag", in closed form, or "exact", the inextensible elastica of any sag.
/// moment : tuple of sequence, optional
///     Curvatures (1/m) and moments (N·m) of a strip whose moment is no straight line, in place of flexural_rigidity;
///     for the exact theory.
///
/// Raises
/// ------
/// ValueError
///     If a number makes no sense.
/// SolveError
///     If no force was found.
///
/// Examples
/// --------
/// A limp span hangs as a parabola, whose sag is nearly run·√(3/8·(length/run − 1)):
///
/// >>> span = plydrape.Span(run=0.1, length=0.101, weight=3.0, flexural_rigidity=1e-9)
/// >>> round(span.sag * 1e3, 2), round(1e2 * (3 / 8 * 0.01) ** 0.5, 2)
/// (6.15, 6.12)
///
/// The elastica of a strip of the paper's ply, and the theory of small sag beside it:
///
/// >>> strip = dict(run=0.09, length=0.1, weight=3.08014, flexural_rigidity=9e-6)
/// >>> exact = plydrape.Span(**strip, theory="exact")
/// >>> round(exact.force, 5), round(plydrape.Span(**strip, axial_stiffness=np.inf).force, 5)
/// (0.1633, 0.15086)
#[pyclass(frozen, module = "plydrape")]
pub struct Span {
    pub span: catenary::Span,
    /// How it bends by the exact theory.
    pub exact: Option<Bending>,
    profile: Option<Profile>,
    shape: Option<Shape>,
    state: SpanState,
}

#[pymethods]
impl Span {
    #[new]
    #[pyo3(signature = (
        *, run: "float | str", length: "float | str", weight: "float | str",
        flexural_rigidity: "float | str" = Amount::Number(0.0), rise: "float | str" = Amount::Number(0.0),
        axial_stiffness: "float | str | None" = None, slopes = (None, None), theory = "small-sag",
        moment = None
    ))]
    #[expect(clippy::too_many_arguments, reason = "they are keywords in Python")]
    fn new(
        run: Amount,
        length: Amount,
        weight: Amount,
        flexural_rigidity: Amount,
        rise: Amount,
        axial_stiffness: Option<Amount>,
        slopes: (Option<f64>, Option<f64>),
        theory: &str,
        moment: Option<(Vec<f64>, Vec<f64>)>,
    ) -> PyResult<Self> {
        // all values in SI units
        let run = run.positive("run", Measured::Length, &usual::Span::USUAL)?;
        let length = length.positive("length", Measured::Length, &usual::Span::USUAL)?;
        let weight = weight.positive("weight", Measured::ForcePerLength, &usual::Weight::USUAL)?;
        let flexural_rigidity = flexural_rigidity.si(
            "flexural_rigidity",
            Measured::FlexuralRigidity,
            &usual::Flexural::USUAL,
        )?;
        let rise = rise.si("rise", Measured::Length, &usual::Span::USUAL)?;
        let axial_stiffness = axial_stiffness
            .map(|ea| ea.positive("axial_stiffness", Measured::Force, &usual::Axial::USUAL))
            .transpose()?;

        // a strip of the exact theory does not stretch, and may have a moment curve
        let exact = match theory {
            "small-sag" => false,
            "exact" => true,
            other => {
                return Err(PyValueError::new_err(format!(
                    "theory is {other:?}; expected \"small-sag\" or \"exact\""
                )));
            }
        };
        if exact && axial_stiffness.is_some_and(f64::is_finite) {
            return Err(PyValueError::new_err(
                "axial_stiffness is given with theory=\"exact\", whose strip does not stretch",
            ));
        }
        if moment.is_some() && !(exact && flexural_rigidity == 0.0) {
            return Err(PyValueError::new_err(
                "moment is for theory=\"exact\", in place of flexural_rigidity",
            ));
        }

        // the stiffness if it is not given; a moment curve has its rigidity at rest
        let axial_stiffness = axial_stiffness.unwrap_or(if exact { f64::INFINITY } else { 1e5 });
        let curve = moment.map(|(curvature, moment)| MomentCurve { curvature, moment });
        if !curve.as_ref().is_none_or(MomentCurve::is_sound) {
            return Err(PyValueError::new_err(
                "moment is no table: expected as many curvatures as moments, two or more, both rising from 0",
            ));
        }
        let flexural_rigidity = curve.as_ref().map_or(flexural_rigidity, MomentCurve::rigidity);

        if flexural_rigidity < 0.0 {
            return Err(PyValueError::new_err(format!(
                "flexural_rigidity is {flexural_rigidity}; expected 0 or more"
            )));
        }

        // a limp strip can prescribe no slopes
        let given = [slopes.0, slopes.1];
        if flexural_rigidity == 0.0 && given.iter().any(Option::is_some) {
            return Err(PyValueError::new_err(
                "slopes are prescribed; without flexural_rigidity they must be free",
            ));
        }
        if !given.iter().flatten().all(|slope| slope.is_finite()) {
            return Err(PyValueError::new_err("slopes must be finite"));
        }

        let ends = given.map(|slope| slope.map_or(EndCondition::Free, EndCondition::Slope));
        let span =
            catenary::Span { run, rise, length, ends, weight, flexural_rigidity, axial_stiffness };
        let bending = || curve.map_or(Bending::Rigidity(flexural_rigidity), Bending::Curve);
        Span::solved(span, exact.then(bending))
    }

    /// Horizontal distance of the ends (m).
    #[getter]
    fn run(&self) -> f64 {
        self.span.run
    }

    /// Height of the second end above the first (m).
    #[getter]
    fn rise(&self) -> f64 {
        self.span.rise
    }

    /// Fabric length between the ends (m).
    #[getter]
    fn length(&self) -> f64 {
        self.span.length
    }

    /// Horizontal force H (N), negative in compression; None for a straight inextensible span.
    #[getter]
    fn force(&self) -> Option<f64> {
        let exact = self.shape.as_ref().map(Shape::horizontal_force);
        exact.or_else(|| self.profile.as_ref().map(Profile::force))
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
        if let Some(shape) = &self.shape {
            return (shape.angle(0.0).tan(), shape.angle(shape.length()).tan());
        }
        let slope = |end| self.profile.as_ref().map_or(self.chord_slope(), |p| p.end_slope(end));
        (slope(0), slope(1))
    }

    /// Largest vertical distance below its chord (m).
    #[getter]
    fn sag(&self) -> f64 {
        match (&self.shape, &self.profile) {
            (Some(shape), _) => shape.sag().0,
            (None, Some(profile)) => profile.sag().0,
            (None, None) => 0.0,
        }
    }

    /// Height above the first end (m) at horizontal distances from it.
    ///
    /// Parameters
    /// ----------
    /// x : array_like
    ///     Horizontal distances from the first end (m), of any shape.
    ///
    /// Returns
    /// -------
    /// ndarray
    ///     The heights (m), of the same shape.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If a distance is not between 0 and `run`, or the span bulges beyond its ends and has several heights.
    ///
    /// Examples
    /// --------
    /// >>> span = plydrape.Span(run=0.1, length=0.101, weight=3.0, flexural_rigidity=1e-5)
    /// >>> (span.heights([0, 0.05, 0.1]) * 1e3).round(2) + 0.0
    /// array([ 0.  , -6.18,  0.  ])
    fn heights(&self, x: Numbers<'_>) -> PyResult<Array<f64>> {
        let (x, run) = (x.any("x")?, self.span.run);
        if let Some(x) = x.values.iter().find(|x| !(0.0..=run).contains(*x)) {
            let text = format!("x holds {x} m; expected 0 to the run of {run} m");
            return Err(PyValueError::new_err(text));
        }
        if let Some(shape) = &self.shape {
            let heights: Option<Vec<f64>> =
                x.values.iter().map(|x| Some(shape.at(shape.arc(*x)?)[1])).collect();
            let heights = heights.ok_or_else(|| {
                PyValueError::new_err("the span bulges beyond its ends; `points` has its places")
            })?;
            return Ok(Array::new(&x.shape, heights));
        }
        let height = |x: f64| match &self.profile {
            Some(profile) => profile.station(x).z,
            None => self.chord_slope() * x,
        };
        Ok(Array::new(&x.shape, x.values.iter().map(|x| height(*x)).collect()))
    }

    /// Places: at equal lengths along the span by the exact theory, at equal distances by that of small sag.
    ///
    /// Parameters
    /// ----------
    /// n : int, default 101
    ///     How many, 2 to 100 000.
    ///
    /// Returns
    /// -------
    /// ndarray
    ///     Horizontal distance and height from the first end (m), shape (n, 2).
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If n is below 2 or above 100 000.
    ///
    /// Examples
    /// --------
    /// >>> span = plydrape.Span(run=0.02, length=0.1, weight=3.0, flexural_rigidity=1e-4, theory="exact")
    /// >>> span.points(3)[1].round(4) + 0.0
    /// array([ 0.01  , -0.0409])
    #[pyo3(signature = (n = 101))]
    fn points(&self, n: usize) -> PyResult<Array<f64>> {
        let n = at_least_two("n", n)?;
        let share = |k: usize| k as f64 / (n - 1) as f64;
        let points: Vec<f64> = match (&self.shape, &self.profile) {
            (Some(shape), _) => {
                (0..n).flat_map(|k| shape.at(share(k) * self.span.length)).collect()
            }
            (None, profile) => (0..n)
                .flat_map(|k| {
                    let x = share(k) * self.span.run;
                    let straight = self.chord_slope() * x;
                    [x, profile.as_ref().map_or(straight, |profile| profile.station(x).z)]
                })
                .collect(),
        };
        Ok(Array::new(&[n, 2], points))
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

    /// A span with its solution, by the exact theory where it says how the strip bends.
    pub fn solved(span: catenary::Span, exact: Option<Bending>) -> PyResult<Self> {
        if let Some(bending) = exact.clone().filter(|_| span.state() != SpanState::Straight) {
            let catenary::Span { run, rise, length, ends, weight, .. } = span;
            let strip = HeavyStrip { run, rise, length, ends, weight, bending };
            let shape = strip.solve().map_err(|fault| {
                error::solve(&fault.to_string(), Status::LengthNotMet.name(), 0, f64::NAN)
            })?;
            let state = SpanState::Hanging;
            return Ok(Span { span, exact, profile: None, shape: Some(shape), state });
        }
        let root = span.solve(None);
        if !span.is_solved_by(&root) {
            let text = format!(
                "no force gives the span its length: an error of {:.1e} of it is left",
                root.residual
            );
            let status = Status::LengthNotMet.name();
            return Err(error::solve(&text, status, root.evaluations, root.residual));
        }
        let profile = root.force.map(|force| Profile::new(&span, force));
        Ok(Span { span, exact, profile, shape: None, state: root.state })
    }
}
