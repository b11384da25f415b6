//! Where the grippers start.

use super::FlatDrape;
use super::error::{Document, SceneError};
use super::file::GrippersTable;
use super::located::{Fixed, Located};
use super::mold::{coordinates, heading};
use super::places::Places;
use super::quantity::{Length, Quantity};
use crate::mold::{Mold, Plane};
use crate::ply::Ply;
use std::path::Path;

/// Checks where the table `[grippers]` puts the grippers.
pub(super) fn start(
    table: &Located<GrippersTable>,
    ply: &Ply,
    mold: Option<&Mold>,
    document: &Document,
    base: &Path,
) -> Result<Places, SceneError> {
    let keys = &table.value;
    match (&keys.positions, &keys.spacing, &keys.height) {
        (Some(positions), None, None) => {
            if let Some(key) = other_key(keys) {
                return Err(document.error(
                    positions.span.clone(),
                    format!("the grippers have `positions` and `{key}`"),
                    format!("remove `{key}`: positions say all"),
                ));
            }
            Places::read(positions, ply.grid, document, base)
        }
        (Some(positions), ..) => Err(document.error(
            positions.span.clone(),
            "the grippers have `positions` and a `spacing` or `height`",
            "keep `positions`, or `spacing` and `height`",
        )),
        (None, Some(spacing), Some(height)) => {
            rectangle(keys, spacing, height, ply, mold, document)
        }
        (None, ..) => Err(document.error(
            table.span.clone(),
            "[grippers] does not say where the grippers start",
            "give spacing = [\"98 mm\", \"98 mm\"] and height = \"75 mm\", or `positions`",
        )),
    }
}

/// A key that has no place beside `positions` or a motion file.
pub(super) fn other_key(keys: &GrippersTable) -> Option<&'static str> {
    [
        ("origin", keys.origin.is_some()),
        ("direction", keys.direction.is_some()),
        ("parallel_to_mold", keys.parallel_to_mold.is_some()),
    ]
    .into_iter()
    .find_map(|(key, given)| given.then_some(key))
}

/// A rectangle of grippers: level, or parallel to the mold.
fn rectangle(
    keys: &GrippersTable,
    spacing: &Fixed<Quantity<Length>, 2>,
    height: &Quantity<Length>,
    ply: &Ply,
    mold: Option<&Mold>,
    document: &Document,
) -> Result<Places, SceneError> {
    let place = spacing.0[0].span.start..spacing.0[1].span.end;
    let distances = [spacing.0[0].size(document)?, spacing.0[1].size(document)?];
    let lift = height.coordinate(document)?;
    let origin = match &keys.origin {
        Some(origin) => coordinates(origin, document)?,
        None => [0.0; 2],
    };
    let direction = match &keys.direction {
        Some(direction) => heading(direction, document)?,
        None => 0.0,
    };
    let plane = match (&keys.parallel_to_mold, mold) {
        (Some(parallel), None) if parallel.value => {
            return Err(document.error(
                parallel.span.clone(),
                "the grippers shall be parallel to the mold, and the scene has no mold",
                "add [mold] with kind = \"plane\", or remove `parallel_to_mold`",
            ));
        }
        (Some(parallel), Some(Mold::Plane(plane))) if parallel.value => *plane,
        _ => Plane { point: [0.0; 3], normal: [0.0, 0.0, 1.0] },
    };
    let mut points = FlatDrape::on(&plane, origin, direction, 0.0).grippers(ply.grid, distances);
    for point in &mut points {
        for (coordinate, n) in point.iter_mut().zip(plane.normal) {
            *coordinate += lift * n;
        }
    }
    Ok(Places {
        points,
        document: document.clone(),
        spans: vec![place],
        height: Some(height.span.clone()),
    })
}

/// Refuses a start that cannot be: fabric too short, spans straight up, grippers in the mold.
pub(super) fn check(
    places: &Places,
    ply: &Ply,
    mold: Option<&Mold>,
    tolerance: f64,
) -> Result<(), SceneError> {
    places.check_reach(ply)?;
    places.check_run(ply, "at the start")?;
    let Some(Mold::Plane(plane)) = mold else {
        return Ok(());
    };
    for (index, point) in places.points.iter().enumerate() {
        let height: f64 = (0..3).map(|k| (point[k] - plane.point[k]) * plane.normal[k]).sum();
        if height < -tolerance {
            let mut error = places.error(
                index,
                format!(
                    "gripper {:?} starts {:.2} mm below the mold",
                    ply.grid.id(index),
                    -height * 1e3
                ),
                "start above the mold: raise the grippers or lower the mold",
            );
            error.span = places.height.clone().or(error.span);
            return Err(error);
        }
    }
    Ok(())
}
