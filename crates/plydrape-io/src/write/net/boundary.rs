//! The boundary of the ply on its mold as a table and as DXF: `boundary.csv`, `boundary.dxf`.

use crate::Error;
use crate::write::csv::{number, text};
use crate::write::pattern;
use ::csv::Writer;
use plydrape::net::Boundary;

/// One row a point (m): its ring, 0 the outer boundary and then the holes; the part of the ring, counted from 1 where it leaves
/// the mold in between; its number from 1; fabric coordinates and place. A whole ring ends with its first point once more.
///
/// # Errors
/// If the table cannot be formed; memory apart there is no known case.
pub fn table(boundary: &Boundary) -> Result<String, Error> {
    let mut table = Writer::from_writer(Vec::new());
    table.write_record(["ring", "part", "point", "u (m)", "v (m)", "x (m)", "y (m)", "z (m)"])?;
    for (line, part) in boundary.lines.iter().zip(parts(boundary)) {
        let again = line.points.first().filter(|_| line.closed);
        for (n, point) in line.points.iter().chain(again).enumerate() {
            let mut row = vec![line.ring.to_string(), part.to_string(), (n + 1).to_string()];
            row.extend(point.fabric.iter().chain(&point.place).map(|value| number(*value)));
            table.write_record(&row)?;
        }
    }
    text(table)
}

/// The lines of the boundary in space as DXF, in millimeters.
#[must_use]
pub fn dxf(boundary: &Boundary) -> String {
    let line = |(line, part): (&plydrape::net::BoundaryLine, usize)| pattern::PatternLine {
        name: match line.ring {
            0 => format!("boundary {part}"),
            hole => format!("hole {hole}, part {part}"),
        },
        points: line.points.iter().map(|point| point.place).collect(),
        closed: line.closed,
    };
    let lines: Vec<pattern::PatternLine> =
        boundary.lines.iter().zip(parts(boundary)).map(line).collect();
    pattern::boundary::dxf(&lines)
}

/// The number of each line among those of its ring, from 1.
fn parts(boundary: &Boundary) -> Vec<usize> {
    let lines = &boundary.lines;
    (0..lines.len())
        .map(|n| lines[..=n].iter().filter(|line| line.ring == lines[n].ring).count())
        .collect()
}
