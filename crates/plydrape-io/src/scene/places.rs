//! Gripper positions as written: by spacing, as a table, or in a CSV file.

use super::choice::{Positions, PositionsRow};
use super::located::Located;
use super::quantity::{Read, rounded};
use super::read;
use super::source::Document;
use super::table::{Column, Plain, Row, Table};
use super::units::Dimension;
use super::usual::Coordinate;
use crate::Error;
use plydrape::LayupError;
use plydrape::ply::{Grid, GripperId, Ply, gripper_name};
use std::ops::Range;

/// Largest coordinate of a gripper (m).
const FARTHEST: f64 = 1e4;
/// Distance over length of fabric from which a unit is more likely wrong than a distance.
const OTHER_UNIT: f64 = 300.0;
/// A chord this much longer than its fabric, as a share, is taut and not too long.
const TAUT: f64 = 1e-9;

/// Positions of all grippers, and where each was read.
#[derive(Debug)]
pub(super) struct Places {
    /// Positions (m) in the order of [`Grid::index`].
    pub points: Vec<[f64; 3]>,
    /// The file they were read from.
    pub document: Document,
    /// One span per gripper, or one for all.
    pub spans: Vec<Range<usize>>,
    /// The span of the height, if it is a key of its own.
    pub height: Option<Range<usize>>,
}

/// The columns of a table of positions.
const COLUMNS: [Column; 5] =
    [Column::named(&["i"], Dimension::NONE), Column::named(&["j"], Dimension::NONE), X, Y, Z];
/// The columns of coordinates.
pub(super) const X: Column = coordinate(&["x"]);
pub(super) const Y: Column = coordinate(&["y"]);
pub(super) const Z: Column = coordinate(&["z"]);

const fn coordinate(names: &'static [&'static str]) -> Column {
    Column { plain: Some(&PLAIN), ..Column::named(names, Dimension::LENGTH) }
}

/// The largest coordinate in meters without a unit, as in a scene.
const PLAIN: Plain =
    Plain { believed: [0.0, 2.0 * Coordinate::USUAL.found[1]], words: Coordinate::USUAL.range };

impl Places {
    /// Reads the key `positions`.
    pub fn read(
        positions: &Located<Positions>,
        ply: &Ply,
        scene: &Document,
    ) -> Result<Self, Error> {
        match &positions.value {
            Positions::Table(rows) => from_table(rows, &positions.span, ply, scene),
            Positions::File(name) => {
                let document = csv_file(name, &positions.span, scene)?;
                from_csv(document, ply)
            }
        }
    }

    /// An error at the gripper with an index.
    pub fn error(&self, index: usize, message: String, help: impl Into<String>) -> Error {
        let span = self.spans.get(index).or_else(|| self.spans.first());
        match span {
            Some(span) => self.document.error(span.clone(), message, help),
            None => self.document.error_anywhere(message, help),
        }
    }

    /// Refuses neighbors further apart than the ply between them.
    pub fn check_reach(&self, ply: &Ply) -> Result<(), Error> {
        // a line across the yarns may be longer than flat: the ply shears
        let fibers = ply.neighbors().into_iter().filter(|pair| pair.fiber.is_some());
        fibers.into_iter().try_for_each(|pair| {
            let [[u, v], [p, q]] = pair.grippers.map(|n| ply.place(n));
            let length = ply.length_factor * (p - u).hypot(q - v);
            let [from, to] = pair.grippers.map(|n| self.points[n]);
            let distance = norm([to[0] - from[0], to[1] - from[1], to[2] - from[2]]);
            if distance <= length * (1.0 + TAUT) {
                return Ok(());
            }
            let [a, b] = pair.grippers.map(|n| gripper_name(ply.id(n)));
            Err(self.error(
                pair.grippers[1],
                format!(
                    "grippers {a} and {b} are {:.2} mm apart at the start; the ply between them is {:.2} mm",
                    distance * 1e3,
                    length * 1e3
                ),
                if distance > OTHER_UNIT * length {
                    "is their unit right? a number without a unit is in meters: write \"98 mm\", and in the header of a table `x (mm)`"
                } else {
                    "bring the grippers closer together, or give the ply a longer `cell`"
                },
            ))
        })
    }

    /// Refuses positions that [`Ply::check_places`] refuses, such as neighbors that are almost straight above each other.
    pub fn check_run(&self, ply: &Ply, when: &str) -> Result<(), Error> {
        ply.check_places(&self.points).map_err(|fault| match fault {
            LayupError::GripperSteep { a, b, run, length, .. } => self.error(
                ply.index(b).unwrap_or(0),
                format!(
                    "grippers {} and {} are only {:.3} mm apart in plan {when}; the ply between them is {:.2} mm",
                    gripper_name(a),
                    gripper_name(b),
                    run * 1e3,
                    length * 1e3
                ),
                "move them apart: a span needs a horizontal distance of 1 % of its fabric or more",
            ),
            LayupError::GripperFar { gripper, position, .. } => self.error(
                ply.index(gripper).unwrap_or(0),
                format!(
                    "gripper {} is at {position:?} m {when}, out of all scale",
                    gripper_name(gripper)
                ),
                "coordinates are finite numbers: is the unit right?",
            ),
            other => self.document.error_anywhere(other.to_string(), "give every gripper one position"),
        })
    }
}

fn norm([x, y, z]: [f64; 3]) -> f64 {
    x.hypot(y).hypot(z)
}

/// A CSV file that a scene names.
pub(super) fn csv_file(
    name: &str,
    span: &Range<usize>,
    scene: &Document,
) -> Result<Document, Error> {
    read::table(&scene.path(name), name).map_err(|error| scene.error_of_named(span, error, "scene"))
}

fn from_table(
    rows: &[PositionsRow],
    span: &Range<usize>,
    ply: &Ply,
    scene: &Document,
) -> Result<Places, Error> {
    // rows and columns need an array of grippers along the yarns
    let grid = ply.grid;
    if grid == Grid::NONE {
        return Err(scene.error(
            span.clone(),
            "a table of positions has rows and columns, and the cups that hold this ply are no whole array along its yarns",
            "give the positions as a CSV file with the columns i, j, x, y, z, or `spacing` and `height`",
        ));
    }

    // a row for each gripper along v
    let help = format!(
        "give a row for every gripper along v ({}), each with a position [x, y, z] for every gripper along u ({})",
        grid.nv, grid.nu
    );
    if rows.len() != grid.nv {
        let message =
            format!("the number of rows in this table is {}, not {}", rows.len(), grid.nv);
        return Err(scene.error(span.clone(), message, help));
    }
    let mut places = Places {
        points: Vec::with_capacity(grid.grippers()),
        document: scene.clone(),
        spans: Vec::with_capacity(grid.grippers()),
        height: None,
    };

    // in each row a position for each gripper along u
    for row in rows {
        if row.value.len() != grid.nu {
            let message = format!(
                "the number of positions in this row is {}, not {}",
                row.value.len(),
                grid.nu
            );
            return Err(scene.error(row.span.clone(), message, help));
        }
        for position in &row.value {
            places.points.push(position.read(scene)?);
            places.spans.push(position.span.clone());
        }
    }
    Ok(places)
}

fn from_csv(document: Document, ply: &Ply) -> Result<Places, Error> {
    // each row puts one gripper at its place, and each gripper once
    let mut points = vec![None; ply.grippers()];
    let mut spans = vec![0..0; ply.grippers()];
    let header = {
        let csv = Table::new(&document, &COLUMNS, &[])?;
        for row in csv.rows() {
            let gripper = [row.whole(0)?, row.whole(1)?];
            let index = index(gripper, ply).map_err(|(m, h)| row.fault(0, m, h))?;
            if points[index].is_some() {
                return Err(row.fault(
                    0,
                    format!("gripper {} is listed for the second time", gripper_name(gripper)),
                    "give every gripper one row",
                ));
            }
            points[index] = Some(point(&row, [2, 3, 4])?);
            spans[index] = row.span.clone();
        }
        csv.check_plain()?;
        csv.header()
    };

    // no gripper is left without a place
    if let Some(missing) = points.iter().position(Option::is_none) {
        return Err(document.error(
            header,
            format!("gripper {} has no row", gripper_name(ply.id(missing))),
            format!("give every one of the {} grippers one row", ply.grippers()),
        ));
    }
    Ok(Places { points: points.into_iter().flatten().collect(), document, spans, height: None })
}

/// The index of a gripper, or why there is none with such an id.
pub(super) fn index(gripper: GripperId, ply: &Ply) -> Result<usize, (String, String)> {
    if let Some(index) = ply.index(gripper) {
        return Ok(index);
    }
    let grid = ply.grid;
    if grid == Grid::NONE {
        let message = format!("no gripper {} holds the ply", gripper_name(gripper));
        let last = ply.grippers() - 1;
        let (first, last) = (gripper_name(ply.id(0)), gripper_name(ply.id(last)));
        let help = format!(
            "{} cups hold it, from {first} to {last}; `plydrape check` shows them",
            ply.grippers()
        );
        return Err((message, help));
    }
    Err((
        format!("there is no gripper {}", gripper_name(gripper)),
        format!(
            "the ply has {} × {} grippers, from g0_0 to {}",
            grid.nu,
            grid.nv,
            gripper_name([grid.nu - 1, grid.nv - 1])
        ),
    ))
}

/// The position (m) in three columns of a row.
pub(super) fn point(row: &Row, columns: [usize; 3]) -> Result<[f64; 3], Error> {
    let mut point = [0.0; 3];
    for (coordinate, column) in point.iter_mut().zip(columns) {
        *coordinate = row.number(column)?;
        if coordinate.abs() > FARTHEST {
            return Err(row.fault(
                column,
                format!("this is {} m, out of all scale for a ply", rounded(*coordinate)),
                "a column without a unit is in meters: did you mean a header such as `x (mm)`?",
            ));
        }
    }
    Ok(point)
}
