//! Cylinders, spheres and tori.

use super::Keys;
use crate::Error;
use crate::scene::file::SideKey;
use crate::scene::quantity::Read;
use plydrape::mold::{Cylinder, Face, Mold, Pose, Sphere, Torus};

/// Most upward part of the axis of a cylinder: one this steep or steeper is a pillar (89.9°).
const UPRIGHT: f64 = 0.999_998;

/// Checks the keys of a cylinder.
pub(super) fn cylinder(keys: &Keys) -> Result<Mold, Error> {
    let radius = keys.required(&keys.table.radius, "radius", "\"500 mm\"")?.read(keys.document)?;
    let (pose, face) = turned(keys)?;
    match &keys.table.rotation {
        Some(rotation) if pose.axes[0][2].abs() > UPRIGHT => Err(keys.document.error(
            rotation.span.clone(),
            "this turns the cylinder upright: it has no top for a ply to lie on",
            "its axis is its x axis and lies level without a rotation; incline it by less than 89.9 deg",
        )),
        _ => Ok(Mold::Cylinder(Cylinder { pose, radius, face })),
    }
}

/// Checks the keys of a sphere.
pub(super) fn sphere(keys: &Keys) -> Result<Mold, Error> {
    let radius = keys.required(&keys.table.radius, "radius", "\"500 mm\"")?.read(keys.document)?;
    let (pose, face) = turned(keys)?;
    Ok(Mold::Sphere(Sphere { pose, radius, face }))
}

/// Checks the keys of a torus.
pub(super) fn torus(keys: &Keys) -> Result<Mold, Error> {
    let (table, document) = (keys.table, keys.document);
    let ring = keys.required(&table.ring_radius, "ring_radius", "\"500 mm\"")?;
    let tube = keys.required(&table.tube_radius, "tube_radius", "\"200 mm\"")?;
    let [ring_radius, tube_radius] = [ring.read(document)?, tube.read(document)?];
    if tube_radius >= ring_radius {
        return Err(document.error(
            tube.span.clone(),
            "the tube is as thick as its ring is wide, or thicker: the torus would pass through itself",
            "give a `tube_radius` smaller than the `ring_radius`",
        ));
    }
    let (pose, face) = turned(keys)?;
    Ok(Mold::Torus(Torus { pose, ring_radius, tube_radius, face }))
}

/// Pose and side of a mold; one that holds the ply from inside stays open upwards.
fn turned(keys: &Keys) -> Result<(Pose, Face), Error> {
    match keys.table.side.as_ref().map(|side| side.value) {
        Some(SideKey::Inside) => Ok((keys.upward_pose()?, Face::Inside)),
        Some(SideKey::Outside) | None => Ok((keys.pose()?, Face::Outside)),
    }
}
