//! Molds that are a height over x and y: saddles, formulas and height grids.

use super::Keys;
use super::heights::heights;
use crate::Error;
use crate::read::formula;
use crate::scene::located::Located;
use crate::scene::placement::extent;
use crate::scene::quantity::Read;
use crate::scene::source::Document;
use plydrape::mold::{Graph, Mold, Saddle, Surface};
use plydrape::ply::Ply;
use std::ops::Range;

/// Checks the keys of a saddle.
pub(super) fn saddle(keys: &Keys) -> Result<Mold, Error> {
    let radii = keys.required(&keys.table.radii, "radii", "[\"800 mm\", \"500 mm\"]")?;
    let radii = radii.read(keys.document)?;
    let domain = range(keys)?;
    let pose = keys.upward_pose()?;
    Ok(Mold::Graph(Graph { pose, surface: Surface::Saddle(Saddle { radii }), domain }))
}

/// Checks the keys of a formula, which must be defined wherever the mold is.
pub(super) fn formula(keys: &Keys, ply: &Ply) -> Result<Mold, Error> {
    // the formula, and the range in which it is the mold
    let document = keys.document;
    let text = keys.required(&keys.table.z, "z", "\"0.1*x^2 - y^2\"")?;
    let z = formula::read(&text.value).map_err(|error| in_place(text, document, error))?;
    let domain = range(keys)?;

    // without a range it must be defined as far as the ply may reach
    let [u, v] = extent(ply);
    let reach = u.hypot(v);
    let looked_at = domain.unwrap_or([[-reach, reach]; 2]);
    if let Some([x, y]) = z.undefined_within(looked_at) {
        let help = match domain {
            Some(_) => {
                "make the range of `x` and `y` smaller, or write a formula that is smooth all over it"
            }
            None => {
                "say where the mold reaches, as in x = [\"-0.2 m\", \"0.2 m\"] and y = [\"-0.2 m\", \"0.2 m\"], or write a formula that is smooth everywhere"
            }
        };
        return Err(document.error(
            text.span.clone(),
            format!(
                "height, slope or curvature of the mold is not finite at x = {:.4} m, y = {:.4} m",
                x + 0.0,
                y + 0.0
            ),
            help,
        ));
    }
    let pose = keys.upward_pose()?;
    Ok(Mold::Graph(Graph { pose, surface: Surface::Formula { z }, domain }))
}

/// Checks the keys of a height grid, and reads its file.
pub(super) fn height_grid(keys: &Keys) -> Result<Mold, Error> {
    let file =
        keys.required(&keys.table.file, "file", "\"heights.csv\" with the columns x, y, z")?;
    let grid = heights(file, keys.document)?;
    let domain = Some(grid.range());
    let pose = keys.upward_pose()?;
    Ok(Mold::Graph(Graph { pose, surface: Surface::HeightGrid(grid), domain }))
}

/// The ranges of x and y, if they are given (m).
fn range(keys: &Keys) -> Result<Option<[[f64; 2]; 2]>, Error> {
    let (x, y) = match (&keys.table.x, &keys.table.y) {
        (Some(x), Some(y)) => (x, y),
        (None, None) => return Ok(None),
        (Some(one), None) | (None, Some(one)) => {
            let (present, other) = if keys.table.x.is_some() { ("x", "y") } else { ("y", "x") };
            return Err(keys.document.error(
                one.span.clone(),
                format!("the mold has a range `{present}` and no `{other}`"),
                format!("add {other} = [\"-0.2 m\", \"0.2 m\"], or remove `{present}`: the mold then has no boundary"),
            ));
        }
    };
    let mut ranges = [[0.0; 2]; 2];
    for (found, written) in ranges.iter_mut().zip([x, y]) {
        let [low, high] = written.read(keys.document)?;
        if low >= high {
            return Err(keys.document.error(
                written.span.clone(),
                "this range ends before it begins",
                "give the smaller end first, as in [\"-0.2 m\", \"0.2 m\"]",
            ));
        }
        *found = [low, high];
    }
    Ok(Some(ranges))
}

/// A fault of a formula at its place in the scene.
fn in_place(text: &Located<String>, document: &Document, error: Error) -> Error {
    match error {
        Error::Scene(fault) => {
            let at = fault.span.unwrap_or_default();
            document.error(inside(text, document, &at), fault.message, fault.help)
        }
        other => other,
    }
}

/// The place of some bytes of a text within its quotes; the whole text where it is written with escapes.
fn inside(text: &Located<String>, document: &Document, at: &Range<usize>) -> Range<usize> {
    let written = document.text.get(text.span.clone()).unwrap_or_default();
    let quoted = |quote: char| format!("{quote}{}{quote}", text.value);
    if written != quoted('"') && written != quoted('\'') || at.is_empty() {
        return text.span.clone();
    }
    let start = text.span.start + 1;
    start + at.start..start + at.end
}
