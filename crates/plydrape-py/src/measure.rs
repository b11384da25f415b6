//! `plydrape.Measure`: what is measured of a drape, as the library declares it.

use plydrape::measure::{Name, Scope, Sense};
use pyo3::prelude::*;

/// Something that is measured of a drape: what it is called, in which unit, and how a limit bounds it.
///
/// Examples
/// --------
/// >>> shares = [measure for measure in plydrape.measures() if measure.sense == "at-least"]
/// >>> [(measure.label, measure.shown) for measure in shares]
/// [('contact share', '%'), ('gripper distance', 'mm'), ('clearance', 'mm'), ('table gap', 'mm'), ('joint margin', '°'), ('distance from a singularity', '1')]
#[pyclass(frozen, eq, hash, module = "plydrape")]
#[derive(Clone, PartialEq, Eq, Hash)]
pub struct Measure(Name);

#[pymethods]
impl Measure {
    /// Key in `Result.measures` and in each step of a result, the unit at its end where it has one.
    #[getter]
    pub fn key(&self) -> &'static str {
        self.0.measure().key()
    }

    /// Name of its limit: its key in `limits` of a scene that sets one, and its name in `Result.limits`.
    #[getter]
    fn name(&self) -> &'static str {
        self.0.measure().name()
    }

    /// What it is called in tables and charts.
    #[getter]
    fn label(&self) -> &'static str {
        self.0.measure().label()
    }

    /// Unit of its values in `Result.measures`: "mm", "deg", "N"; "1" of ratios and shares.
    #[getter]
    fn unit(&self) -> &'static str {
        self.0.measure().unit().recorded
    }

    /// Unit that it is shown in, which is that of its limit in `Result.limits`: "mm", "°", "N", "%".
    #[getter]
    fn shown(&self) -> &'static str {
        self.0.measure().unit().shown
    }

    /// From a value in `unit` to the same in `shown`.
    #[getter]
    fn factor(&self) -> f64 {
        self.0.measure().unit().factor
    }

    /// Which way a limit bounds it: "at-most" or "at-least".
    #[getter]
    fn sense(&self) -> &'static str {
        match self.0.measure().sense() {
            Sense::AtMost => "at-most",
            Sense::AtLeast => "at-least",
        }
    }

    /// When it counts: "every-step"; the last step alone, "end"; "time" only of a motion with times; "whole" of a
    /// motion or plan in one, so that no step has it.
    #[getter]
    fn scope(&self) -> &'static str {
        match self.0.measure().scope() {
            Scope::EveryStep => "every-step",
            Scope::End => "end",
            Scope::Time => "time",
            Scope::Motion | Scope::Whole => "whole",
        }
    }

    fn __repr__(&self) -> String {
        let unit = self.shown();
        let unit = if unit.is_empty() { String::new() } else { format!(", {unit}") };
        format!("<plydrape.Measure {:?}{unit}>", self.name())
    }
}

/// Everything that is measured of drapes, in the order of tables.
///
/// Returns
/// -------
/// list of Measure
///     One for each measure.
///
/// Examples
/// --------
/// >>> tilt = next(measure for measure in plydrape.measures() if measure.name == "tilt")
/// >>> tilt.key, tilt.unit, tilt.shown, tilt.sense, tilt.scope
/// ('tilt_deg', 'deg', '°', 'at-most', 'every-step')
#[pyfunction]
pub fn measures() -> Vec<Measure> {
    Name::ALL.iter().map(|name| Measure(*name)).collect()
}
