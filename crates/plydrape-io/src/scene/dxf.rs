//! The outline of a ply from a drawing that the scene names, and which of its pieces it is.

use super::choice::OutlineChoice;
use super::file::{DrawingTable, PieceTable, PlyTable};
use super::located::Located;
use super::quantity::{Read, read_or};
use super::read;
use super::source::Document;
use super::units::{self, Dimension};
use crate::Error;
use crate::read::outline::{self, Drawn, Options, Piece};

/// How far a curve may be from the lines that stand for it, and the widest gap that is closed (m), unless given: what a cutter keeps.
pub(super) const TOLERANCE: f64 = 1e-4;

/// Reads the file that an outline names; `None` for an outline that is points.
pub(super) fn drawn(ply: &PlyTable, document: &Document) -> Result<Option<Drawn>, Error> {
    let choice = ply.outline.as_ref().map(|key| (&key.value, &key.span));
    let (name, span, mut options) = match choice {
        None | Some((OutlineChoice::Points(_), _)) => {
            return match &ply.piece {
                None => Ok(None),
                Some(piece) => Err(document.error(
                    piece.span.clone(),
                    "`piece` chooses one of the pieces of a drawing, and the ply has none",
                    "remove `piece`, or give the drawing, as in outline = \"nest.dxf\"",
                )),
            };
        }
        Some((OutlineChoice::File(name), span)) => (name, span, Options::new(TOLERANCE)),
        Some((OutlineChoice::Drawing(table), _)) => {
            (&table.file.value, &table.file.span, options(table, document)?)
        }
    };
    options.piece = ply.piece.as_ref().map(|table| piece(table, document)).transpose()?;
    let bytes = read::bytes(&document.path(name), name, outline::LARGEST)
        .map_err(|error| document.error_of_named(span, error, "scene"))?;
    outline::read_dxf(name, &bytes, &options).map(Some).map_err(|error| {
        // what the drawing lacks without a choice too is no fault of the choice
        let unchosen =
            || outline::read_dxf(name, &bytes, &Options { piece: None, ..options.clone() });
        let is_of_file = || unchosen().is_err_and(|other| other.to_string() == error.to_string());
        let place = ply.piece.as_ref().filter(|_| !is_of_file()).map(|piece| &piece.span);
        document.error(place.unwrap_or(span).clone(), error.to_string(), error.help())
    })
}

/// The piece that a table chooses.
fn piece(table: &Located<PieceTable>, document: &Document) -> Result<Piece, Error> {
    let refused = |message: &str| {
        document.error(
            table.span.clone(),
            message,
            "choose one piece: piece = { label = \"FRONT\" }, the text inside it, { block = \"P1\" }, or { point = [\"120 mm\", \"80 mm\"] }",
        )
    };
    let PieceTable { block, label, point } = &table.value;
    let blank = |name: &Located<String>| name.value.trim().is_empty();
    if [block, label].into_iter().flatten().any(blank) {
        return Err(refused("the name of the piece is empty"));
    }
    match (block, label, point) {
        (Some(block), None, None) => Ok(Piece::Block(block.value.trim().into())),
        (None, Some(label), None) => Ok(Piece::Label(label.value.trim().into())),
        (None, None, Some(point)) => Ok(Piece::Point(point.read(document)?)),
        (None, None, None) => Err(refused("`piece` chooses no piece")),
        _ => Err(refused("`piece` chooses in more than one way")),
    }
}

fn options(table: &DrawingTable, document: &Document) -> Result<Options, Error> {
    let names = |layers: &Vec<Located<String>>| layers.iter().map(|l| l.value.clone()).collect();
    let tolerance = read_or(&table.tolerance, TOLERANCE, document)?;
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
