//! Where the grippers start.

use super::check::Surroundings;
use super::choice::PlaceChoice;
use super::file::GrippersTable;
use super::located::{Fixed, Located};
use super::places::Places;
use super::quantity::{Quantity, Read};
use super::rectangle::Rectangle;
use super::usual::{Height, Spacing};
use crate::Error;
use plydrape::layup::Target;
use plydrape::mold::{Mold, Plane};
use plydrape::net::Net;
use plydrape::ply::{Grid, Ply, directions, gripper_name};
use plydrape::scene::start_above;
use std::ops::Range;

/// Checks where the table `[grippers]` puts the grippers.
pub(super) fn start(
    table: &Located<GrippersTable>,
    around: &Surroundings,
    target: Option<&Target>,
) -> Result<Places, Error> {
    let keys = &table.value;
    let &Surroundings { ply, document, .. } = around;

    // grippers start at positions, or in a rectangle of a spacing at a height
    match (&keys.positions, &keys.spacing, &keys.height) {
        (Some(positions), None, None) => {
            if let Some(key) = other_key(keys) {
                return Err(document.error(
                    positions.span.clone(),
                    format!("the grippers have `positions` and `{key}`"),
                    format!("remove `{key}`: positions say all"),
                ));
            }
            Places::read(positions, ply, document)
        }
        (Some(positions), ..) => Err(document.error(
            positions.span.clone(),
            "the grippers have `positions` and a `spacing` or `height`",
            "keep `positions`, or `spacing` and `height`",
        )),
        (None, Some(spacing), Some(height)) => rectangle(keys, spacing, height, around, target),
        (None, ..) => Err(document.error(
            table.span.clone(),
            "[grippers] does not say where the grippers start",
            "give spacing = [\"98 mm\", \"98 mm\"] and height = \"75 mm\", or `positions`",
        )),
    }
}

/// Whether the table says nothing about where the grippers start.
pub(super) fn is_open(keys: &GrippersTable) -> bool {
    keys.positions.is_none()
        && keys.spacing.is_none()
        && keys.height.is_none()
        && other_key(keys).is_none()
}

/// The start of a scene that only says where the ply is to lie, see [`start_above`]; `span` is the place in the scene that faults of it are
/// shown at.
pub(super) fn above(net: &Net, span: &Range<usize>, around: &Surroundings) -> Places {
    let points = start_above(around.ply, net);
    Places { points, document: around.document.clone(), spans: vec![span.clone()], height: None }
}

/// A key that has no place beside `positions` or a motion file.
pub(super) fn other_key(keys: &GrippersTable) -> Option<&'static str> {
    [
        ("origin", keys.origin.is_some()),
        ("middle", keys.middle.is_some()),
        ("direction", keys.direction.is_some()),
        ("parallel_to_mold", keys.parallel_to_mold.is_some()),
    ]
    .into_iter()
    .find_map(|(key, present)| present.then_some(key))
}

/// A rectangle of grippers: level, or parallel to the mold.
fn rectangle(
    keys: &GrippersTable,
    spacing: &Fixed<Quantity<Spacing>, 2>,
    height: &Quantity<Height>,
    around: &Surroundings,
    target: Option<&Target>,
) -> Result<Places, Error> {
    let &Surroundings { ply, turn, document, .. } = around;
    let place = spacing.0[0].span.start..spacing.0[1].span.end;
    let distances = spacing.read(document)?;
    let lift = height.read(document)?;
    let plane = plane_below(keys, around)?;
    let direction = match (&keys.direction, target.filter(|_| is_centered(keys))) {
        (Some(direction), _) => direction.read(document)? + turn,
        (None, Some(target)) => match target.drape.as_ref().filter(|_| ply.grid == Grid::NONE) {
            Some(net) => net.placement.heading,
            None => heading_of(&target.grippers, ply),
        },
        (None, None) => turn,
    };
    // gripper g0_0 as far from the middle of the ply, or from that of all grippers, as without a shift
    let unmoved = || Rectangle::on(&plane, [0.0; 2], direction);
    let shift = |[x, y]: [f64; 2], [a, b]: [f64; 2]| [x - a, y - b];
    let ply_at = |place: [f64; 2]| {
        let [a, b, _] = unmoved().point(ply, distances, ply.middle());
        shift(place, [a, b])
    };
    let origin = match (&keys.origin, &keys.middle) {
        (None, None) => [0.0; 2],
        (None, Some(place)) => ply_at(place.read(document)?),
        (Some(_), Some(place)) => {
            return Err(document.error(
                place.span.clone(),
                "the grippers have an `origin` and a `middle`",
                "keep one of them: `origin` is the place of gripper g0_0, `middle` that of the middle of the ply",
            ));
        }
        (Some(origin), None) => match (&origin.value, target) {
            (PlaceChoice::At(origin), _) => origin.read(document)?,
            (PlaceChoice::Centered, Some(target)) => {
                shift(middle(&target.grippers), middle(&unmoved().grippers(ply, distances)))
            }
            (PlaceChoice::Centered, None) => {
                return Err(document.error(
                    origin.span.clone(),
                    "the start shall be centered above the target, and the scene has no target",
                    "add [target], or give the place [x, y] of gripper g0_0",
                ));
            }
        },
    };
    let mut points = Rectangle::on(&plane, origin, direction).grippers(ply, distances);
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

/// Whether the rectangle shall be above the middle of the target.
fn is_centered(keys: &GrippersTable) -> bool {
    keys.origin.as_ref().is_some_and(|origin| matches!(origin.value, PlaceChoice::Centered))
}

/// The plane above which the rectangle lies: the mold, or z = 0.
fn plane_below(keys: &GrippersTable, around: &Surroundings) -> Result<Plane, Error> {
    let level = Plane { point: [0.0; 3], normal: [0.0, 0.0, 1.0] };
    let Some(parallel) = keys.parallel_to_mold.as_ref().filter(|parallel| parallel.value) else {
        return Ok(level);
    };
    let (message, help) = match around.mold {
        Some(Mold::Plane(plane)) => return Ok(*plane),
        Some(_) => (
            "the grippers shall be parallel to the mold, and the mold is curved",
            "remove `parallel_to_mold`: `height` is then the z of all grippers; or give their `positions`",
        ),
        None => (
            "the grippers shall be parallel to the mold, and the scene has no mold",
            "add [mold] with kind = \"plane\", or remove `parallel_to_mold`",
        ),
    };
    Err(around.document.error(parallel.span.clone(), message, help))
}

/// Mean place of all grippers in plan (m).
fn middle(points: &[[f64; 3]]) -> [f64; 2] {
    [0, 1].map(|n| points.iter().map(|point| point[n]).sum::<f64>() / points.len() as f64)
}

/// Mean heading of the lines of grippers along u (rad).
fn heading_of(points: &[[f64; 3]], ply: &Ply) -> f64 {
    if ply.grid == Grid::NONE {
        let [[x, y, _], _] = directions(ply, points);
        return y.atan2(x);
    }
    let grid = ply.grid;
    let across = |n: usize| -> f64 {
        (0..grid.nv)
            .map(|j| points[grid.index([grid.nu - 1, j])][n] - points[grid.index([0, j])][n])
            .sum()
    };
    across(1).atan2(across(0))
}

/// Refuses a start that cannot be: fabric too short, spans straight up, grippers in the mold.
pub(super) fn check(places: &Places, around: &Surroundings) -> Result<(), Error> {
    let &Surroundings { ply, mold, tolerance, .. } = around;
    places.check_reach(ply)?;
    places.check_run(ply, "at the start")?;
    let Some(mold) = mold else {
        return Ok(());
    };
    let depth = |point: &[f64; 3]| -mold.signed_distance(*point);
    let Some((index, point)) =
        places.points.iter().enumerate().find(|(_, point)| depth(point) > tolerance)
    else {
        return Ok(());
    };
    let id = gripper_name(ply.id(index));
    let depth_mm = depth(point) * 1e3;
    let message = match mold {
        Mold::Plane(_) => format!("gripper {id} starts {depth_mm:.2} mm below the mold"),
        _ => format!("gripper {id} starts inside the mold, {depth_mm:.2} mm from its surface"),
    };
    let mut help = "start above the mold: raise the grippers or lower the mold".to_string();
    // a level start clears the mold above its highest point under a gripper
    let tops = places.points.iter().filter_map(|&[x, y, _]| mold.highest_point([x, y]));
    let top = tops.map(|top| top[2]).fold(f64::NEG_INFINITY, f64::max);
    if places.height.is_some() && !matches!(mold, Mold::Plane(_)) && top.is_finite() {
        help += &format!("; below the grippers it reaches up to z = {:.1} mm", top * 1e3);
    }
    let mut error = places.error(index, message, help);
    if let (Error::Scene(fault), Some(height)) = (&mut error, &places.height) {
        fault.span = Some(height.clone());
    }
    Err(error)
}
