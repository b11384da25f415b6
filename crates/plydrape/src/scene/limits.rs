//! What an accepted drape keeps to.

use super::Limits;
use super::error::{Document, SceneError};
use super::file::LimitsTable;
use super::heading::coordinates;
use super::located::Fixed;
use super::quantity::{Angle, Length, Measure, Quantity, Ratio};
use crate::ply::Ply;

/// Largest angle between landed edges and the fibres of the ideal drape unless given (rad).
const FIBRE_ANGLE: f64 = 3.0 * std::f64::consts::PI / 180.0;
/// Smallest and largest speed of a gripper (m/s).
const SPEEDS: [f64; 2] = [1e-6, 1e2];
/// Smallest and largest acceleration of a gripper (m/s²).
const ACCELERATIONS: [f64; 2] = [1e-6, 1e4];
/// Smallest and largest jerk of a gripper (m/s³).
const JERKS: [f64; 2] = [1e-6, 1e7];

/// Checks the table `[limits]`; `max_tilt` is the largest gripper tilt (rad) unless the table says another.
pub(super) fn limits(
    table: &LimitsTable,
    ply: &Ply,
    max_tilt: f64,
    document: &Document,
) -> Result<Limits, SceneError> {
    let length = |key: &Option<Quantity<_>>, default: f64| match key {
        Some(value) => value.not_negative(document),
        None => Ok(default),
    };
    Ok(Limits {
        slack_ratio: share(table.slack_ratio.as_ref(), 0.0005, document)?,
        bridging: length(&table.bridging, 1e-3)?,
        overstretch: share(table.overstretch.as_ref(), 0.001, document)?,
        landing_contact: length(&table.landing_contact, 2e-3)?,
        landing_gripper: length(&table.landing_gripper, 5e-4)?,
        fibre_angle: match &table.fibre_angle {
            Some(angle) => acute(angle, document)?,
            None => FIBRE_ANGLE,
        },
        shear: match &table.shear {
            Some(shear) => Some(acute(shear, document)?),
            None => ply.material.locking_angle,
        },
        tilt: match &table.tilt {
            Some(tilt) => acute(tilt, document)?,
            None => max_tilt,
        },
        force: match &table.force {
            Some(force) => Some(force.positive(document)?),
            None => None,
        },
        contact_share: share(table.contact_share.as_ref(), 0.95, document)?,
        gripper_distance: match &table.gripper_distance {
            Some(distance) => distance.size(document)?,
            None => 0.5 * ply.cell[0].min(ply.cell[1]),
        },
        workspace: match &table.workspace {
            Some(sides) => Some(workspace(sides, document)?),
            None => None,
        },
        speed: rate(table.speed.as_ref(), 0.25, SPEEDS, document)?,
        acceleration: rate(table.acceleration.as_ref(), 1.0, ACCELERATIONS, document)?,
        jerk: rate(table.jerk.as_ref(), 10.0, JERKS, document)?,
    })
}

/// Speed, acceleration or jerk of a gripper.
fn rate<M: Measure>(
    key: Option<&Quantity<M>>,
    default: f64,
    bounds: [f64; 2],
    document: &Document,
) -> Result<f64, SceneError> {
    key.map_or(Ok(default), |rate| rate.within_for(document, bounds, "a gripper"))
}

/// A box (m); refuses sides that are empty or run backwards.
fn workspace(
    sides: &Fixed<Fixed<Quantity<Length>, 2>, 3>,
    document: &Document,
) -> Result<[[f64; 2]; 3], SceneError> {
    let mut out = [[0.0; 2]; 3];
    for (n, side) in sides.0.iter().enumerate() {
        let [from, to] = coordinates(side, document)?;
        if from >= to {
            let axis = ["x", "y", "z"][n];
            let fault = if from == to { "is empty" } else { "runs backwards" };
            return Err(document.error(
                side.0[0].span.start..side.0[1].span.end,
                format!("the workspace {fault} along {axis}"),
                "give [from, to] with from below to, as in [\"-500 mm\", \"500 mm\"]",
            ));
        }
        out[n] = [from, to];
    }
    Ok(out)
}

/// An angle above zero and below a right angle (rad).
pub(super) fn acute(angle: &Quantity<Angle>, document: &Document) -> Result<f64, SceneError> {
    angle.positive(document)?;
    angle.below_right_angle(document)
}

/// A share from 0 to 1.
fn share(
    key: Option<&Quantity<Ratio>>,
    default: f64,
    document: &Document,
) -> Result<f64, SceneError> {
    let Some(ratio) = key else {
        return Ok(default);
    };
    let value = ratio.not_negative(document)?;
    if value <= 1.0 {
        return Ok(value);
    }
    Err(document.error(
        ratio.span.clone(),
        format!("{} is more than the whole", document.quoted(&ratio.span)),
        format!("a share from 0 to 1 is wanted; {value} of a hundred is \"{value} %\""),
    ))
}
