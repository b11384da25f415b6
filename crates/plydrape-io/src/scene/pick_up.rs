//! How the ply is picked up from a table.

use super::file::{MotionKind, PickUpTable, SceneKeys};
use super::located::Located;
use super::quantity::{Read, read_given, read_or};
use super::source::Document;
use crate::Error;
use crate::store::shown::millimeters;
use plydrape::layup::{Layup, Model, PickUp};
use plydrape::motion::Motion;

/// How far above the ply the pads come from unless given (m).
pub(super) const CLEARANCE: f64 = 0.05;
/// How long they stand on it (s).
pub(super) const GRIP: f64 = 0.5;
/// How far they go back along the normals of the mold (m).
pub(super) const RETREAT: f64 = 0.02;
/// Height of a start over the table (of the shorter side of a cell) below which nothing could hang free.
const LEAST_LIFT: f64 = 0.05;

/// Checks the table `[pick_up]` of a scene, which may `also` be draped by the other model, and lets the motion of its layup begin on the table.
pub(super) fn pick_up(
    table: &Located<PickUpTable>,
    file: &SceneKeys,
    layup: &mut Layup,
    also: bool,
    document: &Document,
) -> Result<(), Error> {
    // the sheet alone can lie on a table
    let Located { value: keys, span } = table;
    if layup.settings.model == Model::Catenaries || also {
        return Err(document.error(
            span.clone(),
            "catenaries know no table from which a ply could be lifted",
            "drape it with the sheet alone, as kind = \"sheet\" in [model] does without `also`, or leave out [pick_up]",
        ));
    }

    // the table, and times and heights of the pick-up
    let (height, obstacle) = table_of(keys, span, layup, document)?;
    let mut pick_up = PickUp {
        height,
        clearance: read_or(&keys.clearance, CLEARANCE, document)?,
        grip: read_or(&keys.grip, GRIP, document)?,
        vacuum_timeout: read_given(&keys.vacuum_timeout, document)?,
        retreat: read_or(&keys.retreat, RETREAT, document)?,
        table: obstacle,
        lift_steps: 0,
    };

    // a motion from a file begins on the table itself, so that there is nothing to lift
    let start = layup.start().to_vec();
    let low = start.iter().map(|p| p[2]).fold(f64::INFINITY, f64::min);
    if file.motion.as_ref().is_some_and(|motion| motion.value.kind == MotionKind::File) {
        let least = LEAST_LIFT * layup.ply.shorter_side();
        if start.iter().any(|p| (p[2] - height).abs() > least) {
            return Err(document.error(
                span.clone(),
                format!(
                    "the motion's file begins at z = {} mm, and the ply lies at {} mm",
                    millimeters(low),
                    millimeters(height)
                ),
                "let it begin with the pads on the flat ply, or leave out [pick_up]",
            ));
        }
        layup.pick_up = Some(pick_up);
        return Ok(());
    }

    // other motions begin where the ply hangs free, and a lift from the table comes first
    if low - height < LEAST_LIFT * layup.ply.shorter_side() {
        return Err(document.error(
            span.clone(),
            format!(
                "the grippers hang the ply from z = {} mm, too low over its table at {} mm for it to hang free",
                millimeters(low),
                millimeters(height)
            ),
            "raise `height` in [grippers], or lower the table of [pick_up]",
        ));
    }

    let lift = pick_up.lift(&layup.ply, &start);
    pick_up.lift_steps = lift.len();
    layup.motion = lifted(&layup.motion, lift);
    layup.pick_up = Some(pick_up);
    Ok(())
}

/// The height of the table (m), and which obstacle it is.
fn table_of(
    keys: &PickUpTable,
    span: &std::ops::Range<usize>,
    layup: &Layup,
    document: &Document,
) -> Result<(f64, Option<usize>), Error> {
    // the obstacle that is the table, by its name
    let obstacles = layup.bodies.obstacles();
    let obstacle = match &keys.table {
        Some(name) => {
            let found = obstacles.iter().position(|obstacle| obstacle.name == name.value);
            Some(found.ok_or_else(|| {
                let names: Vec<String> =
                    obstacles.iter().map(|obstacle| format!("\"{}\"", obstacle.name)).collect();
                let help = match names.is_empty() {
                    true => {
                        "give the table as one of [[obstacles]], or its `height` in place of it"
                            .to_owned()
                    }
                    false => format!("name one of {}", names.join(", ")),
                };
                document.error(
                    name.span.clone(),
                    format!("no obstacle has the name {}", document.quoted(&name.span)),
                    help,
                )
            })?)
        }
        None => None,
    };

    // the ply lies at a given height, or on top of that obstacle
    let height = match (&keys.height, obstacle) {
        (Some(height), _) => height.read(document)?,
        (None, Some(n)) => obstacles[n].bounds()[1][2],
        (None, None) => {
            return Err(document.error(
                span.clone(),
                "the scene does not say how high the ply lies",
                "add height = \"20 mm\", or the name of an obstacle, as in table = \"table\"",
            ));
        }
    };
    Ok((height, obstacle))
}

/// A motion with steps of a lift before it, each as long as its own first one, or a second.
fn lifted(motion: &Motion, lift: Vec<Vec<[f64; 3]>>) -> Motion {
    let step = match motion.times.as_slice() {
        [first, second, ..] => second - first,
        _ => 1.0,
    };
    let later = step * lift.len() as f64;
    let mut times: Vec<f64> = (0..lift.len()).map(|k| step * k as f64).collect();
    times.extend(motion.times.iter().map(|time| later + time));
    let positions = lift.into_iter().chain(motion.positions.iter().cloned()).collect();
    Motion { times, positions }
}
