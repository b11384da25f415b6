//! What an accepted drape keeps to.

use super::error::{Document, SceneError};
use super::file::LimitsTable;
use super::heading::coordinates;
use super::located::Fixed;
use super::motion::DURATIONS;
use super::quantity::{Angle, AngularRate, Force, Length, Measure, Quantity, Ratio};
use super::usual::{self, Usual};
use plydrape::measure::slack_of_angle;
use plydrape::ply::{Kind, Ply};
use plydrape::preset::Preset;
use plydrape::scene::{Limits, Settings};

/// Smallest and largest angular rate of a ball joint (rad/s).
const TILT_RATES: [f64; 2] = [1e-6, 1e4];
/// Smallest and largest speed of a gripper (m/s).
const SPEEDS: [f64; 2] = [1e-6, 1e2];
/// Smallest and largest acceleration of a gripper (m/s²).
const ACCELERATIONS: [f64; 2] = [1e-6, 1e4];
/// Smallest and largest jerk of a gripper (m/s³).
const JERKS: [f64; 2] = [1e-6, 1e7];

/// Smallest and largest safety of the pads.
const GRIP_SAFETIES: [f64; 2] = [1.0, 100.0];

/// Checks the table `[limits]`; what it does not say is that of its preset, or else as in [`Limits::of`].
pub(super) fn limits(
    table: &LimitsTable,
    ply: &Ply,
    settings: &Settings,
    document: &Document,
) -> Result<Limits, SceneError> {
    let usual = match &table.preset {
        Some(preset) => Preset::from(preset.value).over(Limits::of(ply, settings)),
        None => Limits::of(ply, settings),
    };
    let angle = |key: &Option<Quantity<Angle>>, default: f64| match key {
        Some(angle) => acute(angle, document),
        None => Ok(default),
    };
    let force = |key: &Option<Quantity<Force>>| match key {
        Some(force) => force.positive(document).map(Some),
        None => Ok(None),
    };
    let length = |key: &Option<Quantity<_>>, default: f64| match key {
        Some(value) => value.limit(document, &usual::LIMIT),
        None => Ok(default),
    };
    let slack_angle = match &table.slack_angle {
        Some(angle) => Some(acute(angle, document)?),
        None => usual.slack_angle,
    };
    // an angle is the same limit in another unit, and a default in the first one must not stand over it
    let slack_ratio =
        table.slack_angle.as_ref().and(slack_angle).map_or(usual.slack_ratio, slack_of_angle);
    Ok(Limits {
        preset: usual.preset,
        slack_ratio: share(table.slack_ratio.as_ref(), slack_ratio, document)?,
        slack_angle,
        wrinkle: wrinkle(table, usual.wrinkle, ply, document)?,
        bridging: length(&table.bridging, usual.bridging)?,
        overstretch: share(table.overstretch.as_ref(), usual.overstretch, document)?,
        landing_contact: length(&table.landing_contact, usual.landing_contact)?,
        landing_gripper: length(&table.landing_gripper, usual.landing_gripper)?,
        fibre_angle: angle(&table.fibre_angle, usual.fibre_angle)?,
        shear: angle(&table.shear, usual.shear)?,
        landing_shear: angle(&table.landing_shear, usual.landing_shear)?,
        strain: share(table.strain.as_ref(), usual.strain, document)?,
        penetration: match &table.penetration {
            Some(depth) => depth.size(document, &usual::LIMIT)?,
            None => usual.penetration,
        },
        tilt: angle(&table.tilt, usual.tilt)?,
        tilt_rate: match &table.tilt_rate {
            Some(rate) => tilt_rate(rate, document)?,
            None => usual.tilt_rate,
        },
        height: length(&table.height, usual.height)?,
        out_of_plane: angle(&table.out_of_plane, usual.out_of_plane)?,
        position: length(&table.position, usual.position)?,
        gripper_force: force(&table.gripper_force)?,
        force: force(&table.force)?,
        gripper_load: force(&table.gripper_load)?.unwrap_or(usual.gripper_load),
        gripper_pull: force(&table.gripper_pull)?,
        grip_safety: match &table.grip_safety {
            Some(safety) => safety.within_for(document, GRIP_SAFETIES, "the safety of a pad")?,
            None => usual.grip_safety,
        },
        contact_share: share(table.contact_share.as_ref(), usual.contact_share, document)?,
        gripper_distance: match &table.gripper_distance {
            Some(distance) => distance.size(document, &usual::DISTANCE)?,
            None => usual.gripper_distance,
        },
        clearance: match &table.clearance {
            Some(distance) => distance.size(document, &usual::DISTANCE)?,
            None => usual.clearance,
        },
        workspace: match &table.workspace {
            Some(sides) => Some(workspace(sides, document)?),
            None => None,
        },
        speed: rate(table.speed.as_ref(), usual.speed, SPEEDS, &usual::SPEED, document)?,
        acceleration: rate(
            table.acceleration.as_ref(),
            usual.acceleration,
            ACCELERATIONS,
            &usual::ACCELERATION,
            document,
        )?,
        jerk: rate(table.jerk.as_ref(), usual.jerk, JERKS, &usual::JERK, document)?,
        duration: match &table.duration {
            Some(duration) => Some(duration.within_for(document, DURATIONS, "a motion")?),
            None => None,
        },
    })
}

/// Height of the ruck of a slack (m); refused where edges of the ply have no rigidity, because their slack has no height.
fn wrinkle(
    table: &LimitsTable,
    usual: Option<f64>,
    ply: &Ply,
    document: &Document,
) -> Result<Option<f64>, SceneError> {
    let height = match &table.wrinkle {
        Some(height) => Some(height.limit(document, &usual::LIMIT)?),
        None => usual,
    };
    let said = table.wrinkle.as_ref().map(|height| &height.span);
    let said = said.or(table.preset.as_ref().map(|preset| &preset.span));
    let edges: &[Kind] =
        if ply.grid.nv != 1 { &[Kind::EdgeU, Kind::EdgeV] } else { &[Kind::EdgeU] };
    let limp = edges.iter().any(|kind| ply.line(*kind).flexural_rigidity <= 0.0);
    match (height, said) {
        (Some(_), Some(span)) if limp => Err(document.error(
            span.clone(),
            "the slack of a ply without bending rigidity has no height: it crumples",
            "give a `slack_angle` or a `slack_ratio` instead, or the material its rigidity",
        )),
        _ => Ok(height),
    }
}

/// Angular rate of a ball joint (rad/s).
fn tilt_rate(rate: &Quantity<AngularRate>, document: &Document) -> Result<f64, SceneError> {
    rate.believed(document, &usual::TURN)?;
    rate.within_for(document, TILT_RATES, "a gripper's joint")
}

/// Speed, acceleration or jerk of a gripper.
fn rate<M: Measure>(
    key: Option<&Quantity<M>>,
    default: f64,
    bounds: [f64; 2],
    usual: &Usual,
    document: &Document,
) -> Result<f64, SceneError> {
    let Some(rate) = key else { return Ok(default) };
    rate.believed(document, usual)?;
    rate.within_for(document, bounds, "a gripper")
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
