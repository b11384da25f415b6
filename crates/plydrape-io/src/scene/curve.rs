//! Curves of force of a material: tension over strain, shear force over the shear angle.

use super::choice::Curve;
use super::error::{Document, SceneError};
use super::file::{ShearCurveTable, TensionTable};
use super::located::Located;
use super::quantity::{Measure, Quantity, ShearSlope, TensileStiffness};
use plydrape::material::{ShearCurve, TensionLaw};

/// Largest shear force per length, or its slope (N/m).
const SHEAR: f64 = 1e6;
/// Smallest and largest tensile stiffness per width (N/m).
const TENSION: [f64; 2] = [1.0, 1e10];

/// A tensile stiffness, or a measured table.
pub(super) fn tension(
    law: &Located<Curve<TensileStiffness, TensionTable>>,
    document: &Document,
) -> Result<TensionLaw, SceneError> {
    match &law.value {
        Curve::Slope(stiffness) => {
            let stiffness = Located { value: stiffness.clone(), span: law.span.clone() };
            Ok(TensionLaw::Linear { stiffness: stiffness.within(document, TENSION)? })
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
    curve: &Located<Curve<ShearSlope, ShearCurveTable>>,
    document: &Document,
) -> Result<ShearCurve, SceneError> {
    let table = match &curve.value {
        Curve::Slope(slope) => {
            let slope = Located { value: slope.clone(), span: curve.span.clone() };
            let value = slope.not_negative(document)?;
            let slope = if value > SHEAR { slope.within(document, [0.0, SHEAR])? } else { value };
            return Ok(ShearCurve::Polynomial { coefficients: vec![slope] });
        }
        Curve::Table(table) => table,
    };
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
            let mut coefficients = Vec::with_capacity(polynomial.value.len());
            for coefficient in &polynomial.value {
                coefficients.push(coefficient.si(document)?);
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
) -> Result<Vec<f64>, SceneError> {
    let mut values: Vec<f64> = Vec::with_capacity(angles.len());
    for angle in angles {
        let value = angle.not_negative(document)?;
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
    most_help: "a shear force per length up to 1e6 N/m is wanted",
    rising_help: "give forces that never fall: where a test shows less force, the cloth slipped or wrinkled, and the curve ends before",
};
const TENSIONS: Forces = Forces {
    most: TENSION[1],
    of: "the tension",
    most_help: "a tension per width up to 1e10 N/m is wanted",
    rising_help: "give forces that never fall: where a test shows less force, yarns broke or slipped, and the table ends before",
};

fn rising<M: Measure>(
    forces: &[Quantity<M>],
    rules: Forces,
    document: &Document,
) -> Result<Vec<f64>, SceneError> {
    let mut values: Vec<f64> = Vec::with_capacity(forces.len());
    for force in forces {
        let value = force.not_negative(document)?;
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
) -> Result<Vec<f64>, SceneError> {
    let mut values: Vec<f64> = Vec::with_capacity(strains.len());
    for strain in strains {
        let value = strain.not_negative(document)?;
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
