//! Lines in space for a laser projector, such as the boundary of a ply on the mold: as a table and as DXF.

use super::PatternLine;
use super::dxf_text::Text;
use crate::Error;
use crate::write::csv::{cell, number, text};
use ::csv::Writer;

/// One row a point (m): the line, the number of the point from 1, x, y, z. A closed line ends with its first point once more.
///
/// # Errors
/// If the table cannot be formed; memory apart there is no known case.
pub fn csv(lines: &[PatternLine]) -> Result<String, Error> {
    let mut table = Writer::from_writer(Vec::new());
    table.write_record(["polyline", "point", "x (m)", "y (m)", "z (m)"])?;
    for line in lines {
        let again = line.points.first().filter(|_| line.closed);
        for (n, point) in line.points.iter().chain(again).enumerate() {
            let [x, y, z] = point.map(number);
            table.write_record([&cell(&line.name), &(n + 1).to_string(), &x, &y, &z])?;
        }
    }
    text(table)
}

/// The lines as polylines in space on the layer `BOUNDARY` of a DXF text, in millimeters and in their order. Same lines, same
/// bytes.
#[must_use]
pub fn dxf(lines: &[PatternLine]) -> String {
    let mut text = Text::new(&[("BOUNDARY", 1)]);
    for line in lines {
        text.polyline_3d("BOUNDARY", &line.points, line.closed);
    }
    text.finish()
}
