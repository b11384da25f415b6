//! Curves of force of a material: moment over curvature, tension over strain, shear force over the shear angle.

use super::choice::Curve;
use super::file::{MomentTable, ShearCurveTable, TensionTable};
use super::located::Located;
use super::quantity::{Measure, Quantity, Read};
use super::source::Document;
use super::usual::{Shear, Tension};
use crate::Error;
use plydrape::material::{MomentCurve, ShearCurve, TensionLaw};
use std::f64::consts::FRAC_PI_2;

/// Largest moment per width (N).
const MOST_MOMENT: f64 = 1e6;
/// Largest curvature (1/m): a radius of 10 µm.
const MOST_CURVATURE: f64 = 1e5;
/// Smallest slope of a moment as a share of its first: below it a fold would have no size.
const LEAST_SLOPE: f64 = 1e-6;

/// Measured moments over curvatures.
pub(super) fn moment(table: &MomentTable, document: &Document) -> Result<MomentCurve, Error> {
    let MomentTable { curvature, moment } = table;
    if curvature.value.len() != moment.value.len() || curvature.value.len() < 2 {
        return Err(document.error(
            moment.span.clone(),
            format!(
                "the bending has {} curvatures and {} moments",
                curvature.value.len(),
                moment.value.len()
            ),
            "give as many moments as curvatures, two or more",
        ));
    }
    let curve = MomentCurve {
        curvature: climbing(&curvature.value, "curvature", MOST_CURVATURE, document)?,
        moment: climbing(&moment.value, "moment", MOST_MOMENT, document)?,
    };
    if curve.least_slope() >= LEAST_SLOPE * curve.rigidity() {
        return Ok(curve);
    }
    Err(document.error(
        moment.span.clone(),
        format!("the moment hardly rises somewhere: its slope falls below {LEAST_SLOPE:e} of the first one"),
        "leave points out where the moment stays as it is: the ply creased or slipped there",
    ))
}

/// Values that rise from 0, up to a largest one.
fn climbing<M: Measure>(
    list: &[Quantity<M>],
    what: &str,
    most: f64,
    document: &Document,
) -> Result<Vec<f64>, Error> {
    let mut values: Vec<f64> = Vec::with_capacity(list.len());
    for item in list {
        let value = item.read(document)?;
        // the first value is 0, and each other one is larger than the one before
        let (fault, help) = match values.last() {
            None if value > 0.0 => (
                format!("the {what}s of the bending do not start at 0"),
                "a flat ply has no moment: give 0 there, and the means of both bending directions from there on",
            ),
            Some(last) if value <= *last => (
                format!("the {what} of the bending does not rise here"),
                "give curvatures and moments that rise from point to point, as in { curvature = [0, 10, 30], moment = [0, \"0.02 N\", \"0.04 N\"] }; where a test shows less, the ply creased or slipped, and the table ends before",
            ),
            _ if value > most => (
                format!("{} is too large for a ply", document.quoted(&item.span)),
                "expected curvatures up to 1e5 1/m and moments up to 1e6 N",
            ),
            _ => {
                values.push(value);
                continue;
            }
        };
        return Err(document.error(item.span.clone(), fault, help));
    }
    Ok(values)
}

/// A tensile stiffness, or a measured table.
pub(super) fn tension(
    law: &Located<Curve<Tension, TensionTable>>,
    document: &Document,
) -> Result<TensionLaw, Error> {
    match &law.value {
        Curve::Slope(stiffness) => {
            let stiffness = Located { value: stiffness.clone(), span: law.span.clone() };
            Ok(TensionLaw::Linear { stiffness: stiffness.read(document)? })
        }
        Curve::Table(TensionTable { strain, force }) => {
            let [strains, forces] = TENSION_TABLE.read(strain, force, document)?;
            let law = TensionLaw::Table { strain: strains, force: forces };
            match law.tension(0.0) {
                [_, start, _] if start > 0.0 => Err(document.error(
                    force.value[0].span.clone(),
                    "the tension does not start at a force of 0",
                    "a yarn that is not strained pulls with no force: give 0 there",
                )),
                _ if law.tension(f64::MAX)[2] <= 0.0 => Err(document.error(
                    force.span.clone(),
                    "the tension does not rise at the end of its table",
                    "give forces that rise at last: beyond the table its last slope goes on",
                )),
                _ => Ok(law),
            }
        }
    }
}

/// A slope, a measured table, or a polynomial.
pub(super) fn shear(
    curve: &Located<Curve<Shear, ShearCurveTable>>,
    document: &Document,
) -> Result<ShearCurve, Error> {
    // a single number is the slope of a straight line
    let table = match &curve.value {
        Curve::Slope(slope) => {
            let slope = Located { value: slope.clone(), span: curve.span.clone() };
            return Ok(ShearCurve::Polynomial { coefficients: vec![slope.read(document)?] });
        }
        Curve::Table(table) => table,
    };

    // a table of measured points, or a polynomial whose force is checked up to 60°
    match (&table.angle, &table.force, &table.polynomial) {
        (Some(angle), Some(force), None) => {
            let [angle, force] = SHEAR_TABLE.read(angle, force, document)?;
            Ok(ShearCurve::Table { angle, force })
        }
        (None, None, Some(polynomial)) => {
            if polynomial.value.is_empty() {
                return Err(document.error(
                    polynomial.span.clone(),
                    "the polynomial has no coefficients",
                    "give those of γ, γ², … in N/m, or shear_curve = 0 for a ply that shears without force",
                ));
            }
            let mut coefficients = Vec::with_capacity(polynomial.value.len());
            for coefficient in &polynomial.value {
                coefficients.push(coefficient.read(document)?);
            }
            let curve = ShearCurve::Polynomial { coefficients };
            let force = |degree: i32| curve.force(f64::from(degree).to_radians()).0;
            match (1..=60).find(|degree| force(*degree) < 0.0 || !force(*degree).is_finite()) {
                None => Ok(curve),
                Some(degree) => Err(document.error(
                    polynomial.span.clone(),
                    format!("the shear force is negative or infinite at {degree} deg"),
                    "give coefficients of γ, γ², … in N/m, γ in rad, with a force of zero or more up to 60 deg",
                )),
            }
        }
        _ => Err(document.error(
            curve.span.clone(),
            "the shear curve is neither a table nor a polynomial",
            "give `angle` and `force`, or `polynomial`, and not both",
        )),
    }
}

/// A table of forces over angles or strains: what messages call it, its limits and its remedies.
struct ForceTable {
    /// Name of the curve, and of what the forces are measured over.
    curve: &'static str,
    over: &'static str,
    /// Whether an angle (rad) or a strain is beyond what a table may have.
    is_beyond: fn(f64) -> bool,
    /// Faults of a table that does not start at 0, does not ascend, or goes beyond, with the remedy.
    does_not_start: &'static str,
    does_not_ascend: &'static str,
    goes_beyond: &'static str,
    ascending_help: &'static str,
    /// Largest force per length (N/m), with the remedies of a larger force and of one that falls.
    most: f64,
    most_help: &'static str,
    rising_help: &'static str,
}

const SHEAR_TABLE: ForceTable = ForceTable {
    curve: "the shear curve",
    over: "angles",
    is_beyond: |angle| angle >= FRAC_PI_2,
    does_not_start: "the shear curve does not start at an angle of 0",
    does_not_ascend: "the angles of the shear curve do not ascend",
    goes_beyond: "the shear curve reaches a right angle or more",
    ascending_help: "give angles ascending from 0 to below 90 deg, as in [0, \"10 deg\", \"20 deg\"]",
    most: 1e6,
    most_help: "expected a shear force per length up to 1e6 N/m",
    rising_help: "give forces that never fall: where a test shows less force, the cloth slipped or wrinkled, and the curve ends before",
};
const TENSION_TABLE: ForceTable = ForceTable {
    curve: "the tension",
    over: "strains",
    is_beyond: |strain| strain > 1.0,
    does_not_start: "the tension does not start at a strain of 0",
    does_not_ascend: "the strains of the tension do not ascend",
    goes_beyond: "the tension goes beyond a strain of 100 %",
    ascending_help: "give strains ascending from 0, as in [0, \"0.2 %\", \"0.5 %\"]",
    most: 1e10,
    most_help: "expected a tension per width up to 1e10 N/m",
    rising_help: "give forces that never fall: where a test shows less force, yarns broke or slipped, and the table ends before",
};

impl ForceTable {
    /// Reads the angles or strains, and the force at each (N/m).
    fn read<M: Measure, F: Measure>(
        &self,
        over: &Located<Vec<Quantity<M>>>,
        forces: &Located<Vec<Quantity<F>>>,
        document: &Document,
    ) -> Result<[Vec<f64>; 2], Error> {
        let (count, found) = (over.value.len(), forces.value.len());
        if count != found || count < 2 {
            return Err(document.error(
                forces.span.clone(),
                format!("{} has {count} {} and {found} forces", self.curve, self.over),
                format!("give as many forces as {}, two or more", self.over),
            ));
        }
        Ok([self.ascending(&over.value, document)?, self.rising(&forces.value, document)?])
    }

    fn ascending<M: Measure>(
        &self,
        list: &[Quantity<M>],
        document: &Document,
    ) -> Result<Vec<f64>, Error> {
        let mut values: Vec<f64> = Vec::with_capacity(list.len());
        for item in list {
            let value = item.read(document)?;
            let fault = match values.last() {
                None if value > 0.0 => self.does_not_start,
                Some(last) if value <= *last => self.does_not_ascend,
                _ if (self.is_beyond)(value) => self.goes_beyond,
                _ => {
                    values.push(value);
                    continue;
                }
            };
            return Err(document.error(item.span.clone(), fault, self.ascending_help));
        }
        Ok(values)
    }

    fn rising<M: Measure>(
        &self,
        forces: &[Quantity<M>],
        document: &Document,
    ) -> Result<Vec<f64>, Error> {
        let mut values: Vec<f64> = Vec::with_capacity(forces.len());
        for force in forces {
            let value = force.read(document)?;
            if value > self.most {
                return Err(document.error(
                    force.span.clone(),
                    format!("{} is too large for a ply", document.quoted(&force.span)),
                    self.most_help,
                ));
            }
            if values.last().is_some_and(|last| value < *last) {
                return Err(document.error(
                    force.span.clone(),
                    format!("the force of {} falls here", self.curve),
                    self.rising_help,
                ));
            }
            values.push(value);
        }
        Ok(values)
    }
}
