//! How a robot carries the grippers.

use super::file::{AxisKey, AxisTable, JointsKey, PlacedTable, ToolTable};
use super::located::Located;
use super::placement::round;
use super::pose::pose;
use super::quantity::{Measure, Read, read_given, read_or};
use super::source::Document;
use crate::Error;
use plydrape::geometry::Pose;
use plydrape::layup::Layup;
use plydrape::measure::{Limits, Name};
use plydrape::tool::{Axis, Tool};

/// Longest stroke, as a multiple of the size of the array: a longer one is a slip of the unit.
const LONGEST: f64 = 10.0;

/// Checks the table `[tool]` of a layup whose grippers start at `start` (m).
pub(super) fn tool(
    table: &ToolTable,
    layup: &Layup,
    start: &[[f64; 3]],
    limits: &Limits,
    document: &Document,
) -> Result<Tool, Error> {
    // the axes of each gripper, at most one in each direction
    let mut axes: Vec<Axis> = Vec::new();
    for written in table.axes.iter().flat_map(|axes| &axes.value) {
        let axis = axis(written, start, limits, document)?;
        if axes.iter().any(|other| other.name == axis.name) {
            return Err(document.error(
                written.value.direction.span.clone(),
                format!("each gripper has two axes along {}", axis.name),
                "give each direction once: two axes along one are one with the stroke of both",
            ));
        }
        axes.push(axis);
    }

    // rates that are not given are the usual ones
    let usual = Tool::new(start, axes);
    Ok(Tool {
        turn_rate: read_or(&table.turn_rate, usual.turn_rate, document)?,
        turn_acceleration: read_or(&table.turn_acceleration, usual.turn_acceleration, document)?,
        fixed_pads: fixed_pads(table, layup, start, document)?,
        residual: read_given(&table.residual, document)?,
        flange: placed(table.flange.as_ref(), document)?,
        world: placed(table.world.as_ref(), document)?,
        ..usual
    })
}

/// The axes of pads without joints: those of the array at the start.
fn fixed_pads(
    table: &ToolTable,
    layup: &Layup,
    start: &[[f64; 3]],
    document: &Document,
) -> Result<Option<[[f64; 3]; 3]>, Error> {
    let Some(joints) = table.joints.as_ref().filter(|joints| joints.value == JointsKey::None)
    else {
        return Ok(None);
    };
    if layup.settings.pad.radius == 0.0 {
        return Err(document.error(
            joints.span.clone(),
            "a pad without a joint holds the ply in its direction, and these pads are points",
            "give the size of the pads, as in pad_radius = \"15 mm\" in [grippers]",
        ));
    }
    Ok(Some(layup.ply.flat_axes(start)))
}

fn placed<M: Measure>(table: Option<&PlacedTable<M>>, document: &Document) -> Result<Pose, Error> {
    match table {
        Some(PlacedTable { position, rotation }) => {
            pose(position.as_ref(), rotation.as_ref(), document)
        }
        None => Ok(Pose::ORIGIN),
    }
}

fn axis(
    written: &Located<AxisTable>,
    start: &[[f64; 3]],
    limits: &Limits,
    document: &Document,
) -> Result<Axis, Error> {
    // a stroke is counted from the start, so 0 is within it
    let table = &written.value;
    let stroke = table.stroke.read(document)?;
    if !(stroke[0] <= 0.0 && 0.0 <= stroke[1] && stroke[0] < stroke[1]) {
        return Err(document.error(
            table.stroke.span.clone(),
            "a stroke is counted from the start, and this one does not hold it",
            "write how far the axis goes back and how far it goes on from there, as in stroke = [\"-20 mm\", \"120 mm\"]",
        ));
    }

    // a stroke far longer than the array is a slip of the unit
    let across = diagonal(start);
    let length = stroke[1] - stroke[0];
    if across > 0.0 && length > LONGEST * across {
        return Err(document.error(
            table.stroke.span.clone(),
            format!(
                "a stroke of {} m is out of all scale for an array {} m across",
                round(length),
                round(across)
            ),
            "plain numbers are meters: write millimeters with their unit, as in stroke = [\"-20 mm\", \"120 mm\"]",
        ));
    }

    // direction and speed, which is that of the limits unless given
    let (name, direction) = match table.direction.value {
        AxisKey::X => ("x", [1.0, 0.0, 0.0]),
        AxisKey::Y => ("y", [0.0, 1.0, 0.0]),
        AxisKey::Z => ("z", [0.0, 0.0, 1.0]),
    };
    let speed = read_or(&table.speed, limits.most(Name::Speed), document)?;
    Ok(Axis { name: name.into(), direction, stroke, speed })
}

/// Length of the diagonal of the box around places (m).
fn diagonal(places: &[[f64; 3]]) -> f64 {
    let side = |n: usize| {
        let ends = places.iter().map(|p| p[n]);
        let low = ends.clone().fold(f64::INFINITY, f64::min);
        ends.fold(f64::NEG_INFINITY, f64::max) - low
    };
    side(0).hypot(side(1)).hypot(side(2))
}
