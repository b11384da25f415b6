//! The outline of a ply from a drawing that the scene names.

use super::drawing::OutlineChoice;
use super::file::DrawingTable;
use super::located::Located;
use super::read;
use super::source::Document;
use super::units::{self, Dimension};
use super::usual;
use crate::Error;
use crate::read::outline::{self, Options};
use plydrape::ply::Outline;
use std::path::Path;

/// How far a curve may be from the lines that stand for it (m), unless given: what a cutter keeps.
const TOLERANCE: f64 = 1e-4;

/// Reads the file that an outline names; none of an outline that is points.
pub(super) fn outline(
    key: &Located<OutlineChoice>,
    document: &Document,
    base: &Path,
) -> Result<Option<Outline>, Error> {
    let (name, span, options) = match &key.value {
        OutlineChoice::Points(_) => return Ok(None),
        OutlineChoice::File(name) => (name, &key.span, Options::new(TOLERANCE)),
        OutlineChoice::Drawing(table) => {
            (&table.file.value, &table.file.span, options(table, document)?)
        }
    };
    let bytes = read::bytes(&base.join(name), name, outline::LARGEST)
        .map_err(|error| document.error_of_named(span, error, "scene"))?;
    outline::read_dxf(name, &bytes, &options)
        .map(Some)
        .map_err(|error| document.error(span.clone(), error.to_string(), error.help()))
}

fn options(table: &DrawingTable, document: &Document) -> Result<Options, Error> {
    let names = |layers: &Vec<Located<String>>| layers.iter().map(|l| l.value.clone()).collect();
    let tolerance = match &table.tolerance {
        Some(tolerance) => tolerance.size(document, &usual::DRAWN)?,
        None => TOLERANCE,
    };
    let unit = match &table.unit {
        Some(unit) => Some(length(unit, document)?),
        None => None,
    };
    let layers = table.layers.as_ref().map(|layers| names(&layers.value));
    Ok(Options { layers, unit, ..Options::new(tolerance) })
}

/// Length of a unit by its name (m).
fn length(unit: &Located<String>, document: &Document) -> Result<f64, Error> {
    match units::unit(&unit.value) {
        Ok((value, Dimension::LENGTH)) => Ok(value),
        _ => Err(document.error(
            unit.span.clone(),
            format!("{} is no unit of length", document.quoted(&unit.span)),
            "write \"mm\", \"cm\", \"m\" or \"in\": the unit that the coordinates of the drawing are in",
        )),
    }
}
