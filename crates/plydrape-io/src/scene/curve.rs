//! Curves of force of a material: moment over curvature, tension over strain, shear force over the shear angle.

use super::choice::Curve;
use super::file::{MomentTable, ShearCurveTable, TensionTable};
use super::located::Located;
use super::quantity::{Measure, Quantity, Read};
use super::source::Document;
use super::usual::{Shear, Tension};
use crate::Error;
use plydrape::material::{MomentCurve, ShearCurve, TensionLaw};

/// Largest shear force per length (N/m).
const SHEAR: f64 = 1e6;
/// Largest moment per width (N).
const RIGIDITY: f64 = 1e6;
/// Largest tension per width (N/m).
const TENSION: f64 = 1e10;

/// Largest curvature (1/m): a radius of 10 µm.
const CURVATURE: f64 = 1e5;

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
        curvature: climbing(&curvature.value, "curvature", CURVATURE, document)?,
        moment: climbing(&moment.value, "moment", RIGIDITY, document)?,
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

/// Smallest slope of a moment as a share of its first: below it a fold would have no size.
const LEAST_SLOPE: f64 = 1e-6;

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
            same_length("the tension", "strains", [strain.value.len(), force.value.len()])
                .map_err(|[message, help]| document.error(force.span.clone(), message, help))?;
            let law = TensionLaw::Table {
                strain: ascending_strains(&strain.value, document)?,
                force: rising(&force.value, TENSIONS, document)?,
            };
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
            same_length("the shear curve", "angles", [angle.value.len(), force.value.len()])
                .map_err(|[message, help]| document.error(force.span.clone(), message, help))?;
            Ok(ShearCurve::Table {
                angle: ascending_angles(&angle.value, document)?,
                force: rising(&force.value, SHEARS, document)?,
            })
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

fn ascending_angles<M: Measure>(
    angles: &[Quantity<M>],
    document: &Document,
) -> Result<Vec<f64>, Error> {
    let mut values: Vec<f64> = Vec::with_capacity(angles.len());
    for angle in angles {
        let value = angle.read(document)?;
        let fault = match values.last() {
            None if value > 0.0 => "the shear curve does not start at an angle of 0",
            Some(last) if value <= *last => "the angles of the shear curve do not ascend",
            _ if value >= std::f64::consts::FRAC_PI_2 => {
                "the shear curve reaches a right angle or more"
            }
            _ => {
                values.push(value);
                continue;
            }
        };
        return Err(document.error(
            angle.span.clone(),
            fault,
            "give angles ascending from 0 to below 90 deg, as in [0, \"10 deg\", \"20 deg\"]",
        ));
    }
    Ok(values)
}

/// What a force must be that does not fit, for [`rising`]: most (N/m), its name and two remedies.
struct Forces {
    most: f64,
    of: &'static str,
    most_help: &'static str,
    rising_help: &'static str,
}

const SHEARS: Forces = Forces {
    most: SHEAR,
    of: "the shear curve",
    most_help: "expected a shear force per length up to 1e6 N/m",
    rising_help: "give forces that never fall: where a test shows less force, the cloth slipped or wrinkled, and the curve ends before",
};
const TENSIONS: Forces = Forces {
    most: TENSION,
    of: "the tension",
    most_help: "expected a tension per width up to 1e10 N/m",
    rising_help: "give forces that never fall: where a test shows less force, yarns broke or slipped, and the table ends before",
};

fn rising<M: Measure>(
    forces: &[Quantity<M>],
    rules: Forces,
    document: &Document,
) -> Result<Vec<f64>, Error> {
    let mut values: Vec<f64> = Vec::with_capacity(forces.len());
    for force in forces {
        let value = force.read(document)?;
        if value > rules.most {
            return Err(document.error(
                force.span.clone(),
                format!("{} is too large for a ply", document.quoted(&force.span)),
                rules.most_help,
            ));
        }
        if values.last().is_some_and(|last| value < *last) {
            return Err(document.error(
                force.span.clone(),
                format!("the force of {} falls here", rules.of),
                rules.rising_help,
            ));
        }
        values.push(value);
    }
    Ok(values)
}

fn ascending_strains<M: Measure>(
    strains: &[Quantity<M>],
    document: &Document,
) -> Result<Vec<f64>, Error> {
    let mut values: Vec<f64> = Vec::with_capacity(strains.len());
    for strain in strains {
        let value = strain.read(document)?;
        let fault = match values.last() {
            None if value > 0.0 => "the tension does not start at a strain of 0",
            Some(last) if value <= *last => "the strains of the tension do not ascend",
            _ if value > 1.0 => "the tension goes beyond a strain of 100 %",
            _ => {
                values.push(value);
                continue;
            }
        };
        return Err(document.error(
            strain.span.clone(),
            fault,
            "give strains ascending from 0, as in [0, \"0.2 %\", \"0.5 %\"]",
        ));
    }
    Ok(values)
}

/// Message and remedy where a curve has not as many forces as other values, or fewer than two.
fn same_length(curve: &str, others: &str, [count, forces]: [usize; 2]) -> Result<(), [String; 2]> {
    if count == forces && count >= 2 {
        return Ok(());
    }
    Err([
        format!("{curve} has {count} {others} and {forces} forces"),
        format!("give as many forces as {others}, two or more"),
    ])
}
